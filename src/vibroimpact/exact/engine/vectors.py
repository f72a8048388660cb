"""Arithmetic of eight numbers at once, which the compiler does not find by itself."""

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

EIGHT = ir.VectorType(ir.DoubleType(), 8)


@intrinsic
def weighted_sum(_, table, mode, j, weights):
    """Sum over m of weights[m] table[mode, j, m], of a table (modes, n, m, 16): two tuples of eight."""
    eight = types.UniTuple(types.float64, 8)
    signature = types.UniTuple(eight, 2)(table, types.intp, types.intp, weights)

    def generate(context, builder, signature, arguments):
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        zero = context.get_constant(types.intp, 0)
        indices = [*arguments[1:3], zero, zero]
        start = cgutils.get_item_pointer(context, builder, signature.args[0], array, indices)
        halves = []
        for half in range(2):
            total = None
            for m in range(signature.args[3].count):
                place = builder.gep(start, [context.get_constant(types.intp, 16 * m + 8 * half)])
                row = builder.load(builder.bitcast(place, EIGHT.as_pointer()), align=8)
                weight = builder.extract_value(arguments[3], m)
                first = builder.insert_element(ir.Constant(EIGHT, ir.Undefined), weight, ir.Constant(ir.IntType(32), 0))
                spread = builder.shuffle_vector(
                    first, ir.Constant(EIGHT, ir.Undefined), ir.Constant(ir.VectorType(ir.IntType(32), 8), [0] * 8)
                )
                part = builder.fmul(row, spread, flags=("contract",))
                total = part if total is None else builder.fadd(total, part, flags=("contract",))
            entries = [builder.extract_element(total, ir.Constant(ir.IntType(32), k)) for k in range(8)]
            halves.append(context.make_tuple(builder, eight, entries))
        return context.make_tuple(builder, signature.return_type, halves)

    return signature, generate
