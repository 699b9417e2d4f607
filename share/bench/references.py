"""Answers of the problems without an exact one: extrapolation, and the values that the front page found, which the
other pages use."""
import json
import math
import os


def richardson(sizes, values):
    """Limit and order of values that differ from it by a constant times size^order, from three; the last value and no
    order where the differences are not those of a power. By bisection: the ratio of the differences grows with the
    order"""
    (a, b, c), first, second = sizes, values[0] - values[1], values[1] - values[2]
    ratio = lambda order: (a**order - b**order) / (b**order - c**order)  # noqa: E731
    low, high = 0.05, 8.0
    if second == 0 or not ratio(low) <= first / second <= ratio(high):
        return values[2], math.nan
    for _ in range(60):
        order = (low + high) / 2
        low, high = (order, high) if ratio(order) < first / second else (low, order)
    return values[2] - second * c**order / (b**order - c**order), order


def path(folder):
    return os.path.join(folder, "references.json")


def save(folder, values):
    """values: problem: quantity: value"""
    with open(path(folder), "w") as file:
        json.dump(values, file, indent=1)


def load(folder):
    """Nothing before the front page was made"""
    if not os.path.exists(path(folder)):
        return {}
    with open(path(folder)) as file:
        return json.load(file)
