"""Values that the options of axes set at all points of a dataset: the value of the scene then never holds."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import Origin
from riserstudy.scene.paths import within_any

if TYPE_CHECKING:
    import xarray as xr


class OfOptions(NamedTuple):
    """The scene of a dataset with the values of axes that have only one option.

    ``alone``: paths that this option sets, by axis. ``several``: of other axes, those of each option.
    """

    file: SceneFile
    alone: dict[str, list[str]]
    several: dict[str, list[list[str]]]

    def axis_of_one(self, path: str) -> str | None:
        """Return the axis whose only option sets a value."""
        return next((axis for axis, paths in self.alone.items() if within_any(path, paths)), None)

    def varied_by(self, path: str) -> str | None:
        """Return the axis of which each option sets a value or a part that contains it."""
        every = self.several.items()
        return next((axis for axis, options in every if all(within_any(path, one) for one in options)), None)


def set_by_options(dataset: xr.Dataset) -> OfOptions:
    """Return the scene of a dataset, with the paths that its axes with options set."""
    attributes = dataset.attrs
    origins, evidence = (json.loads(attributes.get(name, "{}")) for name in ("origins", "evidence"))
    known = {path: Origin(status, None, why=evidence.get(path, "")) for path, status in origins.items()}
    of = OfOptions(SceneFile("", json.loads(attributes["scene"]), known, held={}), {}, {})
    for axis in map(str, dataset["point_key"].dims):
        options = _options(dataset[axis])
        if len(options) == 1:
            of = of._replace(file=of.file.with_values(options[0], axis))
            of.alone[axis] = [*options[0]]
        elif options:
            of.several[axis] = [[*one] for one in options]
    return of


def _options(axis: xr.DataArray) -> list[dict[str, Any]]:
    """Return what each option of an axis sets; nothing for an axis of numbers."""
    sets = json.loads(axis.attrs.get("sets", "{}"))
    if axis.dtype.kind in "fiu":
        return []
    return [sets.get(str(value), {}) for value in axis.values.tolist()]
