"""Scenes for rigid.sh, and their answers: python rigid.py write|judge."""
import math
import os
import re
import sys

import numpy as np

from roller import ROLLER
from summaries import load, say

PUNCH = """bodies:
  - block: {lower: [0, 0, 0], upper: [1, 2, 3], cells: [3, 4, 5], young: 10, poisson: 0.3}
  - punch: {lower: [-1, -1, 3], upper: [2, 3, 4], cells: [2, 2, 1], material: rigid}
symmetry: [block.xmin, block.ymin, block.zmin]
displacements:
  - press: {body: punch, value: [0.5, 0, -0.03]}
  - more: {body: punch, value: [0, 0, -0.06], ramp: later}
contact:
  - touch: {mortar: punch.zmin, nonmortar: block.zmax}
probes:
  - corner: {point: [1, 2, 3], body: block}
load: {steps: 2}
ramps:
  - later: {factors: [0, 1]}
"""
TURN = """bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 1, 4], cells: [2, 2, 5], material: neohookean, young: 10, poisson: 0.3}
displacements:
  - foot: {face: bar.zmin, value: [0.5, 0, 1], rotation: [0, 90, 0], center: [1, 2, 3]}
  - head: {face: bar.zmax, value: [0.5, 0, 0], rotation: [0, 60, 0], center: [1, 2, 3]}
  - head_too: {face: bar.zmax, value: [0, 0, 1], rotation: [0, 30, 0], center: [1, 2, 3]}
probes:
  - middle: {point: [0.5, 1, 1.6]}
load: {steps: 8}
"""
TWIST = """bodies:
  - bar: {lower: [-1, -1, 0], upper: [1, 1, 4], cells: [3, 3, 5], young: 10, poisson: 0.3}
displacements:
  - foot: {face: bar.zmin, value: [0, 0, 0]}
  - head: {face: bar.zmax, value: [0, 0, 0], rotation: [0, 0, 0.01], center: [0, 0, 4]}
"""


def hertz():
    """The cylinder that is pressed on a plane of held faces; the same where a rigid plane is pressed on the cylinder"""
    with open(os.path.join(os.environ["AMGF_DIR"], "share", "scenes", "hertz_cylinder.yaml")) as file:
        held = re.sub(r"(patches|even): \[[^]]*\]", lambda m: "patches: [4, 16, 10]"
                      if m[1] == "patches" else "even: [1, 5, 2]", file.read(), count=2)
    plane = re.sub(r"(cells: \[1, 1, 1\]\n) *young: 1000\n *poisson: 0.3\n(?: *element: .*\n)?",
                   r"\1      material: rigid\n", held)
    plane = re.sub(r"  - rigid: .*\n  - bottom: .*\n", "  - rise: {body: plane, value: [0, 0, 7.7308e-5]}\n",
                   plane).replace("free, free, -7.7308e-5", "free, free, 0")
    return held, plane


FINE = ROLLER.replace("CELLS", "cells: [30, 1, 24], grading: [60, 1, 0.02], even: [14, 1, 8]")
PRESSED = FINE.replace("MOTION", "[0, 0, -0.002]")
SCENES = dict(punch=PUNCH, turn=TURN, twist=TWIST, roller=PRESSED,
              rolled=PRESSED.replace("0.002]", "0.002], rotation: [0, 2, 0], center: [0, 0, 1]"))
SCENES["held"], SCENES["plane"] = hertz()


def near(a, b, size, within=1e-6):
    return bool(np.linalg.norm(np.subtract(a, b)) <= within * size)


def judge():
    steps = {name: load(name)["steps"] for name in SCENES}
    corner = [step["probes"][0] for step in steps["punch"]]
    say(
        "punch: stress and displacement of either step",
        all(
            near(p["stress_zz"], -10 * d / 3, 0.3) and near(p["displacement"], [0.1 * d, 0.2 * d, -d], d)
            for p, d in zip(corner, (0.015, 0.09))), corner)
    face = steps["punch"][1]["faces"][0]
    say("punch: what holds it is the pressure's resultant", face["name"] == "punch.*"
        and near(face["reaction"], [0, 0, -0.6], 0.6), face)
    turn = steps["turn"][-1]
    say(
        "turned by 90 degrees: no energy, no forces, places", turn["energy"] < 1e-15
        and all(near(f["reaction"], 0, 1e-3) for f in turn["faces"])
        and near(turn["probes"][0]["displacement"], [-0.4, 0, 2.9], 1), turn)
    twist = steps["twist"][0]
    foot, head = (f["moment"][2] for f in twist["faces"])
    say("twisted: moments in balance, their work the energy",
        near(foot, -head, head) and near(head * math.radians(0.01) / 2, twist["energy"], twist["energy"]),
        (foot, head, twist["energy"]))
    for name in ("roller", "rolled"):
        pair = steps[name][0]["pairs"][0]
        force, modulus = 2 * pair["normal_force"] / 0.01, 1000 / 0.91
        peak, half_width = math.sqrt(force * modulus / math.pi), math.sqrt(4 * force / (math.pi * modulus))
        say(name + ": Hertz's pressure and width to 2 %",
            near(pair["pressure"], peak, peak, 0.02) and near(pair["area"] / 0.01, half_width, half_width, 0.02),
            (pair, peak, half_width))
    held, plane = (steps[name][0] for name in ("held", "plane"))
    say(
        "a rigid plane that rises against a held one: energy and force",
        near(held["energy"], plane["energy"], held["energy"])
        and near(held["pairs"][0]["force"], plane["pairs"][0]["force"], held["pairs"][0]["normal_force"]),
        (held["energy"], plane["energy"]))


if sys.argv[1] == "write":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text if "problem:" in text else "problem: %s\n%s" % (name, text))
else:
    judge()
