"""A rubber ring pinched between two rigid rollers until its inside touches itself: self_contact_ring.py write | judge.

By symmetry the ring's upper half behaves as if it touched a rigid plane. The scene `quarter` has that plane and an
ordinary pair; `half` and `auto` have the whole ring right of the axis, and self contact.
"""
import sys

import numpy as np

from summaries import load, say

SCENE = """problem: ring
bodies:
  - ring: {{shape: tube_arc, axis: y, radii: [0.85, 1], angles: [0, {angle}], extent: [0, 0.2], cells: [2, {cells}, 1],
           material: neohookean, young: 1, poisson: 0.3}}
  - top: {{shape: rigid_cylinder, center: [0, 0, 1.4], direction: [0, 1, 0], radius: 0.4}}
  - bottom: {{{bottom}}}
displacements:
  - push: {{body: top, value: [0, 0, -0.9]}}
  - stay: {{body: bottom, value: [0, 0, {up}]}}
symmetry: [ring.lmin, ring.lmax, ring.amin, ring.amax]
contact:
{contact}
load: {{factors: [0.3, 0.6, 0.8, 0.944, 0.95, 0.96, 0.97, 0.98, 0.99, 1]}}
"""
ROLLER = "shape: rigid_cylinder, center: [0, 0, -1.4], direction: [0, 1, 0], radius: 0.4"
PLANE = "shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]"
ABOVE, BELOW = "  - above: {mortar: top.surface, nonmortar: ring.outer}", ("\n"
                                                                           "  - below: {mortar: bottom.surface, "
                                                                           "nonmortar: ring.outer}")
SCENES = {
    "half": (180, 64, ROLLER, 0.9, ABOVE + BELOW + "\n  - inside: {self: ring.inner}"),
    "auto": (180, 64, ROLLER, 0.9, "  - auto: {self: true}"),
    "quarter": (90, 32, PLANE, 0, ABOVE + "\n  - inside: {mortar: bottom.surface, nonmortar: ring.inner}"),
}


def write():
    for name, values in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(SCENE.format(**dict(zip(("angle", "cells", "bottom", "up", "contact"), values))))


def pair(name, which):
    return next(p for p in load(name)["steps"][-1]["pairs"] if which in p["name"])


def judge_ring(name, quarter, inside="inside"):
    """The right half of the ring has two quarters"""
    step, other, touch = load(name)["steps"][-1], load(quarter)["steps"][-1], pair(name, inside)
    errors = [
        step["energy"] / (2 * other["energy"]) - 1, touch["normal_force"] / pair(quarter, "inside")["normal_force"] - 1,
        step["energy"] / step["work"] - 1
    ]
    say("%s: energy of two quarters, to 0.2 %%" % name, abs(errors[0]) < 2e-3, errors[0])
    say("%s: contact force of a quarter, to 1 %%" % name, abs(errors[1]) < 1e-2, errors[1])
    say("%s: the work of the rollers is stored, to 1 %%" % name, abs(errors[2]) < 1e-2, errors[2])
    sums = np.add(touch["force"], touch["mortar_force"])
    say("%s: action and reaction, to 1e-9" % name, np.abs(sums).max() < 1e-9 * touch["normal_force"], sums)


def same(name, other, tolerance):
    errors = [load(name)["steps"][-1][key] / load(other)["steps"][-1][key] - 1 for key in ("energy", "work")]
    errors.append(pair(name, "inside")["normal_force"] / pair(other, "inside")["normal_force"] - 1)
    say("%s and %s agree to %g" % (name, other, tolerance), max(abs(e) for e in errors) < tolerance, errors)


def judge():
    judge_ring("half", "quarter")


def long():
    judge_ring("half_refined", "quarter_refined")
    judge_ring("auto", "quarter", "ring_self")
    same("half_2", "half", 1e-5)
    same("half_3", "half", 1e-5)
    same("restarted", "half", 1e-5)


{"write": write, "judge": judge, "long": long}[sys.argv[1]]()
