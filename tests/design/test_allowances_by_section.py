"""A limit of the whole riser has the offsets that its sections have together, in calm water and in a sea."""

import numpy as np
import pytest
from rigs_in_waves import in_waves, limited

from riserstudy.design.envelope import envelope
from riserstudy.design.operability import AtRest
from riserstudy.design.sea_allowances import allowances
from riserstudy.study.in_sea import Sea

SEA = Sea(5.0, 11.0)
UNITS = {"von_mises_stress": "Pa", "bending_moment": "N*m", "effective_tension": "N"}
SEEDS = (2, 3)


def tree_of(seed, spatial):
    tree = in_waves(seed, spatial, 31, "5 m", 20, 30.0, [0.1], [320])
    tree["current"]["profile"]["surface_speed"] = 0.4
    return tree


def ends(file, reach, seas):
    """Offsets at which an envelope ends (m), infinite if it does not end; and whether all is evaluated."""
    found = envelope(file, reach, [0.4], seas, 1)
    (row,) = found.table.rows
    none = row[5] == row[6] == ""
    low, high = (
        np.nan if none else end if one is None else one
        for one, end in zip(row[3:5], (-np.inf, np.inf), strict=True)
    )
    return (low, high), not found.missing


@pytest.mark.long
@pytest.mark.parametrize("output", UNITS)
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_the_whole_riser_has_the_offsets_of_all_of_its_sections(seed, spatial, output):
    tree = tree_of(seed, spatial)
    reach = -0.05 * tree["water"]["seabed"]
    names = [section["name"] for section in tree["riser"]]
    assert len(names) > 1
    side = "smallest" if output == "effective_tension" else "largest"
    at = AtRest(limited(tree, {output: 1e12}, UNITS).resolved(), reach)
    still, far = (
        {
            row["where"]: row[side]
            for row in at.extremes(x)
            if row["output"] == output and row["where"] in names
        }
        for x in (0.0, 0.8 * reach)
    )
    some = limited(tree, {output: 1e12}, UNITS)
    value = 0.5 * (max(still.values()) + max(far.values()))
    if side == "smallest":  # met with a margin that the sea takes about
        value = 0.5 * min(still.values())
    else:
        added = allowances(some, SEA, 1)[0]
        value += 0.0 if added.missing else added.value
    limit = {"output": output, side: f"{value!r} {UNITS[output]}", "mode": "drilling"}
    whole = some.with_values({"limits": [limit]}, "test")
    parts = some.with_values({"limits": [limit | {"at": name} for name in names]}, "test")
    for seas in ([], [SEA]):
        (one, known), (other, too) = (ends(file, reach, seas) for file in (whole, parts))
        assert known == too
        if known:
            np.testing.assert_allclose(one, other, atol=0.2)
