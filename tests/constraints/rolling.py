"""Free rotations that are large: rollers, a wheel, a bar that is bent to a quarter of a circle.

python3 rolling.py scenes writes the scenes; python3 rolling.py judges the runs that rolling.sh has made.
"""
import csv
import math
import os
import sys

from summaries import load, say, within

ROLLS = """load: {steps: %d}
ramps:
  - down: {expression: 1}
  - along: {expression: t - 1}
symmetry: [%s]
displacements:
  - floor: {%s, value: [0, 0, 0]}
  - guide: {body: %s, value: [0, 0, free], rotation: [0, free, 0], center: [0, 0, 1], ramp: down}
  - pull: {body: %s, value: [%r, 0, free], rotation: [0, free, 0], center: [0, 0, 1], ramp: along}
forces:
  - load: {body: %s, value: [0, 0, -1], point: [0, 0, 1], ramp: down}
"""
WAY = math.pi / 2  # of the centre; the radius is 1
ROLLER = """problem: roller
bodies:
  - block: {lower: [-0.4, 0, -0.4], upper: [2, 0.2, 0], cells: [48, 1, 5], young: 1000, poisson: 0.3}
  - roller: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.8, 1], angles: [60, 210], extent: [0, 0.2],
             cells: [1, 40, 1], material: rigid}
contact:
  - touch: {mortar: roller.outer, nonmortar: block.zmax, friction: 0.3}
""" + ROLLS % (7, "block.ymin, block.ymax", "face: block.zmin", "roller", "roller", WAY / 6, "roller")
# An elastic tyre on a rigid hub, and rigid ground
WHEEL = """problem: wheel
bodies:
  - ground: {lower: [-0.5, 0, -0.5], upper: [2.2, 0.2, 0], cells: [27, 1, 1], material: rigid}
  - tyre: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.6, 1], angles: [50, 210], extent: [0, 0.2],
           cells: [2, 48, 1], material: neohookean, young: 1000, poisson: 0.3}
  - hub: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.5, 0.6], angles: [50, 210], extent: [0, 0.2],
          cells: [1, 48, 1], material: rigid}
ties:
  - glue: {mortar: hub.outer, nonmortar: tyre.inner}
contact:
  - touch: {mortar: ground.zmax, nonmortar: tyre.outer, friction: 0.3}
""" + ROLLS % (10, "tyre.lmin, tyre.lmax", "body: ground", "hub", "hub", WAY / 9, "hub")
# Euler's elastica under an end moment is an arc: angle M L / E I, here 90 degrees
MOMENT = 1000 * 0.5**3 / 12 * (math.pi / 2) / 10
BEND = """problem: bend
bodies:
  - bar: {lower: [0, 0, -0.25], upper: [10, 1, 0.25], cells: [16, 1, 1], material: saint_venant, young: 1000,
          poisson: 0, order: 2}
  - plate: {lower: [10, 0, -0.5], upper: [10.5, 1, 0.5], cells: [1, 1, 2], material: rigid}
load: {steps: 4}
displacements:
  - foot: {face: bar.xmin, value: [0, 0, 0]}
  - guide: {body: plate, value: [free, 0, free], rotation: [0, free, 0], center: [10, 0.5, 0]}
forces:
  - twist: {body: plate, value: [0, 0, 0], moment: [0, %r, 0]}
ties:
  - glue: {mortar: plate.xmin, nonmortar: bar.xmax}
""" % MOMENT
# An elastic tube that rolls between two rigid plates
TUBE = """problem: tube
bodies:
  - low: {lower: [-3, 0, -1.5], upper: [3, 1, -1], cells: [1, 1, 1], material: rigid}
  - top: {lower: [-3, 0, 1], upper: [3, 1, 1.5], cells: [1, 1, 1], material: rigid}
  - tube: {shape: tube_arc, axis: y, radii: [0.3, 1], angles: [4, 364], extent: [0, 1], cells: [3, 32, 1],
           material: neohookean, young: 100, poisson: 0.3}
load: {steps: 7}
ramps:
  - press: {expression: 1}
  - along: {expression: t - 1}
displacements:
  - lift: {body: low, value: [0, 0, 0.02], ramp: press}
  - push: {body: top, value: [0, 0, -0.02], ramp: press}
  - pull: {body: top, value: [0.2, 0, 0], ramp: along}
symmetry: [tube.lmin, tube.lmax]
contact:
  - a: {mortar: low.zmax, nonmortar: tube.outer, friction: 0.5}
  - b: {mortar: top.zmin, nonmortar: tube.outer, friction: 0.5}
"""
SCENES = {"roller": ROLLER, "wheel": WHEEL, "tube": TUBE, "bend": BEND}


def body(step, name):
    return next(b for b in step["rigid_bodies"] if b["name"] == name)


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for name, rolls in ("roller", "roller"), ("wheel", "hub"), ("roller_3", "roller"):
        if not os.path.exists(name + ".json"):
            continue  # the expected output says which must be there
        run = load(name)
        steps = run["steps"]
        last, title = body(steps[-1], rolls), name + ": "
        say(title + "all load steps converge", run["converged"] and not run["warnings"],
            (run["reason"], run["warnings"]))
        sizes = [abs(step["pairs"][0]["force"][0]) for step in steps]
        say(title + "a free roller carries no tangential force, below 1 % of what friction could",
            max(sizes) < 0.01 * 0.3, sizes)
        say(
            title + "the centre moves by the angle times the radius, to 1 % of a quarter of a turn",
            within(last["position"][0], math.radians(last["rotation"][1]), 0.01)
            and within(last["position"][0], WAY, 1e-6), last)
        say(title + "nothing is dissipated, and the work is balanced",
            max(step["imbalance"] for step in steps) < 0.01 and abs(steps[-1]["dissipated"]) < 1e-3 * WAY * 0.3,
            [step["imbalance"] for step in steps])
    run = load("tube")
    cuts = [step["cuts"] for step in run["steps"]]
    say("tube: all load steps converge, and after the first rolling one at most one is cut", run["converged"]
        and sum(cuts[2:]) <= 1, (run["reason"], cuts))
    end, bent = load("bend")["steps"][-1], math.pi / 2
    plate = body(end, "plate")
    say(
        "bend: a quarter of a circle",
        within(plate["rotation"][1], 90, 5e-3) and within(plate["position"][0], 10 / bent, 5e-3)
        and within(plate["position"][2], -10 / bent, 5e-3), plate)
    say("bend: energy half of moment times angle",
        within(end["energy"], MOMENT * bent / 2, 1e-2) and within(end["work"], end["energy"], 1e-2),
        (end["energy"], end["work"]))
    with open("bend.csv") as file:
        row = list(csv.DictReader(file))[-1]
    say(
        "bend: place and rotation are in the history",
        within(float(row["plate.rotation_y"]), plate["rotation"][1], 1e-9)
        and within(float(row["plate.position_z"]), plate["position"][2], 1e-9), row)
