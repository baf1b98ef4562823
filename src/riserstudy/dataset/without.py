"""Keep libraries from loading others that nothing here needs, which takes longer than most runs."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without(*modules: str) -> Iterator[None]:
    """While it lasts, modules that are not loaded yet are not to be found."""
    away = [name for name in modules if name not in sys.modules]
    sys.modules.update(dict.fromkeys(away))  # type: ignore[arg-type]  # as the import system has it
    try:
        yield
    finally:
        for name in away:
            del sys.modules[name]
