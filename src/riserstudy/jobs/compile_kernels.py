"""Compile a group of kernels once, before jobs fan out; without a group, note that all are."""

from __future__ import annotations

import argparse

from riserstudy.simulation.compile import compile_group, join_markers
from riserstudy.simulation.kernel_groups import GROUPS

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--group", choices=GROUPS)
    options = parser.parse_args()
    if options.group:
        print(compile_group(options.group))
    else:
        join_markers()
