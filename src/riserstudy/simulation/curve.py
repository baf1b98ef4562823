"""The curve of the riser between nodes, as the elements define it.

A moment is the cubic through its values at a segment's ends and its slopes there, which are those of the
parabola through three nodes, so the shear is continuous. At corners, where shear may jump, the three nodes
are on one side. A segment bends by the moments at its ends, and its tension is linear from end to end.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import Arrays, FloatArray

NEAR = 1e-5  # share of a segment within which a place is a node, for meshes with rounded nodes
SAME = 1e-9  # share of the length within which a place is a node


class Slopes(NamedTuple):
    """Slopes at one end of all segments, as weights of the values at three nodes."""

    node: NDArray[np.int64]  # (n, 3)
    weight: FloatArray  # (n, 3), 1/m

    def of(self, values: FloatArray, e: NDArray[np.int64]) -> FloatArray:
        """Slopes (1/m) at this end of segments ``e``, any shape, of values over (..., nodes)."""
        return np.asarray((values[..., self.node[e]] * self.weight[e]).sum(axis=-1))


class Curve(NamedTuple):
    """A mesh and what is known of it between nodes."""

    s: FloatArray  # (n + 1,) m
    low: Slopes
    up: Slopes

    def segment(self, places: FloatArray) -> tuple[NDArray[np.int64], FloatArray]:
        """The segments that contain places (m), and the relative positions within them, in the same shape."""
        e = np.clip(np.searchsorted(self.s, places, "right") - 1, 0, len(self.s) - 2)
        share = (places - self.s[e]) / (self.s[e + 1] - self.s[e])
        return e, np.where(share > 1.0 - SAME, 1.0, np.where(share < SAME, 0.0, share))

    def cubic(self, values: FloatArray, places: FloatArray) -> FloatArray:
        """Values over (..., nodes) at places (m), (..., places), by the cubic of each segment."""
        e, x = self.segment(places)
        length = self.s[e + 1] - self.s[e]
        ends = (1.0 + 2.0 * x) * (1.0 - x) ** 2 * values[..., e]
        ends = ends + x * x * (3.0 - 2.0 * x) * values[..., e + 1]
        low = x * (1.0 - x) ** 2 * length * self.low.of(values, e)
        return np.asarray(ends + low - x * x * (1.0 - x) * length * self.up.of(values, e))

    def straight(self, values: FloatArray, places: FloatArray) -> FloatArray:
        """Values over (..., nodes) at places (m), (..., places), linear between nodes."""
        e, x = self.segment(places)
        return np.asarray((1.0 - x) * values[..., e] + x * values[..., e + 1])

    @property
    def middle_weights(self) -> FloatArray:
        """Shares of nodes e - 1 to e + 2 in the value of the cubic at the middle of a segment, (n, 4)."""
        length = np.diff(self.s)[:, None]
        low, up = self.slope_weights
        return np.asarray(np.array([0.0, 0.5, 0.5, 0.0]) + 0.125 * length * (low - up))

    @property
    def slope_weights(self) -> FloatArray:
        """Weights of nodes e - 1 to e + 2 in the slopes at both ends of a segment (1/m), (2, n, 4)."""
        n = len(self.s) - 1
        out = np.zeros((2, n, 4))
        rows = np.arange(n)
        for side, slopes in zip(out, (self.low, self.up), strict=True):
            for k in range(3):
                side[rows, slopes.node[:, k] - rows + 1] += slopes.weight[:, k]
        return out


def between_nodes(s: FloatArray, values: FloatArray, places: FloatArray) -> FloatArray:
    """Values over nodes (m), (..., nodes), at places (m): linear between nodes, and exact at a node.

    A NaN at one node therefore does not affect the value at the next node.
    """
    e = np.clip(np.searchsorted(s, places, "right") - 1, 0, len(s) - 2)
    share = (places - s[e]) / (s[e + 1] - s[e])
    between = (1.0 - share) * values[..., e] + share * values[..., e + 1]
    between = np.where(share < NEAR, values[..., e], between)
    return np.asarray(np.where(share > 1.0 - NEAR, values[..., e + 1], between))


def curve_of(arrays: Arrays) -> Curve:
    """The curve of a run's mesh."""
    s = arrays["s_node"]
    corner = arrays.get("mesh_corner")
    return _known(s.tobytes(), (np.zeros(len(s)) if corner is None else corner).tobytes())


