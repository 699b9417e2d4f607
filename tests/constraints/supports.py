"""Scenes for supports.sh, and their answers: python supports.py write|judge."""
import sys

import numpy as np

from summaries import load, say

BAR = "bodies:\n  - bar: {lower: [0, 0, 0], upper: [1, 2, 3], cells: [2, 3, 4], young: 10, poisson: 0.3}\n"
PROBES = "probes:\n  - corner: {point: [1, 2, 3]}\n  - foot: {point: [1, 2, 0]}\n"
SIX = "".join("  - p%s%s: {face: bar.%s%s, value: 0.5}\n" % (axis, end, axis, end)
              for axis in "xyz"
              for end in ("min", "max"))
BLOCK = "  - %s: {lower: [%g, %g, %g], upper: [%g, %g, %g], cells: [%d, %d, 2], young: 1e5, poisson: 0.3}\n"

# A cone in a rigid bore without friction. Nothing but weak springs holds it against a rotation about its axis.
PLUG = """bodies:
  - plug: {shape: cone, axis: z, radii: [1, 1.2], extent: [0, 2], cells: [3, 3, 6], young: 1000, poisson: 0.3}
  - bore: {shape: rigid_revolved, center: [0, 0, 0], direction: [0, 0, 1], points: [1.4, 4, 0.95, -0.5]}
displacements:
  - seat: {body: bore, value: [0, 0, 0]}
  - push: {face: plug.lmax, value: [free, free, -0.1]}
contact:
  - fit: {mortar: bore.surface, nonmortar: plug.surface}
load: {factors: [0.25, 0.5]}
weak_springs: true
"""

SCENES = {
    "plug": PLUG,
    "pull": BAR +
    ("symmetry: [bar.xmin, bar.ymin, bar.zmin]\ntractions:\n  - up: {face: bar.zmax, value: [0, 0, 0.1]}\n"
     "forces:\n  - more: {face: bar.zmax, value: [0, 0, 0.4]}\n") + PROBES,
    "twist": BAR.replace("young: 10", "young: 1e7")  # moments are those of the deformed places
    + ("displacements:\n  - wall: {face: bar.zmin, value: [0, 0, 0]}\nforces:\n"
       "  - top: {face: bar.zmax, value: [0.1, 0.2, -0.3], moment: [0.02, -0.01, 0.03]}\n"
       "  - turn: {face: bar.zmax, moment: [0, 0.01, 0.02]}\ntractions:\n"
       "  - side: {face: bar.xmax, value: [0, 0.01, 0]}\n"),
    "bed": BAR +
    ("symmetry: [bar.xmin, bar.ymin]\nsprings:\n  - ground: {face: bar.zmin, value: [0, 0, 4]}\npressures:\n"
     "  - load: {face: bar.zmax, value: 0.2}\n") + PROBES,
    "float": BAR + "weak_springs: true\npressures:\n" + SIX + PROBES,
    "stack": "bodies:\n" + BLOCK % ("bottom", -2, -2, 0, 2, 2, 1, 4, 4) + BLOCK %
    ("middle", -1.5, -1.5, 1, 1.5, 1.5, 2, 3, 3) + BLOCK % ("top", -1, -1, 2, 1, 1, 3, 4, 4) +
    ("displacements:\n  - floor: {face: bottom.zmin, value: [0, 0, 0]}\npressures:\n"
     "  - load: {face: top.zmax, value: 1}\n") +
    ("contact:\n  - lower: {mortar: middle.zmin, nonmortar: bottom.zmax}\n"
     "  - upper: {mortar: middle.zmax, nonmortar: top.zmin}\nweak_springs: true\n"),
}
SCENES["pins"] = BAR + ("displacements:\n  - a: {body: bar, point: [0, 0, 0], value: [0, 0, 0]}\n"
                        "  - b: {body: bar, point: [1, 0, 0], value: [free, 0, 0]}\n"
                        "  - c: {body: bar, point: [0, 2, 0], value: [free, free, 0]}\n"
                        "pressures:\n" + SIX + PROBES)
