"""How near the solver is to what the memory can deliver, and what an application of AMGF costs in products with the matrix."""
import math

BLOCK_ENTRY = 8 + 4 / 9  # [byte]: a value, and an index for nine of them
POINT_ENTRY = 8 + 4  # [byte]: hypre's rows have an index for every value
ROW = 24  # [byte]: an entry of the vector that is read, one that is written, and is read for that
# cycle: V-cycles, filter solves and products with the matrix of one application, as include/petscamgf.h has it
MODEL = {"fbf": (1, 2, 0), "bfb": (2, 1, 2), "additive": (1, 1, 0)}


def product(events, fine):
    """Seconds and bytes/s of one product with the condensed matrix; those with the thin constraint matrices hardly count"""
    mult = events["MatMult"]
    seconds = mult["seconds"] * 2 * fine["entries"] / mult["flops"]
    return seconds, (fine["entries"] * BLOCK_ENTRY + fine["rows"] * ROW) / seconds


def cycle_bytes(fine, complexity):
    """A V(1,1)-cycle reads every level's matrix three times (sweep, residual, sweep) and every interpolation twice; ten entries of vectors per row"""
    operator, interpolation = complexity["operator"], complexity["memory"] - complexity["operator"]
    return POINT_ENTRY * fine["entries"] * (3 * operator + 2 * interpolation) + 80 * fine["rows"] * complexity["grid"]


def nearest(triad, size):
    """Rate of the working set whose logarithm is nearest"""
    return min(triad, key=lambda point: abs(math.log(point[0] / size)))[1]


def analyse(record, cycle, triad):
    """A row of the table"""
    events, fine, complexity = record["log"]["events"], record["log"]["levels"][0], record["log"]["complexity"]
    seconds, rate = product(events, fine)
    each = {name: events[event]["seconds"] / max(events[event]["count"], 1) for name, event in (("cycle", "PCAMGFAMGApply"), ("filter", "PCAMGFFltApply"), ("whole", "PCApply"))}
    bytes_a_cycle = cycle_bytes(fine, complexity)
    size = fine["entries"] * (BLOCK_ENTRY + POINT_ENTRY * complexity["operator"])  # the matrix, and hypre's copy with its coarse levels
    bound = nearest(triad, size)
    cycles, filters, products = MODEL[cycle]
    return {
        "unknowns": fine["rows"],
        "cycle": cycle,
        "megabytes": size / 1e6,
        "triad": bound,
        "product_rate": rate,
        "product_share": rate / bound,
        "cycle_rate": bytes_a_cycle / each["cycle"],
        "cycle_share": bytes_a_cycle / each["cycle"] / bound,
        "operator_complexity": complexity["operator"],
        "cycle_products": each["cycle"] / seconds,
        "filter_products": each["filter"] / seconds,
        "application_products": each["whole"] / seconds,
        "model_products": (cycles * each["cycle"] + filters * each["filter"]) / seconds + products,
    }
