"""A configuration of another folder, whose chapters the present folder does not have."""

from pathlib import Path

CONFIG = Path(__file__).parents[2] / "config"


def test_a_folder_without_chapters_is_named(commands, tmp_path, monkeypatch):
    """The message names neither a missing function nor a file that does not exist."""
    monkeypatch.chdir(tmp_path)
    code, out, err = commands("prune", "--config", CONFIG)
    assert (code, out) == (2, "")
    assert "the present folder has no chapters" in err
    assert "defines no function" not in err
