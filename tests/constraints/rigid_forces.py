"""Scenes for rigid_forces.sh, and their answers: python rigid_forces.py drive|write|judge."""
import os
import sys

import numpy as np

from roller import ROLLER
from summaries import load, say

PUNCH = """bodies:
  - block: {lower: [0, 0, 0], upper: [1, 2, 3], cells: [3, 4, 5], young: 10, poisson: 0.3}
  - punch: {lower: [-1, -1, 3], upper: [2, 3, 4], cells: [2, 2, 1], material: rigid}
symmetry: [block.xmin, block.ymin, block.zmin]
displacements:
  - press: {body: punch, value: [0, 0, -0.03]}
contact:
  - touch: {mortar: punch.zmin, nonmortar: block.zmax}
"""
RUBBER = PUNCH.replace("young",
                       "material: neohookean, young").replace("symmetry",
                                                              "load: {steps: 2}\nsymmetry").replace("-0.03", "-0.6")
FLAT = ROLLER.replace("CELLS", "cells: [24, 1, 16], grading: [30, 1, 0.03], even: [12, 1, 6]")
PRESSED = FLAT.replace("MOTION", "[0, 0, -0.002]")
# Turned and shifted: these motions stay prescribed while the force presses
ROLLED = FLAT.replace("MOTION", "[0.004, 0, -0.002], rotation: [0, 2, 0], center: [0, 0, 1]")
DRIVEN = dict(punch=PUNCH, rubber=RUBBER, roller=PRESSED, rolled=ROLLED)
# A plate glued on a bar carries a force beside its middle and a moment: stretched, and bent both ways
BEAM = """bodies:
  - bar: {lower: [-0.5, -1, 0], upper: [0.5, 1, 4], cells: [2, 3, 4], young: 10, poisson: 0, order: 2}
  - plate: {lower: [-1, -2, 4], upper: [1, 2, 5], cells: [3, 2, 1], material: rigid}
displacements:
  - foot: {face: bar.zmin, value: [0, 0, 0]}
  - guide: {body: plate, value: [free, free, free], rotation: [free, free, free], center: [0, 0, 4]}
forces:
  - load: {body: plate, value: [0, 0, 0.02], moment: [0.01, 0, 0], point: [0.3, 0, 7]}
ties:
  - glue: {mortar: plate.zmin, nonmortar: bar.zmax}
"""
TILT = """bodies:
  - block: {lower: [-1, -1, 0], upper: [1, 1, 1], cells: [4, 4, 3], young: 10, poisson: 0.3}
  - plate: {lower: [-1.5, -2, 1], upper: [1.5, 2, 2], cells: [3, 2, 1], material: rigid}
displacements:
  - foot: {face: block.zmin, value: [0, 0, 0]}
  - guide: {body: plate, value: [0, 0, free], rotation: [free, free, 0], center: [0, 0, 1]}
forces:
  - load: {body: plate, value: [0.00003, 0, -0.002], moment: [0.0001, 0, 0], point: [0.1, -0.2, 7]}
contact:
  - touch: {mortar: plate.zmin, nonmortar: block.zmax}
"""
# All six motions are free, and friction holds what the pressure does not
RUBS = TILT.replace("block.zmax}", "block.zmax, friction: 0.3}").replace("value: [0, 0, free]",
                                                                         "value: [free, free, free]").replace(
                                                                             "free, free, 0]", "free, free, free]")
# On springs at its face of 1 by 2: it sinks by F / k A
SPRUNG = """bodies:
  - plate: {lower: [0, 0, 0], upper: [1, 2, 0.5], cells: [2, 2, 1], material: rigid}
  - cap: {lower: [0, 0, 0.5], upper: [1, 2, 1], cells: [3, 3, 1], young: 10, poisson: 0}
displacements:
  - guide: {body: plate, value: [0, 0, free]}
springs:
  - soil: {face: plate.zmin, value: [0, 0, 3]}
forces:
  - load: {body: plate, value: [0, 0, -0.02]}
pressures:
  - top: {face: cap.zmax, value: 0.05}
ties:
  - glue: {mortar: plate.zmax, nonmortar: cap.zmin}
probes:
  - top: {point: [0, 0, 1], body: cap}
"""


def near(a, b, size, within=1e-8):
    return bool(np.linalg.norm(np.subtract(a, b)) <= within * size)


def body_face(step):
    return next(face for face in step["faces"] if face["name"].endswith(".*"))


