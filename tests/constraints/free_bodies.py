"""Scenes for free_bodies.sh, and their answers: python free_bodies.py write|judge."""
import math
import sys

from summaries import load, say, within

# A beam clamped on a whole face, above a plane, with a force on its tip
BEAM = """bodies:
  - beam: {lower: [0, 0, 0], upper: [%d, 5, 2], cells: [%d, 2, 1], young: 2.1e5, poisson: 0, element: incompatible}
  - plane: {shape: rigid_plane, point: [0, 0, -0.5], normal: [0, 0, 1]}
displacements:
  - clamp: {face: beam.xmin, value: [0, 0, 0]}
  - ground: {body: plane, value: [0, 0, 0]}
forces: [tip: {face: beam.xmax, value: [0, 0, %g]}]
contact: [touch: {mortar: plane.surface, nonmortar: beam.zmin}]
probes: [tip: {point: [%d, 2.5, 0]}]
"""
# Two leaves, clamped at one end, on one another
LEAVES = """bodies:
  - low: {lower: [0, 0, 0], upper: [100, 5, 1], cells: [40, 1, 1], young: 2.1e5, poisson: 0, element: incompatible}
  - high: {lower: [0, 0, 1], upper: [100, 5, 2], cells: [40, 1, 1], young: 2.1e5, poisson: 0, element: incompatible}
displacements:
  - low: {face: low.xmin, value: [0, 0, 0]}
  - high: {face: high.xmin, value: [0, 0, 0]}
forces: [tip: {face: high.xmax, value: [0, 0, -1]}]
contact: [between: {mortar: low.zmax, nonmortar: high.zmin}]
probes: [tip: {point: [100, 2.5, 0]}]
"""
# A lever, clamped at its foot, that a force pushes along the face of a block
LEVER = """bodies:
  - lever: {lower: [0, 0, 0], upper: [2, 2, 90], cells: [1, 1, 30], young: 2.1e5, poisson: 0, element: incompatible}
  - stop: {lower: [2, 0, 0], upper: [10, 2, 90], cells: [1, 1, 10], young: 2.1e5, poisson: 0}
displacements:
  - foot: {face: lever.zmin, value: [0, 0, 0]}
  - back: {face: stop.xmax, value: [0, 0, 0]}
forces: [push: {face: lever.zmax, value: [0, 0.5, 0]}]
contact: [face: {mortar: stop.xmin, nonmortar: lever.xmax}]
probes: [tip: {point: [2, 2, 90]}]
"""

# A bracket that a bolt clamps on a base, and that a force pulls along its faces
BRACKET = """bodies:
  - base: {shape: holed_box, axis: z, lower: [-20, -20, -10], upper: [20, 20, 0], radius: 5, cells: [4, 4, 2],
           young: 2.1e5, poisson: 0.3}
  - bracket: {shape: holed_box, axis: z, lower: [-20, -20, 0], upper: [20, 20, 10], radius: 5, cells: [4, 4, 2],
              young: 2.1e5, poisson: 0.3}
  - head: {shape: tube_arc, axis: z, radii: [3, 8], angles: [0, 360], extent: [10, 15], cells: [2, 16, 2],
           young: 2.1e5, poisson: 0.3}
  - shank: {shape: tube_arc, axis: z, radii: [1, 4], angles: [0, 360], extent: [-10, 15], cells: [2, 16, 10],
            young: 2.1e5, poisson: 0.3}
displacements:
  - foot: {face: base.zmin, value: [0, 0, 0]}
  - bolt: {face: shank.lmin, value: [0, 0, 0]}
ties: [nut: {mortar: shank.outer, nonmortar: head.inner, distance: 2}]
bolts: [m8: {body: shank, point: [0, 0, 5], axis: [0, 0, 1], force: 10000}]
forces: [pull: {face: bracket.xmax, value: [500, 0, 0]}]
contact:
  - low: {mortar: base.zmax, nonmortar: bracket.zmin}
  - high: {mortar: bracket.zmax, nonmortar: head.lmin}
weak_springs: true
"""

# A log of n facets on two others, which are held, without friction
LOG = "  - %s: {shape: tube_arc, axis: y, center: [%g, 0, %.17g], radii: [0.3, 1], angles: [0, 360], extent: [0, 1], " \
      "cells: [2, %d, 1], young: 1e5, poisson: 0.3}\n"
