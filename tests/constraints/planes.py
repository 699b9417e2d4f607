"""Scenes for planes.sh, and their answers: python planes.py write|judge."""
import math
import sys

import numpy as np

from summaries import load, say

ARC = ("{shape: tube_arc, axis: %s, radii: [1, 2], angles: [%g, %g], extent: [%g, %g], cells: [%d, 4, 2], "
       "%syoung: 10, poisson: 0.3, element: full}")
PRESSURES = "pressures:\n" + "".join("  - %s_%s: {face: %s.%s, value: 0.5}\n" % (b, f, b, f)
                                     for b in ("BODY", )
                                     for f in ("inner", "outer"))


def wedge(axis, angles, material="", symmetry="[arc.amin, arc.amax, arc.lmin, arc.lmax]"):
    return "bodies:\n  - arc: " + ARC % (
        axis, *angles, 0, 1, 3, material) + "\nsymmetry: " + symmetry + "\n" + PRESSURES.replace("BODY", "arc")


def place(axis, radius, angle, along):
    x = np.zeros(3)
    x["xyz".index(axis)] = along
    x[("xyz".index(axis) + 1) % 3] = radius * math.cos(math.radians(angle))
    x[("xyz".index(axis) + 2) % 3] = radius * math.sin(math.radians(angle))
    return x


def probe(x):
    return "probes:\n  - corner: {point: [%.17g, %.17g, %.17g]}\n" % tuple(x)


NORMAL = "[%.17g, %.17g, 0]" % (-math.sin(math.radians(50)), math.cos(math.radians(50)))
PROBE = {
    name: place(*at)
    for name, at in {
        "one": ("z", 2, 50, 1), "two": ("y", 2, 70, 1), "named": ("z", 2, 50, 1), "finite": ("z", 2, 50,
                                                                                             1), "tied": ("z", 2, 50, 2)
    }.items()
}
SCENES = {
    "one": wedge("z", (0, 50)),
    "two": wedge("y", (25, 70)),
    "named": wedge("z", (0, 50), symmetry="[arc.amin, cut: {face: arc.amax, normal: %s}, arc.lmin, arc.lmax]" % NORMAL),
    "finite": wedge("z", (0, 50), "material: neohookean, "),
    "tied": "bodies:\n  - arc: " + ARC % ("z", 0, 50, 0, 1, 3, "") + "\n  - top: " + ARC % ("z", 0, 50, 1, 2, 5, "") +
    ("\nsymmetry: [arc.amin, arc.amax, arc.lmin, top.amin, top.amax, top.lmax]\nties:\n"
     "  - glue: {mortar: arc.lmax, nonmortar: top.lmin}\n") + PRESSURES.replace("BODY", "arc") +
    PRESSURES.replace("BODY", "top").replace("pressures:\n", ""),
}
HALF, QUARTER = wedge("z", (0, 45)).replace("    - arc_outer", "#"), wedge("z", (0, 90))
ONE_SIDED = "pressures:\n  - arc_inner: {face: arc.inner, value: 0.5}\n"
SCENES["half"] = HALF.split("pressures:")[0] + ONE_SIDED
SCENES["quarter"] = QUARTER.replace("cells: [3, 4, 2]", "cells: [3, 8, 2]").split("pressures:")[0] + ONE_SIDED
SCENES["oblique"] = """bodies:
  - w: {shape: wedge, axis: y, corners: [0, 0, 4, 1, 1, 3], extent: [0, 2], side_cells: 2, length_cells: 2,
        material: neohookean, young: 1000, poisson: 0.3}
symmetry: [s1: {face: w.side1, normal: [-4, 0, 1]}, s2: {face: w.side2, normal: [3, 0, 2]}, w.lmin, w.lmax]
pressures: [p: {face: w.side3, value: 10}]
"""
SCENES["tubes"] = """bodies:
  - i: {shape: tube_arc, axis: z, radii: [1, 1.5], angles: [15, 105], extent: [0, 0.3], cells: [2, 4, 1], young: 1000,
        poisson: 0.3}
  - o: {shape: tube_arc, axis: z, radii: [1.5, 2], angles: [15, 105], extent: [0, 0.3], cells: [2, 4, 1], young: 3000,
        poisson: 0.3}
symmetry: [i.amin, i.amax, i.lmin, i.lmax, o.amin, o.amax, o.lmin, o.lmax]
pressures: [p: {face: i.inner, value: 5}]
ties: [t: {mortar: o.inner, nonmortar: i.outer}]
"""
for angle in 0, 20:
    SCENES["clamped_%d" % angle] = wedge("z", (angle, angle + 45), symmetry="[arc.amin, arc.amax]") + (
        "displacements: [foot: {face: arc.lmin, value: [0, 0, 0]}]\n")


