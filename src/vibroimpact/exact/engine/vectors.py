"""Sums of rows of a table, eight numbers at once, as the compiler does not form them by itself."""

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

WIDTH = 8
NUMBERS, INDICES = ir.VectorType(ir.DoubleType(), WIDTH), ir.VectorType(ir.IntType(32), WIDTH)
NOTHING = ir.Constant(NUMBERS, ir.Undefined)


@intrinsic
def weighted_sum(_, table, mode, j, weights):
    """Sum over m of weights[m] times table[mode, j, m], a table (modes, n, m, 16): its two halves, tuples of eight."""
    eight = types.UniTuple(types.float64, WIDTH)

    def generate(context, builder, signature, arguments):
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        zero = context.get_constant(types.intp, 0)
        start = cgutils.get_item_pointer(
            context, builder, signature.args[0], array, [arguments[1], arguments[2], zero, zero]
        )
        weights = [builder.extract_value(arguments[3], m) for m in range(signature.args[3].count)]
        wide, halves = [_in_all(builder, weight) for weight in weights], []
        for half in range(2):
            rows = [row_at(context, builder, start, 2 * m + half) for m in range(len(weights))]
            halves.append(context.make_tuple(builder, eight, _entries(builder, weighted(builder, rows, wide))))
        return context.make_tuple(builder, signature.return_type, halves)

    return types.UniTuple(eight, 2)(table, types.intp, types.intp, weights), generate


def row_at(context, builder, start, place):
    """The vector at a place after the start."""
    pointer = builder.gep(start, [context.get_constant(types.intp, WIDTH * place)])
    return builder.load(builder.bitcast(pointer, NUMBERS.as_pointer()), align=8)


def weighted(builder, rows, weights):
    """The weighted sum of vectors, product and sum rounded as one where the processor can; weights: vectors."""
    total = None
    for row, weight in zip(rows, weights, strict=True):
        part = builder.fmul(row, weight, flags=("contract",))
        total = part if total is None else builder.fadd(total, part, flags=("contract",))
    return total


def _in_all(builder, number):
    """The vector of which every entry is this number."""
    first = builder.insert_element(NOTHING, number, ir.IntType(32)(0))
    return builder.shuffle_vector(first, NOTHING, INDICES([0] * WIDTH))


def _entries(builder, vector):
    return [builder.extract_element(vector, ir.IntType(32)(k)) for k in range(WIDTH)]
