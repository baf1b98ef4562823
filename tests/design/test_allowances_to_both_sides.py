"""The allowance of a sea covers motions to both sides of the riser at rest, whatever its sign there."""

import numpy as np
import pytest
from random_rigs import written
from rigs_in_waves import in_waves, limited

from riserstudy import simulate
from riserstudy.design.sea_allowances import allowances
from riserstudy.errors import InputError
from riserstudy.scene.at_rest import static
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.study.in_sea import Sea, in_sea

SEA = Sea(4.0, 10.0)
UNITS = {"lfj_angle": "rad", "ufj_angle": "rad"}


def file_of(seed, spatial, side):
    """A rig in waves with an offset to one side and limits that no demand reaches."""
    tree = in_waves(seed, spatial, 17, "4 m", 20, 30.0, [0.1], [60, 80])
    depth = -float(tree["water"]["seabed"])
    tree["platform"]["position"]["surge"] = side * 0.01 * depth
    return limited(tree, dict.fromkeys(UNITS, 1e3), UNITS)


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_an_allowance_covers_every_output_of_the_run(seed, spatial, side):
    file = file_of(seed, spatial, side)
    found = {
        limit.output: one for limit, one in zip(file.resolved().limits, allowances(file, SEA, 1), strict=True)
    }
    at_rest = run(static(file.resolved())).arrays
    moving = simulate(in_sea(file, SEA, 1))
    for name, one in found.items():
        if one.missing:
            assert "as estimated" in one.missing
            continue
        still = float(np.ravel(at_rest[f"{name}_static"])[0])
        swing = np.abs(moving[name].values - still).max()
        assert one.value >= swing * (1.0 - 1e-6), name
        assert one.value > 0.0


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_an_allowance_covers_the_motion_at_every_node_of_a_section(seed, spatial):
    """Where a section is largest at rest it can move little; at other offsets its other nodes govern."""
    tree = in_waves(seed, spatial, 19, "4 m", 20, 30.0, [0.1], [240])
    of_stress = {"output": "von_mises_stress", "largest": "1e6 MPa", "mode": "drilling"}
    of_moment = {"output": "bending_moment", "largest": "1e6 MN*m", "mode": "drilling"}
    of_tension = {"output": "effective_tension", "smallest": "-1e6 MN", "mode": "drilling"}
    file = SceneFile("rig.yaml", written(tree) | {"limits": [of_stress, of_moment, of_tension]})
    none = dict.fromkeys(("analysis.duration", "analysis.output", "analysis.step"))
    still, moving = simulate(file.with_values(none, "test")), simulate(in_sea(file, SEA, 1))
    ends = np.cumsum([0.0, *(section.total_length for section in file.resolved().riser)])
    tried = 0
    for limit, one in zip(file.resolved().limits, allowances(file, SEA, 1), strict=True):
        if one.missing:
            continue
        rest = still[f"{limit.output}_static"]
        for section, low, up in zip(file.resolved().riser, ends, ends[1:], strict=False):
            of = slice(low - 1e-6, up + 1e-6)
            above, below = (
                float((sign * (moving[f"{limit.output}_{end}"] - rest)).sel(s_node=of).max())
                for sign, end in ((1.0, "max"), (-1.0, "min"))
            )
            sided = {"von_mises_stress": above, "effective_tension": below}
            motion = sided.get(limit.output, max(above, below))
            assert one.by_place[section.name] >= motion * (1.0 - 1e-6), (limit.output, section.name)
            tried += 1
    assert tried


VESSEL = {"mass": "6e7 kg", "hull_drag": "6e5 N*s^2/m^2", "wave_drift": {"force": "1 MN", "heading": "0 deg"}}


def departing(file, kind, seed):
    """The rig with a further event or motion during its runs in a sea."""
    early = f"{np.random.default_rng(seed).uniform(2.0, 20.0)} s"
    if kind == "vessel":
        return {"vessel": VESSEL, "top.x": "vessel", "platform.position": None}
    if kind == "top.tension_loss":
        loss = {"share": 0.3, "at": early, "over": "2 s"}
        return {
            "top": {"x": "platform", "z": "free", "tension": "9 MN", "rotation": "free", "tension_loss": loss}
        }
    return {kind: {"at": early, "cylinders": [0]}}


@pytest.mark.parametrize("kind", ["vessel", "top.tension_loss", "top.tensioners.failing"])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(2))
def test_what_moves_or_loads_the_riser_without_the_sea_is_no_allowance_of_the_sea(
    seed, spatial, kind, monkeypatch
):
    file = file_of(seed, spatial, 1.0)
    other = file.with_values(departing(file, kind, seed), "test")
    other.resolved()  # the scene itself is allowed
    monkeypatch.setattr("riserstudy.design.sea_allowances.run", None)  # refused before the first run
    with pytest.raises(InputError, match=kind):
        allowances(other, SEA, 1)
