"""What a row says of its samples and cases, as sentences."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import xarray as xr
from scipy.stats import binomtest

from riserstudy.grading.models import Item
from riserstudy.grading.names import input_name, option_name
from riserstudy.grading.sensitivity import deciding, listed, shares_by_option
from riserstudy.grading.verdict import ALMOST_ALWAYS, ENOUGH, Verdict, few

MANY = 100  # samples from which a band is told

Called = (
    Mapping[str, str] | None
)  # what inputs are called, as in ``riserstudy.grading.names.input_name``


def explained(
    item: Item, hits: xr.DataArray, about: xr.Dataset, verdict: Verdict, base: bool, called: Called
) -> tuple[str, str]:
    """What decides, and the share of the samples, as text; ``base``: whether the base case is met."""
    word = "met" if item.kind == "number" else "true"
    share = hits_in_words(hits, word)
    if verdict != "depends":
        return "", f"{share[0].upper()}{share[1:]}."
    if float(hits.mean()) >= ALMOST_ALWAYS:  # whatever else is open, it decides nothing
        samples = hits.sizes.get("sample")
        short = base and few(samples)
        name = f"too few samples ({samples} of {ENOUGH})" if short else "the base case"
        return f"{name}; {share}", ""
    names, why = deciding(hits, about, called)
    said = [why, *_by_option(hits, about, names, word, called)]
    in_words = [input_name(name, called) for name in names]
    name = listed(in_words) if names else "no single input or pair"
    return f"{name}; {share}", " ".join(text for text in said if text)


def case_in_words(
    item: Item,
    name: str,
    value: xr.DataArray,
    hits: xr.DataArray,
    about: xr.Dataset,
    called: Called,
) -> str:
    """One further case as a sentence, of one cell or many."""
    words = ("met", "missed") if item.kind == "number" else ("true", "false")
    unit = f" {item.unit}" if item.unit not in ("", "1") else ""
    if not hits.ndim:
        hit = words[0] if bool(hits) else words[1]
        return f"{name}: {float(value):.3g}{unit}, {hit}."
    low, high = float(value.min()), float(value.max())
    names = [input_name(name, called) for name in deciding(hits, about).names]
    by = f", decided by {listed(names)}" if names else ""
    return f"{name}: {low:.3g} to {high:.3g}{unit}, {hits_in_words(hits, words[0])}{by}."


def hits_in_words(hits: xr.DataArray, word: str) -> str:
    """How many samples are hits."""
    percent = f"{100 * float(hits.mean()):.0f} %{_band(hits)}"
    return f"{word} in {int(hits.sum())} of {hits.size} samples ({percent})"


def premise_in_words(judged: int, samples: int) -> str:
    """How many samples a claim with a premise is judged by."""
    if not judged:
        return f"What it takes for granted is so in none of {samples} samples; judged by the base case."
    return f"Judged where what it takes for granted is so: {judged} of {samples} samples."


def _by_option(
    hits: xr.DataArray, about: xr.Dataset, names: list[str], word: str, called: Called
) -> Iterator[str]:
    """How often it comes out under each option of deciding inputs, a sentence an input."""
    for name, shares in shares_by_option(hits, about, names).items():
        each = "; ".join(f"{option_name(o)} ({100 * share:.0f} %)" for o, share in shares.items())
        yield f"{word.capitalize()} by {input_name(name, called)}: {each}."


def _band(hits: xr.DataArray) -> str:
    """95 % confidence band of a share of many samples, by Wilson; too wide for evenly spread ones.

    All cells of a sample count as one draw.
    """
    count = hits.sizes.get("sample", 0)
    if count < MANY:
        return ""
    true = round(float(hits.mean()) * count)
    band = binomtest(true, count).proportion_ci(method="wilson")
    return f", {100 * band.low:.0f} to {100 * band.high:.0f} %"
