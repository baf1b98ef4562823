"""Compile all kernels once, before jobs fan out, and note how long that took from nothing."""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

from riserstudy.compile_times import while_compiling
from riserstudy.folders import kernel_cache, write_whole
from riserstudy.warmup import warm_up


def main(marker: Path) -> None:
    """Warm up, and write the times into the marker when there were no kernels before."""
    cold = next(kernel_cache().rglob("*.nbi"), None) is None
    started = time.perf_counter()
    kernels = while_compiling(warm_up)
    seconds = round(time.perf_counter() - started, 1)
    marker.parent.mkdir(parents=True, exist_ok=True)
    about = {"cold_seconds": seconds, "kernels": kernels} if cold else {"cold_seconds": None}
    write_whole(marker, json.dumps(about).encode())
    print(f"{'compiled' if cold else 'loaded'} in {seconds} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("marker", type=Path)
    main(**vars(parser.parse_args()))