@lru_cache(64)
def _known(s: bytes, corner: bytes) -> Curve:
    """The curve, cached by mesh: a comparison of two runs uses it a dozen times."""
    return curve(np.frombuffer(s), np.frombuffer(corner))


def curve(s: FloatArray, corner: FloatArray) -> Curve:
    """The curve over nodes (m), (n + 1,), with corners at its ends and where ``corner``, (n + 1,), is set."""
    n = len(s) - 1
    smooth = corner == 0.0
    smooth[[0, -1]] = False
    e = np.arange(n)
    # three nodes about the lower end, three nodes about the upper end, or two nodes
    below, above = np.stack([e - 1, e, e + 1], axis=1), np.stack([e, e + 1, e + 2], axis=1)
    two = np.stack([e, e + 1, e], axis=1)
    secant = np.array([-1.0, 1.0, 0.0]) / np.diff(s)[:, None]
    by_below, by_above = _parabola(s, below), _parabola(s, above)
    has_below, has_above = smooth[:-1][:, None], smooth[1:][:, None]
    low = np.where(has_below, by_below[1], np.where(has_above, by_above[0], secant))
    up = np.where(has_above, by_above[1], np.where(has_below, by_below[2], secant))
    return Curve(
        s,
        Slopes(np.where(has_below, below, np.where(has_above, above, two)), low),
        Slopes(np.where(has_above, above, np.where(has_below, below, two)), up),
    )


def _parabola(s: FloatArray, nodes: NDArray[np.int64]) -> list[FloatArray]:
    """Weights of the slopes at each of three nodes, of the parabola through them, three times (n, 3)."""
    a, b, c = s[np.clip(nodes, 0, len(s) - 1)].T
    with np.errstate(divide="ignore", invalid="ignore"):  # beyond the ends, where no slope is used
        h, k = b - a, c - b
        whole = h + k
        return [
            np.stack([-(h + whole) / (h * whole), whole / (h * k), -h / (k * whole)], axis=1),
            np.stack([-k / (h * whole), (k - h) / (h * k), h / (k * whole)], axis=1),
            np.stack([k / (h * whole), -whole / (h * k), (k + whole) / (k * whole)], axis=1),
        ]


def at_stations(arrays: Arrays, places: FloatArray) -> Arrays:
    """Histories at places (m) from histories at all nodes, by the curve of the elements between nodes.

    Positions are computed together with the moment. ``mesh_moment`` (time, 3, nodes), the components of a
    moment whose magnitude is the history, is removed.
    """
    of = curve_of(arrays)
    e, x = of.segment(places)
    arrays_there: Arrays = {"s": places}
    axes = [name for name in "xyz" if name in arrays]
    moment = arrays.get("bending_moment")
    components = arrays.get("mesh_moment")
    for name in axes:
        arrays_there[name] = of.straight(arrays[name], places)
    if moment is not None and "mesh_flexibility" in arrays and {"x", "z"}.issubset(axes):
        bent = moment if components is None else components
        for name, sideways in _sag(arrays, axes, bent, e, x).items():
            arrays_there[name] = arrays_there[name] + sideways
    elif "x" in arrays_there:  # the Hermite beam, with cubic elements
        arrays_there["x"] = of.cubic(arrays["x"], places)
    if "effective_tension" in arrays:
        arrays_there["effective_tension"] = of.straight(arrays["effective_tension"], places)
    if components is not None:
        laid = of.cubic(components, places) - _jump(arrays, components, e, x)
        arrays_there["bending_moment"] = np.linalg.norm(laid, axis=1)
    elif moment is not None:
        arrays_there["bending_moment"] = of.cubic(moment, places) - _jump(arrays, moment, e, x)
    return arrays_there


