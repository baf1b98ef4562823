"""Operators of diffraction codes: a platform in a scene moves as the code's own formula says."""

import cmath
import math
import sys

import numpy as np
import pytest
import xarray as xr

from riserstudy.cli import main
from riserstudy.errors import InputError
from riserstudy.importers.capytaine import from_capytaine
from riserstudy.importers.wamit import from_wamit
from riserstudy.model.rao import harmonics
from riserstudy.scene.load import SceneFile

PERIODS, HEADINGS = (8.0, 12.0, 16.0), (0.0, 45.0, 90.0)
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


def made_up(motion, period, heading):
    """A complex number for each: none is like another."""
    k = MOTIONS.index(motion)
    size = (0.1 + 0.05 * k) * period / 10.0 * (0.02 if k > 2 else 1.0)
    return cmath.rect(size, math.radians(20.0 * k + 5.0 * period + 0.3 * heading))


def wamit(path, length=1.0, skip=(), change=lambda row: row):
    """The file, with rotations made dimensionless by the length."""
    lines = ["  PER  BETA  I  MOD  PHA  RE  IM"]
    for period in (*PERIODS, -1.0):
        for heading in HEADINGS:
            for k, motion in enumerate((*MOTIONS, "mode 7")):
                if motion in skip:
                    continue
                scale = length if k > 2 else 1.0
                value = scale * made_up(motion, period, heading) if k < 6 else 1j
                row = [
                    period,
                    heading,
                    k + 1,
                    abs(value),
                    math.degrees(cmath.phase(value)),
                    value.real,
                    value.imag,
                ]
                lines.append(" ".join(f"{x:.6E}" if k != 2 else str(x) for k, x in enumerate(change(row))))
    path.write_text("\n".join(lines))
    return path


def capytaine(path, by="omega", body="", **changes):
    """A dataset as Capytaine's are saved: real and imaginary parts along a dimension."""
    waves = np.sort({"omega": 2.0 * np.pi / np.array(PERIODS), "period": np.array(PERIODS)}[by])
    periods = 2.0 * np.pi / waves if by == "omega" else waves
    values = np.array([[[made_up(m, p, h) for m in MOTIONS] + [1j] for h in HEADINGS] for p in periods])
    parts = np.stack([values.real, values.imag])
    coordinates = {
        "complex": ["re", "im"], by: waves, "wave_direction": np.radians(HEADINGS),
        "radiating_dof": [body + name.capitalize() for name in (*MOTIONS, "bulge")],
    }  # fmt: skip
    rao = xr.DataArray(parts, coordinates, ("complex", by, "wave_direction", "radiating_dof"))
    xr.Dataset({"RAO": rao, "added_mass": 1.0} | changes).to_netcdf(path)
    return path


def imported(source, *words):
    target = source.with_suffix(".csv")
    sys.argv = ["riserstudy", "import", str(source), "-o", str(target), "--force", *words]
    main()
    return target


def moved(table, phases, motion, period, heading):
    """What a scene with that table has the platform do in a wave of 1 m, over time."""
    tree = {
        "title": "platform", "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-500 m"},
        "riser": [{"name": "rope", "length": "480 m", "axial_stiffness": "1e9 N",
                   "submerged_weight": "1 N/m"}],
        "bottom": {"hold": "wellhead", "elevation": "-480 m"},
        "top": {"x": "platform", "z": "platform", "elevation": "0 m"},
        "platform": {
            "centre_of_rotation": {"elevation": "0 m"},
            "response": {
                "operators": {"file": table.name}, "phases": phases, "headings": "towards",
                "wave": {"amplitude": "1 m", "period": f"{period} s"}, "heading": f"{heading} deg",
            },
        },
        "analysis": {},
    }  # fmt: skip
    response = SceneFile(str(table.parent / "scene.yaml"), tree).resolved().platform.response
    parts = harmonics(response, response.wave)
    k = parts.motion.index(motion)
    time = np.linspace(0.0, 30.0, 61)
    return time, parts.amplitude[k] * np.sin(parts.frequency[k] * time + parts.phase[k])


CASES = [("heave", 12.0, 0.0), ("pitch", 8.0, 45.0), ("sway", 16.0, 90.0), ("yaw", 12.0, 45.0)]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("length", [1.0, 80.0])
def test_wamit_moves_as_the_real_part_with_time_forward(tmp_path, case, length):
    """Its motions are Re(x exp(i w t)) of waves cos(w t - k x)."""
    table = imported(wamit(tmp_path / "semi.4", length), "--length", f"{length} m")
    time, motion = moved(table, "lead", *case)
    exact = (made_up(*case) * np.exp(2j * np.pi * time / case[1])).real
    np.testing.assert_allclose(motion, exact, atol=2e-5 * abs(exact).max())  # six digits are printed


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("by", ["omega", "period"])
@pytest.mark.parametrize("body", ["", "semi__"])
def test_capytaine_moves_as_the_real_part_with_time_backward(tmp_path, case, by, body):
    """Its motions are Re(X exp(-i w t)) of waves cos(k x - w t)."""
    table = imported(capytaine(tmp_path / "semi.nc", by, body))
    time, motion = moved(table, "lag", *case)
    exact = (made_up(*case) * np.exp(-2j * np.pi * time / case[1])).real
    np.testing.assert_allclose(motion, exact, atol=1e-8)


