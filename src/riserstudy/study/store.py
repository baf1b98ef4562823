"""The point store: every simulated point under the hash of its parameters and of the engine.

A point is one file, written under another name and renamed when complete. It contains its description as
JSON, the arrays that its studies need, both compressed, and a seal, which is the hash of all this and of the
point's key. A point that is damaged, has the name of another point, or lacks requested arrays counts as
missing. `pack` combines many points in few files. Planning needs no numpy, because keys follow from plain
text.
"""

from __future__ import annotations

import hashlib
import json
import math
import struct
import zlib
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import BaseModel

from riserstudy.errors import SimulationError
from riserstudy.files.cache import cache_folder
from riserstudy.files.digests import engine_digest
from riserstudy.files.whole import write_whole
from riserstudy.scene.parts import Parts
from riserstudy.study.needed import needed
from riserstudy.study.packs import Packs, write_pack

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile


SEAL = hashlib.sha256().digest_size  # bytes
ENDING = ".point2"  # of the second format; files of the first format remain until they are pruned
LENGTH = struct.Struct("<Q")  # length of the compressed JSON
LEVEL = 6  # level of compression: 2.4 % smaller than level 1, for 0.13 ms per point
A_PACK = 1000  # largest number of points in a pack
LEAST = 256  # smallest number of points for a pack


def canonical(value: Any) -> Any:
    """Plain data with floats in hexadecimal, so that only equal numbers give equal text."""
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

#: parts of a scene that a simulation depends on, in the order of keys
COUNTS = tuple(sorted(set(Parts.model_fields) - {"title", "note", "paper", "limits"}))


def text_of(part: Any) -> str:
    """Canonical text of a part of a scene."""
    return _to_json(canonical(part))


def key_of_texts(texts: dict[str, str], engine: str | None = None) -> str:
    """Hash of the canonical texts of a scene's parts, and of the engine: its digest; None: this one's."""
    parts = ", ".join([f'"{name}": {texts[name]}' for name in COUNTS])
    text = f'["{engine or engine_digest()}", {{{parts}}}]'
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def key_of(scene: Parts, engine: str | None = None) -> str:
    """Hash of a checked scene and the engine; titles and notes have no effect. ``engine`` as above."""
    return key_of_texts({name: text_of(getattr(scene, name)) for name in COUNTS}, engine)


def _file(key: str) -> Path:
    return cache_folder() / "points" / key[:2] / f"{key}{ENDING}"


def put(key: str, result: Result, file: SceneFile, keep: Collection[str] | None = None) -> None:
    """Store the arrays of a point for some quantities (None: all), completely or not at all.

    Arrays that were stored earlier, for another study, are kept. Raises SimulationError when the point cannot
    be stored, as in a read-only cache or on a full disk.
    """
    import numpy as np

    before = _read(key)
    shapes = {name: np.shape(values) for name, values in result.arrays.items()}
    names = needed(shapes, keep).union(before.about["arrays"] if before else ())
    target = _file(key)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, packed(key, result, file, names))
    except OSError as error:
        raise SimulationError(
            f"{cache_folder()} cannot be written: {error.strerror}; see whether the disk is full, or set the "
            "environment variable RISERSTUDY_CACHE to another folder"
        ) from None


def packed(key: str, result: Result, file: SceneFile, names: Collection[str]) -> bytes:
    """A point with some of its arrays in stored form, with its seal."""
    import numpy as np

    arrays = {n: np.asarray(a, order="C") for n, a in result.arrays.items() if n in names}
    about = {
        "facts": result.facts,
        "scene": file.tree,
        "source": file.source,
        "engine": engine_digest(),
        "origins": {path: origin.status for path, origin in file.origins.items()},
        "arrays": {name: [values.dtype.str, values.shape] for name, values in arrays.items()},
        "left_out": [name for name in result.arrays if name not in arrays],
    }
    head = zlib.compress(json.dumps(about).encode(), LEVEL)
    body = zlib.compress(b"".join([_by_place(values) for values in arrays.values()]), LEVEL)
    whole = b"".join([LENGTH.pack(len(head)), head, body])
    return whole + _seal(key, whole)


def _by_place(values: NDArray[Any]) -> bytes:
    """The first bytes of all numbers, then the second bytes, and so on: equal exponents compress well."""
    return values.reshape(-1).view("u1").reshape(-1, values.itemsize).T.tobytes()


def _from_places(content: memoryview, dtype: np.dtype[Any]) -> NDArray[Any]:
    """The numbers from bytes in the order of `_by_place`."""
    import numpy as np

    places = np.frombuffer(content, "u1").reshape(dtype.itemsize, -1)
    return np.ascontiguousarray(places.T).reshape(-1).view(dtype)


def _seal(key: str, content: bytes | memoryview) -> bytes:
    """The seal at the end of a complete point."""
    total = hashlib.sha256(key.encode() + b"\n")
    total.update(content)
    return total.digest()


