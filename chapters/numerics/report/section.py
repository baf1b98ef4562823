"""Section of the report on the results of the engine studies."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING

from chapters.numerics.answers import STEP_FOUND
from chapters.numerics.report.tables import tables
from riserstudy.records.numerals import duration
from riserstudy.records.page import Cell, Section, Table
from riserstudy.records.words import listed
from riserstudy.report.formats import counted

if TYPE_CHECKING:
    import xarray as xr

HONEST = (0.5, 5.0)  # range of the ratio of estimated to true error
PEAK = "the largest moment"
WANTED = 0.01  # largest error of the moment accepted in a long run
UNSAFE = 0.9999  # measured / predicted stable step, below which the prediction is unsafe


def section(datasets: Mapping[str, xr.Dataset]) -> Section | None:
    """Return the section on measurements of the engine, or None without any dataset of them."""
    # load first: tables show each cell, and each would need a separate read of the file
    datasets = {name: dataset.load() for name, dataset in datasets.items()}
    sentences: list[str] = []
    bad: list[Table] = []
    if (stability := datasets.get("stability")) is not None:
        sentences += hard_cases(stability)
        bad = unexpected(stability)
    if (steps := datasets.get("stable_step")) is not None:
        sentences.append(stable_steps(steps))
    if (validation := datasets.get("validation")) is not None:
        sentences.append(known(validation))
    if (effects := datasets.get("effects")) is not None:
        sentences += costs(effects)
    if (drawn := datasets.get("random_scenes")) is not None:
        sentences += random_scenes(drawn)
    if (long := datasets.get("long_runs")) is not None:
        sentences += long_runs(long)
    sentences += references(datasets)
    return Section(sentences, [*bad, *tables(datasets)]) if sentences else None


def unexpected(stability: xr.Dataset) -> list[Table]:
    """Table of the hard cases that did not end as expected of a sound engine; no table if all did."""
    bad = stability.isel(case=~stability["as_expected"].values)
    columns = [map(str, bad[name].values) for name in ("case", "about", "expected", "finding")]
    rows = [[Cell(text) for text in row] for row in zip(*columns, strict=True)]
    about = "Expected and observed outcome of each case"
    heads = ["Case", "Description", "Expected", "Found"]
    title = "Hard cases that did not end as expected"
    return [Table(title, about, heads, set(), rows, folded=False)] if rows else []


def references(datasets: Mapping[str, xr.Dataset]) -> list[str]:
    """State how many references a rerun reproduces, and which it does not; empty if none was rerun."""
    deviations = {
        f"{study}, {case}": float(deviation)
        for study, of in datasets.items()
        if "recomputed" in of.coords
        for case, deviation in zip(of["recomputed"].values, of["recomputed_deviation"].values, strict=True)
    }
    if not deviations:
        return []
    bad = [case for case, deviation in deviations.items() if deviation > 1.0]
    met = len(deviations) - len(bad)
    but = f" It does not reproduce: {listed(bad)}." if bad else ""
    return [
        f"A rerun reproduces {met} of {counted(len(deviations), 'reference solution')} within the estimated "
        f"errors.{but}"
    ]


def hard_cases(stability: xr.Dataset) -> list[str]:
    """Count hard cases by outcome of their scene as written."""
    outcomes = Counter(map(str, stability["written_outcome"].values))
    met, count = int(stability["as_expected"].sum()), stability.sizes["case"]
    text = listed(f"“{outcome}” ({number})" for outcome, number in outcomes.most_common())
    return [
        f"{met} of {counted(count, 'hard case')} ended with the expected outcome. The outcomes of the hard "
        f"cases, with the number of cases, are {text}."
    ]


def known(validation: xr.Dataset) -> str:
    """State how many numbers agree with known values, and which do not."""
    holds = validation["holds"].values
    kinds = Counter(map(str, validation["kind"].values))
    text = listed(counted(number, kind) for kind, number in kinds.items())
    met = f"{int(holds.sum())} of {len(holds)}"
    bad = validation.isel(row=~holds)
    named = [f"{n}, {q}" for n, q in zip(bad["name"].values, bad["quantity"].values, strict=True)]
    but = f" The results that do not agree are {'; '.join(named)}." if named else ""
    return (
        f"{met} results agree with a known value within the tolerance of the comparison. The sources of the "
        f"known values are {text}.{but}"
    )


def stable_steps(steps: xr.Dataset) -> str:
    """State the accuracy of the predicted stable step of explicit stepping."""
    ratio = steps["measured"] / steps["predicted"]
    unsafe = ratio.where(ratio < UNSAFE).min("mesh").dropna("variant")
    named = [
        f"{name} ({100 * (1.0 - float(x)):.1f} % too long)"
        for name, x in zip(unsafe["variant"].values, unsafe.values, strict=True)
    ]
    ends = dict.fromkeys(f"{float(end):.3f}" for end in (ratio.min(), ratio.max()))
    return (
        f"In explicit integration, the longest stable time step was found to {STEP_FOUND:g} %. "
        f"The longest stable step is {' to '.join(ends)} times the step that the engine predicts. "
        + (
            f"The predicted steps are too long for {listed(named)}."
            if named
            else "No predicted time step is longer than the longest stable time step."
        )
    )


def costs(effects: xr.Dataset) -> list[str]:
    """State the most expensive effects, and the time to compile the engine."""
    share = effects["time_share"].drop_sel(effect="solver and bookkeeping", errors="ignore")
    costliest = share.max("scene").sortby(share.max("scene"), ascending=False)[:3]
    named = [
        f"{name} ({100 * float(x):.0f} %)"
        for name, x in zip(costliest["effect"].values, costliest.values, strict=True)
    ]
    cold = effects.attrs["cold_compile_seconds"]
    spent = effects.attrs["cold_compile_core_seconds"]
    compiled = f"Before its first run, the engine compiles {effects.attrs['compiled_functions']} functions"
    return [
        f"The most expensive effects are {listed(named)}. Each percentage is the largest share of the run "
        "time that an effect takes in any scene.",
        f"{compiled}. The compilation takes {duration(cold, 3)} ({spent:.0f} core-seconds)."
        if cold == cold
        else f"{compiled}. The compile time is unknown, because some functions were compiled before.",
    ]


def random_scenes(drawn: xr.Dataset) -> list[str]:
    """State how often tolerances are met, how good the error estimates are, and the relative work."""
    requested, count = float(drawn.attrs["requested"]), drawn.sizes["drawn"]
    refused = int(drawn["is_refused"].sum())
    ran = drawn.isel(drawn=drawn["true"].notnull().values)
    left = count - refused - ran.sizes["drawn"]
    were = "was" if count == 1 else "were"
    counts = (
        f"{counted(count, 'random scene')} {were} run with a tolerance of {100 * requested:g} %. The engine "
        f"refused {refused or 'none'} of the random scenes, and {left or 'none'} could not be "
        "judged, because a run took too long or there is no reference solution"
    )
    if not ran.sizes["drawn"]:
        return [f"{counts}."]
    ratio = (ran["estimated"] / ran["true"]).where(ran["true"] > 0.0)
    work = (ran["work_asked"] / ran["work_fixed"]).dropna("drawn")
    none = ran.sizes["drawn"] - work.sizes["drawn"]
    held = ran.isel(drawn=ran["held_out"].values)

    def within(of: xr.Dataset) -> str:
        return f"{100 * float((of['true'] <= requested).mean()):.0f} %"

    honest = float(((ratio >= HONEST[0]) & (ratio <= HONEST[1])).mean())
    lines = [
        f"{counts}. The true error is within the tolerance in {within(ran)} of the judged scenes, and in "
        f"{within(held)} of the scenes that were not used to tune the engine. In {100 * honest:.0f} % of the "
        "scenes the estimated error is between 0.5 and 5 times the true error."
    ]
    if work.sizes["drawn"]:
        middle, most = (float(x) for x in work.quantile([0.5, 0.95]))
        lines.append(
            "To meet a tolerance, the engine refines mesh and time step in several runs. The work of all "
            "refinements is divided by the work of the cheapest single run of equal error, with a uniform "
            f"mesh. In {counted(none, 'scene')} no tested single run of equal error requires less work than "
            f"the refinements. In {counted(work.sizes['drawn'], 'scene')}, the median of this ratio of work "
            f"is {middle:.2g}, and 95 % have a ratio of at most {most:.2g}."
        )
    return lines


def long_runs(long: xr.Dataset) -> list[str]:
    """State the cheapest settings of each long simulation, and the published time."""
    lines = []
    for case in dict.fromkeys(long["case"].values.tolist()):
        of = long.isel(run=long["case"].values == case)
        parts, published, name = [], "", f"the long simulation “{case}”"
        for error, label in (("error_peak", PEAK), ("error_moment", "all moments")):
            good = of.isel(run=((of[error] <= WANTED) & of["cpu_seconds"].notnull()).values)
            if not good.sizes["run"]:
                parts.append(
                    f"No tested run of {name} gives {label} with an error of at most {100 * WANTED:g} %."
                )
                continue
            best = good.isel(run=int(good["cpu_seconds"].values.argmin()))
            spent, named = float(best["cpu_seconds"]), float(best["published_seconds"])
            published = f" The paper states a run time of {duration(named, 3)}." if named == named else ""
            parts.append(
                f"The cheapest run of {name} with {label} accurate to {100 * WANTED:g} % takes "
                f"{duration(spent, 3)} of CPU time, with {counted(int(best['elements']), 'segment')} and "
                f"a time step of {float(best['asked_step']):g} s."
            )
        lines.append(" ".join(parts) + published)
    return lines
