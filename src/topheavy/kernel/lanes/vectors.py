"""Several floats that are worked on at once: the vector registers of the CPU, within numba.

A value of the type `lanes` holds `WIDTH` floats. Arithmetic, comparison and the functions below
treat each as a float of its own. numba sees a type whose LLVM form is `<WIDTH x double>`, so that
no other compiler is needed. Each lane goes through the same roundings whatever `WIDTH` is: `fma` is
one operation (two on a CPU without it), and nothing else is contracted.

Only this module knows LLVM. numba.core and llvmlite may change without notice: both are pinned.
"""

import math
import operator

import llvmlite.ir as ir
import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.registry import cpu_target
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    infer_getattr,
    intrinsic,
    lower_builtin,
    lower_cast,
    lower_getattr_generic,
    lower_setattr_generic,
    models,
    register_model,
    type_callable,
)

from topheavy.kernel.compiled import compiled

# Target, CPU and features that numba compiles for, and by which it keeps its cache.
_TARGET, _, _LISTED = cpu_target.target_context.codegen().magic_tuple()
_FEATURES = set(_LISTED.split(","))
#: Whether the CPU multiplies and adds in one operation.
HAS_FMA = "+fma" in _FEATURES or _TARGET.startswith(("aarch64", "arm64"))
#: Floats in a value: two registers of the CPU, as one alone would wait for its own results.
WIDTH = 4
if "+avx2" in _FEATURES:
    WIDTH = 16 if {"+avx512f", "+avx512dq", "+avx512vl"} <= _FEATURES else 8

_FLOATS = ir.VectorType(ir.DoubleType(), WIDTH)
_INTEGERS = ir.VectorType(ir.IntType(64), WIDTH)
_SHORT = ir.VectorType(ir.IntType(32), WIDTH)
_FLAGS = ir.VectorType(ir.IntType(1), WIDTH)


class _Lanes(types.Type):
    def __init__(self):
        super().__init__(name=f"lanes({WIDTH})")


class _Mask(types.Type):
    def __init__(self):
        super().__init__(name=f"mask({WIDTH})")


class _Rows(types.Type):
    def __init__(self):
        super().__init__(name=f"rows({WIDTH})")


class _Fields(types.Type):
    def __init__(self, record):
        self.record = record
        super().__init__(name=f"fields({record.name})")


lanes, mask, rows = _Lanes(), _Mask(), _Rows()
_POINTER = _FLOATS.as_pointer()
for _type, _form in ((_Lanes, _FLOATS), (_Mask, _FLAGS), (_Rows, _POINTER), (_Fields, _POINTER)):

    @register_model(_type)
    class _Model(models.PrimitiveModel):
        def __init__(self, manager, kind, form=_form):
            super().__init__(manager, kind, form)


def _splat(builder, value):
    empty = ir.Constant(_FLOATS, ir.Undefined)
    first = builder.insert_element(empty, value, ir.IntType(32)(0))
    return builder.shuffle_vector(first, empty, ir.Constant(_SHORT, [0] * WIDTH))


@lower_cast(types.Number, _Lanes)
def _cast(context, builder, kind, _, value):
    return _splat(builder, context.cast(builder, value, kind, types.float64))


def _fits(argument, kind):
    return argument is kind or (kind is lanes and isinstance(argument, types.Number))


def _operator(symbol, kinds, result, emit):
    """Give a Python operator its meaning for `kinds`; `emit` writes the instruction."""

    @type_callable(symbol)
    def _type(context):
        def typer(*arguments):
            if len(arguments) != len(kinds) or kinds[0] not in arguments:
                return None
            return result if all(map(_fits, arguments, kinds)) else None

        return typer

    def lower(context, builder, signature, arguments):
        cast = [
            context.cast(builder, value, argument, kind)
            for value, argument, kind in zip(arguments, signature.args, kinds, strict=True)
        ]
        return emit(builder, *cast)

    lower_builtin(symbol, *map(type, kinds))(lower)
    if kinds == (lanes, lanes):
        lower_builtin(symbol, _Lanes, types.Number)(lower)
        lower_builtin(symbol, types.Number, _Lanes)(lower)


