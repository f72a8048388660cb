"""Operations that Numba lacks: fused multiply-add, weighted sums of table rows, vectors of eight floats.

Only this file generates code through Numba's internals. It is tested with Numba 0.68 and llvmlite 0.50; pyproject.toml
excludes later versions.

`Lanes` is the type of a vector of eight floats. Each float belongs to one lane, that is, to one of eight runs that
advance together in vector instructions. An operation on `Lanes` rounds like the operation on floats, so a formula gives
the same bits for both types. Comparisons of `Lanes` return a `Mask`, with which `where` selects values.
"""

import math
import operator

from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model
from numba.np.unsafe.ndarray import to_fixed_tuple as to_fixed_tuple

WIDTH = 8
NUMBERS, INDICES = ir.VectorType(ir.DoubleType(), WIDTH), ir.VectorType(ir.IntType(32), WIDTH)
UNDEFINED = ir.Constant(NUMBERS, ir.Undefined)


@intrinsic
def weighted_sum(_, table, mode, j, weights):
    """Return the sum of weights[m] * table[mode, j, m] over m as two tuples of eight numbers.

    table: shape (modes, n, len(weights), 16). If the processor supports it, each product is added to the sum with a
    single rounding.
    """
    eight = types.UniTuple(types.float64, WIDTH)

    def generate(context, builder, signature, arguments):
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        zero = context.get_constant(types.intp, 0)
        start = cgutils.get_item_pointer(
            context, builder, signature.args[0], array, [arguments[1], arguments[2], zero, zero]
        )
        weights = [builder.extract_value(arguments[3], m) for m in range(signature.args[3].count)]
        wide, halves = [_in_all(builder, weight) for weight in weights], []
        for half in range(2):  # explicit vector instructions, since the compiler would not create them from a loop
            total = None
            for m, weight in enumerate(wide):
                pointer = builder.gep(start, [context.get_constant(types.intp, WIDTH * (2 * m + half))])
                row = builder.load(builder.bitcast(pointer, NUMBERS.as_pointer()), align=8)
                part = builder.fmul(row, weight, flags=("contract",))
                total = part if total is None else builder.fadd(total, part, flags=("contract",))
            entries = [builder.extract_element(total, ir.IntType(32)(k)) for k in range(WIDTH)]
            halves.append(context.make_tuple(builder, eight, entries))
        return context.make_tuple(builder, signature.return_type, halves)

    return types.UniTuple(eight, 2)(table, types.intp, types.intp, weights), generate


def _in_all(builder, number):
    """Return a vector of eight copies of a number."""
    first = builder.insert_element(UNDEFINED, number, ir.IntType(32)(0))
    return builder.shuffle_vector(first, UNDEFINED, INDICES([0] * WIDTH))


class Lanes(types.Type):
    """Numba type of a vector of eight floats."""

    vector = NUMBERS


class Mask(types.Type):
    """Numba type of a vector of eight truth values."""

    vector = ir.VectorType(ir.IntType(1), WIDTH)


LANES, MASK = Lanes("Lanes"), Mask("Mask")


@register_model(Lanes)
@register_model(Mask)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, kind.vector)


def _wide(context, builder, value, kind):
    """Return a value as a vector of eight floats or truth values; copy a float or integer to all eight entries."""
    if isinstance(kind, Lanes | Mask):
        return value
    return _in_all(builder, context.cast(builder, value, kind, types.float64))


def _operation(function, operand, result, generate):
    """Register the code of an operation on one or two operands of the Numba type `operand`.

    If the type is LANES, one of two operands may also be a scalar. result: type of the result.
    """
    kind, scalar = type(operand), (types.Float | types.Integer if operand is LANES else Mask)

    class Typing(AbstractTemplate):
        def generic(self, args, kws):
            fits = operand in args and all(isinstance(one, kind | scalar) for one in args)
            return signature(result, *args) if fits else None

    infer_global(function)(Typing)

    def lower(context, builder, signed, args):
        return generate(builder, *(_wide(context, builder, a, k) for a, k in zip(args, signed.args, strict=True)))

    for kinds in ((kind,), (kind, kind), (kind, types.Number), (types.Number, kind)):
        lower_builtin(function, *kinds)(lower)


def _called(name):
    def generate(builder, *args):
        kind = ir.FunctionType(NUMBERS, [NUMBERS] * len(args))
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v8f64"), args)

    return generate


def _comparison(sign):
    return lambda builder, a, b: builder.fcmp_ordered(sign, a, b)


