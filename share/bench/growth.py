"""How time and memory grow with the number of unknowns, and where two ways cost the same."""
import math

import numpy as np

SMALLEST = 10000  # unknowns: below, start-up counts


def exponent(unknowns, values):
    """Slope in logarithms over the larger meshes; NaN with fewer than two of them"""
    points = [(math.log(n), math.log(v)) for n, v in zip(unknowns, values) if n >= SMALLEST and v > 0]
    return float(np.polyfit(*zip(*points), 1)[0]) if len(points) > 1 else math.nan


def crossover(ours, theirs):
    """Unknowns from which on `ours` costs less, by interpolation of logarithms on common meshes: a number, or 0 where
    it is always the cheaper, infinity where it never is. Arguments: {unknowns: cost}"""
    common = sorted(set(ours) & set(theirs))
    excess = [math.log(ours[n] / theirs[n]) for n in common]
    if not common or excess[-1] > 0:
        return math.inf
    for k in range(len(common) - 1, 0, -1):
        if excess[k - 1] > 0:
            t = excess[k - 1] / (excess[k - 1] - excess[k])
            return math.exp((1 - t) * math.log(common[k - 1]) + t * math.log(common[k]))
    return 0.0
