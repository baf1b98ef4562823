"""The machine on which a report was made; without it the times in the report mean little."""

from __future__ import annotations

import platform
import re
from pathlib import Path

from riserstudy.simulation.compile import available_cores

CPUINFO = Path("/proc/cpuinfo")  # on Linux


def made_on() -> str:
    """Return cores, processor, system and Python, in one sentence without its full stop."""
    cores = available_cores()
    count = "1 core" if cores == 1 else f"{cores} cores"
    python = platform.python_version()
    return f"Made on {count} ({processor()}), {platform.system()}, Python {python}"


def processor() -> str:
    """Return the name of the processor, or its architecture if the system does not tell the name."""
    try:
        named = re.search(r"^model name\s*:\s*(.+)$", CPUINFO.read_text("utf-8"), re.MULTILINE)
    except OSError:
        named = None
    return named[1].strip() if named else platform.processor() or platform.machine()
