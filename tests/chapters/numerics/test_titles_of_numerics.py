"""Titles of the numerics figures hold for all their data: every mesh, and scenes that are not judged."""

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.answers import OWN
from chapters.numerics.figures.cost import cost, over_lowest_cost
from chapters.numerics.figures.long_runs import answer as of_long_runs
from chapters.numerics.figures.random_scenes import answer as of_random_scenes
from chapters.numerics.figures.random_scenes import not_judged
from chapters.numerics.report.section import section


def runs(draw):
    """Runs of three cases on uniform and graded meshes, and on the uniform mesh of a paper."""
    rows = [
        (case, "ESDIRK4", mesh) for case in ("a", "b", "c") for mesh in ("even", "graded") for _ in range(3)
    ]
    rows.append(("a", OWN, ""))
    case, method, mesh = (np.array(column) for column in zip(*rows, strict=True))
    wrong = 10.0 ** draw.uniform(-1.9, 0.0, len(rows))
    for kind, chance in (("graded", 0.6), ("even", 0.03), ("", 0.3)):
        good = (mesh == kind) & (draw.random(len(rows)) < chance)
        wrong[good] = draw.uniform(1e-4, 9e-3, good.sum())
    return xr.Dataset(
        {
            "case": ("run", case),
            "method": ("run", method),
            "mesh": ("run", mesh),
            "error_moment": ("run", wrong),
            "cpu_seconds": ("run", np.ones(len(rows))),
        }
    )


@pytest.mark.parametrize("seed", range(60))
def test_only_graded_meshes_are_named_where_no_uniform_one_is_as_accurate(seed):
    """The mesh of a paper is uniform."""
    of = runs(np.random.default_rng(seed))
    rows = list(zip(*(of[name].values.tolist() for name in ("case", "mesh", "error_moment")), strict=True))
    accurate = {case for case, _, error in rows if error <= 0.01}
    uniform = any(mesh != "graded" and error <= 0.01 for _, mesh, error in rows)
    said = of_long_runs(of)
    if len(accurate) == 3 and not uniform:
        assert said == "In long simulations, only graded meshes reach a moment error below 1 %"
    else:
        assert said == f"{len(accurate)} of 3 long simulations reach a moment error below 1 %"


@pytest.mark.parametrize("seed", range(30))
def test_counts_of_random_scenes_add_up_to_all_of_them(seed):
    draw = np.random.default_rng(seed)
    true = draw.uniform(0.0, 0.012, draw.integers(1, 30))
    true[draw.random(len(true)) < 0.2 * (seed % 4)] = np.nan
    of = xr.Dataset({"true": ("drawn", true)}, attrs={"requested": 0.01})
    title, beside = of_random_scenes(of), not_judged(of)
    numbers = [[int(word) for word in said.split() if word.isdigit()] for said in (title, beside)]
    met, left = sum(one <= 0.01 for one in true), sum(one != one for one in true)
    judged = len(true) - left
    assert numbers[1] == ([left] if left else [])
    if judged == 0:
        assert numbers[0] == [left]
        return
    assert numbers[0] == ([met] if met == judged else [met, judged])
    assert ("judged" in title) == bool(left)


@pytest.mark.parametrize("seed", range(20))
def test_the_time_to_find_a_mesh_is_divided_by_that_of_a_run_within_the_tolerance(seed):
    """Such a run may have a larger error than the run to the tolerance, and the axis says so."""
    draw = np.random.default_rng(seed)
    times, wrong = 10.0 ** draw.uniform(-2.0, 0.0, 30), 10.0 ** draw.uniform(-3.0, -1.0, (3, 30))
    wrong[:, 0] = 0.009  # one of the runs is within the tolerance
    reached, spent = 10.0 ** draw.uniform(-3.0, -2.0, 3), draw.uniform(0.5, 2.0)
    names = ("displacement", "moment", "tension")
    data = {
        "wall_seconds": (("scene", "rung"), times[None]),
        "request_scene": ("request", ["S2"]),
        "requested": ("request", [0.01]),
        "request_seconds": ("request", [spent]),
        "request_last_seconds": ("request", [0.3 * spent]),
    }
    for k, name in enumerate(names):
        data[f"error_{name}"] = (("scene", "rung"), wrong[k][None])
        data[f"reached_{name}"] = ("request", [reached[k]])
    of = xr.Dataset(data, {"scene": ["S2"]})
    allowed = [time for time, errors in zip(times, wrong.T, strict=True) if all(errors <= 0.01)]
    every, last, missing = over_lowest_cost(of, "S2")
    assert not missing
    assert (every, last) == pytest.approx((spent / min(allowed), 0.3 * spent / min(allowed)))
    ratios = next(ax for ax in cost(of).axes if ax.get_title(loc="left").startswith("(c)"))
    label = " ".join(ratios.get_xlabel().split())
    assert label == "time / time of the cheapest single run within the tolerance"


@pytest.mark.parametrize("seed", range(20))
def test_quantiles_of_work_are_those_of_the_scenes_that_the_sentence_counts(seed):
    """Scenes without a cheaper run have no ratio; scenes that are not judged are in no count."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(20, 60))
    true = np.where(draw.random(count) < 0.2, np.nan, draw.uniform(1e-4, 9e-3, count))
    fixed = np.where(draw.random(count) < 0.4, np.nan, draw.uniform(1.0, 2.0, count))
    asked = fixed * draw.uniform(1.0, 9.0, count)
    columns = {
        "true": true,
        "estimated": true,
        "work_fixed": fixed,
        "work_asked": np.nan_to_num(asked, nan=3.0),
    }
    columns |= {"held_out": np.arange(count) % 2 == 1, "is_refused": np.zeros(count, bool)}
    of = xr.Dataset({name: ("drawn", values) for name, values in columns.items()}, attrs={"requested": 0.01})
    said = section({"random_scenes": of}).sentences[-1]
    ratios = sorted(a / f for a, f, t in zip(asked, fixed, true, strict=True) if t == t and f == f)
    without = sum(t == t and f != f for t, f in zip(true, fixed, strict=True))
    assert f"In {without} scene" in said
    assert f"In {len(ratios)} scenes, the median of this ratio of work is " in said
    middle = 0.5 * (ratios[(len(ratios) - 1) // 2] + ratios[len(ratios) // 2])
    assert f"is {middle:.2g}, and 95 % have" in said