_PAIR = (lanes, lanes)
_operator(operator.add, _PAIR, lanes, lambda builder, x, y: builder.fadd(x, y))
_operator(operator.sub, _PAIR, lanes, lambda builder, x, y: builder.fsub(x, y))
_operator(operator.mul, _PAIR, lanes, lambda builder, x, y: builder.fmul(x, y))
_operator(operator.truediv, _PAIR, lanes, lambda builder, x, y: builder.fdiv(x, y))
_operator(operator.neg, (lanes,), lanes, lambda builder, x: builder.fneg(x))
_operator(operator.lt, _PAIR, mask, lambda builder, x, y: builder.fcmp_ordered("<", x, y))
_operator(operator.le, _PAIR, mask, lambda builder, x, y: builder.fcmp_ordered("<=", x, y))
_operator(operator.gt, _PAIR, mask, lambda builder, x, y: builder.fcmp_ordered(">", x, y))
_operator(operator.ge, _PAIR, mask, lambda builder, x, y: builder.fcmp_ordered(">=", x, y))
_operator(operator.and_, (mask, mask), mask, lambda builder, x, y: builder.and_(x, y))
_operator(operator.or_, (mask, mask), mask, lambda builder, x, y: builder.or_(x, y))
_operator(operator.invert, (mask,), mask, lambda builder, x: builder.not_(x))


def _function(result, kinds, emit):
    """Return the signature and the writer of a function, as `intrinsic` takes them."""
    return result(*kinds), lambda context, builder, signature, arguments: emit(builder, *arguments)


def _call(builder, name, *arguments):
    kind = ir.FunctionType(_FLOATS, [_FLOATS] * len(arguments))
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{WIDTH}f64")
    return builder.call(function, arguments)


@intrinsic
def fma(typing, x, y, z):
    """Return x y + z."""

    def emit(builder, x, y, z):
        if HAS_FMA:
            return _call(builder, "fma", x, y, z)
        return builder.fadd(builder.fmul(x, y), z)

    return _function(lanes, (lanes, lanes, lanes), emit)


@intrinsic
def absolute(typing, x):
    """Return |x|."""
    return _function(lanes, (lanes,), lambda builder, x: _call(builder, "fabs", x))


@intrinsic
def square_root(typing, x):
    """Return √x."""
    return _function(lanes, (lanes,), lambda builder, x: _call(builder, "sqrt", x))


def _choice(comparison):
    """Return the writer of min or max, of the second where one is NaN."""
    return lambda builder, x, y: builder.select(builder.fcmp_ordered(comparison, x, y), x, y)


@intrinsic
def minimum(typing, x, y):
    """Return the smaller of x and y."""
    return _function(lanes, _PAIR, _choice("<"))


@intrinsic
def maximum(typing, x, y):
    """Return the larger of x and y."""
    return _function(lanes, _PAIR, _choice(">"))


@intrinsic
def select(typing, where, x, y):
    """Return x where the mask is set, y elsewhere."""
    kinds = (mask, lanes, lanes)
    return _function(lanes, kinds, lambda builder, where, x, y: builder.select(where, x, y))


@intrinsic
def bits(typing, where):
    """Return an integer whose bit l is that of the mask in lane l."""

    def emit(builder, where):
        return builder.zext(builder.bitcast(where, ir.IntType(WIDTH)), ir.IntType(64))

    return _function(types.int64, (mask,), emit)


@intrinsic
def mask_of(typing, chosen):
    """Return the mask of the lanes whose bits are set in an integer."""

    def emit(builder, chosen):
        return builder.bitcast(builder.trunc(chosen, ir.IntType(WIDTH)), _FLAGS)

    return _function(mask, (types.int64,), emit)


@intrinsic
def first_lane(typing, chosen):
    """Return the number of the lowest bit that is set in an integer that is not zero."""

    def emit(builder, chosen):
        return builder.cttz(chosen, ir.Constant(ir.IntType(1), 1))

    return _function(types.int64, (types.int64,), emit)


@intrinsic
def count_bits(typing, chosen):
    """Return how many bits of an integer are set."""
    return _function(types.int64, (types.int64,), lambda builder, chosen: builder.ctpop(chosen))


@intrinsic
def rough_power(typing, x, exponent):
    """Return x > 0 to a power between 0 and 1, wrong by up to 6 %.

    The upper half of the bits of a float is a piecewise linear logarithm to base 2.
    """

    def emit(builder, x, exponent):
        one = ir.Constant(_SHORT, [0x3FF00000] * WIDTH)
        half = ir.Constant(_INTEGERS, [32] * WIDTH)
        upper = builder.trunc(builder.lshr(builder.bitcast(x, _INTEGERS), half), _SHORT)
        logarithm = builder.sitofp(builder.sub(upper, one), _FLOATS)
        scaled = builder.fptosi(builder.fmul(logarithm, _splat(builder, exponent)), _SHORT)
        power = builder.zext(builder.add(scaled, one), _INTEGERS)
        return builder.bitcast(builder.shl(power, half), _FLOATS)

    return _function(lanes, (lanes, types.float64), emit)


