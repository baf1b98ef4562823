"""The machine that a report was made on: times in it mean little without."""

from __future__ import annotations

import platform
import re
from pathlib import Path

from riserstudy.simulation.compile import available_cores

CPUINFO = Path("/proc/cpuinfo")  # of Linux


def made_on() -> str:
    """Cores, processor, system and Python, in one sentence without its point."""
    cores = available_cores()
    count = "1 core" if cores == 1 else f"{cores} cores"
    python = platform.python_version()
    return f"Made on {count} ({processor()}), {platform.system()}, Python {python}"


def processor() -> str:
    """Name of the processor, or of its kind where the system does not tell."""
    try:
        named = re.search(r"^model name\s*:\s*(.+)$", CPUINFO.read_text("utf-8"), re.MULTILINE)
    except OSError:
        named = None
    return named[1].strip() if named else platform.processor() or platform.machine()