_operation(operator.add, LANES, LANES, ir.IRBuilder.fadd)
_operation(operator.sub, LANES, LANES, ir.IRBuilder.fsub)
_operation(operator.mul, LANES, LANES, ir.IRBuilder.fmul)
_operation(operator.truediv, LANES, LANES, ir.IRBuilder.fdiv)
_operation(operator.lt, LANES, MASK, _comparison("<"))
_operation(operator.le, LANES, MASK, _comparison("<="))
_operation(operator.gt, LANES, MASK, _comparison(">"))
_operation(operator.ge, LANES, MASK, _comparison(">="))
_operation(operator.eq, LANES, MASK, _comparison("=="))
_operation(abs, LANES, LANES, _called("fabs"))
_operation(math.sqrt, LANES, LANES, _called("sqrt"))
_operation(math.floor, LANES, LANES, _called("floor"))
_operation(operator.neg, LANES, LANES, ir.IRBuilder.fneg)
_operation(operator.invert, MASK, MASK, ir.IRBuilder.not_)
_operation(operator.and_, MASK, MASK, ir.IRBuilder.and_)
_operation(operator.or_, MASK, MASK, ir.IRBuilder.or_)


@intrinsic
def fused(_, a, b, c):
    """Return a * b + c, rounded only once.

    The arguments are floats or `Lanes`. For `Lanes`, each of the eight entries is computed in this way.
    """
    if LANES in (a, b, c):

        def generate(context, builder, signed, args):
            wide = (_wide(context, builder, a, k) for a, k in zip(args, signed.args, strict=True))
            return _called("fma")(builder, *wide)

        return LANES(a, b, c), generate
    one = types.float64(types.float64, types.float64, types.float64)
    return one, lambda context, builder, signed, args: builder.fma(*args)


if config.DISABLE_JIT:

    def fused(*_):
        """Raise RuntimeError, since only compiled code can compute a * b + c with a single rounding."""
        raise RuntimeError("the simulation requires compiled code; unset NUMBA_DISABLE_JIT")


@intrinsic
def where(_, mask, a, b):
    """Return a vector of eight floats: each entry is from `a` if the mask is true there, otherwise from `b`."""

    def generate(context, builder, signed, args):
        _, one, other = signed.args
        one, other = _wide(context, builder, args[1], one), _wide(context, builder, args[2], other)
        return builder.select(args[0], one, other)

    return LANES(mask, a, b), generate


@intrinsic
def load(_, array, k):
    """Return row k of an array of shape (n, 8) as `Lanes`."""

    def generate(context, builder, signed, args):
        return builder.load(_pointer(context, builder, signed, args), align=8)

    return LANES(array, types.intp), generate


@intrinsic(prefer_literal=True)
def load_rows(_, array, k, count):
    """Return rows k to k + count - 1 of an array of shape (n, 8) as a tuple of `Lanes`.

    count: a literal integer.
    """
    kind = types.UniTuple(LANES, count.literal_value)

    def generate(context, builder, signed, args):
        pointers = [_pointer(context, builder, signed, args, n) for n in range(kind.count)]
        return context.make_tuple(builder, kind, [builder.load(pointer, align=8) for pointer in pointers])

    return kind(array, types.intp, count), generate


@intrinsic
def store(_, array, k, value):
    """Write `Lanes` or a scalar to row k of an array of shape (n, 8)."""

    def generate(context, builder, signed, args):
        value = _wide(context, builder, args[2], signed.args[2])
        builder.store(value, _pointer(context, builder, signed, args), align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, value), generate


@intrinsic
def replace_rows(_, array, k, mask, values):
    """Write the tuple `values` to rows k, k + 1, ... of an array of shape (n, 8).

    In each row, only the entries where the mask is true are replaced.
    """

    def generate(context, builder, signed, args):
        for n, kind in enumerate(signed.args[3]):
            pointer = _pointer(context, builder, signed, args, n)
            value = _wide(context, builder, builder.extract_value(args[3], n), kind)
            builder.store(builder.select(args[2], value, builder.load(pointer, align=8)), pointer, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, mask, values), generate


def _pointer(context, builder, signed, args, later=0):
    """Return a pointer to the row with index k + `later` of an array; `args` begins with the array and k."""
    array = context.make_array(signed.args[0])(context, builder, args[0])
    row, zero = builder.add(args[1], context.get_constant(types.intp, later)), context.get_constant(types.intp, 0)
    pointer = cgutils.get_item_pointer(context, builder, signed.args[0], array, [row, zero])
    return builder.bitcast(pointer, NUMBERS.as_pointer())


@intrinsic
def count(_, mask):
    """Return the number of true entries of a mask."""

    def generate(context, builder, signed, args):
        bits = builder.bitcast(args[0], ir.IntType(WIDTH))
        return builder.zext(builder.ctpop(bits), ir.IntType(64))

    return types.intp(mask), generate
