"""Scenes for equations.sh, and their answers: python equations.py write|judge."""
import math
import sys

import numpy as np

from summaries import load, say

# bars of 1 x 1 x 2 and two cells, without lateral strain: their stiffness is E / 2. Three pulls at the top of a
BAR = ("  - %s: {shape: box, lower: [%g, 0, %g], upper: [%g, 1, %g], cells: [1, 1, 2], young: %g, poisson: 0, "
       "element: full}\n")
BARS = "bodies:\n" + BAR % ("a", 0, 0, 1, 2, 200) + BAR % ("b", 3, 0, 4, 2, 100)
FEET = "symmetry: [a.zmin, b.zmin, a.xmin, b.xmin, a.ymin, b.ymin]\n"
PULL = "tractions:\n  - pull: {face: a.zmax, value: [0, 0, 3]}\n"
TOPS = "probes:\n  - a: {point: [0.3, 0.4, 2]}\n  - b: {point: [3.3, 0.4, 2]}\n"
CORNERS = [(x, y) for x in (0, 1) for y in (0, 1)]
PLANE = math.radians(50)


def equations(*entries):
    return "equations:\n" + "".join("  - e%d: {%s}\n" % entry for entry in enumerate(entries, 1))


def couple(body, point, factor, to, to_point):
    """u_z of the first point plus factor times that of the second one is 0"""
    return "body: %s, point: %s, direction: [0, 0, 1], to: %s, to_point: %s, to_direction: [0, 0, %g]" % (
        body, list(point), to, list(to_point), factor)


def give(point, value, direction, more="", body="b"):
    return "body: %s, point: %s, direction: %s, value: %.17g%s" % (body, list(point), direction, value, more)


STILL = "displacements:\n  - still: {body: b, value: [0, 0, 0]}\n"
LEVER = [couple("a", (x, y, 2), 0.5, "b", (3 + x, y, 2)) for x, y in CORNERS]
SCENES = {
    # the top of b moves down by twice the displacement by which the top of a moves up
    "lever": BARS + FEET + PULL + equations(*LEVER) + TOPS,
    "ramp": BARS + FEET + PULL + TOPS + "load:\n  steps: 2\nramps:\n  - back: {factors: [1, -2]}\n" + equations(
        *(give((3 + x, y, 2), 0.04, [0, 0, 2], ", ramp: back") for x, y in CORNERS)),
    # one corner leads all others, of which those of b follow those of a
    "chain": BARS + FEET + "forces:\n  - pull: {body: a, point: [0.2, 0.5, 2], value: [0, 0, 3]}\n" + equations(
        *(couple("b", (3 + x, y, 2), -1, "a", (x, y, 2)) for x, y in CORNERS),
        *(couple("a", (x, y, 2), -1, "a", (1, 1, 2)) for x, y in CORNERS[:3])) + TOPS,
    "inner": BARS + FEET + PULL + equations(*(couple("a", (x, y, 1.5), 1, "b", (3 + x, y, 2))
                                              for x, y in CORNERS)) + TOPS,
    # all corners of b move along one direction, given along it and across it
    "oblique": BARS + "symmetry: [a.zmin, a.xmin, a.ymin, b.ymin]\n" + STILL.replace("body: b", "face: b.zmin") + TOPS +
    equations(
        *(give((3 + x, y, 2), value, way) for x, y in CORNERS for value, way in ((0.02, [0.6, 0, 0.8]),
                                                                                   (0, [0.8, 0, -0.6])))),
    # an edge on an inclined plane of symmetry moves outward
    "plane": "bodies:\n  - t: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 50], extent: [0, 1], "
    "cells: [2, 4, 1], young: 10, poisson: 0.3}\nsymmetry: [t.amin, t.amax, t.lmin]\n" + equations(
        *(give([2 * math.cos(PLANE), 2 * math.sin(PLANE), z], 0.1, [math.cos(PLANE), math.sin(PLANE), 0], body="t")
          for z in (0, 1))) + "probes:\n  - edge: {point: [%.17g, %.17g, 0.4]}\n" % (2 * math.cos(PLANE),
                                                                                    2 * math.sin(PLANE)),
    # b carries a body that is tied to it; a follows tied nodes
    "tied": BARS + BAR % ("c", 3, 2, 4, 3, 100) + FEET.replace("]", ", c.xmin, c.ymin]") + PULL +
    "ties:\n  - glue: {mortar: b.zmax, nonmortar: c.zmin}\n" + equations(
        *(couple("a", (x, y, 2), 0.5, "c", (3 + x, y, 2)) for x, y in CORNERS)) + TOPS,
    # nothing but equations holds b along z
    "hung": BARS + "symmetry: [a.zmin, a.xmin, a.ymin, b.xmin, b.ymin]\ntractions:\n"
    "  - pull: {face: b.zmax, value: [0, 0, 3]}\n" + equations(*(give((3 + x, y, 0), 0, [0, 0, 1])
                                                                 for x, y in CORNERS)) + TOPS,
    "finite": BARS.replace("young", "material: neohookean, young") + FEET + PULL + equations(*LEVER) + TOPS,
    "time": BARS.replace("young", "density: 1, young") + FEET + PULL + equations(*LEVER) + TOPS +
    "dynamics:\n  time_step: 0.005\n  end_time: 0.1\n",
}
WRONG = {
    "held": equations(give((3, 0, 0), 0.1, [0, 0, 1])),
    "zero": equations(give((3, 0, 2), 0.1, [0, 0, 0])),
    "lone": equations(give((3, 0, 2), 0.1, [0, 0, 1], ", to: a")),
    "outside": equations(give((3, 0, 3), 0.1, [0, 0, 1])),
    "twice": equations(give((3, 0, 2), 0.1, [0, 0, 1]), give((3, 0, 2), 0.1, [0, 0, 2])),
}
WRONG = {name: BARS + FEET + PULL + text for name, text in WRONG.items()}
WRONG["rigid"] = SCENES["lever"].replace("b: {", "b: {material: rigid, ", 1).replace(
    ", young: 100, poisson: 0, element: full", "").replace(FEET, "symmetry: [a.zmin, a.xmin, a.ymin]\n" + STILL)


