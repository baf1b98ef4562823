"""Wall tension as effective tension: by the dry weight of the wall, and by weights step by step."""

import csv
import math

import numpy as np
import pytest
import xarray as xr

from riserstudy import simulate
from riserstudy.dataset.comparison import compared, difference
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.wall_stress import Wall, four_stresses

GRAVITY, STEEL = 9.81, 7850.0


def scene(rng, sections=1):
    """A riser of steel pipes of some mud, upright in still water, its top above the water."""
    outer = rng.uniform(0.4, 0.55)
    inner = outer - rng.uniform(0.03, 0.06)
    water, mud = rng.uniform(1000.0, 1030.0), rng.uniform(1000.0, 1900.0)
    deep = rng.uniform(200.0, 1500.0)
    share = rng.dirichlet(np.full(sections, 5.0))
    pipe = {
        "outer_diameter": f"{outer} m",
        "inner_diameter": f"{inner} m",
        "young_modulus": "207 GPa",
        "wall_density": f"{STEEL} kg/m^3",
        "contents": {"density": f"{mud} kg/m^3"},
    }
    riser = [
        pipe | {"name": f"pipe {k}", "length": f"{(deep + 5.0) * part} m"} for k, part in enumerate(share)
    ]
    area = 0.25 * math.pi * (outer**2 - inner**2)
    weight = GRAVITY * (deep + 5.0) * (STEEL * area + mud * 0.25 * math.pi * inner**2)
    return {
        "title": "a pipe",
        "gravity": f"{GRAVITY} m/s^2",
        "water": {"density": f"{water} kg/m^3", "surface": "0 m", "seabed": f"{-deep - 4.0} m"},
        "riser": riser,
        "bottom": {"hold": "wellhead", "elevation": f"{-deep} m", "rotation": "free"},
        "top": {"x": "held", "z": "free", "tension": f"{1.2 * weight} N", "rotation": "free"},
        "analysis": {"mesh": {"elements": 20}},
    }


def write(path, headings, *columns):
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([headings, *zip(*columns, strict=True)])
    return path


@pytest.mark.parametrize("seed", range(8))
def test_wall_tension_falls_by_the_dry_weight_of_the_wall(tmp_path, seed):
    """On an upright pipe pressures act at its ends alone: T_w = T_top - g m (L - s), m of steel in air."""
    tree = scene(np.random.default_rng(seed), sections=1 + seed % 2)
    file = SceneFile("pipe.yaml", tree)
    run = simulate(file, progress=False)
    pipe = tree["riser"][0]
    outer, inner = (float(pipe[f"{side}_diameter"].split()[0]) for side in ("outer", "inner"))
    mass = STEEL * 0.25 * math.pi * (outer**2 - inner**2)
    s, top = run["s"].to_numpy(), float(tree["top"]["tension"].split()[0])
    wall = top - GRAVITY * mass * (s[-1] - s)
    path = write(tmp_path / "other.csv", ["s (m)", "wall_tension (N)"], s, wall)
    (pair,) = compared(run, path, scene=file.resolved()).pairs
    # the riser stretches by a thousandth, and its columns with it
    assert np.abs(pair.ours - pair.theirs).max() < 3e-3 * top
    assert np.abs(pair.theirs - wall).max() > 4e-3 * top
    assert "T_e = T_w + p_o A_o - p_i A_i" in pair.notes[0]
    assert pair.name == "effective_tension"


@pytest.mark.parametrize("seed", range(6))
def test_wall_tension_over_time_is_that_of_the_elevations_at_the_time(tmp_path, seed):
    """Of a pipe that heaves: effective tension by weights in water, wall tension by weights in air."""
    rng = np.random.default_rng(seed)
    tree = scene(rng)
    file = SceneFile("pipe.yaml", tree)
    model, pipe = file.resolved(), file.resolved().riser[0]
    length = sum(section.total_length for section in model.riser)
    s = np.linspace(0.0, length, 4001)
    time = np.linspace(0.0, 20.0, 81)
    heave = 2.0 * np.sin(2.0 * np.pi * time / 9.0)
    z = model.bottom.elevation + s + heave[:, None]
    steel = STEEL * pipe.wall_area
    wet = np.where(z < 0.0, model.water.density * 0.25 * math.pi * pipe.outer_diameter**2, 0.0)
    per_metre = GRAVITY * (steel + pipe.contents_mass - wet)
    steps = 0.5 * (per_metre[:, 1:] + per_metre[:, :-1]) * np.diff(s)
    pull = 5e6 + 2e5 * np.sin(time)
    below = np.concatenate([np.zeros((len(time), 1)), np.cumsum(steps[:, ::-1], axis=1)], axis=1)
    tension = pull[:, None] - below[:, ::-1]
    run = xr.Dataset(
        {
            "effective_tension": (("time", "s"), tension, {"units": "N"}),
            "z": (("time", "s"), z, {"units": "m"}),
        },
        {"time": time, "s": s},
    )
    place = float(rng.uniform(1.0, length - 1.0))
    wall = 1e-3 * (pull - GRAVITY * steel * (s[-1] - place))
    path = write(tmp_path / "other.csv", ["time (s)", f"wall_tension at {place} m (kN)"], time, wall)
    (pair,) = compared(run, path, scene=model).pairs
    # half a station of the pipe at the surface
    assert difference(pair).rms < GRAVITY * 1030.0 * 0.25 * (s[1] - s[0]) + 1.0


