"""The point store: every simulated point under the hash of its parameters and of the engine.

A point is one file, written under another name and renamed when complete. What cannot be read whole
counts as missing. Planning needs no numpy: keys come from plain text.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from riserstudy.digests import engine_digest
from riserstudy.folders import cache_folder, write_whole
from riserstudy.scene.models import Scene

if TYPE_CHECKING:
    from numpy.lib.npyio import NpzFile

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile


SEAL = hashlib.sha256().digest_size  # bytes


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
COUNTS = tuple(sorted(set(Scene.model_fields) - {"title", "note", "paper"}))


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
    return cache_folder() / "points" / key[:2] / f"{key}.npz"


def put(key: str, result: Result, file: SceneFile) -> None:
    """Store a point, complete or not at all."""
    import numpy as np

    target = _file(key)
    target.parent.mkdir(parents=True, exist_ok=True)
    about = {
        "facts": result.facts,
        "scene": file.tree,
        "source": file.source,
        "engine": engine_digest(),
    }
    about["origins"] = {path: origin.status for path, origin in file.origins.items()}
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, about=np.array(json.dumps(about)), **result.arrays)
    whole = content.getvalue()
    write_whole(target, whole + _seal(whole))


def _seal(content: bytes) -> bytes:
    """What stands at the end of a whole point: the format's own sums leave its directory out."""
    return hashlib.sha256(content).digest()


def get(key: str, names: Collection[str] | None = None) -> Result | None:
    """A stored point with all arrays or some, or None when it is missing or not whole."""
    from riserstudy.dataset.result import Result

    with _opened(_file(key)) as stored:
        if stored is None:
            return None
        wanted = [n for n in stored.files if n != "about" and (names is None or n in names)]
        arrays = {name: stored[name] for name in wanted}
        return Result(arrays, json.loads(str(stored["about"]))["facts"])


@contextmanager
def _opened(path: Path) -> Iterator[NpzFile | None]:
    """The arrays of a stored point; None when it is missing or not as it was written."""
    import numpy as np

    try:
        whole = path.read_bytes()
    except OSError:
        whole = b""
    content, seal = whole[:-SEAL], whole[-SEAL:]
    if seal != _seal(content):
        yield None
        return
    with np.load(io.BytesIO(content), allow_pickle=False) as stored:
        yield stored


def has(key: str) -> bool:
    """Whether a file of that name is there; `get` tells whether it is whole."""
    return _file(key).exists()


def about_points() -> Iterator[dict[str, Any]]:
    """What each stored point says of itself, with its key."""
    for path in sorted((cache_folder() / "points").glob("*/*.npz")):
        with _opened(path) as stored:
            if stored is not None:
                yield {"key": path.stem, **json.loads(str(stored["about"]))}
