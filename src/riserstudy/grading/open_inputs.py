"""Grade published values and claims over the unspecified inputs of any model that Python can run."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.stats import qmc

from riserstudy.errors import InputError
from riserstudy.grading.found import Found, judged
from riserstudy.grading.grade import FITTED, graded
from riserstudy.grading.open_claims import BASE, SAMPLES, Assumed, ClaimsFile, OpenClaim, Value
from riserstudy.grading.yardstick import Condition, plain
from riserstudy.inputs.misfit import Misfit
from riserstudy.records.graded import Graded

#: function of inputs by name, and of the options of an item, that returns a number, or a value with a margin
Check = Callable[..., Any]


def claim(value: float, judged_by: float | Condition) -> Found:
    """The result of a check of a claim.

    Raises ValueError when the margin is not one number.

    Parameters
    ----------
    value : value to report, in its unit; NaN if there is no result.
    judged_by : a margin, which is above zero if the claim is true; or a condition with a word of size from
        ``more``, ``less`` or ``alike``.
    """
    condition = judged_by if isinstance(judged_by, Condition) else plain(xr.DataArray(judged_by))
    if condition.margin.ndim:
        found = f"the margin is an array of shape {condition.margin.shape}"
        raise Misfit("", found, "return one number as margin")
    return judged(xr.DataArray(float(value)), condition)


def grade_claims(file: ClaimsFile, checks: Mapping[str, Check]) -> list[Graded]:
    """Verdicts of all published values and claims of a file.

    Each check is run with the inputs of the base case, then with every sample of the unspecified inputs:
    Sobol points, uniform over ranges, and with equal probability over options. ``checks``: functions by name.
    Each takes the inputs as a mapping, and the options of its item by name. For a published value it returns
    a float, for a claim the result of ``claim``. Raises InputError when a check does not exist, or returns
    neither. Raises SimulationError when the base case has no result.
    """
    draws = sampled(file)
    found: list[Graded] = []
    for one in file.items:
        item = file.item(one)
        datasets: dict[str, xr.Dataset] = {}
        if one.check:
            function = _function(checks, one)
            rows = [{**file.base, **row} for row in _rows(draws)]
            base = [_answer(function, file.base, one, item.options)]
            datasets[f"{one.id} {BASE}"] = _dataset(base, file.fitted).isel(sample=0)
            if rows:
                answers = [_answer(function, row, one, item.options) for row in rows]
                datasets[f"{one.id} {SAMPLES}"] = _dataset(answers, file.fitted, draws)
        found.append(graded(file.study, item, lambda name: _looked_up, datasets))
    return found


def sampled(file: ClaimsFile) -> dict[str, NDArray[Any]]:
    """Values of all unspecified inputs in every sample, by name; empty if there are none."""
    if not file.open:
        return {}
    points = qmc.Sobol(len(file.open), seed=file.seed).random(file.samples)
    return {name: _spread(one, points[:, k]) for k, (name, one) in enumerate(file.open.items())}


def _spread(one: Assumed, share: NDArray[np.float64]) -> NDArray[Any]:
    """Values of an input at positions from 0 to 1 in its range or its options."""
    if one.range is not None:
        low, high = one.range
        return low + share * (high - low)
    options: NDArray[Any] = np.array(one.options, dtype=object)
    drawn: NDArray[Any] = options[(share * len(options)).astype(int)]
    return drawn


def _rows(draws: Mapping[str, NDArray[Any]]) -> list[dict[str, Value]]:
    columns = [[value if isinstance(value, str) else float(value) for value in c] for c in draws.values()]
    return [dict(zip(draws, row, strict=True)) for row in zip(*columns, strict=True)]


def _function(checks: Mapping[str, Check], one: OpenClaim) -> Check:
    if one.check is None or one.check not in checks:
        allowed = "use one of " + ", ".join(checks)
        found = f"there is no check function {one.check!r}"
        raise InputError("items", f"{one.id}.check", found, allowed)
    return checks[one.check]


def _answer(function: Check, inputs: Mapping[str, Value], one: OpenClaim, options: Any) -> Found:
    """The result of a check with some inputs."""
    _takes(function, inputs, one, options)
    answer = function(dict(inputs), **options)
    is_number = isinstance(answer, int | float | np.floating | np.integer)
    if one.kind == "number" and is_number and not isinstance(answer, bool):
        return Found(xr.DataArray(float(answer)))
    if one.kind == "claim" and isinstance(answer, Found):
        return answer
    allowed = "return a number, or `claim(value, margin)` for a claim"
    found = f"the check {one.check} returns {answer!r}"[:120]
    raise InputError("items", f"{one.id}.check", found, allowed)


def _takes(function: Check, inputs: Mapping[str, Value], one: OpenClaim, options: Any) -> None:
    """Refuse options that a check does not accept, before it is run."""
    try:
        inspect.signature(function).bind(inputs, **options)
    except TypeError as error:
        allowed = "give in `with` only arguments of this function"
        found = f"the check {one.check} cannot be called: {error}"
        raise InputError("items", f"{one.id}.with", found, allowed) from None


def _dataset(
    answers: list[Found], fitted: bool, draws: Mapping[str, NDArray[Any]] | None = None
) -> xr.Dataset:
    """Answers over samples, with the assumptions of each sample."""
    columns = {name: [getattr(answer, name) for answer in answers] for name in ("value", "margin", "same")}
    data: dict[str, Any] = {
        name: ("sample", [value.item() for value in column])
        for name, column in columns.items()
        if column[0] is not None
    }
    for name, values in (draws or {}).items():
        data[f"assumed_{name}"] = ("sample", np.array([str(v) for v in values]), {"long_name": name})
    return xr.Dataset(data, {"sample": np.arange(len(answers))}, {FITTED: int(fitted)})


def _looked_up(answers: xr.Dataset, **_: Any) -> Found:
    """The result from the dataset of answers, for which the options have already been used."""
    value = answers["value"].drop_vars("sample") if not answers["value"].ndim else answers["value"]
    if "margin" not in answers:
        return Found(value)
    parts = [
        answers[name] if value.ndim else answers[name].drop_vars("sample") for name in ("margin", "same")
    ]
    return judged(value, Condition(*parts))
