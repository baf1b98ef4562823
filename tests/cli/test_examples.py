"""Every command has an example in its help, and says what it has written."""

import re
import shlex
from pathlib import Path

import pytest
import typer
import yaml

from riserstudy.cli import app
from riserstudy.cli.examples import EXAMPLES

ROOT = Path(__file__).parents[2]
COMMANDS = typer.main.get_command(app).commands
SCENE = """\
title: hung
riser:
  - {name: pipe, length: 250 m, axial_stiffness: 5e9 N, submerged_weight: 1 kN/m}
bottom: {hold: wellhead, elevation: 0 m}
top: {z: free, tension: 1 MN}
analysis: {mesh: {elements: 10}}
"""


def test_every_command_has_an_example():
    assert set(EXAMPLES) == set(COMMANDS)


def test_the_help_has_five_groups():
    assert [*dict.fromkeys(of.rich_help_panel for of in COMMANDS.values())] == [
        *("Simulate", "Inspect", "Design", "Files", "Results")
    ]


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_shows_every_word_of_its_text(name, commands):
    """Names of extras are in square brackets: ``pip install "riserstudy[formats]"``."""
    _, shown, _ = commands(name, "--help")
    assert "".join(COMMANDS[name].help.split()) in "".join(shown.split())


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_a_command_line_that_is_understood(name):
    """All its options exist, and all that it needs are there."""
    words = shlex.split(EXAMPLES[name].partition(" > ")[0])
    assert words[:2] == ["riserstudy", name]
    context = COMMANDS[name].make_context(name, words[2:])
    assert context.params
    assert EXAMPLES[name] in " ".join(COMMANDS[name].epilog.split())


def test_studies_of_the_repository_in_examples_exist():
    """A dataset of results/, and the argument of ``results``; ``mine`` stands for a study of a user."""
    studies = {
        (file.stem, name)
        for file in (ROOT / "config/studies").glob("*.yaml")
        for name in yaml.safe_load(file.read_text("utf-8")).get("studies", {})
    }
    named = re.findall(r"results[ /](\w+)/(\w+)", " ".join(EXAMPLES.values()))
    assert len(named) == 3
    assert {pair for pair in named if pair[0] != "mine"} <= studies


@pytest.mark.parametrize("command, target", [("draw", "a.png"), ("run", "a.nc"), ("table", "a.csv")])
def test_a_command_that_succeeds_names_the_file(command, target, tmp_path, monkeypatch, commands):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.yaml").write_text(SCENE)
    assert commands(command, "scene.yaml", "-o", target)[1].splitlines()[-1] == f"written: {target}"
    assert (tmp_path / target).stat().st_size > 0