@pytest.mark.parametrize("seed", range(10))
def test_a_file_by_frequency_gives_the_table_of_the_file_by_period_or_is_refused(tmp_path, monkeypatch, seed):
    """WAMIT's IPEROUT decides what the first column is; the file does not say it."""
    draw = np.random.default_rng(seed)
    periods = np.sort(draw.uniform(5.0, 25.0, 4))
    monkeypatch.setattr(sys.modules[__name__], "PERIODS", tuple(periods))
    by_period = from_wamit(wamit(tmp_path / "p.4"), 1.0)
    other = wamit(tmp_path / "f.4", change=lambda row: [2.0 * np.pi / row[0], *row[1:]])
    with pytest.raises(InputError, match=r"first column.*may be frequencies"):
        from_wamit(other, 1.0)
    by_frequency = from_wamit(other, 1.0, "frequency")
    np.testing.assert_allclose(by_frequency.rows, by_period.rows, rtol=1e-5)
    assert by_frequency.columns == by_period.columns
    assert from_wamit(tmp_path / "p.4", 1.0, "period") == by_period


def test_what_is_left_out_is_named_with_what_the_scene_says_beside(tmp_path, capsys):
    imported(wamit(tmp_path / "semi.4"), "--length", "1 m")
    said = capsys.readouterr().out
    assert "left out: period -1: no wave" in said
    assert "left out: mode 7" in said
    assert "phases: lead, headings: towards" in said
    imported(capytaine(tmp_path / "semi.nc"))
    said = capsys.readouterr().out
    assert "left out: semi__bulge" in said or "left out: Bulge: no motion" in said
    assert "left out: variable added_mass" in said
    assert "phases: lag, headings: towards" in said


def test_motions_that_a_file_does_not_have_are_not_in_the_table(tmp_path):
    table = imported(wamit(tmp_path / "semi.4", skip=("sway", "yaw")), "--length", "1 m")
    head = table.read_text().splitlines()[0]
    assert "surge (m/m)" in head
    assert "sway" not in head


@pytest.mark.parametrize(
    "change, why",
    [
        (lambda row: [*row[:4], -row[4], *row[5:]], "check the order of the columns"),
        (lambda row: row[:5], "5 numbers"),
        (lambda row: [8.0, 0.0, *row[2:]], "two lines have the same period, heading and mode"),
    ],
)
def test_a_file_that_contradicts_itself_is_refused(tmp_path, change, why):
    with pytest.raises(SystemExit):
        imported(wamit(tmp_path / "semi.4", change=change), "--length", "1 m")
    with pytest.raises(InputError, match=why):
        from_wamit(tmp_path / "semi.4", 1.0)


def test_a_file_without_all_modes_everywhere_is_refused(tmp_path):
    source = wamit(tmp_path / "semi.4")
    source.write_text("\n".join(source.read_text().splitlines()[:3] + source.read_text().splitlines()[4:]))
    with pytest.raises(InputError, match="mode 3 has no line at 0 deg and 8 s"):
        from_wamit(source, 1.0)


def test_rotations_of_wamit_need_its_length(tmp_path, capsys):
    with pytest.raises(SystemExit):
        imported(wamit(tmp_path / "semi.4"))
    assert "WAMIT multiplies rotations by this length" in capsys.readouterr().err


def test_a_length_that_only_wamit_needs_is_refused_elsewhere(tmp_path, capsys):
    deck = tmp_path / "deck.yml"
    deck.write_text("General: {}\n")
    for source in (capytaine(tmp_path / "semi.nc"), deck):
        with pytest.raises(SystemExit):
            imported(source, "--length", "1 m")
        assert "--length: 1 m: has no effect on this file" in capsys.readouterr().err
        with pytest.raises(SystemExit):
            imported(source, "--first-column", "frequency")
        assert "--first-column: frequency: has no effect on this file" in capsys.readouterr().err
        assert not source.with_suffix(".csv").exists()


def test_a_dataset_without_operators_or_of_two_bodies_is_refused(tmp_path):
    xr.Dataset({"added_mass": 1.0}).to_netcdf(tmp_path / "bare.nc")
    with pytest.raises(InputError, match=r"post_pro\.rao"):
        from_capytaine(tmp_path / "bare.nc")
    both = xr.load_dataset(capytaine(tmp_path / "one.nc"))
    names = [f"{'a' if k < 3 else 'b'}__{name}" for k, name in enumerate(both["radiating_dof"].values)]
    both.assign_coords(radiating_dof=names).to_netcdf(tmp_path / "two.nc")
    with pytest.raises(InputError, match="2 bodies"):
        from_capytaine(tmp_path / "two.nc")
    (tmp_path / "text.nc").write_text("not a netCDF")
    with pytest.raises(InputError, match="not a netCDF"):
        from_capytaine(tmp_path / "text.nc")


