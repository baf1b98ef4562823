"""What the studies of the engine itself found, for the report."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.report.wording import counted, listed, seconds

if TYPE_CHECKING:
    import xarray as xr

UNSAFE = 0.9999  # measured over predicted stable step, below which the prediction is not safe


class Finding(NamedTuple):
    """A hard case that did not come out as a sound engine would have it."""

    case: str
    about: str
    expected: str
    finding: str


class Engine(NamedTuple):
    """Findings in words, and the hard cases behind those that are bad."""

    said: list[str]
    findings: list[Finding]


def engine(datasets: dict[str, xr.Dataset]) -> Engine | None:
    """What was measured of the engine, None where nothing was."""
    said: list[str] = []
    findings: list[Finding] = []
    if (stability := datasets.get("stability")) is not None:
        said += hard_cases(stability)
        bad = stability.isel(case=~stability["as_expected"].values)
        columns = [map(str, bad[name].values) for name in ("case", "about", "expected", "finding")]
        findings = [Finding(*row) for row in zip(*columns, strict=True)]
    if (steps := datasets.get("stable_step")) is not None:
        said.append(stable_steps(steps))
    if (effects := datasets.get("effects")) is not None:
        said += costs(effects)
    return Engine(said, findings) if said else None


def hard_cases(stability: xr.Dataset) -> list[str]:
    """How many hard cases came out how, as written and by every method."""
    outcomes = Counter(map(str, stability["written_outcome"].values))
    met = int(stability["as_expected"].sum())
    told = listed(f"{count} {outcome}" for outcome, count in outcomes.most_common())
    lines = [
        f"{counted(stability.sizes['case'], 'hard case')} as written: {told}. "
        f"{met} came out as a sound engine would have it."
    ]
    for method in stability["method"].values:
        found = Counter(map(str, stability["outcome"].sel({"method": method}).values))
        lines.append(f"{method}: {listed(f'{n} {outcome}' for outcome, n in found.most_common())}.")
    return lines


def stable_steps(steps: xr.Dataset) -> str:
    """How well the stable step of explicit stepping is predicted."""
    ratio = steps["measured"] / steps["predicted"]
    unsafe = ratio.where(ratio < UNSAFE).min("mesh").dropna("variant")
    named = [
        f"{name} ({100 * (1.0 - float(x)):.1f} % too long)"
        for name, x in zip(unsafe["variant"].values, unsafe.values, strict=True)
    ]
    return (
        f"Explicit stepping: the longest stable step measured is {float(ratio.min()):.3f} to "
        f"{float(ratio.max()):.3f} of the predicted one; not safe: {listed(named)}."
    )


def costs(effects: xr.Dataset) -> list[str]:
    """What effects cost, and compiling them."""
    share = effects["time_share"].drop_sel(effect="solver and bookkeeping", errors="ignore")
    dearest = share.max("scene").sortby(share.max("scene"), ascending=False)[:3]
    named = [
        f"{name} {100 * float(x):.0f} %"
        for name, x in zip(dearest["effect"].values, dearest.values, strict=True)
    ]
    cold = effects.attrs["cold_compile_seconds"]
    compiled = (
        f"Compiled: {effects.attrs['compiled_entries']} entries of effects, "
        f"{effects.attrs['compiled_functions']} other functions"
    )
    return [
        f"Dearest effects, by their share of the run time in the scene where it is largest: {listed(named)}.",
        f"{compiled}; from nothing in {seconds(cold)}." if cold == cold else f"{compiled}.",
    ]