def near(a, b, size, within=1e-6):
    return bool(np.linalg.norm(np.subtract(a, b)) <= within * size)


def judge_forces(steps):
    """Reactions of planes at edges that they share, with each other, with ties and with a clamped face"""
    faces = {name: {face["name"]: face["reaction"] for face in step["faces"]} for name, step in steps.items()}
    oblique = faces["oblique"]
    say("oblique: the forces of two planes with a common edge are those of statics",
        near(oblique["w.side1"], [80, 0, -20], 100) and near(oblique["w.side2"], [-60, 0, -40], 100), oblique)
    tubes, planes = faces["tubes"], {15: "amin", 105: "amax"}
    along = [
        np.dot(tubes[body + planes[angle]],
               [math.cos(math.radians(angle)), math.sin(math.radians(angle)), 0])
        for body in ("i.", "o.")
        for angle in planes
    ]
    say("tubes: no force of a plane along it", max(map(abs, along)) < 1e-9, along)
    sizes = [np.linalg.norm(tubes["i." + face]) + np.linalg.norm(tubes["o." + face]) for face in ("amin", "amax")]
    say("tubes: the forces across the planes are the pressure's", near(sizes, [1.5, 1.5], 1.5, 1e-9), sizes)
    sizes = [np.linalg.norm(faces["clamped_%d" % a]["arc." + face]) for a in (0, 20) for face in ("amin", "amax")]
    say("clamped: the forces of both ends are equal, in any direction", near(sizes, sizes[0], sizes[0], 1e-9),
        sizes)
    say("oblique, tubes, clamped: in balance",
        all(steps[name]["balance"] < 1e-8 for name in ("oblique", "tubes", "clamped_0", "clamped_20")),
        [steps[name]["balance"] for name in ("oblique", "tubes", "clamped_0", "clamped_20")])


def judge():
    steps = {name: load(name)["steps"][-1] for name in SCENES}
    strain = -0.5 * 1.3 * 0.4 / 10
    for name in ("one", "two", "named", "tied"):
        axis = 1 if name == "two" else 2
        u = strain * PROBE[name]
        u[axis] = 0
        point = steps[name]["probes"][0]
        across = [point["stress_" + 2 * c] for i, c in enumerate("xyz") if i != axis]
        say(name + ": displacement and stress to 1e-11",
            near(point["displacement"], u, 0.05, 1e-11) and near(across, [-0.5, -0.5], 0.5, 1e-10), point)
        say(name + ": in balance", steps[name]["balance"] < 1e-11, steps[name]["balance"])
    plane = {face["name"]: face["reaction"] for face in steps["one"]["faces"]}["arc.amax"]
    say("one: the plane's force is the pressure's",
        near(plane, 0.5 * np.array([math.sin(math.radians(50)), -math.cos(math.radians(50)), 0]), 0.5), plane)
    finite = steps["finite"]["probes"][0]
    x = PROBE["finite"]
    say(
        "finite: a uniform state, along the radius",
        near(np.cross(finite["displacement"], [x[0], x[1], 0])[2], 0, 0.05)
        and near([finite["stress_xx"] - finite["stress_yy"], finite["stress_xy"]], 0, 0.5)
        and abs(finite["stress_xx"] / -0.5 - 1) < 0.1, finite)
    say("half of a quarter under pressure from inside: half of its energy",
        near(2 * steps["half"]["energy"], steps["quarter"]["energy"], steps["quarter"]["energy"], 1e-10),
        (steps["half"]["energy"], steps["quarter"]["energy"]))
    judge_forces(steps)


if sys.argv[1] == "write":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s%s" % (name, text, probe(PROBE[name]) if name in PROBE else ""))
else:
    judge()
