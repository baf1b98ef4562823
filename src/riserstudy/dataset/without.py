"""Prevents imports of unneeded libraries by other libraries, which would take longer than most runs."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without(*modules: str) -> Iterator[None]:
    """Within this context, modules that are not loaded yet cannot be imported.

    If xarray is already loaded, its memory of available modules is cleared now and afterwards. If xarray is
    loaded within this context, it works without these modules.
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