@pytest.mark.parametrize("seed", range(4))
def test_the_wall_that_stress_rests_on_is_converted_back(tmp_path, seed):
    """Axial stress is the mean of both sides' where no pressure acts in the ring: of a run's own stresses."""
    rng = np.random.default_rng(100 + seed)
    tree = scene(rng)
    tree["riser"][0].pop("contents")
    tree["riser"][0] |= {"contents": {"density": "1 kg/m^3"}, "submerged_weight": "500 N/m"}
    tree["water"]["density"] = "1 kg/m^3"
    file = SceneFile("pipe.yaml", tree)
    run, pipe = simulate(file, progress=False), file.resolved().riser[0]
    wall = Wall(0.5 * pipe.outer_diameter, 0.5 * pipe.inner_diameter)
    tension = run["effective_tension"].to_numpy()
    none = np.zeros(len(tension))
    axial = four_stresses(wall, tension, none, none, none)[0] * wall.area
    path = write(tmp_path / "o.csv", ["s (m)", "wall_tension (N)"], run["s"].to_numpy(), axial)
    (pair,) = compared(run, path, scene=file.resolved()).pairs
    assert np.abs(pair.ours - pair.theirs).max() < 1e-3 * np.abs(tension).max()


def lacking(tree, path):
    *folders, last = path
    part = tree
    for key in folders:
        part = part[key]
    part.pop(last)
    return tree


@pytest.mark.parametrize(
    "path, said",
    [
        (["riser", 0, "contents"], "contents of section 'pipe 0'"),
        (["water", "surface"], "water.surface"),
        (["water"], "water"),
    ],
)
def test_what_is_not_known_is_not_guessed(tmp_path, path, said):
    tree = lacking(scene(np.random.default_rng(1)), path)
    tree["riser"][0]["submerged_weight"] = "500 N/m"
    file = SceneFile("pipe.yaml", tree)
    run = simulate(file, progress=False)
    s = run["s"].to_numpy()
    other = write(tmp_path / "other.csv", ["s (m)", "wall_tension (N)"], s, s)
    with pytest.raises(InputError, match=said) as refused:
        compared(run, other, scene=file.resolved())
    assert "T_e = T_w" in str(refused.value)


def two_walls(seed):
    """A riser of two pipes of other walls."""
    tree = scene(np.random.default_rng(seed), sections=2)
    outer = float(tree["riser"][1]["outer_diameter"].split()[0])
    tree["riser"][1]["outer_diameter"] = f"{outer + 0.02} m"
    return tree


def test_where_two_walls_meet_the_row_is_left_out_and_said(tmp_path):
    file = SceneFile("pipe.yaml", two_walls(3))
    run = simulate(file, progress=False)
    s = run["s"].to_numpy()
    other = write(tmp_path / "other.csv", ["s (m)", "wall_tension (N)"], s, 1e6 + s)
    (pair,) = compared(run, other, scene=file.resolved()).pairs
    meeting = file.resolved().riser[0].total_length
    assert len(pair.along) == len(s) - 1
    assert not np.isclose(pair.along, meeting).any()
    assert any("walls of two sections meet" in note for note in pair.notes)