SCENES["edges"] = BAR + (
    "displacements:\n  - left: {body: bar, from: [0, 0, 0], to: [0, 2, 0], value: [0, free, 0]}\n"
    "  - right: {body: bar, from: [1, 2, 0], to: [1, 0, 0], value: [free, free, 0]}\n"
    "  - foot: {body: bar, point: [0, 0, 0], value: [free, 0, free]}\nbody_forces:\n  - weight: {value: [0, 0, -1]}\n" +
    PROBES)
# Two blocks and a pad between their faces, whose meshes do not match, in series
SCENES["pad"] = """bodies:
  - low: {lower: [0, 0, 0], upper: [1, 2, 3], cells: [2, 2, 3], young: 10, poisson: 0}
  - top: {lower: [0, 0, 3.2], upper: [1, 2, 5.2], cells: [3, 5, 2], young: 5, poisson: 0, order: 2}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
springs:
  - pad: {face: top.zmin, to: low.zmax, value: [4, 4, 20], distance: 0.3}
forces:
  - load: {face: top.zmax, value: [0, 0, -0.6]}
probes:
  - tip: {point: [1, 2, 5.2]}
"""
SCENES["pads"] = SCENES["pad"].replace("value: [4, 4, 20]", "value: [4, 4, 5]").replace(
    "forces:", "  - more: {face: low.zmax, to: top.zmin, value: [0, 0, 15], distance: 0.3}\nforces:")
# Pressed beside its middle between two larger blocks: what tilts of their faces presses out
SQUEEZED = (
    "bodies:\n  - low: {lower: [-3, -3, 0], upper: [3, 3, 1.6], cells: [4, 4, 3], young: 3000, poisson: 0.3}\n"
    "  - mid: {lower: [-1.5, -1.5, 1.6], upper: [1.5, 1.5, 2.9], cells: [3, 2, 3], young: 10, poisson: 0.3}\n"
    "  - top: {lower: [-2, -2, 2.9], upper: [2.5, 3, 4.3], cells: [2, 2, 3], young: 1400, poisson: 0.3}\n"
    "displacements:\n  - floor: {face: low.zmin, value: [0, 0, 0]}\n  - push: {face: top.zmax, value: [0, 0, -0.18]}\n"
    "contact:\n  - lower: {mortar: mid.zmin, nonmortar: low.zmax}\n"
    "  - upper: {mortar: mid.zmax, nonmortar: top.zmin}\nweak_springs: true\n")
SCENES["soft"] = SCENES["stack"].replace("1e5", "100")


def near(a, b, size):
    return bool(np.linalg.norm(np.subtract(a, b)) <= 1e-6 * size)


