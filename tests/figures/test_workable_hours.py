"""The figure of workable hours says something whatever the hours are."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.figures.workable_hours import workable_hours

MONTHS = list("JFMAMJJASOND")


def hours(shares, waits):
    """Three settings, two modes, two limits and two windows."""
    of_modes = ("setting", "riser_mode")
    share = np.array([[one, 1.0] for one in shares])
    month = np.repeat(share[:, :, None], 12, axis=2)
    wait = np.full((3, 2, 2), waits)
    names = ("workable", "workable_at_worst", "workable_at_best", "mean_year_low", "mean_year_high")
    return xr.Dataset(
        {
            **dict.fromkeys(names, (of_modes, share)),
            "workable_by_month": ((*of_modes, "month"), month),
            "exceeded": (("setting", "limit"), 1.0 - share),
            "exceeded_alone": (("setting", "limit"), 0.5 * (1.0 - share)),
            "wait_p50": ((*of_modes, "window"), wait),
            "wait_p90": ((*of_modes, "window"), 2.0 * wait),
        },
        coords={
            "setting": ["low", "middle", "high"],
            "riser_mode": ["drilling", "connected"],
            "month": MONTHS,
            "limit": ["drilling: mean lfj_angle", "connected: largest von_mises_stress"],
            "window": [24.0, 72.0],
        },
    )


@pytest.mark.parametrize(
    "shares, waits, title",
    [
        ((0.0, 0.0, 0.0), np.nan, "Drilling is possible in no hour of the record"),
        ((1.0, 1.0, 1.0), 0.0, "Drilling is possible in 100.0 % of the hours"),
        ((0.0, 0.25, 0.5), 7.0, "Drilling is possible in 0.0 % to 50.0 % of the hours"),
    ],
)
def test_every_panel_says_something(shares, waits, title):
    figure = workable_hours(hours(shares, waits))
    assert figure.get_suptitle() == title
    for ax in figure.axes:
        drawn = [line for line in ax.lines if np.isfinite(np.asarray(line.get_ydata(), float)).any()]
        assert drawn or ax.patches or ax.texts, ax.get_title(loc="left")
    months = figure.axes[1]
    low, high = months.get_ylim()
    assert high - low > 1.0  # per cent: a flat line is no slope of rounding
    for line in months.lines:
        assert (low <= line.get_ydata()).all()
        assert (line.get_ydata() <= high).all()


@pytest.mark.parametrize("seed", range(20))
def test_settings_whose_hours_are_not_known_do_not_change_the_title(seed):
    draw = np.random.default_rng(seed)
    shares = draw.uniform(0.1, 0.9, 3)
    known = draw.random(3) < 0.5
    title = workable_hours(hours(np.where(known, shares, np.nan), 7.0)).get_suptitle()
    ends = sorted({f"{100.0 * end:.1f} %" for end in shares[known]}, key=lambda word: float(word.split()[0]))
    words = " to ".join(dict.fromkeys([*ends[:1], *ends[-1:]]))
    wanted = (
        f"Drilling is possible in {words} of the hours"
        if ends
        else "Workable hours of drilling are not known"
    )
    assert title == wanted


def test_limits_are_written_as_in_the_field():
    limits = workable_hours(hours((0.0, 0.25, 0.5), 7.0)).axes[2]
    words = " ".join(label.get_text().replace("\n", " ") for label in limits.get_yticklabels())
    assert "mean LFJ angle" in words
    assert "von Mises stress" in words