def now(step, point, center):
    """Where a point of the rigid body is"""
    body = step["rigid_bodies"][0]
    rotation = np.radians(body["rotation"])
    angle, arm = np.linalg.norm(rotation), np.subtract(point, center)
    axis = rotation / angle
    return body["position"] + arm + np.sin(angle) * np.cross(axis, arm) + (1 - np.cos(angle)) * np.cross(
        axis, np.cross(axis, arm))


def forced(name):
    """The same scene, where the force that drove it along z drives it now"""
    last = load("driven_" + name)["steps"][-1]
    body = body_face(last)["name"][:-2]
    text = DRIVEN[name].replace("-0.002", "free").replace("-0.03", "free").replace("-0.6", "free")
    return text + "forces:\n  - load: {body: %s, value: [0, 0, %r]}\n" % (body, body_face(last)["reaction"][2])


def write(scenes):
    for name, text in scenes.items():
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s" % (name, text))


def judge_driven(title, name, step):
    one = load("driven_" + name)["steps"][-1]
    pair, same = one["pairs"][0], step["pairs"][0]
    size = pair["normal_force"]
    # its area is that of the bulge where the gap was linearized
    ends = near(one["energy"], step["energy"], one["energy"]) and near(
        pair["force"], same["force"], size) and (name == "rubber"
                                                 or near(pair["pressure"], same["pressure"], pair["pressure"]))
    say(title + name + ": energy and force of the run that a displacement drives", ends
        and abs(body_face(step)["reaction"][2]) < 1e-12 * size, (one["energy"], step["energy"], pair, same))


def judge_punch(title, step):
    say(title + "punch: energy F^2 L / 2 E A", near(step["energy"], 0.03**2 / 2 * 10 * 2 / 3, 0.003), step["energy"])


def judge_beam(title, step):
    beam = 0.02**2 * 4 / (2 * 10 * 2) + 0.01**2 * 4 / (2 * 10 * 8 / 12) + 0.006**2 * 4 / (2 * 10 * 2 / 12)
    say(title + "beam: energy of a bar that is stretched and bent both ways",
        near(step["energy"], beam, beam) and near(step["work"], beam, beam), step["energy"])


def judge_tilt(title, step):
    pair, held = step["pairs"][0], body_face(step)
    force = np.array([0.00003, 0, -0.002])
    moment = np.add(held["moment"], np.add([0.0001, 0, 0], np.cross(now(step, [0.1, -0.2, 7], [0, 0, 1]), force)))
    force = force + held["reaction"]
    say(title + "tilt: contact and what holds the plate balance the load, force and moment",
        near(pair["force"], force, 0.002) and near(pair["moment"], moment, 0.002), (pair["moment"], moment))


def judge_rubs(title, step):
    say(title + "rubs: friction carries what pushes",
        near(step["pairs"][0]["force"], [0.00003, 0, -0.002], 0.002) and near(body_face(step)["reaction"], 0, 0.002),
        step["pairs"])


def judge_sprung(title, step):
    sinks = (0.02 + 0.05 * 2) / (3 * 2)
    plate = next(body for body in step["bodies"] if body["name"] == "plate")
    say(
        title + "sprung: sinks by force over stiffness",
        near(plate["springs"], [0, 0, 0.12], 0.12)
        and near(step["probes"][0]["displacement"], [0, 0, -sinks - 0.05 * 0.5 / 10], sinks), (plate, step["probes"]))


def judge(title, end):
    """All scenes that ran; the expected output says which must have"""
    steps = {
        name: load(name + end)["steps"]
        for name in (*DRIVEN, "beam", "tilt", "rubs", "sprung")
        if os.path.exists(name + end + ".json")
    }
    for name in DRIVEN:
        if name in steps:
            judge_driven(title, name, steps[name][-1])
    for name, check in ("punch", judge_punch), ("beam", judge_beam), ("tilt", judge_tilt), ("rubs",
                                                                                            judge_rubs), ("sprung",
                                                                                                          judge_sprung):
        if name in steps:
            check(title, steps[name][0])


if sys.argv[1] == "drive":
    write({"driven_" + name: text for name, text in DRIVEN.items()})
elif sys.argv[1] == "write":
    write(dict({name: forced(name) for name in DRIVEN}, beam=BEAM, tilt=TILT, rubs=RUBS, sprung=SPRUNG))
else:
    judge("", "")
    judge("three ranks, ", "_3")
