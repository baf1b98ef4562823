"""Tables that `make test-faults` and `make test-strangers` write: rows change only where tried anew."""

import importlib.util
import random
import re
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
PAGES = {"faults": "docs/faults.md", "strangers": "docs/machines.md"}


def program_of(folder):
    """The program of one of the two targets, as a module."""
    spec = importlib.util.spec_from_file_location(f"run_of_{folder}", TESTS / folder / "run.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look their module up
    spec.loader.exec_module(module)
    return module


def rows_of(page):
    """Rows of the table between the marks, by their first cell."""
    table = page.read_text("utf-8").partition("<!-- table -->\n")[2].partition("<!-- end -->")[0]
    rows = [re.findall(r"[^|]+", line.strip("| ")) for line in table.splitlines()[2:]]
    return {first.strip(): [cell.strip() for cell in rest] for first, *rest in rows}


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("folder", PAGES)
def test_rows_that_were_not_tried_stay_as_they_were(folder, seed, tmp_path):
    """Drawn rows of the page in use: some tried anew, some not tried, some not named; and a new one."""
    draw = random.Random(seed)
    page = tmp_path / "page.md"
    page.write_text((TESTS.parent / PAGES[folder]).read_text("utf-8"), "utf-8")
    former, around = rows_of(page), re.split(r"(?s)<!-- table -->.*<!-- end -->", page.read_text("utf-8"))
    width = len(next(iter(former.values())))
    expected, rows = dict(former), []
    for what in draw.sample([*former], len(former)):
        fate = draw.choice(["anew", "not tried", "not named"])
        if fate == "anew":
            cells = [f"EXIT {draw.randrange(9)}:\nit broke"] + ["exit 0"] * (width - 1)
            expected[what] = [cells[0].replace("\n", " "), *cells[1:]]
            rows.append((what, *cells))
        elif fate == "not tried":
            rows.append((what, "not tried: mount: must be superuser") + ("",) * (width - 1))
    rows.append(("a row of its own", "not tried: no program") + ("x",) * (width - 1))
    expected["a row of its own"] = [*rows[-1][1:]]
    program_of(folder).write(page, rows)
    assert list(rows_of(page).items()) == list(expected.items())
    assert re.split(r"(?s)<!-- table -->.*<!-- end -->", page.read_text("utf-8")) == around
