"""Scenes of bolts.sh, and what must hold of their results."""
import csv
import json
import sys

from neo_hookean import uniaxial

BARS = """bodies:
  - bolt: {lower: [0, 0, 0], upper: [1, 1, 10], cells: [1, 1, 10], young: 2e5, poisson: 0}
  - sleeve: {lower: [1, 0, 0], upper: [4, 1, 10], cells: [2, 1, 5], young: 1e5, poisson: 0}
  - head: {lower: [0, 0, 10], upper: [4, 1, 11], cells: [4, 1, 1], material: rigid}
displacements:
  - screwed: {face: bolt.zmin, value: [0, 0, 0]}
  - ground: {face: sleeve.zmin, value: [0, 0, 0]}
  - head: {body: head, value: [0, 0, free]}
ties:
  - a: {mortar: head.zmin, nonmortar: bolt.zmax}
  - b: {mortar: head.zmin, nonmortar: sleeve.zmax}
bolts:
  - m8: {body: bolt, point: [0, 0, 4.5], axis: [0, 0, 1], force: 1000, lock: 1, ramp: tighten}
forces:
  - pull: {body: head, value: [0, 0, 300], ramp: pull}
ramps:
  - tighten: {factors: [1, 0, 0]}
  - pull: {factors: [0, 0.5, 1]}
load: {steps: 3}
"""

# Clearances of 0.001 and 0.003 are closed by the bolts; one of them is of order 2, one has hanging nodes in its section
FOUR = """bodies:
  - base: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 1], young: 1e5, poisson: 0.3}
  - lid: {lower: [0, 0, 1.001], upper: [4, 4, 2], cells: [4, 4, 1], young: 1e5, poisson: 0.3}
  - s1: {lower: [0.5, 0.5, 2.003], upper: [1, 1, 4], cells: [1, 1, 4], young: 2e5, poisson: 0.3}
  - s2: {lower: [3, 0.5, 2], upper: [3.5, 1, 4], cells: [1, 1, 4], young: 2e5, poisson: 0.3}
  - s3: {lower: [0.5, 3, 2], upper: [1, 3.5, 4], cells: [1, 1, 3], young: 2e5, poisson: 0.3, order: 2}
  - s4: {lower: [3, 3, 2], upper: [3.5, 3.5, 4], cells: [1, 1, 4], young: 2e5, poisson: 0.3}
  - top: {lower: [0, 0, 4], upper: [4, 4, 4.5], cells: [1, 1, 1], material: rigid}
displacements:
  - ground: {face: base.zmin, value: [0, 0, 0]}
  - top: {body: top, value: [0, 0, 0]}
  - corner: {body: lid, from: [0, 0, 1.001], to: [0, 0, 2], value: [0, 0, free]}
  - turn: {body: lid, point: [4, 0, 1.001], value: [free, 0, free]}
ties:
  - a1: {mortar: top.zmin, nonmortar: s1.zmax}
  - a2: {mortar: top.zmin, nonmortar: s2.zmax}
  - a3: {mortar: top.zmin, nonmortar: s3.zmax}
  - a4: {mortar: top.zmin, nonmortar: s4.zmax}
contact:
  - all: {mortar: base.zmax, nonmortar: lid.zmin}
  - c1: {mortar: lid.zmax, nonmortar: s1.zmin, gap: node}
  - c2: {mortar: lid.zmax, nonmortar: s2.zmin, gap: node}
  - c3: {mortar: lid.zmax, nonmortar: s3.zmin, gap: node}
  - c4: {mortar: lid.zmax, nonmortar: s4.zmin, gap: node}
bolts:
  - b1: {body: s1, point: [0, 0, 3.1], axis: [0, 0, 1], force: -1000}
  - b2: {body: s2, point: [0, 0, 3.1], axis: [0, 0, 1], force: -800}
  - b3: {body: s3, point: [0, 0, 3.1], axis: [0, 0, 1], force: -600}
  - b4: {body: s4, point: [0, 0, 3.1], axis: [0, 0, -3], force: -1200}
refinements:
  - hanging: {body: s4, lower: [3, 3, 2.5], upper: [3.2, 3.5, 3.4]}
load: {steps: 1}
"""

RUBBER = """bodies:
  - band: {lower: [0, 0, 0], upper: [1, 1, 4], cells: [2, 2, 4], material: neohookean, young: 3, poisson: 0}
displacements:
  - wall: {face: band.zmin, value: [free, free, 0]}
  - end: {face: band.zmax, value: [free, free, 0]}
symmetry: [band.xmin, band.ymin]
bolts:
  - pull: {body: band, point: [0, 0, 2.5], axis: [0, 0, 1], force: 0.9}
load: {steps: 2}
"""

