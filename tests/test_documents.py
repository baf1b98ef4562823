"""What is written about the project agrees with the project."""

import difflib
import json
import re
import subprocess
import sys
import tomllib
from functools import cache
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import jsonschema
import pytest
import typer
from ruamel.yaml import YAML

from made_parts import MARK
from make_reference import made
from riserstudy.cli import app
from riserstudy.effects.catalogue import catalogue

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
EDITED = [
    ROOT / "config/config.yaml",
    *sorted((ROOT / "config/studies").glob("*.yaml")),
    *sorted((ROOT / "config/scenes").glob("*/*.yaml")),
    *sorted((ROOT / "examples").glob("*/config/**/*.yaml")),
]


MADE = made()


@pytest.mark.parametrize("path", MADE, ids=lambda path: path.name)
def test_what_is_written_from_the_models_is_up_to_date(path):
    stands, should = path.read_text("utf-8"), MADE[path]
    difference = difflib.unified_diff(stands.splitlines(), should.splitlines(), lineterm="")
    assert stands == should, "run `python workflow/scripts/make_reference.py`:\n" + "\n".join(difference)


@cache
def schema(path):
    """What validates by a schema, which is checked itself once: that takes longer than a scene."""
    content = json.loads(path.read_text("utf-8"))
    kind = jsonschema.validators.validator_for(content)
    kind.check_schema(content)
    return kind(content)