def test_the_wall_tension_over_time_where_two_walls_meet_is_not_known(tmp_path):
    """A millimetre below and above it is, with the areas of either wall."""
    model, time = SceneFile("pipe.yaml", two_walls(3)).resolved(), np.linspace(0.0, 9.0, 19)
    s = np.linspace(0.0, sum(section.total_length for section in model.riser), 401)
    z = model.bottom.elevation + s + np.sin(time)[:, None]
    units = {"effective_tension": "N", "z": "m"}
    data = {
        name: (("time", "s"), 0.0 * z if unit == "N" else z, {"units": unit}) for name, unit in units.items()
    }
    run, meeting = xr.Dataset(data, {"time": time, "s": s}), model.riser[0].total_length
    found = {}
    for off in (-1e-3, 0.0, 1e-3):
        head = f"wall_tension at {meeting + off!r} m (N)"
        other = write(tmp_path / "other.csv", ["time (s)", head], time, 0.0 * time)
        if off:
            (pair,) = compared(run, other, scene=model).pairs
            found[off] = pair.theirs
        else:
            with pytest.raises(InputError, match="two sections with different walls meet"):
                compared(run, other, scene=model)
    # the wider pipe above has more water around it
    assert (found[1e-3] > found[-1e-3]).all()


def test_a_step_of_the_wall_is_pushed_by_the_water_on_it(tmp_path):
    """The wider pipe stands above: water pushes its lower face up, so that wall tension drops there."""
    file = SceneFile("pipe.yaml", two_walls(5))
    run, model = simulate(file, progress=False), file.resolved()
    lower, upper, _ = model.riser  # what is above the water is a section of its own
    s, top = run["s"].to_numpy(), model.top.tension
    above = s > lower.total_length
    step = 0.25 * math.pi * (upper.outer_diameter**2 - lower.outer_diameter**2)
    depth = -(model.bottom.elevation + lower.total_length)
    masses = [STEEL * one.wall_area for one in (lower, upper)]
    wall = top - GRAVITY * masses[1] * (s[-1] - s)
    foot = top - GRAVITY * masses[1] * (s[-1] - lower.total_length)
    pushed = foot + model.water.density * GRAVITY * depth * step
    wall[~above] = pushed - GRAVITY * masses[0] * (lower.total_length - s[~above])
    other = write(tmp_path / "other.csv", ["s (m)", "wall_tension (N)"], s, wall)
    (pair,) = compared(run, other, scene=model).pairs
    assert np.abs(pair.ours - pair.theirs).max() < 3e-3 * top


def test_the_command_converts_by_the_scene_of_the_dataset(tmp_path, commands):
    """A range graph in OrcaFlex's words, from the top: the wall's dry weight, and the convention printed."""
    from riserstudy.dataset.write_dataset import write_dataset

    tree = scene(np.random.default_rng(11))
    file = SceneFile("pipe.yaml", tree)
    run, pipe = simulate(file, progress=False), file.resolved().riser[0]
    write_dataset(run, tmp_path / "pipe.nc")
    s, top = run["s"].to_numpy(), file.resolved().top.tension
    wall = 1e-3 * (top - GRAVITY * STEEL * pipe.wall_area * (s[-1] - s))
    rows = [f"{arc:.4f}\t{value:.4f}" for arc, value in zip(s[-1] - s, wall, strict=True)][::-1]
    other = tmp_path / "wall tension.txt"
    other.write_text("\n".join(["Pipe", "Arc length (m)\tWall tension (kN)", *rows]))
    figure = tmp_path / "both.png"
    code, said, wrong = commands("compare", tmp_path / "pipe.nc", other, "-o", figure, "--end-a", "top")
    assert (code, wrong) == (0, "")
    assert "T_e = T_w + p_o A_o - p_i A_i" in said
    assert "arc length is measured down from s" in said
    assert figure.stat().st_size > 1e4
    code, _, wrong = commands("compare", tmp_path / "pipe.nc", other, "-o", figure)
    assert code == 2
    assert "add --end-a" in wrong


@pytest.mark.parametrize("setting", ["Te", "=s (m)", "a=s (m)", "Te=", "Te=tension"])
def test_a_column_that_is_not_named_well_is_refused(tmp_path, commands, setting):
    run = simulate(SceneFile("pipe.yaml", scene(np.random.default_rng(1))), progress=False)
    run.to_netcdf(tmp_path / "pipe.nc")
    other = write(tmp_path / "o.csv", ["s (m)", "Te"], np.arange(9.0), np.arange(9.0))
    figure = tmp_path / "both.png"
    code, _, wrong = commands("compare", tmp_path / "pipe.nc", other, "-o", figure, "--column", setting)
    assert code == 2
    assert len(wrong.splitlines()) == 1
    assert not figure.exists()