def judge_bars():
    step = {name: load(name)["steps"][-1] for name in SCENES}
    corner, foot = ({
        name: next(p
                   for p in step[name]["probes"]
                   if p["name"] == probe)
        for name in ("pull", "bed", "float")
    }
                    for probe in ("corner", "foot"))
    say(
        "pulled: stress and displacement",
        near(corner["pull"]["stress_zz"], 0.3, 0.3)
        and near(corner["pull"]["displacement"], [-0.009, -0.018, 0.09], 0.09), corner["pull"])
    face = step["twist"]["faces"][0]
    force = np.array([0.1, 0.2 + 0.06, -0.3])
    moment = np.cross([0.5, 1, 3], [0.1, 0.2, -0.3]) + [0.02, 0, 0.05] + np.cross([1, 1, 1.5], [0, 0.06, 0])
    say("twisted: reaction is the load", near(face["reaction"], -force, 1), face)
    say("twisted: moment is the load's", near(face["moment"], -moment, 1), (face["moment"], moment))
    say("on springs: sinks by pressure over stiffness",
        near(foot["bed"]["displacement"][2], -0.05, 0.05) and near(corner["bed"]["stress_zz"], -0.2, 0.2), foot["bed"])
    body = step["bed"]["bodies"][0]
    say("on springs: they carry the load, in balance",
        near(body["springs"], [0, 0, 0.4], 0.4) and body["balance"] < 1e-8, body)
    say("free under pressure: stress",
        near([corner["float"]["stress_" + c] for c in ("xx", "yy", "zz", "xy")], [-0.5, -0.5, -0.5, 0], 0.5),
        corner["float"])
    say("free under pressure: weak springs carry less than 1e-6 of the load",
        0 < step["float"]["weak_spring_force"] < 1e-6 * 0.5 * 6, step["float"]["weak_spring_force"])
    forces = {pair["name"]: pair["force"] for pair in step["stack"]["pairs"]}
    say("stack: each pair's force",
        near(forces["upper"], [0, 0, 4], 4) and near(forces["lower"], [0, 0, -4], 4), forces)
    say("stack: weak springs carry less than 1e-6 of the load", 0 < step["stack"]["weak_spring_force"] < 4e-6,
        step["stack"]["weak_spring_force"])
    pins = step["pins"]
    point = next(p for p in pins["probes"] if p["name"] == "corner")
    say(
        "on three points: displacement, stress, no forces",
        near(point["displacement"], [-0.02, -0.04, -0.06], 0.06) and near(point["stress_zz"], -0.5, 0.5)
        and all(near(f["reaction"], 0, 1) for f in pins["faces"]), pins["faces"])
    for name in ("pad", "pads"):
        bodies, tip = {body["name"]: body["springs"]
                       for body in step[name]["bodies"]}, step[name]["probes"][0]["displacement"]
        sinks = 0.3 * (3 / 10 + 1 / 20 + 2 / 5)
        series = np.linalg.norm(np.subtract(
            tip, [0, 0, -sinks])) < 1e-10 * sinks and abs(step[name]["energy"] - 0.3 * sinks) < 1e-10 * sinks
        say(name + " between two blocks: in series, and what it carries", series
            and near(bodies["top"], [0, 0, 0.6], 0.6) and near(bodies["low"], [0, 0, -0.6], 0.6), (tip, bodies))
    reactions = {face["name"]: face["reaction"] for face in step["edges"]["faces"]}
    say(
        "on two edges: half of the weight on each",
        near(reactions["bar.@left"], [0, 0, 3], 3) and near(reactions["bar.@right"], [0, 0, 3], 3)
        and step["edges"]["balance"] < 1e-10, reactions)
    pair = step["plug"]["pairs"][0]
    sine = 0.1 / np.hypot(0.1, 1)
    say("plug: the pressure carries the force",
        near(pair["force"], [0, 0, pair["normal_force"] * sine], pair["normal_force"]), pair)
    say("plug: does not rotate, so that its energy is the work",
        abs(step["plug"]["energy"] - step["plug"]["work"]) < 1e-6 * step["plug"]["work"],
        (step["plug"]["energy"], step["plug"]["work"]))
    forces = {pair["name"]: pair["force"] for pair in step["soft"]["pairs"]}
    say("soft stack: each pair's force",
        near(forces["upper"], [0, 0, 4], 4) and near(forces["lower"], [0, 0, -4], 4), forces)
    say("soft stack: weak springs carry less than 1e-6 of the load",
        0 < step["soft"]["weak_spring_force"] < 4e-6, step["soft"]["weak_spring_force"])
    say("soft stack: the tight tolerance is reached in the subspace, in fewer than 1,000 applications",
        step["soft"]["amg_applications"] < 1000, step["soft"]["amg_applications"])


if sys.argv[1] == "write":
    for name, text in (*SCENES.items(), ("squeezed", SQUEEZED)):
        with open(name + ".yaml", "w") as file:
            file.write("problem: %s\n%s" % (name, text))
else:
    judge_bars()
