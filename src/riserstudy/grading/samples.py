"""How many samples meet a number or claim, as its row tells it. Needs no solver of statistics to read."""

from __future__ import annotations

import re
from typing import NamedTuple

#: how a row tells hits and samples, and where samples are many the band of their share
SAMPLES_MET = r"(?:[Mm]et|[Tt]rue) in (\d+) of (\d+) samples(?: \(\d+ %(?:, (\d+) to (\d+) %)?\))?"


class Share(NamedTuple):
    """Hits among samples, and the 95 % band of their share where samples are many."""

    met: int | None
    samples: int | None
    low: float | None
    high: float | None


def samples_met(text: str) -> Share:
    """Hits and samples as a row tells them: at the start of a note, or behind what decides."""
    counts = re.search(rf"(?:^|; ){SAMPLES_MET}", text)
    if not counts:
        return Share(None, None, None, None)
    low, high = (int(percent) / 100 if percent else None for percent in counts.group(3, 4))
    return Share(int(counts[1]), int(counts[2]), low, high)
