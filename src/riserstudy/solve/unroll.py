"""Plain functions on tuples, unrolled number by number into the compiled code that calls them.

While a kernel is compiled, the plain function is run once, on numbers that record the operations on them.
These operations become part of the caller, as if written there by hand. There is no separate function to
compile, and no call. Compared with functions compiled by numba, this halves the compile time of a kernel.

You need not read this file to understand the physics: `vec` and `rows` are plain functions of floats. It is
for developers who need an operation that is not recorded yet, or who move to another release of numba.
"""

from __future__ import annotations

import math

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin

INDEX = ir.IntType(64)


def unrolled(function):
    """Make a function of floats, tuples of floats, arrays and indices usable in compiled code.

    The operations must not depend on the values: branches and loops may depend on lengths only. Negative
    indices are not allowed.
    """

    def lower(context, builder, sig, arguments):
        writer = _Writer(context, builder)
        given = map(writer.wrap, sig.args, arguments)
        return writer.unwrap(sig.return_type, function(*given))

    class Typed(AbstractTemplate):
        key = function

        def generic(self, arguments, keywords):
            kinds = [types.unliteral(kind) for kind in arguments]
            result = function(*map(_Writer(None, None).wrap, kinds, kinds))
            return signature(_kind(result), *kinds)

    infer_global(function, types.Function(Typed))
    lower_builtin(function, types.VarArg(types.Any))(lower)
    return function


def root(x):
    """Square root."""
    return x.root() if isinstance(x, _Number) else math.sqrt(x)


def floor(x):
    """Largest whole number that is not above x."""
    return x.floor() if isinstance(x, _Number) else np.floor(x)


def _kind(result):
    if isinstance(result, tuple):
        return types.Tuple([_kind(part) for part in result])
    return types.none if result is None else types.float64


class _Writer:
    """Writes the instructions; without a builder, it only determines types."""

    def __init__(self, context, builder):
        self.context, self.builder = context, builder

    def wrap(self, kind, value):
        if isinstance(kind, types.BaseTuple):
            parts = cgutils.unpack_tuple(self.builder, value) if self.builder else kind.types
            return tuple(map(self.wrap, kind.types, parts))
        if isinstance(kind, types.Array):
            return _Array(self, kind, value)
        if isinstance(kind, types.Integer):
            return _Index(kind, value)
        return _Number(self, value)

    def unwrap(self, kind, result):
        if result is None:
            return self.context.get_dummy_value()
        if isinstance(result, tuple):
            parts = map(self.unwrap, kind.types, result)
            return self.context.make_tuple(self.builder, kind, tuple(parts))
        return self.float(result)

    def float(self, x):
        return x.value if isinstance(x, _Number) else ir.Constant(ir.DoubleType(), float(x))

    def do(self, instruction, *operands):
        if self.builder is None:
            return _Number(self, None)
        return _Number(self, getattr(self.builder, instruction)(*map(self.float, operands)))


class _Number:
    def __init__(self, writer, value):
        self.writer, self.value = writer, value

    def __add__(self, other):
        return self.writer.do("fadd", self, other)

    def __radd__(self, other):
        return self if other == 0 else self.writer.do("fadd", other, self)

    def __sub__(self, other):
        return self.writer.do("fsub", self, other)

    def __rsub__(self, other):
        return self.writer.do("fsub", other, self)

    def __mul__(self, other):
        return self.writer.do("fmul", self, other)

    def __rmul__(self, other):
        return self.writer.do("fmul", other, self)

    def __truediv__(self, other):
        return self.writer.do("fdiv", self, other)

    def __rtruediv__(self, other):
        return self.writer.do("fdiv", other, self)

    def __neg__(self):
        return self.writer.do("fneg", self)

    def __abs__(self):
        return self._intrinsic("llvm.fabs")

    def root(self):
        return self._intrinsic("llvm.sqrt")

    def floor(self):
        return self._intrinsic("llvm.floor")

    def _intrinsic(self, name):
        builder = self.writer.builder
        if builder is None:
            return self
        function = builder.module.declare_intrinsic(name, [ir.DoubleType()])
        return _Number(self.writer, builder.call(function, [self.value]))


class _Index:
    def __init__(self, kind, value):
        self.kind, self.value = kind, value


class _Array:
    def __init__(self, writer, kind, value):
        self.writer, self.kind, self.value = writer, kind, value

    def __getitem__(self, place):
        if self.writer.builder is None:
            return _Number(self.writer, None)
        context, builder = self.writer.context, self.writer.builder
        value = context.unpack_value(builder, self.kind.dtype, self._pointer(place))
        return _Number(self.writer, value)

    def __setitem__(self, place, x):
        if self.writer.builder is not None:
            context, builder = self.writer.context, self.writer.builder
            value = self.writer.float(x)
            context.pack_value(builder, self.kind.dtype, value, self._pointer(place))

    def _pointer(self, place):
        context, builder = self.writer.context, self.writer.builder
        array = context.make_array(self.kind)(context, builder, self.value)
        indices = [self._index(k) for k in (place if isinstance(place, tuple) else (place,))]
        return cgutils.get_item_pointer(context, builder, self.kind, array, indices)

    def _index(self, k):
        if isinstance(k, int):
            return ir.Constant(INDEX, k)
        return self.writer.context.cast(self.writer.builder, k.value, k.kind, types.intp)
