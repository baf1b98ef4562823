"""The tables of colours of chapters, and which meaning a colour has by them."""

from matplotlib.colors import to_hex, to_rgb

from chapters.chang2020.figures import shared as chang2020
from chapters.liu2020.figures import colours as liu2020
from chapters.mao_hangoff.figures import colours as mao_hangoff
from riserstudy.figures.style import shades

TABLES = {
    "chang2020": (chang2020.OF_MODEL, chang2020.OF_STATE, chang2020.OF_START, chang2020.OF_MASS),
    "liu2020": (
        liu2020.OF_TOP,
        liu2020.OF_MOTION,
        {"waves on the riser": liu2020.WITH_WAVES},
        liu2020.OF_PROFILE,
        liu2020.OF_CALIBRATION,
    ),
    "mao_hangoff": (
        mao_hangoff.OF_INPUT,
        mao_hangoff.OF_COORDINATE,
        mao_hangoff.OF_MESH,
        mao_hangoff.OF_WEIGHT,
    ),
}
MOST_SHADES = 6


def meanings(paper):
    """All meanings of a chapter with their colours."""
    return [item for table in TABLES[paper] for item in table.items()]


def base_of(paper, colour):
    """The assigned colour that one is, or is a shade of; "neutral" for grey; None for any other."""
    red, green, blue = to_rgb(colour)
    if max(red, green, blue) - min(red, green, blue) < 0.02:
        return "neutral"
    for _, base in meanings(paper):
        known = {base, *(s for count in range(2, MOST_SHADES + 1) for s in shades(base, count))}
        if to_hex(colour) in known:
            return base
    return None
