"""The point store: every simulated point under the hash of its parameters and of the engine.

A point is one file, written under another name and renamed when complete: a line of JSON that says what
follows, the arrays one after the other, and a seal, the hash of all this and of the point's key. What is
not as it was written, or stands under another's name, counts as missing. Planning needs no numpy: keys
come from plain text.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import BaseModel

from riserstudy.digests import engine_digest
from riserstudy.folders import cache_folder, write_whole
from riserstudy.scene.models import Scene

if TYPE_CHECKING:
    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile


SEAL = hashlib.sha256().digest_size  # bytes
ENDING = ".point"


def canonical(value: Any) -> Any:
    """Plain data with floats in hexadecimal: equal numbers give equal text, and only they."""
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, dict):
        return {str(key): canonical(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [canonical(item) for item in value]
    if isinstance(value, BaseModel):
        return {name: canonical(getattr(value, name)) for name in type(value).__pydantic_fields__}
    return value


_to_json = json.JSONEncoder(sort_keys=True).encode

#: parts of a scene that a simulation depends on, as keys order them
COUNTS = tuple(sorted(set(Scene.model_fields) - {"title", "note", "paper", "limits"}))


def text_of(part: Any) -> str:
    """Canonical text of a part of a scene."""
    return _to_json(canonical(part))


def key_of_texts(texts: dict[str, str]) -> str:
    """Hash of the canonical texts of a scene's parts, and of the engine."""
    parts = ", ".join([f'"{name}": {texts[name]}' for name in COUNTS])
    text = f'["{engine_digest()}", {{{parts}}}]'
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def key_of(scene: Scene) -> str:
    """Hash of a checked scene and the engine; titles and notes do not count."""
    return key_of_texts({name: text_of(getattr(scene, name)) for name in COUNTS})


def _file(key: str) -> Path:
    return cache_folder() / "points" / key[:2] / f"{key}{ENDING}"


def put(key: str, result: Result, file: SceneFile) -> None:
    """Store a point, complete or not at all."""
    import numpy as np

    arrays = {name: np.asarray(values, order="C") for name, values in result.arrays.items()}
    about = {
        "facts": result.facts,
        "scene": file.tree,
        "source": file.source,
        "engine": engine_digest(),
        "origins": {path: origin.status for path, origin in file.origins.items()},
        "arrays": {name: [values.dtype.str, values.shape] for name, values in arrays.items()},
    }
    whole = b"".join([json.dumps(about).encode(), b"\n", *(a.tobytes() for a in arrays.values())])
    target = _file(key)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_whole(target, whole + _seal(key, whole))


def _seal(key: str, content: bytes | memoryview) -> bytes:
    """What stands at the end of a whole point."""
    total = hashlib.sha256(key.encode() + b"\n")
    total.update(content)
    return total.digest()


class Stored(NamedTuple):
    """A point that was read whole: what it says of itself, and the bytes of its arrays."""

    about: dict[str, Any]
    content: memoryview


def _read(path: Path) -> Stored | None:
    """A stored point; None when it is missing or not as it was written."""
    try:
        whole = path.read_bytes()
    except OSError:
        return None
    content = memoryview(whole)[:-SEAL]
    if len(whole) <= SEAL or whole[-SEAL:] != _seal(path.stem, content):
        return None
    end = whole.index(b"\n")  # JSON has none
    return Stored(json.loads(whole[:end]), content[end + 1 :])


def get(key: str, names: Collection[str] | None = None) -> Result | None:
    """A stored point with all arrays or some, or None when it is missing or not whole."""
    stored = _read(_file(key))
    if stored is None:
        return None
    import numpy as np

    from riserstudy.dataset.result import Result

    arrays, begin = {}, 0
    for name, (kind, shape) in stored.about["arrays"].items():
        dtype, count = np.dtype(kind), math.prod(shape)
        if names is None or name in names:
            part = np.frombuffer(stored.content, dtype, count, begin)
            arrays[name] = part.reshape(shape).copy()  # so that the others can be let go
        begin += count * dtype.itemsize
    return Result(arrays, stored.about["facts"])


def has(key: str) -> bool:
    """Whether a file of that name is there; `get` tells whether it is whole."""
    return _file(key).exists()


def about(key: str) -> dict[str, Any] | None:
    """What a stored point says of itself: facts, scene, source, engine, origins; None when not whole."""
    stored = _read(_file(key))
    return None if stored is None else stored.about


def about_points() -> Iterator[dict[str, Any]]:
    """What each stored point says of itself, with its key."""
    for path in sorted((cache_folder() / "points").glob(f"*/*{ENDING}")):
        if (stored := _read(path)) is not None:
            yield {"key": path.stem, **stored.about}


class Held(NamedTuple):
    """Something that takes space in the store; without a key where it is no point of today's format."""

    key: str | None
    bytes: int
    path: Path


def everything() -> Iterator[Held]:
    """All that lies in the store, whole or not."""
    for path in sorted((cache_folder() / "points").glob("*/*")):
        yield Held(path.stem if path.suffix == ENDING else None, path.stat().st_size, path)


def remove(held: Held) -> None:
    """Take something out of the store."""
    held.path.unlink(missing_ok=True)
