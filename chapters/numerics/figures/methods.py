"""Mark, colour and name of each time integration method: one for all figures of the numerics chapter."""

from __future__ import annotations

from riserstudy.figures.style import COLOURS

EXPLICIT = "explicit"
#: families of the methods of the datasets
FAMILIES = {
    "gen.-alpha 0.8": "generalised-alpha",
    "gen.-alpha 1": "generalised-alpha",
    "gen.-alpha 0.5": "generalised-alpha",
    "Newmark 0.3025 0.6": "Newmark (β 0.3025, γ 0.6)",
    "Newmark 1/4 1/2": "Newmark (β 1/4, γ 1/2)",
    "Verlet": EXPLICIT,
    "semi-implicit Euler": EXPLICIT,
    "Hermite, Newmark 1/4 1/2": "Newmark, Hermite elements",
}
#: names without settings, of families whose name has settings
SHORT = {"Newmark (β 0.3025, γ 0.6)": "Newmark", "Newmark (β 1/4, γ 1/2)": "Newmark"}
#: names in keys that distinguish the methods of a family
IN_KEYS = {
    "gen.-alpha 0.8": "generalised-alpha 0.8",
    "gen.-alpha 1": "generalised-alpha 1",
    "gen.-alpha 0.5": "generalised-alpha 0.5",
    "Newmark 0.3025 0.6": FAMILIES["Newmark 0.3025 0.6"],
    "Newmark 1/4 1/2": FAMILIES["Newmark 1/4 1/2"],
}
#: mark, colour and width of the line of each family
LOOK = {
    "generalised-alpha": ("o", COLOURS[0], 1.4),
    "TR-BDF2": ("v", COLOURS[4], 1.4),
    "ESDIRK4": ("D", COLOURS[1], 2.2),
    "Newmark (β 0.3025, γ 0.6)": ("^", COLOURS[3], 1.4),
    "Newmark (β 1/4, γ 1/2)": ("^", COLOURS[3], 1.4),
    EXPLICIT: ("s", COLOURS[2], 1.4),
    "Newmark, Hermite elements": ("P", COLOURS[5], 1.4),
    "Radau": (">", COLOURS[6], 1.4),
}
UNKNOWN = ("*", "0.4", 1.4)


def family_of(method: str) -> str:
    """Return the family of a method of a dataset."""
    return FAMILIES.get(method, method)


def short_name(method: str) -> str:
    """Return the name of a method or family without its settings."""
    family = family_of(method)
    return SHORT.get(family, family)


def look_of(method: str) -> tuple[str, str, float]:
    """Return mark, colour and width of the line of a method or family."""
    return LOOK.get(family_of(method), UNKNOWN)
