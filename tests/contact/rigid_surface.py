"""Rigid surfaces without facets: Hertz's sphere, Sneddon's cone, a plane that presses and is driven by a force, a
cylinder in rubber.

python3 rigid_surface.py scenes writes the scenes; python3 rigid_surface.py [exact] judges the runs.
"""
import math
import sys

from summaries import load, say, within

HALF_SPACE = """problem: {name}
bodies:
  - block: {{lower: [0, 0, -80], upper: [80, 80, 0], cells: [13, 13, 13], grading: [{grading}, {grading}, {inverse}],
      even: [5, 5, 5], young: 1000, poisson: 0.3, order: 2}}
  - tool: {{{tool}, material: rigid}}
displacements:
  - bottom: {{face: block.zmin, value: [0, 0, 0]}}
  - press: {{body: tool, value: [0, 0, {press}]}}
symmetry: [block.xmin, block.ymin]
contact:
  - touch: {{mortar: tool.surface, nonmortar: block.zmax, distance: 1}}
"""
FLAT = """problem: flat
bodies:
  - block: {{lower: [-1, -1, 0], upper: [1, 1, 1], cells: [6, 6, 3], young: 1000, poisson: 0}}
  - tool: {{shape: rigid_plane, point: [0.3, 0.2, 1], normal: [0, 0, -2], material: rigid}}
{rest}
contact:
  - touch: {{mortar: tool.surface, nonmortar: block.zmax}}
"""
DRIVEN = """problem: driven
bodies:
  - block: {lower: [-1, -1, 0], upper: [1, 1, 1], cells: [8, 8, 4], young: 1000, poisson: 0.3}
  - tool: {shape: rigid_plane, point: [0, 0, 1], normal: [0, 0, -1], material: rigid}
displacements:
  - bottom: {face: block.zmin, value: [0, 0, 0]}
  - guide: {body: tool, value: [0, 0, free], rotation: [0, free, 0], center: [0, 0, 1]}
forces:
  - load: {body: tool, value: [0, 0, -4], moment: [0, 0.4, 0], point: [0, 0, 1]}
contact:
  - touch: {mortar: tool.surface, nonmortar: block.zmax}
"""
# The cube that carries the plane's motion gives gaps of 1e-48 at the start
BESIDE = DRIVEN.replace("cells: [8, 8, 4], young: 1000, poisson: 0.3",
                        "cells: [6, 6, 3], young: 1000, poisson: 0").replace("point: [0, 0, 1]",
                                                                             "point: [0.3, 0.2, 1]").replace(
                                                                                 "center: [0, 0, 1]",
                                                                                 "center: [0.3, 0.2, 1]")
BOTTOM = ("displacements:\n  - bottom: {face: block.zmin, value: [free, free, 0]}\n"
          "  - pin: {point: [-1, -1, 0], body: block, value: [0, 0, 0]}\n"
          "  - line: {point: [1, -1, 0], body: block, value: [free, 0, 0]}\n")
RUBBER = """problem: rubber
bodies:
  - block: {{lower: [-1, 0, 0], upper: [1, 0.5, 1], cells: [16, 1, 8], material: neohookean, young: 1, poisson: 0.4,
      element: full, order: {order}}}
  - tool: {{{tool}, material: rigid}}
load_steps: 3
displacements:
  - bottom: {{face: block.zmin, value: [0, 0, 0]}}
  - press: {{body: tool, value: [0.1, 0, -0.3], rotation: [0, 30, 0], center: [0, 0, 1.5]}}
symmetry: [block.ymin, block.ymax]
contact:
  - touch: {{mortar: tool.{face}, nonmortar: block.zmax}}
"""
# A flat punch of radius 1 on a slice of a half-space, whose cells are graded towards the edge of the punch
PUNCH = """problem: punch
bodies:
  - inner: {{shape: tube_arc, axis: z, radii: [0.001, 1], angles: [0, 10], extent: [-1500, 0], cells: [12, 1, 22],
      grading: [{inward}, 1, {down}], young: 1000, poisson: 0.3, order: 2}}
  - outer: {{shape: tube_arc, axis: z, radii: [1, 1500], angles: [0, 10], extent: [-1500, 0], cells: [22, 1, 22],
      grading: [90000, 1, {down}], young: 1000, poisson: 0.3, order: 2}}
  - punch: {{shape: rigid_revolved, center: [0, 0, 0], direction: [0, 0, 1], points: [0, 0, 1, 0, 1, 1]}}
ties:
  - seam: {{mortar: inner.outer, nonmortar: outer.inner}}
displacements:
  - base: {{face: inner.lmin, value: [free, free, 0]}}
  - rest: {{face: outer.lmin, value: [free, free, 0]}}
  - press: {{body: punch, value: [0, 0, -0.001]}}
symmetry: [inner.amin, inner.amax, outer.amin, outer.amax]
contact:
  - under: {{mortar: punch.surface, nonmortar: inner.lmax}}
  - beside: {{mortar: punch.surface, nonmortar: outer.lmax}}
probes:
  - two: {{body: outer, point: [2, 0, 0]}}
"""
# The same plane as a profile of one line, and a corner of a profile beside the block
PROFILE = ("shape: rigid_extruded, center: [0, 0, 1.1], direction: [0, 3, 0], across: [-1, 0.5, 0], points: [-1.5, "
           "0, 1.5, 0, 1.5, 2], outside: 0.1")