@pytest.mark.parametrize("path", EDITED, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_the_schema_that_a_first_line_names_accepts_its_file(path):
    first = path.read_text("utf-8").partition("\n")[0]
    named = (path.parent / first.removeprefix("# yaml-language-server: $schema=")).resolve()
    assert named.parent == ROOT / "workflow/schemas"
    schema(named).validate(YAML(typ="safe", pure=True).load(path))


@pytest.mark.parametrize(
    "wrong", [{"depth": "3 m"}, {"gravity": 9.81}, {"gravity": {"assumed": "9.81 m/s^2"}}, {"riser": []}]
)
def test_the_schema_refuses_what_a_scene_cannot_say(wrong):
    scene = YAML(typ="safe", pure=True).load(ROOT / "config/scenes/bench/s2c.yaml")
    with pytest.raises(jsonschema.ValidationError):
        schema(ROOT / "workflow/schemas/scene.schema.json").validate(scene | wrong)


def anchor(heading):
    """Address of a heading within a page."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_within_the_project_lead_somewhere(page):
    text = re.sub(r"```.*?```", "", page.read_text("utf-8"), flags=re.S)
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"\w+:", target):
            continue
        path, _, place = target.partition("#")
        linked = (page.parent / path).resolve() if path else page
        assert linked.exists(), target
        if place:
            headings = re.findall(r"^#+ (.*)$", linked.read_text("utf-8"), re.M)
            assert place in {anchor(heading) for heading in headings}, target


def build(docs, target, builder):
    """Build the pages as `make docs` does."""
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "-b", builder, docs, target]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.mark.long
def test_the_site_builds_and_needs_no_network(tmp_path):
    site = tmp_path / "site"
    done = build(ROOT / "docs", site, "html")
    assert (done.returncode, done.stderr) == (0, "")
    loads = re.compile(r"<(?:script|img|link|iframe|source)\b[^>]*?(?:src|href)=[\"\']((?:\w+:)?//[^\"\']+)")
    within = re.compile(r"(?:url\(|@import\s+(?:url\()?)\s*[\"\']?((?:https?:)?//[^\"\')]+)")
    for page in site.rglob("*.html"):
        text = page.read_text("utf-8")
        assert not loads.findall(text), page
        assert not within.findall(text), page
        assert "\\frac" not in re.sub(r"<pre>.*?</pre>", "", text, flags=re.S), page
    for style in site.rglob("*.css"):
        assert not within.findall(style.read_text("utf-8")), style
    assert (site / "theory.html").read_text("utf-8").count("<math") > 80
    for page in ("sweep", "client_table"):
        notebook = json.loads((site / f"{page}.ipynb").read_text("utf-8"))
        assert {cell["cell_type"] for cell in notebook["cells"]} == {"markdown", "code"}
        assert f'href="{page}.ipynb"' in (site / f"{page}.html").read_text("utf-8")
    formulas = formulas_of(site)
    assert len(formulas) > 200
    for page, formula in formulas:
        assert not operators_in_fractions(formula), (page, ElementTree.tostring(formula))


def formulas_of(site):
    """Every formula of a site, with its page."""
    return [
        (page.name, ElementTree.fromstring(found))
        for page in site.rglob("*.html")
        for found in re.findall(r"<math.*?</math>", page.read_text("utf-8"), re.S)
    ]


def operators_in_fractions(formula):
    """Operators that stand alone above or below a bar, where a reader of TeX took too little."""
    return [part for fraction in formula.iter("mfrac") for part in fraction if part.tag == "mo"]


def test_fractions_and_indices_are_drawn_as_tex_has_them(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    drawn = import_module("mathml").mathml
    (half,) = ElementTree.fromstring(drawn(r"\tfrac12 - \beta")).iter("mfrac")
    assert [part.text for part in half] == ["1", "2"]
    assert drawn(r"\frac12") == drawn(r"\frac{1}{2}")
    indexed = ElementTree.fromstring(drawn(r"\hat a_{k+1}"))
    assert [part.tag for part in indexed.find("msub")] == ["mover", "mrow"]
    assert ElementTree.fromstring(drawn(r"\sum_i^n x_i", as_block=True)).find("munderover") is not None


@pytest.mark.long
def test_every_function_command_and_effect_has_its_place_on_the_site(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    made = import_module("made_pages").MAKERS
    functions = made["functions"]("")
    assert all(f"riserstudy.{name}" in functions for name in ("simulate", "load_scene"))
    text = made["commands"]("")
    listed = text.partition("**Commands**")[2].partition("\n## ")[0]
    assert "import" in listed
    assert "..." not in listed
    for command in typer.main.get_command(app).commands:
        assert f"## `riserstudy {command}`" in text
    assert all(f"| {name} |" in made["called_by"]("") for name in catalogue())


def test_no_page_that_a_checkout_points_to_is_an_empty_shell():
    """What the site makes stands in the page too, wherever a reader of README comes to it."""
    readme = (ROOT / "README.md").read_text("utf-8")
    pages = {ROOT / name for name in re.findall(r"\]\((docs/\w+\.md)", readme)}
    pages |= {ROOT / f"docs/{name}.md" for name in ("variables", "effects", "validation")}
    for page in pages:
        for found in MARK.finditer(page.read_text("utf-8")):
            if found[1] != "laws":  # whole docstrings, of which the page lists the first sentences
                assert len((found["kept"] or "").splitlines()) > 3, f"{page.name}: {found[1]}"


@pytest.mark.long
def test_a_link_that_leads_nowhere_stops_the_build(tmp_path):
    """With the settings of the site, on a page of its own."""
    for part in ("conf.py", "_extensions", "_static"):
        (tmp_path / part).symlink_to(ROOT / "docs" / part)
    targets = ("index.md", "absent.md", "index.md#nowhere")
    links = "\n".join(f"[more]({target})" for target in targets)
    (tmp_path / "index.md").write_text(f"# One page\n\n{links}\n")
    done = build(tmp_path, tmp_path / "site", "dummy")
    assert done.returncode != 0
    warnings = done.stderr.splitlines()
    assert ["absent" in warnings[0], "nowhere" in warnings[1], len(warnings)] == [True, True, 2]


def test_the_version_is_one():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    cited = YAML(typ="safe", pure=True).load(ROOT / "CITATION.cff")
    described = [json.loads((ROOT / name).read_text("utf-8")) for name in ("codemeta.json", ".zenodo.json")]
    assert {project["version"], cited["version"], *(one["version"] for one in described)} == {
        project["version"]
    }
    assert project["license"] == cited["license"]


def test_the_style_of_the_pages_names_images_as_the_built_pages_do():
    """Sphinx copies all images into one folder; a style for a folder of ``docs/images`` has no effect."""
    style = (ROOT / "docs/_static/site.css").read_text("utf-8")
    named = re.findall(r'\[src\*="([^"]+)"\]', style)
    images = [path.name for path in (ROOT / "docs/images").rglob("*.*")]
    assert named
    assert [part for part in named if not any(part in image for image in images)] == []


def test_drawings_of_effects_have_the_text_by_which_the_style_finds_them():
    style = (ROOT / "docs/_static/site.css").read_text("utf-8")
    (start,) = re.findall(r'img\[alt\^="([^"]+)"\]', style)
    drawn = re.findall(r"!\[([^\]]*)\]\(images/effects/", (ROOT / "docs/effects.md").read_text("utf-8"))
    assert len(drawn) == len(catalogue())
    assert [text for text in drawn if not text.startswith(start)] == []
