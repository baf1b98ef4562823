"""Compile all kernels once, before jobs fan out."""

from __future__ import annotations

import argparse
from pathlib import Path

from riserstudy.simulation.compile import compile_all

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("marker", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    print(compile_all(options.marker, options.threads))
