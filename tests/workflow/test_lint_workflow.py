"""The linter of the workflow: what the locks answer is passed over, and nothing else."""

import pytest

import lint_workflow

SAID = """Lints for rule figure (line 4, figures.smk):
    * Specify a conda environment or container for each rule.:
      This way, the used software is documented.
{more}
"""
LOG = """    * No log directive defined:
      Without a log directive, all output is printed to the terminal.
"""


@pytest.mark.parametrize("more, titles", [("", []), (LOG, ["No log directive defined"])])
def test_only_an_environment_for_each_rule_is_passed_over(more, titles):
    assert lint_workflow.wanted(SAID.format(more=more)) == titles


@pytest.mark.parametrize(
    "code, said, status",
    [
        (0, "Congratulations", 0),
        (1, SAID.format(more=""), 0),
        (1, SAID.format(more=LOG), 1),
        (1, "SyntaxError", 1),
    ],
)
def test_the_exit_status_is_that_of_what_is_left(monkeypatch, capsys, code, said, status):
    class Done:
        returncode, stdout, stderr = code, said, ""

    monkeypatch.setattr(lint_workflow.subprocess, "run", lambda *a, **k: Done)
    assert lint_workflow.main() == status
    assert bool(capsys.readouterr().out) == bool(status)
