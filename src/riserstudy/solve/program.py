"""A model's effects as a list of addresses, whose functions the compiled loops call.

An effect is a record (NamedTuple of numbers and arrays) and functions ``f(record, state) -> float``.
Here each pair becomes an *entry*: machine code with two arguments, the address of the record and the address
of the state, in numba's calling convention. A program is an array of (entry, record) addresses. It does not
contain absent effects, so these cost nothing, and one compiled solver serves every combination of effects.

Compared with kernels specialised for each combination, it is equally fast. Compiling takes half the time for
eight combinations, and 0.2-1 s instead of 3-5 s for each further combination.

Compiled code sees a ``Packed`` NamedTuple: a table of words in memory, from which an attribute reads only its
words. If the tuple were passed by value, every call would copy, and every function compile, the description
of 50 arrays (77 s of compiling instead of 30).

Only this file and `unroll` extend the compiler. You need not read them to understand the physics: to write an
effect, docs/adding_an_effect.md is enough. They are for developers who change how kernels call effects, or
who move to another release of numba. Two rules follow: a frozen tuple must stay alive and keep its arrays
while a program uses it (``Model`` ensures this), and entries must not raise errors.
"""

from __future__ import annotations

import struct

import numpy as np
from llvmlite import ir
from numba import typeof
from numba.core import types
from numba.core.datamodel import PrimitiveModel
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    NativeValue,
    infer_getattr,
    intrinsic,
    lower_getattr_generic,
    register_model,
    unbox,
)
from numba.np.arrayobj import populate_array

from riserstudy.solve.jit import inner, kernel

WORD = ir.IntType(64)


class Packed:
    """A NamedTuple of numbers, arrays and tuples of floats, stored in memory word by word.

    A float or integer takes one word, a tuple one word per float, an array its address, shape and strides.
    """

    def __init__(self, value):
        self.value = value
        self.kind, self._numba_type_ = _kinds_of(value)
        words = [word for member in value for word in _words(member)]
        self.memory = np.array(words, np.int64)
        self.address = self.memory.ctypes.data


_known: dict[tuple, tuple] = {}


def _kinds_of(value):
    """The numba type of a NamedTuple, and of a reference to it.

    Each type is made once: describing and hashing 50 arrays every time took half the time of a short run.
    """
    signature = type(value), *(_signature(member) for member in value)
    if signature not in _known:
        kind = typeof(value)
        _known.setdefault(signature, (kind, Reference(kind)))  # threads agree on one
    return _known[signature]


def _signature(member):
    if isinstance(member, np.ndarray):
        return member.dtype.char, member.ndim, member.flags.num
    return tuple(map(_signature, member)) if isinstance(member, tuple) else type(member)


@intrinsic
def _data(typing, array):
    """Address of an array's first number."""

    def generate(context, builder, signature, arguments):
        whole = context.make_array(signature.args[0])(context, builder, arguments[0])
        return builder.ptrtoint(whole.data, WORD)

    return types.int64(array), generate


@kernel
def _address_of(array):
    """Address of an array; ten times as fast as numpy's attribute, and a model has 200 arrays."""
    return _data(array)


def _words(member) -> list[int]:
    if isinstance(member, np.ndarray):
        return [_address_of(member), *member.shape, *member.strides]
    if isinstance(member, tuple):
        return [word for part in member for word in _words(part)]
    if isinstance(member, int | np.integer):
        return [int(member)]
    return list(struct.unpack("q", struct.pack("d", member)))


def _size(kind) -> int:
    if isinstance(kind, types.Array):
        return 1 + 2 * kind.ndim
    return len(kind.types) if isinstance(kind, types.BaseTuple) else 1


class Reference(types.Type):
    """The type of a frozen NamedTuple in compiled code: its address."""

    def __init__(self, kind):
        self.kind = kind
        super().__init__(f"Reference({kind})")


@register_model(Reference)
class _ReferenceModel(PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, WORD)


@unbox(Reference)
def _unbox_frozen(kind, value, c):
    held = c.pyapi.object_getattr_string(value, "address")
    address = c.pyapi.long_as_longlong(held)
    c.pyapi.decref(held)
    return NativeValue(address)


@infer_getattr
class _ReferenceAttributes(AttributeTemplate):
    key = Reference

    def generic_resolve(self, reference, name):
        kind = reference.kind
        return kind.types[kind.fields.index(name)] if name in kind.fields else None


@lower_getattr_generic(Reference)
def _read_attribute(context, builder, reference, address, name):
    kind = reference.kind
    index = kind.fields.index(name)
    first = sum(_size(member) for member in kind.types[:index])

    def word(k, native):
        place = builder.add(address, ir.Constant(WORD, 8 * (first + k)))
        load = builder.load(builder.inttoptr(place, native.as_pointer()))
        # the word never changes while compiled code runs, so loops may keep it in a register
        load.set_metadata("invariant.load", builder.module.add_metadata([]))
        return load

    member = kind.types[index]
    if isinstance(member, types.Array):
        array = context.make_array(member)(context, builder)
        item = context.get_data_type(member.dtype)
        populate_array(
            array,
            data=word(0, item.as_pointer()),
            shape=[word(1 + k, WORD) for k in range(member.ndim)],
            strides=[word(1 + member.ndim + k, WORD) for k in range(member.ndim)],
            itemsize=ir.Constant(WORD, context.get_abi_sizeof(item)),
            meminfo=None,  # borrowed: the Packed object owns the memory
        )
        return array._getvalue()
    if isinstance(member, types.BaseTuple):
        parts = [word(k, context.get_value_type(part)) for k, part in enumerate(member.types)]
        return context.make_tuple(builder, member, parts)
    return word(0, context.get_value_type(member))


@intrinsic
def _call(typing, entry, record, state):
    """Call the entry at an address with two addresses."""
    kinds = types.int64, types.int64

    def generate(context, builder, signature, arguments):
        convention = context.call_conv
        native = convention.get_function_type(types.float64, kinds)
        function = builder.inttoptr(arguments[0], native.as_pointer())
        _, value = convention.call_function(builder, function, types.float64, kinds, arguments[1:])
        return value

    return types.float64(types.int64, types.int64, state), generate


@inner
def call_all(program, state):
    """Call all entries of a program, int64 array (entries, 2), on a state; returns the sum of the results."""
    total = 0.0
    for k in range(program.shape[0]):
        total += _call(program[k, 0], program[k, 1], state)
    return total


_entries: dict[tuple, int] = {}


def entry(function, record, state) -> int:
    """Address of the machine code of an effect's function (an `inner`), for the types of record and state."""
    key = (function, id(record), id(state))  # ids are valid, since types are made once and kept
    if key not in _entries:
        function.compile((record, state))
        code = function.overloads[record, state]
        if code.signature.return_type != types.float64:
            raise TypeError(f"{function.__name__} returns {code.signature.return_type}, not a float")
        _entries[key] = code.library.get_pointer_to_function(code.fndesc.llvm_func_name)
    return _entries[key]


def assemble(calls, state: Packed) -> np.ndarray:
    """Program, int64 array (calls, 2), of (function, frozen record) pairs for one state."""
    rows = [
        (entry(function, record._numba_type_, state._numba_type_), record.address)
        for function, record in calls
    ]
    return np.array(rows, np.int64).reshape(-1, 2)
