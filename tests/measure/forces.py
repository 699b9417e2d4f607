"""Scenes for forces.sh, and their forces by statics: python forces.py write|judge."""
import math
import sys

import numpy as np

from summaries import load, say

BODY = "  - {name}: {{lower: {lower}, upper: {upper}, cells: {cells}, young: {young}, poisson: 0.3}}\n"
PUNCHES = (1.0001, 1.01, 1.05, 1.08)  # half widths; the facets of the slab under it are 0.1 wide


def body(name, lower, upper, cells, young):
    return BODY.format(name=name, lower=lower, upper=upper, cells=cells, young=young)


PEG = "bodies:\n" + body("guide", [0, 0, 0], [1.2, 1.2, 0.2], [4, 4, 1], 100) + body(
    "back", [-0.2, 0, 0.2], [0, 1.2, 1.4], [1, 4, 4], 100)
PEG += body("side", [0, -0.2, 0.2], [1.2, 0, 1.4], [4, 1, 4], 100) + body("peg", [0, 0, 0.2], [1, 1, 1.2], [3, 3, 3],
                                                                          50)
PEG += """
displacements:
  - floor: {face: guide.zmin, value: [0, 0, 0]}
  - rear: {face: back.xmin, value: [0, 0, 0]}
  - left: {face: side.ymin, value: [0, 0, 0]}
body_forces:
  - weight: {body: peg, value: [-0.3, -0.4, -0.9]}
contact:
  - below: {mortar: guide.zmax, nonmortar: peg.zmin}
  - behind: {mortar: back.xmax, nonmortar: peg.xmin}
  - beside: {mortar: side.ymax, nonmortar: peg.ymin}
"""

STACK = "bodies:\n" + body("bottom", [0, 0, 0], [2, 2, 1], [5, 5, 2], 1000) + body("middle", [0, 0, 1], [1.5, 1.5, 2],
                                                                                   [3, 3, 2], 1000)
STACK += body("top", [0, 0, 2], [1.1, 1.1, 3], [4, 4, 2], 1000)
STACK += """
symmetry: [bottom.xmin, bottom.ymin, bottom.zmin, middle.xmin, middle.ymin, top.xmin, top.ymin]
body_forces:
  - gravity: {value: [0, 0, -1]}
pressures:
  - load: {face: top.zmax, value: 2}
contact:
  - lower: {mortar: middle.zmin, nonmortar: bottom.zmax}
  - upper: {mortar: middle.zmax, nonmortar: top.zmin}
"""

BALL = """bodies:
  - ball: {shape: ball, radius: 1, patches: [3, 3, 3], layers: 3, young: 100, poisson: 0.3}
""" + body("right", [1, 0, 0], [1.5, 1.5, 1.5], [2, 4, 4], 100) + body("top", [0, 0, 1], [1.5, 1.5, 1.5], [4, 4, 2],
                                                                       100)
BALL += """
symmetry: [ball.x0, ball.y0, ball.z0, right.ymin, right.zmin, top.xmin, top.ymin]
displacements:
  - wall: {face: right.xmax, value: [-0.1, free, free]}
  - lid: {face: top.zmax, value: [free, free, -0.1]}
faces:
  - east: {of: ball.surface, lower: [0.7, -inf, -inf]}
  - north: {of: ball.surface, lower: [-inf, -inf, 0.7]}
contact:
  - wall: {mortar: right.xmin, nonmortar: ball.east, distance: 0.5}
  - lid: {mortar: top.zmin, nonmortar: ball.north, distance: 0.5}
"""

PUNCH = "bodies:\n" + body("slab", [0, 0, 0], [4, 0.25, 4], [40, 1, 24], 1) + body(
    "punch", [0, 0, 4], ["{half}", 0.25, 5], [8, 1, 6], 1000).replace("'", "").replace("{half}", "HALF")
PUNCH += """
symmetry: [slab.xmin, slab.ymin, slab.ymax, punch.xmin, punch.ymin, punch.ymax]
displacements:
  - floor: {face: slab.zmin, value: [free, free, 0]}
  - press: {face: punch.zmax, value: [0, 0, -0.01]}
contact:
  - joint: {mortar: punch.zmin, nonmortar: slab.zmax}
"""


def write():
    punches = [("punch_%g" % half, PUNCH.replace("HALF", str(half))) for half in PUNCHES]
    for name, text in [("peg", PEG), ("stack", STACK), ("ball", BALL)] + punches:
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s" % (name, text))


class Fields:
    """Of the last step, by body"""

    def __init__(self, name):
        import h5py

        with h5py.File(name + ".h5") as file:
            self.x, cells, body = file["vertices"][...], file["cells"][...], file["body"][...].ravel()
        with h5py.File(name + "_0001.h5") as file:
            self.values = {key: file[key][...] for key in file}
        self.body = np.zeros(len(self.x), int)
        for b in range(body.max() + 1):
            self.body[np.unique(cells[body == b])] = b


