"""Parts of small drawings as SVG text: lines, arrows, springs, dampers, on 120 by 120 units, z upwards."""

from __future__ import annotations

import math

Point = tuple[float, float]
SIZE = 120


def short(value: float) -> str:
    """Format a coordinate with at most one decimal."""
    return f"{value:.1f}".rstrip("0").rstrip(".")


def line(kind: str, *points: Point) -> str:
    """A line through points."""
    way = " ".join(f"{short(x)} {short(SIZE - z)}" for x, z in points)
    return f'<path class="{kind}" d="M{way}"/>'


def arrow(start: Point, end: Point, kind: str = "e") -> str:
    """A line with an arrowhead at its end."""
    (x, z), (u, w) = start, end
    way = math.hypot(u - x, w - z)
    a, b = (u - x) / way, (w - z) / way
    back = (u - 8 * a, w - 8 * b)
    head = [(u, w), (back[0] - 4 * b, back[1] + 4 * a), (back[0] + 4 * b, back[1] - 4 * a)]
    corners = " ".join(f"{short(p)},{short(SIZE - q)}" for p, q in head)
    return line(kind, start, back) + f'<polygon class="{"h" if kind == "e" else "b"}" points="{corners}"/>'


def both_ways(start: Point, end: Point) -> str:
    """A double arrow, for motion in both directions."""
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    return arrow(middle, end) + arrow(middle, start)


def zigzag(start: Point, end: Point, kind: str = "e", turns: int = 5, wide: float = 5.0) -> str:
    """A spring."""
    (x, z), (u, w) = start, end
    way = math.hypot(u - x, w - z)
    a, b = (u - x) / way, (w - z) / way
    points = [start, (x + 0.15 * (u - x), z + 0.15 * (w - z))]
    for k in range(2 * turns):
        t, side = 0.15 + 0.7 * (k + 0.5) / (2 * turns), wide if k % 2 else -wide
        points.append((x + t * (u - x) - side * b, z + t * (w - z) + side * a))
    points += [(x + 0.85 * (u - x), z + 0.85 * (w - z)), end]
    return line(kind, *points)


def dashpot(start: Point, end: Point, kind: str = "e") -> str:
    """A damper: a cup on the rod from the start, and a plate on the rod from the end."""
    (x, z), (u, w) = start, end
    way = math.hypot(u - x, w - z)
    a, b = (u - x) / way, (w - z) / way

    def at(along: float, across: float) -> Point:
        middle = 0.5 * way + along
        return x + middle * a - across * b, z + middle * b + across * a

    cup = line(kind, at(8, 6), at(-8, 6), at(-8, -6), at(8, -6))
    plate = line(kind, at(0, 5), at(0, -5))
    return cup + plate + line(kind, start, at(-8, 0)) + line(kind, at(0, 0), end)


def box(kind: str, left: float, low: float, wide: float, high: float) -> str:
    """A box."""
    return (
        f'<rect class="{kind}" x="{short(left)}" y="{short(SIZE - low - high)}" width="{short(wide)}" '
        f'height="{short(high)}"/>'
    )


def ring(kind: str, x: float, z: float, radius: float) -> str:
    """A circle."""
    return f'<circle class="{kind}" cx="{short(x)}" cy="{short(SIZE - z)}" r="{short(radius)}"/>'


def turn(x: float, z: float, radius: float, start: float, end: float) -> str:
    """An arc with an arrowhead at its end; angles in degrees, anticlockwise from the right."""
    steps = [math.radians(start + (end - start) * k / 16) for k in range(17)]
    points = [(x + radius * math.cos(a), z + radius * math.sin(a)) for a in steps]
    return line("e", *points[:-1]) + arrow(points[-4], points[-1])


def word(text: str, x: float, z: float) -> str:
    """A short text."""
    return f'<text x="{short(x)}" y="{short(SIZE - z)}">{text}</text>'