def _jump(arrays: Arrays, moment: FloatArray, e: NDArray[np.int64], x: FloatArray) -> FloatArray:
    """Excess (N m) of the moment between nodes in a telescopic joint, which begins above the jump at a ring.

    The nodal moment at the ring is the moment below it; the moment in the joint is linear.
    """
    within = np.where((e == len(arrays["s_node"]) - 2) & (x > 0.0), 1.0 - x, 0.0)
    if "mesh_above_ring" not in arrays:
        return np.zeros_like(within)
    return np.asarray((moment[..., -2] - arrays["mesh_above_ring"])[..., None] * within)


def _sag(arrays: Arrays, axes: list[str], moment: FloatArray, e: NDArray[np.int64], x: FloatArray) -> Arrays:
    """Distance of segments from their chords; the curvature M / EI is linear from end to end."""
    chord = np.stack([arrays[name][:, e + 1] - arrays[name][:, e] for name in axes], axis=1)
    low, up = moment[..., e], moment[..., e + 1]
    if "mesh_above_ring" in arrays:
        low = np.where(e == len(arrays["s_node"]) - 2, arrays["mesh_above_ring"][..., None], low)
    bent = x * (1.0 - x) * ((2.0 - x) * low + (1.0 + x) * up)
    bent = -bent * arrays["mesh_flexibility"][e] / 6.0
    if len(axes) == 3:  # the tangent rotates about the curvature vector
        away = np.cross(bent, chord, axis=1)
    else:  # towards +x for a positive moment
        away = np.stack([chord[:, 1], -chord[:, 0]], axis=1) * bent[:, None]
    return {name: away[:, k] for k, name in enumerate(axes)}


def largest_moment(arrays: Arrays) -> tuple[float, float] | None:
    """Magnitude (N m) and place (m) of the largest bending moment on the curve; None without bending."""
    if "bending_moment_static" not in arrays:
        return None
    of = curve_of(arrays)
    sides = [arrays[n] for n in ("bending_moment_max", "bending_moment_min") if n in arrays]
    sides = sides or [arrays["bending_moment_static"]]
    middle = 0.5 * (of.s[1:] + of.s[:-1])
    between = [arrays[n] for n in ("mesh_moment_max", "mesh_moment_min") if n in arrays]
    between = between or [of.cubic(side, middle) for side in sides]
    size, place = np.empty(2 * len(of.s) - 1), np.empty(2 * len(of.s) - 1)
    size[::2], size[1::2] = np.abs(sides).max(axis=0), np.abs(between).max(axis=0)
    place[::2], place[1::2] = of.s, middle
    above = [arrays[n] for n in ("mesh_above_ring_absmax", "mesh_above_ring_static") if n in arrays]
    if above and (largest := float(np.linalg.norm(above[0]))) > size.max():
        return largest, float(of.s[-2])
    k = int(size.argmax())
    corner = arrays.get("mesh_corner")
    if 0 < k < len(size) - 1 and (k % 2 or corner is None or corner[k // 2] == 0.0):
        return _vertex(place[k - 1 : k + 2], size[k - 1 : k + 2])
    return float(size[k]), float(place[k])


def _vertex(s: Any, values: Any) -> tuple[float, float]:
    """Value and place of the vertex of the parabola through three points, of which the middle is highest."""
    left = (values[1] - values[0]) / (s[1] - s[0])
    right = (values[2] - values[1]) / (s[2] - s[1])
    bend = (right - left) / (s[2] - s[0])
    if bend >= 0.0:
        return float(values[1]), float(s[1])
    slope = left + bend * (s[1] - s[0])
    return float(values[1] - slope**2 / (4.0 * bend)), float(s[1] - slope / (2.0 * bend))
