"""Names of the scenes of the numerics chapter, in words."""

from __future__ import annotations

#: names of scenes, in two lines
NAMES = {
    "S2": "riser in surge,\nconstant tension",
    "S2c": "riser in surge,\ntop held",
    "S3": "hung-off pipe\nin heave",
    "Chang at 10 m": "gas tensioner,\nheave of 10 m",
    "Liu 2020 roll of 4 deg in 10 s": "riser under\nroll of 4°",
    "fem_riser base": "riser in waves,\nwithout ramp",
}
#: beginnings of the names of random families
PAPERS = {
    "liu2020 in space": "Liu 2020, three-dimensional",
    "chang2020 ": "Chang 2020, ",
    "liu2017 ": "Liu 2017, ",
    "liu2020 ": "Liu 2020, ",
    "mao_hangoff ": "Mao et al., ",
    "fem_riser, ": "riser in waves, ",
}


def in_two_lines(scene: str) -> str:
    """Return the name of a scene in words, in two lines if it is long."""
    if scene in NAMES:
        return NAMES[scene]
    first, _, rest = scene.partition(" of " if len(scene) > 18 else "\0")
    return f"{first}\n{rest}" if rest else first


def in_one_line(scene: str) -> str:
    """Return the name of a scene in words, in one line."""
    return " ".join(NAMES.get(scene, scene).split())


def family_in_words(family: str) -> str:
    """Return the name of a family of random scenes, with the citation of its paper."""
    for name, words in PAPERS.items():
        if family.startswith(name):
            return words + family.removeprefix(name)
    return family
