"""Compile all kernels once, before jobs fan out; a broken cache is thrown away and made anew."""

from __future__ import annotations

import shutil
import time

from riserstudy.jit import kernel_cache
from riserstudy.warmup import warm_up


def main() -> None:
    """Warm up; if the cache cannot be read, delete it and try once more."""
    started = time.perf_counter()
    try:
        warm_up()
    except (EOFError, OSError, ValueError, ImportError, AttributeError, RuntimeError) as error:
        print(f"compiled kernels cannot be read ({error!r}); compiling anew")
        shutil.rmtree(kernel_cache(), ignore_errors=True)
        warm_up()
    print(f"compiled or loaded in {time.perf_counter() - started:.1f} s")


if __name__ == "__main__":
    main()