def near(value, exact, tolerance):
    return np.linalg.norm(np.subtract(value, exact)) <= tolerance * np.linalg.norm(exact)


def judge_fields(name, step):
    """Each pair's fields sum to its force on either side"""
    fields, worst, spans = Fields(name), 0.0, True
    for pair in step["pairs"]:
        end = "_" + pair["name"] if len(step["pairs"]) > 1 else ""
        pressure, area, force = (fields.values["contact_%s%s" % (what, end)] for what in ("pressure", "area", "force"))
        sides = [b for b in np.unique(fields.body) if area[fields.body == b].any()]
        spans = spans and len(sides) == 2 and np.isfinite(pressure).all() and (pressure >=
                                                                               -1e-12 * pressure.max()).all()
        for b in sides:
            on = fields.body == b
            sign = 1 if near(force[on].sum(axis=0), pair["force"], 1e-6) else -1
            worst = max(worst, abs((pressure * area)[on].sum() / pair["normal_force"] - 1),
                        np.linalg.norm(sign * force[on].sum(axis=0) - pair["force"]) / pair["normal_force"])
    say("%s: pressures on both sides of every pair, none negative" % name, spans, name)
    say("%s: pressure times area, and the forces, sum to the pairs' to 1e-10" % name, worst <= 1e-10, worst)


def judge_statics(name, pairs, faces):
    step = load(name)["steps"][-1]
    found = {pair["name"]: pair for pair in step["pairs"]}
    reactions = {face["name"]: face["reaction"] for face in step["faces"]}
    say("%s: each pair's force is its statics' to 1e-8" % name,
        all(near(found[key]["force"], force, 1e-8) for key, force in pairs.items()), found)
    say("%s: action is reaction" % name,
        all(near(np.negative(pair["mortar_force"]), pair["force"], 1e-12) for pair in found.values()), found)
    largest = max(np.linalg.norm(pair["force"]) for pair in found.values())
    say("%s: each face's reaction is its statics' to 1e-8" % name,
        all(np.linalg.norm(np.subtract(reactions[key], force)) <= 1e-8 * largest for key, force in faces.items()),
        reactions)
    say("%s: the bodies are in balance to 1e-8" % name, step["balance"] <= 1e-8, step["bodies"])
    total = np.sum([pair["force"] for pair in found.values()], axis=0)
    say("%s: contact_force is the sum of the pairs' forces" % name, near(step["contact_force"], total, 1e-12),
        step["contact_force"])
    judge_fields(name, step)


def judge_punch(half):
    name = "punch_%g" % half
    step, fields = load(name)["steps"][-1], Fields(name)
    mean = abs(step["pairs"][0]["force"][2]) / half / 0.25
    for side, b in ("slab", 0), ("punch", 1):
        line = (fields.body == b) & (np.abs(fields.x[:, 2] - 4) < 1e-9) & (fields.x[:, 1]
                                                                           == 0) & (fields.values["contact_area"] > 0)
        order = np.argsort(fields.x[line, 0])
        pressure = fields.values["contact_pressure"][line][order]
        say("%s: the pressure on the %s rises to the edge" % (name, side), bool((np.diff(pressure) > 0).all()),
            pressure / mean)
        say(("%s: its middle on the %s is within 3 "
             "%% of the exact curve") % (name, side),
            abs(pressure[0] / (2 / math.pi * mean) - 1) <= 0.03, pressure[0] / mean)
        say("%s: no pressure on the %s is beyond seven times the mean" % (name, side),
            pressure.max() <= 7 * mean, pressure / mean)
    judge_fields(name, step)


def judge():
    judge_statics(
        "peg",
        {"below": [0, 0, 0.9], "behind": [0.3, 0, 0], "beside": [0, 0.4, 0]},
        {"guide.zmin": [0, 0, 0.9], "back.xmin": [0.3, 0, 0], "side.ymin": [0, 0.4, 0]},
    )
    top = 1.1**2 * (1 + 2)
    judge_statics("stack", {"upper": [0, 0, top], "lower": [0, 0, -top - 1.5**2]},
                  {"bottom.zmin": [0, 0, top + 1.5**2 + 4]})
    faces = load("ball")["steps"][-1]["faces"]
    holds = {
        block: np.sum([face["reaction"] for face in faces if face["name"].startswith(block)], axis=0)
        for block in ("right", "top")
    }
    say("ball: both blocks press on it", holds["right"][0] < -0.1 and holds["top"][2] < -0.1, holds)
    aside = max(abs(holds["right"][1]), abs(holds["right"][2]), abs(holds["top"][0]), abs(holds["top"][1]))
    say(("ball: without friction, nothing along the "
         "blocks but for how their faces bend"), aside <= 1e-5 * abs(holds["right"][0]), holds)
    judge_statics("ball", {"wall": holds["right"], "lid": holds["top"]},
                  {"ball.y0": [0, -holds["right"][1] - holds["top"][1], 0]})
    for half in PUNCHES:
        judge_punch(half)


if __name__ == "__main__":
    {"write": write, "judge": judge}[sys.argv[1]]()