# A washer that only contact and weak springs hold
WASHER = """bodies:
  - base: {lower: [0, 0, 0], upper: [4, 4, 2], cells: [2, 2, 1], young: 2e5, poisson: 0.3}
  - washer: {lower: [1, 1, 2], upper: [3, 3, 4], cells: [3, 3, 1], young: 2e5, poisson: 0.3}
  - bolt: {lower: [0, 0, 4], upper: [4, 4, 6], cells: [2, 2, 1], young: 2e5, poisson: 0.3}
displacements:
  - ground: {face: base.zmin, value: [0, 0, 0]}
  - top: {face: bolt.zmax, value: [0, 0, 0]}
weak_springs: true
contact:
  - below: {mortar: base.zmax, nonmortar: washer.zmin}
  - above: {mortar: bolt.zmin, nonmortar: washer.zmax}
bolts:
  - push: {body: bolt, point: [0, 0, 5], axis: [0, 0, 1], force: -1000}
"""


def write():
    scenes = {"bars": BARS, "four": FOUR, "rubber": RUBBER, "washer": WASHER}
    scenes["short"] = BARS.replace("force: 1000, lock: 1, ramp: tighten", "shortening: 0.05")
    for name, text in scenes.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)


def load(name):
    with open(name + ".json") as file:
        return json.load(file)["steps"]


def say(what, off, allowed):
    print(f"{what}: {'sound' if abs(off) <= allowed else f'off by {off:g}'}")


def bolts(step):
    return {bolt["name"]: bolt for bolt in step["bolts"]}


def judge():
    kb, ks = 2e5 / 10, 3e5 / 10
    for name in ("bars", "bars_3", "again"):
        steps = load(name)
        last = bolts(steps[-1])["m8"]
        say(f"{name}: shortening is that of bolt and sleeve", last["shortening"] / (1000 / kb + 1000 / ks) - 1, 1e-10)
        say(f"{name}: a load is shared by stiffness", last["force"] / (1000 + 300 * kb / (kb + ks)) - 1, 1e-10)
        say(f"{name}: work is stored", steps[-1]["work"] / steps[-1]["energy"] - 1, 1e-9)
    say("bars: the force is the given one", bolts(load("bars")[0])["m8"]["force"] / 1000 - 1, 1e-12)
    say("short: the force follows from the shortening",
        bolts(load("short")[-1])["m8"]["force"] / (0.05 / (1 / kb + 1 / ks) + 300 * kb / (kb + ks)) - 1, 1e-10)
    with open("bars.csv") as file:
        rows = list(csv.DictReader(file))
    say("history has force and shortening",
        float(rows[0]["m8.force"]) * float(rows[0]["m8.shortening"]) * 12 - 1000, 1e-6)
    forces = {"b1": -1000, "b2": -800, "b3": -600, "b4": -1200}
    for name in ("four", "four_3"):
        step = load(name)[-1]
        pairs = {pair["name"]: pair for pair in step["pairs"]}
        say(f"{name}: forces are the given ones", max(abs(bolts(step)[b]["force"] / forces[b] - 1) for b in forces),
            1e-7)
        say(f"{name}: and those of the contacts",
            max(abs(pairs["c" + b[1]]["normal_force"] / -forces[b] - 1) for b in forces), 1e-3)
        say(f"{name}: bodies are in equilibrium", step["balance"], 1e-7)
    say("four: ranks agree", load("four")[-1]["energy"] / load("four_3")[-1]["energy"] - 1, 1e-7)
    washer = load("washer")[-1]
    say("washer: both contacts transmit the force", max(abs(p["normal_force"] / 1000 - 1) for p in washer["pairs"]),
        1e-6)
    rubber = load("rubber")[-1]
    band = bolts(rubber)["pull"]
    say("rubber: force", band["force"] / 0.9 - 1, 1e-9)
    # the band keeps its length, and its material is stretched by the shortening
    _, pressure = uniaxial(1 + band["shortening"] / 4, 3.0, 0.0)
    say("rubber: stress of a bar that is stretched by the shortening", -pressure / 0.9 - 1, 1e-6)
    say("rubber: work is stored, by the trapezoidal rule", rubber["work"] / rubber["energy"] - 1, 0.03)


if sys.argv[1] == "write":
    write()
else:
    judge()