@pytest.mark.parametrize("pair", [(0.0, 360.0), (-180.0, 180.0)])
@pytest.mark.parametrize("code", ["wamit", "capytaine"])
def test_a_heading_that_is_another_one_a_turn_later_is_left_out_or_refused(
    tmp_path, monkeypatch, capsys, code, pair
):
    first, last = pair
    monkeypatch.setattr(sys.modules[__name__], "HEADINGS", (first, 90.0, last))
    made = made_up
    for same in (True, False):

        def response(motion, period, heading, same=same):
            return made(motion, period, first if same and heading == last else heading)

        monkeypatch.setattr(sys.modules[__name__], "made_up", response)
        source = wamit(tmp_path / "a.4") if code == "wamit" else capytaine(tmp_path / "a.nc")
        words = ["--length", "1 m"] if code == "wamit" else []
        if same:
            table = imported(source, *words)
            assert f"heading {last:g} deg: that of {first:g} deg" in capsys.readouterr().out
            moved(table, "lead" if code == "wamit" else "lag", "heave", 12.0, last)
        else:
            with pytest.raises(SystemExit):
                imported(source, *words)
            assert "the same heading" in capsys.readouterr().err


@pytest.mark.parametrize("by", ["omega", "period"])
@pytest.mark.parametrize("word", ["degree", "deg"])
def test_units_that_a_dataset_states_are_those_of_its_axes(tmp_path, by, word):
    rows = np.array(from_capytaine(capytaine(tmp_path / "semi.nc", by)).rows)
    dataset = xr.load_dataset(tmp_path / "semi.nc")
    turned = dataset.assign_coords(wave_direction=np.degrees(dataset["wave_direction"]))
    turned["wave_direction"].attrs["units"] = word
    if by == "omega":
        turned = turned.assign_coords(omega=dataset["omega"] / (2.0 * np.pi))
    turned[by].attrs["units"] = {"omega": "Hz", "period": "s"}[by]
    turned.to_netcdf(tmp_path / "turned.nc")
    np.testing.assert_allclose(from_capytaine(tmp_path / "turned.nc").rows, rows, rtol=1e-9)
    turned[by].attrs["units"] = "min"
    turned.to_netcdf(tmp_path / "minutes.nc")
    with pytest.raises(InputError, match=f"{by}: the unit 'min'"):
        from_capytaine(tmp_path / "minutes.nc")


@pytest.mark.parametrize("seed", range(6))
def test_a_dataset_with_missing_values_is_refused(tmp_path, seed):
    draw = np.random.default_rng(seed)
    dataset = xr.load_dataset(capytaine(tmp_path / "semi.nc"))
    place = tuple(int(draw.integers(n)) for n in dataset["RAO"].shape)
    dataset["RAO"].values[(*place[:-1], 6)] = np.nan  # of no motion of a platform
    dataset.to_netcdf(tmp_path / "bulge.nc")
    assert np.isfinite(from_capytaine(tmp_path / "bulge.nc").rows).all()
    dataset["RAO"].values[(*place[:-1], min(place[-1], 5))] = np.nan
    dataset.to_netcdf(tmp_path / "gap.nc")
    with pytest.raises(InputError, match="RAO: a value is missing at"):
        from_capytaine(tmp_path / "gap.nc")


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("code", ["wamit", "capytaine"])
@pytest.mark.parametrize("share", [1e-4, 0.05])
def test_two_responses_to_one_heading_agree_in_each_motion_or_are_refused(
    tmp_path, monkeypatch, capsys, code, motion, share
):
    """Rotations, in rad/m, are small numbers beside displacements: they have a measure of their own."""
    made = made_up
    monkeypatch.setattr(sys.modules[__name__], "HEADINGS", (0.0, 90.0, 360.0))

    def response(name, period, heading):
        factor = 1.0 + share if heading == 360.0 and name == motion else 1.0
        return factor * made(name, period, heading % 360.0)

    monkeypatch.setattr(sys.modules[__name__], "made_up", response)
    source = wamit(tmp_path / "a.4") if code == "wamit" else capytaine(tmp_path / "a.nc")
    words = ["--length", "1 m"] if code == "wamit" else []
    if share < 1e-3:
        imported(source, *words)
        assert "heading 360 deg: that of 0 deg" in capsys.readouterr().out
        return
    with pytest.raises(SystemExit):
        imported(source, *words)
    assert (
        "the response differs from the response at 0 deg, which is the same heading"
        in capsys.readouterr().err
    )