class Stored(NamedTuple):
    """A complete point from the store: its description, and its compressed arrays."""

    about: dict[str, Any]
    content: memoryview

    def result(self, names: Collection[str]) -> Result:
        """The result with the arrays of these names."""
        import numpy as np

        from riserstudy.dataset.result import Result

        content = memoryview(zlib.decompress(self.content)) if names else memoryview(b"")
        arrays, begin = {}, 0
        for name, (kind, shape) in self.about["arrays"].items():
            dtype = np.dtype(kind)
            end = begin + math.prod(shape) * dtype.itemsize
            if name in names:
                arrays[name] = _from_places(content[begin:end], dtype).reshape(shape)
            begin = end
        return Result(arrays, self.about["facts"])


def _read(key: str) -> Stored | None:
    """A stored point, from its file or else from a pack; None if it is missing or damaged."""
    try:
        alone = unpacked(key, _file(key).read_bytes())
    except OSError:
        alone = None
    if alone is None and (packed_bytes := _packs().read(key)) is not None:
        return unpacked(key, packed_bytes)
    return alone


def _packs() -> Packs:
    return _packs_of(cache_folder() / "points/packs")


@cache
def _packs_of(folder: Path) -> Packs:
    return Packs(folder)


def pack(keys: Iterable[str]) -> None:
    """Combine points in separate files into packs, unless they are few.

    Files are removed after their pack is written; if it cannot be written, they are kept.
    """
    alone = [key for key in keys if _file(key).exists()]
    for first in range(0, len(alone), A_PACK):
        some = alone[first : first + A_PACK]
        if len(some) < LEAST:
            return
        contents, same = {}, {}
        for key in some:
            with suppress(OSError):
                same[key] = _file(key).stat().st_ino
                whole = _file(key).read_bytes()
                if whole[-SEAL:] == _seal(key, memoryview(whole)[:-SEAL]):
                    contents[key] = whole
        try:
            write_pack(_packs().folder, contents)
        except OSError:
            return
        for key in contents:
            with suppress(OSError):
                if _file(key).stat().st_ino == same[key]:  # else another process has replaced it
                    _file(key).unlink()


def unpacked(key: str, whole: bytes) -> Stored | None:
    """A point from its stored bytes; None if they are damaged or belong to another key."""
    content = memoryview(whole)[:-SEAL]
    begin = LENGTH.size
    if len(content) < begin or whole[-SEAL:] != _seal(key, content):
        return None
    (length,) = LENGTH.unpack(content[:begin])
    head = zlib.decompress(content[begin : begin + length])
    return Stored(json.loads(head), content[begin + length :])


def get(key: str, keep: Collection[str] | None = None) -> Result | None:
    """The arrays of a stored point for some quantities (None: all).

    None if the point is missing, is damaged, or lacks a required array.
    """
    stored = _read(key)
    if stored is None:
        return None
    held = stored.about["arrays"]
    shapes = {name: shape for name, (_, shape) in held.items()}
    wanted = needed(shapes | dict.fromkeys(stored.about["left_out"], ()), keep)
    return stored.result(wanted) if wanted.issubset(held) else None


class Part(NamedTuple):
    """The stored content of a point: its description, and the result with the stored arrays."""

    about: dict[str, Any]
    result: Result


def all_of(key: str) -> Part | None:
    """The stored content of a point, which may be only a part of its run; None if damaged."""
    stored = _read(key)
    return stored and Part(stored.about, stored.result(stored.about["arrays"]))


def has(key: str) -> bool:
    """Whether something is stored under this key; `get` also checks that it is undamaged."""
    return _file(key).exists() or key in _packs()


def about(key: str) -> dict[str, Any] | None:
    """Description of a stored point: facts, scene, source, engine, origins; None if damaged."""
    stored = _read(key)
    return None if stored is None else stored.about


class Held(NamedTuple):
    """An item in the store; without a key if it is not a point of the present format."""

    key: str | None
    bytes: int
    path: Path  # file of the point, or of its pack


def everything() -> Iterator[Held]:
    """All items in the store, damaged or not."""
    packs = dict(_packs().all())
    for path in sorted((cache_folder() / "points").glob("*/*")):
        if one := packs.get(path):
            for row in one.rows:
                yield Held(row["key"].decode(), int(row["length"]), path)
        else:
            yield Held(path.stem if path.suffix == ENDING else None, path.stat().st_size, path)


def remove(going: Iterable[Held]) -> None:
    """Remove items from the store; a pack is rewritten without them.

    Raises OSError when a pack cannot be rewritten; it is then not changed.
    """
    packs, out_of = dict(_packs().all()), defaultdict(set)
    for held in going:
        if packs.get(held.path):
            out_of[held.path].add(held.key)
        else:
            held.path.unlink(missing_ok=True)
    for path, keys in out_of.items():
        one = packs[path]
        stay = [row for row in one.rows if row["key"].decode() not in keys] if one else []
        contents = {row["key"].decode(): one.read(row) for row in stay} if one else {}
        if whole := {key: content for key, content in contents.items() if content is not None}:
            write_pack(path.parent, whole, born=path.name.partition("-")[0])
        path.unlink(missing_ok=True)
