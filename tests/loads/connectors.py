"""Scenes of connectors.sh, and what must hold of their results."""
import csv
import json
import math
import sys

LEVER = """bodies:
  - arm: {lower: [0, 0, 0], upper: [10, 1, 1], cells: [4, 1, 1], material: rigid}
  - block: {lower: [0, 0, -3], upper: [10, 1, -2], cells: [4, 1, 1], young: 2e5, poisson: 0}
displacements:
  - free: {body: arm, value: [free, free, free], rotation: [free, free, free], center: [5, 0.5, 0.5]}
  - ground: {face: block.zmin, value: [0, 0, 0]}
connectors:
  - hinge1: {body: arm, point: [0, 0, 0.5], value: [1e6, 1e6, 1e6]}
  - hinge2: {body: arm, point: [0, 1, 0.5], value: [1e6, 1e6, 1e6]}
  - rod: {body: arm, point: [10, 0.5, 0], to: block, to_point: [10, 0.5, -2], stiffness: 1000}
forces:
  - weight: {body: arm, value: [0, 0, -1], point: [5, 0.5, 0.5]}
load: {steps: 1}
"""

# a cube on three springs at each of two opposite corners
HUNG = """bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1e9, poisson: 0.3}
connectors:
  - low: {body: cube, point: [0, 0, 0], value: [10, 20, 40]}
  - high: {body: cube, point: [1, 1, 1], value: [10, 20, 40]}
  - stay: {body: cube, point: [1, 0, 0], to_point: [1, 0, -5], stiffness: 40}
  - guy: {body: cube, point: [0, 1, 0], to_point: [0, 1, -5], stiffness: 40}
body_forces:
  - weight: {body: cube, value: [0, 0, -16]}
load: {steps: 1}
"""

# two blocks as stiff as rigid ones, of mass 8 and 4, with a spring and a damper between them; one is hit
DAMPED = """bodies:
  - left: {lower: [0, 0, 0], upper: [2, 2, 2], cells: [2, 1, 1], young: 1e9, poisson: 0, density: 1,
           initial_velocity: [1, 0, 0]}
  - right: {lower: [3, 0, 0], upper: [4, 2, 2], cells: [2, 1, 1], young: 1e9, poisson: 0, density: 1}
symmetry: [left.ymin, left.zmin, right.ymin, right.zmin]
connectors:
  - strut: {body: left, point: [2, 0, 0], to: right, to_point: [3, 0, 0], stiffness: 8000, damping: 40}
dynamics: {time_step: 0.001, end_time: 0.1}
"""

# a bar under a uniform stress of 10: nodal forces at its end, or one force in the middle of its only facet there
PULLED = """bodies:
  - bar: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [2, 1, 1], young: 1000, poisson: 0}
displacements:
  - ground: {face: bar.xmin, value: [0, 0, 0]}
forces:
"""
CORNERS = "".join(f"  - at{y}{z}: {{body: bar, point: [2, {y}, {z}], value: [2.5, 0, 0]}}\n" for y in (0, 1)
                  for z in (0, 1))
MIDDLE = "  - middle: {body: bar, point: [2, 0.5, 0.5], value: [10, 0, 0]}\n"


def load(name):
    with open(name + ".json") as file:
        return json.load(file)["steps"][-1]


def say(what, off, allowed):
    print(f"{what}: {'sound' if abs(off) <= allowed else f'off by {off:g}'}")


def judge_damped(name):
    """The distance x of the blocks: m x'' + 40 x' + 8000 x = 0 with the reduced mass m, x = 0 and x' = -1 at the
    start"""
    mass, stiffness, damping = 8 * 4 / (8 + 4), 8000, 40
    decay = damping / (2 * mass)
    omega = math.sqrt(stiffness / mass - decay**2)
    with open(name + ".csv") as file:
        rows = list(csv.DictReader(file))

    def error(row):
        t = float(row["time"])
        x = -math.exp(-decay * t) * math.sin(omega * t) / omega
        v = -math.exp(-decay * t) * (math.cos(omega * t) - decay / omega * math.sin(omega * t))
        return max(
            abs(float(row["strut.offset_x"]) - x) * omega,
            abs(float(row["strut.force_x"]) - stiffness * x - damping * v) / stiffness * omega)

    say(f"{name}: offset and force of a damped oscillation", max(map(error, rows)), 5e-3)
    say(f"{name}: the energy that is left and the work of damping are the energy at the start",
        max(abs(float(row["dynamics.total_energy"]) + float(row["dynamics.damping_work"]) - 4) for row in rows), 1e-6)
    say(f"{name}: momentum", max(abs(float(row["dynamics.momentum_x"]) - 8) for row in rows), 1e-7)


def judge():
    step = load("lever")
    forces = {c["name"]: c["force"] for c in step["connectors"]}
    say("lever: the rod has half of the weight", forces["rod"][2] - 0.5, 1e-5)
    say("lever: the hinge has the rest", forces["hinge1"][2] + forces["hinge2"][2] - 0.5, 1e-5)
    say("lever: bodies are in equilibrium", step["balance"], 1e-8)
    say("lever: work is stored", step["work"] / (2 * step["energy"] - step["energy"]) - 1, 1e-6)
    step = load("hung")
    springs = [sum(c["force"][d] for c in step["connectors"]) for d in range(3)]
    say("hung: springs carry the weight", max(abs(springs[0]), abs(springs[1]), abs(springs[2] - 16)), 1e-6)
    say("hung: forces are stiffness times offset",
        max(abs(c["force"][2] + 40 * -c["offset"][2]) for c in step["connectors"]), 1e-9)
    # all four springs along z have the same stiffness, and stand around the middle of the cube
    say("hung: each carries a quarter", max(abs(c["force"][2] - 4) for c in step["connectors"]), 1e-6)
    judge_damped("damped")
    for name in ("pulled", "middle"):
        step = load(name)
        say(f"{name}: energy of a uniform stress", step["energy"] - 0.5 * 10**2 / 1000 * 2, 1e-9)
        say(f"{name}: load of the body", step["bodies"][0]["load"][0] - 10, 1e-9)
    with open("lever.csv") as file:
        row = list(csv.DictReader(file))[-1]
    say("history has the force", float(row["rod.force_z"]) - 0.5, 1e-5)


if sys.argv[1] == "write":
    for scene, text in (("lever", LEVER), ("hung", HUNG), ("damped", DAMPED), ("pulled", PULLED + CORNERS),
                        ("middle", PULLED + MIDDLE)):
        with open(scene + ".yaml", "w") as out:
            out.write(text)
else:
    judge()