LOGS = """displacements:
  - left: {face: left.inner, value: [0, 0, 0]}
  - right: {face: right.inner, value: [0, 0, 0]}
  - top: {face: top.lmin, value: [free, 0, free]}
body_forces: [weight: {body: top, value: [0, 0, -1]}]
contact:
  - left: {mortar: %s.outer, nonmortar: %s.outer}
  - right: {mortar: %s.outer, nonmortar: %s.outer}
"""


def logs(n, swapped):
    pairs = [part for side in ("left", "right") for part in ((side, "top") if not swapped else ("top", side))]
    held = LOG % ("left", -1, 0, n) + LOG % ("right", 1, 0, n)
    return "bodies:\n" + held + LOG % ("top", 0, 3**0.5, n) + LOGS % tuple(pairs)


# A strip between two planes that press it and leave it: nothing then holds it along z
SPRINGBACK = """bodies:
  - strip: {lower: [0, 0, 0], upper: [4, 2, 0.5], cells: [8, 4, 2], young: 2.1e5, poisson: 0.3, material: %s}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - lid: {shape: rigid_plane, point: [0, 0, 0.5], normal: [0, 0, -1]}
symmetry: [strip.xmin, strip.ymin]
displacements:
  - floor: {body: floor, value: [0, 0, -1], ramp: floor}
  - lid: {body: lid, value: [0, 0, 1], ramp: lid}
contact:
  - low: {mortar: floor.surface, nonmortar: strip.zmin}
  - high: {mortar: lid.surface, nonmortar: strip.zmax}
probes: [corner: {point: [4, 2, 0.5]}]
ramps: [floor: {factors: [0, 1]}, lid: {factors: [-0.01, 2]}]
load: {steps: 2}
"""

FACETS = 20, 24, 32
SCENES = {
    **{f"springback_{law}": SPRINGBACK % law
       for law in ("linear", "neohookean")},
    **{f"logs_{n}{end}": logs(n, bool(end))
       for n in FACETS for end in ("", "_swapped")}, "bracket": BRACKET, "cantilever_60": BEAM % (60, 30, -2, 60),
    "cantilever_100": BEAM % (100, 50, -0.9, 100), "pressed": BEAM % (100, 50, -4, 100), "leaf": LEAVES, "lever": LEVER
}

if sys.argv[1] == "write":
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
    sys.exit()


def step(name):
    return load(name)["steps"][-1]


def tip(name, component):
    return step(name)["probes"][0]["displacement"][component]


def near(what, seen, exact, tolerance):
    say(what, within(seen, exact, tolerance), (seen, exact))


# force x length^3 / (3 E I)
for name, force, length in ("60_1", -2, 60), ("100_1", -0.9, 100), ("100_3", -0.9, 100):
    near(f"cantilever_{name}: the deflection of a beam within 0.5 %", tip("cantilever_" + name, 2),
         force * length**3 / 2.1e6, 5e-3)
near("leaf: the deflection of two beams within 1 %", tip("leaf_1", 2), -1 * 100**3 / (3 * 2.1e5 * 2 * 5 / 12), 1e-2)
near("lever: the deflection of a beam within 1 %", tip("lever_1", 1), 0.5 * 90**3 / (3 * 2.1e5 * 2 * 8 / 12), 1e-2)
carried = step("pressed_1")["weak_spring_force"]
say("pressed: no weak springs", carried == 0, carried)
for n in FACETS:
    for end in "", "_swapped":
        # the weight; each normal force is weight/(2 cos 30 degrees), but the facets bear at their vertices
        weight = n / 2 * math.sin(2 * math.pi / n) * (1 - 0.3**2)
        pairs = step(f"logs_{n}{end}_1")["pairs"]
        carried = sum(abs(pair["force"][2]) for pair in pairs)
        near(f"logs_{n}{end}: the two forces carry the weight within 0.1 %", carried, weight, 1e-3)
        for pair in pairs:
            near(f"logs_{n}{end}, {pair['name']}: the force of round logs within 7 %", pair["normal_force"],
                 weight / 3**0.5, 0.07)
for law in "linear", "neohookean":
    for n in 1, 3:
        corner = tip(f"springback_{law}_{n}", 2)
        near(f"springback_{law}, {n} ranks: the strip expands about its middle", corner, -0.005, 1e-9)
