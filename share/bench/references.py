"""Answers of the problems without an exact one: extrapolated from three meshes."""
import json
import math
import os

from problems import PROBLEMS
from store import Case

# --only references finds them and keeps them in FILE, where every bench reads them
MESHES = {"two_block": ("1", "2", "4", "8"), "beam_sphere_linear": ("0", "1", "2"), "cantilever": ("0", "1", "2", "3")}
FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "references.json")


def richardson(sizes, values):
    """Limit and order of values that differ from it by a constant times size^order, from three; the last value and no order where
    the differences are not those of a power. By bisection: the ratio of the differences grows with the order"""
    (a, b, c), first, second = sizes, values[0] - values[1], values[1] - values[2]
    ratio = lambda order: (a**order - b**order) / (b**order - c**order)  # noqa: E731
    low, high = 0.05, 8.0
    if second == 0 or not ratio(low) <= first / second <= ratio(high):
        return values[2], math.nan
    for _ in range(60):
        order = (low + high) / 2
        low, high = (order, high) if ratio(order) < first / second else (low, order)
    return values[2] - second * c**order / (b**order - c**order), order


def reference_cases():
    """problem: its runs, coarse to fine; on both cores, as their time does not count"""
    careful = {name: PROBLEMS[name] for name in MESHES}
    return {name: [Case(name, level, p.careful, p.careful_body, ranks=2, limit=1800) for level in MESHES[name]] for name, p in careful.items()}


def extrapolate(problem, records):
    """The reference of every quantity with its order and how far it is from what one mesh less would say"""
    entry = {"meshes": [record["level"] for record in records], "unknowns": [record["summary"]["dofs"] for record in records], "quantities": {}}
    sizes = [problem.levels[level].size for level in entry["meshes"]]
    for quantity in problem.quantities:
        found = [record["measure"][quantity] for record in records]
        limit, order = richardson(sizes[-3:], found[-3:])
        before = richardson(sizes[-4:-1], found[-4:-1])[0] if len(found) > 3 else found[-1]
        entry["quantities"][quantity] = {"values": found, "order": None if math.isnan(order) else order, "value": limit, "uncertainty": abs(limit - before) / abs(limit)}
    return entry


def load():
    if not os.path.exists(FILE):
        return {}
    with open(FILE) as file:
        return json.load(file)


def values(entries):
    """problem: quantity: value"""
    return {name: {quantity: q["value"] for quantity, q in entry["quantities"].items()} for name, entry in entries.items()}
