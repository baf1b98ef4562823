"""Keep libraries from loading others that nothing here needs, which takes longer than most runs."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without(*modules: str) -> Iterator[None]:
    """While it lasts, modules that are not loaded yet are not to be found.

    An xarray that is loaded looks anew, now and afterwards, for what it remembers to have found; one that is
    loaded meanwhile goes on without them.
    """
    away = [name for name in modules if name not in sys.modules]
    remembered = getattr(sys.modules.get("xarray.namedarray.utils"), "module_available", None)
    forget = getattr(remembered, "cache_clear", lambda: None)
    sys.modules.update(dict.fromkeys(away))  # type: ignore[arg-type]  # as the import system has it
    forget()
    try:
        yield
    finally:
        for name in away:
            del sys.modules[name]
        forget()