def inner():
    """Displacement of the top of a if its third quarter moves as far as the top of b moves down"""
    half = np.array([0.5, 0.5])
    stiffness = 200 * np.array([[2, -1], [-1, 1]]) + 50 * np.outer(half, half)
    u = np.linalg.solve(stiffness, [0, 3])
    return u[1], -half @ u


def judge():
    runs = {name: [[np.array(probe["displacement"])
                    for probe in step["probes"]]
                   for step in load(name)["steps"]]
            for name in SCENES}
    closed = {
        "lever": [(0.01, -0.02)], "ramp": [(0.015, 0.02), (0.03, -0.04)], "chain": [(0.02, 0.02)], "inner": [inner()],
        "tied": [(0.01, -0.02)], "hung": [(0, 0.06)]
    }
    for name, wanted in closed.items():
        found = [(step[0][2], step[1][2]) for step in runs[name]]
        say(f"{name}: displacements to 1e-9", np.allclose(found, wanted, 0, 1e-9 * 0.03), found)
    say("oblique: the top moves as given", np.allclose(runs["oblique"][0][1], [0.012, 0, 0.016], 0, 1e-11),
        runs["oblique"][0][1])
    edge = runs["plane"][0][0]
    say("plane: the edge moves along the plane",
        np.allclose(edge[:2], [0.1 * math.cos(PLANE), 0.1 * math.sin(PLANE)], 0, 1e-11), edge)
    for name in "finite", "time":
        one, two = runs[name][-1][0][2], runs[name][-1][1][2]
        say(f"{name}: the lever's ratio", abs(two + 2 * one) < 1e-9 * abs(one) and abs(one) > 1e-3, (one, two))
    say("finite: near the linear answer", abs(runs["finite"][0][0][2] / 0.01 - 1) < 0.05, runs["finite"])


if sys.argv[1] == "write":
    for name, text in {**SCENES, **WRONG}.items():
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s" % (name, text))
else:
    judge()