RADIUS, APPROACH, ANGLE, CONTACT = 1000, 1e-4, 89.9, 0.316
DEPTH = CONTACT * math.pi / 2 / math.tan(math.radians(ANGLE))
MODULUS = 1000 / (1 - 0.3**2)


def grading():
    """The last of 13 cells over the first, five of which are 0.07 wide, on a length of 80."""
    low, high = 1.0, 10.0
    for _ in range(100):
        q = (low + high) / 2
        if 0.07 * (5 + sum(q**k for k in range(1, 9))) > 80:
            high = q
        else:
            low = q
    return q**8


SPHERE = f"shape: rigid_sphere, center: [0, 0, {RADIUS}], radius: {RADIUS}"
CONE = f"shape: rigid_cone, tip: [0, 0, 0], direction: [0, 0, 3], half_angle: {ANGLE}"
CYLINDER = "shape: rigid_cylinder, center: [0, 0, 1.5], direction: [0, 1, 0], radius: 0.5"
TUBE = ("shape: tube_arc, axis: y, center: [0, 0, 1.5], radii: [0.4, 0.5], angles: [110, 250], extent: [0, 0.5], "
        "cells: [1, 96, 1]")
SCENES = {
    "sphere": HALF_SPACE.format(name="sphere", tool=SPHERE, press=-APPROACH, grading=grading(), inverse=1 / grading()),
    "cone": HALF_SPACE.format(name="cone", tool=CONE, press=-DEPTH, grading=grading(), inverse=1 / grading()),
    "beside": BESIDE,
    "pressed": FLAT.format(rest=BOTTOM + "  - press: {body: tool, value: [0, 0, -0.01]}"),
    "driven": DRIVEN,
    "punch": PUNCH.format(inward=1 / 60, down=1 / 90000),
    "profile": FLAT.format(rest=BOTTOM + "  - press: {body: tool, value: [0, 0, -0.01]}").replace(
        "shape: rigid_plane, point: [0.3, 0.2, 1], normal: [0, 0, -2]", PROFILE),
    "rubber_1": RUBBER.format(order=1, tool=CYLINDER, face="surface"),
    "rubber_2": RUBBER.format(order=2, tool=CYLINDER, face="surface"),
    "rubber_mesh": RUBBER.format(order=1, tool=TUBE, face="outer"),
}


def pair(name):
    return load(name)["steps"][-1]["pairs"][0]


def same_on_three_ranks(order):
    one, three = (load(f"rubber_{order}{ranks}")["steps"][-1]["energy"] for ranks in ("", "_3"))
    say(f"cylinder in rubber, order {order}: the same on three ranks", within(three, one, 1e-8), (three, one))


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
elif sys.argv[1:] == ["exact"]:
    hertz = MODULUS * math.sqrt(RADIUS * APPROACH**3) / 3
    sneddon = MODULUS * math.tan(math.radians(ANGLE)) * DEPTH**2 / (2 * math.pi)
    for name, force, energy in ("sphere", hertz, 0.4 * hertz * APPROACH), ("cone", sneddon, sneddon * DEPTH / 3):
        seen = (-pair(name)["force"][2] / force - 1, load(name)["steps"][-1]["energy"] / energy - 1)
        say(f"{name}: force within 0.5 % of the closed form, energy within 0.2 %",
            abs(seen[0]) < 5e-3 and abs(seen[1]) < 2e-3, seen)
    same_on_three_ranks(2)
    punch = 2 * MODULUS * 1e-3 * 10 / 360
    seen = (-sum(one["force"][2] for one in load("punch")["steps"][-1]["pairs"]) / punch - 1,
            load("punch")["steps"][-1]["probes"][0]["displacement"][2] / (-2e-3 / math.pi * math.asin(0.5)) - 1)
    say("flat punch: force, and Boussinesq's surface beside it, within 0.3 %",
        abs(seen[0]) < 3e-3 and abs(seen[1]) < 3e-3, seen)
else:
    seen = pair("pressed")
    say("plane: uniform pressure of 10",
        within(seen["pressure"], 10, 1e-8) and within(-seen["force"][2], 40, 1e-8), seen)
    seen = pair("profile")
    say("a plane as a profile that is extruded: the same",
        within(seen["pressure"], 10, 1e-8) and within(-seen["force"][2], 40, 1e-8), seen)
    place = load("pressed")["steps"][-1]["rigid_bodies"][0]["position"]
    say("plane: its position is that of its point", all(abs(a - b) < 1e-12 for a, b in zip(place, (0.3, 0.2, 0.99))),
        place)
    seen = pair("driven")
    say("plane that a force and a moment drive: they are carried",
        within(-seen["force"][2], 4, 1e-8) and within(seen["moment"][1], 0.4, 5e-3), seen)
    seen = pair("beside")
    say("the same beside its middle", within(-seen["force"][2], 4, 1e-8), seen)
    mesh = load("rubber_mesh")["steps"][-1]
    for order in 1, 2:
        one = load(f"rubber_{order}")["steps"][-1]
        say(
            f"cylinder in rubber, order {order}: within 1 % of a cylinder with facets",
            within(one["pairs"][0]["force"][2], mesh["pairs"][0]["force"][2], 1e-2)
            and within(one["energy"], mesh["energy"], 5e-3), (one, mesh))
        say(f"cylinder in rubber, order {order}: no vertex is inside", one["pairs"][0]["penetration"] < 1e-8,
            one["pairs"])
        if order == 1:
            same_on_three_ranks(order)
