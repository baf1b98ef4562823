"""Printed figures by the names of ours and by the entries of papers' files."""

import random

import pytest

from riserstudy.records.printed_figures import figures_in, number_of


@pytest.mark.parametrize("seed", range(20))
def test_an_entry_names_the_figures_it_was_written_from(seed):
    rng = random.Random(seed)
    wanted, parts = set(), []
    for _ in range(rng.randint(1, 6)):
        kind, first = rng.randrange(3), rng.randint(1, 40)
        if kind == 0:
            last = first + rng.randint(1, 9)
            wanted |= set(range(first, last + 1))
            parts.append(f"{first} to {last}")
        elif kind == 1:
            wanted.add(first)
            parts.append(f"{first}{rng.choice(['', 'a', 'c'])}")
        else:  # another place, whose number is none of a figure
            parts.append(rng.choice(["text", f"section {first}.{first}", f"conclusion {first}"]))
    assert figures_in(", ".join(parts)) == wanted


@pytest.mark.parametrize(
    "text", ["Fig. 8", "figure 8", "8-10", "8 to", "10 to 8", "8 to 9 to 10", "8.2", "²"]
)
def test_an_entry_that_is_no_figure_is_refused(text):
    with pytest.raises(ValueError, match="not the number of a figure"):
        figures_in(text)


def test_names_of_ours_carry_the_printed_number():
    assert [number_of(name) for name in ("fig08", "fig12", "fig", "figure8", "8")] == [8, 12, *[None] * 3]