@intrinsic
def _power_of_two(typing, shifted):
    """Return 2 to the power k from k + 1023 + 1.5·2⁵², whose lowest bits are those of k + 1023."""

    def emit(builder, shifted):
        places = ir.Constant(_INTEGERS, [52] * WIDTH)
        return builder.bitcast(builder.shl(builder.bitcast(shifted, _INTEGERS), places), _FLOATS)

    return _function(lanes, (lanes,), emit)


_SHIFT = 1.5 * 2.0**52
_LN2_HIGH, _LN2_LOW = 0.693147180369123816490, 1.90821492927058770002e-10
_INVERSE_FACTORIALS = np.array([1.0 / math.factorial(k) for k in range(14)])


@compiled
def exponential(x):
    """Return exp x for x < 700, to about 2e-16; below −700 that of −700."""
    x = maximum(x, -700.0)
    turns = x * (1.0 / math.log(2.0)) + _SHIFT
    whole = turns - _SHIFT
    rest = fma(whole, -_LN2_LOW, fma(whole, -_LN2_HIGH, x))
    total = fma(rest, _INVERSE_FACTORIALS[13], _INVERSE_FACTORIALS[12])
    for k in range(11, -1, -1):
        total = fma(total, rest, _INVERSE_FACTORIALS[k])
    return total * _power_of_two(turns + 1023.0)


@intrinsic
def fields(typing, record):
    """Return a record whose attributes are `lanes`, or rows of `lanes`, of a `batch`."""

    def write(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], _POINTER)

    return _Fields(record)(record), write


@infer_getattr
class _FieldTypes(AttributeTemplate):
    key = _Fields

    def generic_resolve(self, kind, name):  # type: ignore[override]
        return rows if kind.record.typeof(name).ndim == 2 else lanes


def _place(builder, kind, pointer, name):
    return builder.gep(pointer, [ir.IntType(64)(kind.record.offset(name) // (8 * WIDTH))])


@lower_getattr_generic(_Fields)
def _get_field(context, builder, kind, pointer, name):
    place = _place(builder, kind, pointer, name)
    has_rows = kind.record.typeof(name).ndim == 2
    return place if has_rows else builder.load(place, align=8)


@lower_setattr_generic(_Fields)
def _set_field(context, builder, signature, arguments, name):
    place = _place(builder, signature.args[0], arguments[0], name)
    builder.store(arguments[1], place, align=8)


@type_callable(operator.getitem)
def _type_row(context):
    return lambda array, row: lanes if array is rows and isinstance(row, types.Integer) else None


@type_callable(operator.setitem)
def _type_set_row(context):
    def typer(array, row, value):
        is_row = array is rows and isinstance(row, types.Integer) and value is lanes
        return types.void if is_row else None

    return typer


@lower_builtin(operator.getitem, _Rows, types.Integer)
def _get_row(context, builder, signature, arguments):
    return builder.load(builder.gep(arguments[0], [arguments[1]]), align=8)


@lower_builtin(operator.setitem, _Rows, types.Integer, _Lanes)
def _set_row(context, builder, signature, arguments):
    builder.store(arguments[2], builder.gep(arguments[0], [arguments[1]]), align=8)
    return context.get_dummy_value()


@intrinsic
def take(typing, array, places):
    """Return array[int(place)] for each lane, of a one-dimensional contiguous array."""

    def write(context, builder, signature, arguments):
        data = context.make_array(signature.args[0])(context, builder, arguments[0]).data
        places = builder.fptosi(arguments[1], _SHORT)
        value = ir.Constant(_FLOATS, ir.Undefined)
        for lane in map(ir.IntType(32), range(WIDTH)):
            pointer = builder.gep(data, [builder.extract_element(places, lane)])
            value = builder.insert_element(value, builder.load(pointer), lane)
        return value

    return lanes(array, lanes), write


def batch(names, row_names, count):
    """Return one record of zeros: a float a lane by each name, `count` of them by each row name."""
    kinds = [*((name, (count, WIDTH)) for name in row_names), *((name, (WIDTH,)) for name in names)]
    layout, size = np.dtype([(name, "f8", shape) for name, shape in kinds]), 8 * WIDTH
    memory = np.zeros(layout.itemsize + size, np.uint8)
    first = -memory.ctypes.data % size  # where the CPU loads a value at once
    return memory[first : first + layout.itemsize].view(layout)
