"""A model's effects as a list of addresses: compiled loops call what the list holds, nothing else.

An effect is a record (NamedTuple of numbers and arrays) and functions ``f(record, state) -> float``.
Here each pair becomes an *entry*: machine code that takes two addresses, that of the record and that
of the state. A program is an array of (entry, record) addresses. Absent effects are not in it, so
they cost nothing, and one compiled solver serves every combination of effects.

Measured against kernels specialised for each combination: equally fast, half the compile time for
eight combinations, 0.2-1 s instead of 3-5 s for each further one.

This is the only file with compiler intrinsics. Two rules follow from it: records and states must
stay alive while their program is used (``Program`` sees to it), and entries must not raise.
"""

from __future__ import annotations

import sys
from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import cfunc, typeof
from numba.core import types
from numba.extending import intrinsic

from riserstudy.jit import FAST, inner, kernel


@intrinsic
def thaw(typing, address, kind):
    """The value of type ``kind`` that ``freeze`` stored at an address; its arrays are borrowed."""

    def generate(context, builder, signature, arguments):
        native = context.get_value_type(signature.return_type)
        return builder.load(builder.inttoptr(arguments[0], native.as_pointer()))

    return kind.instance_type(types.int64, kind), generate


@intrinsic
def _store(typing, address, value):
    def borrowed(context, builder, kind, data):
        """The value without owners, so that reading it elsewhere never counts references."""
        if isinstance(kind, types.Array):
            array = context.make_array(kind)(context, builder, data)
            array.meminfo = ir.Constant(array.meminfo.type, None)
            array.parent = ir.Constant(array.parent.type, None)
            return array._getvalue()
        if isinstance(kind, types.BaseTuple):
            for k, member in enumerate(kind.types):
                part = borrowed(context, builder, member, builder.extract_value(data, k))
                data = builder.insert_value(data, part, k)
        return data

    def generate(context, builder, signature, arguments):
        native = context.get_value_type(value)
        place = builder.inttoptr(arguments[0], native.as_pointer())
        builder.store(borrowed(context, builder, value, arguments[1]), place)
        return context.get_dummy_value()

    return types.void(types.int64, value), generate


@intrinsic
def _call(typing, entry, record, state):
    def generate(context, builder, signature, arguments):
        word = ir.IntType(64)
        kind = ir.FunctionType(ir.DoubleType(), [word, word])
        return builder.call(
            builder.inttoptr(arguments[0], kind.as_pointer()), [arguments[1], arguments[2]]
        )

    return types.float64(types.int64, types.int64, types.int64), generate


@kernel
def _freeze(address, value):
    _store(address, value)


@inner
def every(program, state):
    """Call all entries of a program, int64 array (entries, 2), on the state at an address."""
    total = 0.0
    for k in range(program.shape[0]):
        total += _call(program[k, 0], program[k, 1], state)
    return total


class Frozen(NamedTuple):
    """A record or state in a form that compiled code can read by address."""

    value: object  # keeps the arrays alive
    memory: np.ndarray
    address: int


def freeze(value) -> Frozen:
    """Lay a NamedTuple of numbers, arrays and tuples down in memory."""
    kind = typeof(value)
    memory = np.zeros(1 + _words(kind), np.int64)
    _freeze(memory.ctypes.data, value)
    return Frozen(value, memory, memory.ctypes.data)


def _words(kind) -> int:
    """Eight-byte words that a value of this type fills, or a little more."""
    if isinstance(kind, types.Array):
        return 5 + 2 * kind.ndim
    if isinstance(kind, types.BaseTuple):
        return sum(_words(member) for member in kind.types)
    return 1


_entries: dict[tuple, object] = {}


def entry(function, record_kind, state_kind) -> int:
    """Address of compiled code that applies an effect's function to a record and a state.

    The source is generated in the name of the effect's own file, where numba looks for its cache.
    """
    key = (function, record_kind, state_kind)
    if key not in _entries:
        effect = function.__name__, hash_name(record_kind), hash_name(state_kind)
        name = "entry_" + "_".join(effect)
        source = (
            f"def {name}(record, state):\n"
            "    return function(thaw(record, record_kind), thaw(state, state_kind))\n"
        )
        scope = {
            "function": function,
            "thaw": thaw,
            "record_kind": record_kind,
            "state_kind": state_kind,
            "__name__": function.__module__,
        }
        file = sys.modules[function.__module__].__file__
        exec(compile(source, file, "exec"), scope)
        signature = types.float64(types.int64, types.int64)
        _entries[key] = cfunc(
            signature, cache=True, fastmath=FAST, error_model="numpy"
        )(scope[name])
    return _entries[key].address


def hash_name(kind) -> str:
    """A short name for a type, the same in every process."""
    import hashlib

    return hashlib.sha256(str(kind).encode()).hexdigest()[:10]


def assemble(calls, state) -> np.ndarray:
    """Program, int64 array (len(calls), 2), of (function, frozen record) pairs for one state."""
    state_kind = typeof(state.value)
    rows = [
        (entry(function, typeof(record.value), state_kind), record.address)
        for function, record in calls
    ]
    return np.array(rows, np.int64).reshape(-1, 2)
