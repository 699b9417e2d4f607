"""gap_scenes.py write: scenes whose updates of the gap went in circles, or took many; judge: what the runs of
gap_scenes.sh say."""
import sys

import gap_cycle
from summaries import each, load, say

TUBES = """bodies:
  - inner: {{shape: tube_arc, axis: z, radii: [15, 25.015], angles: [0, 90], extent: [0, 2], cells: [3, {0}, 1],
            young: 210000, poisson: 0.3}}
  - outer: {{shape: tube_arc, axis: z, radii: [24.985, 40], angles: [0, 90], extent: [0, 2], cells: [3, {1}, 1],
            young: 210000, poisson: 0.3}}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {{{2}: outer.inner, {3}: inner.outer, interference: true}}
"""
CROSS = """bodies:
  - low: {{shape: tube_arc, axis: y, center: [0, 0, -2], radii: [0.8, 2], angles: [-40, 40], extent: [-2, 2],
          cells: [3, 10, 10], young: 1000, poisson: 0.3, material: {0}}}
  - up: {{shape: tube_arc, axis: x, center: [0, 0, 2], radii: [0.8, 2], angles: [230, 310], extent: [-2.2, 2.2],
         cells: [3, 9, 11], young: {1}, poisson: 0.3, material: {0}}}
displacements:
  - bottom: {{face: low.inner, value: [0, 0, 0]}}
  - top: {{face: up.inner, value: [0, 0, {2}]}}
contact:
  - pair: {{{3}: low.outer, {4}: up.outer}}
load: {{steps: 2}}
"""
EDGE = """bodies:
  - cylinder: {{shape: tube_arc, axis: y, center: [0, 0, -2], radii: [0.8, 2], angles: [-60, 60], extent: [-1, 1],
               cells: [4, 16, 4], young: 1000, poisson: 0.3}}
  - block: {{lower: [0.2, -1.3, 0], upper: [1.5, 1.3, 1], cells: [5, 5, 4], young: 10000, poisson: 0.3}}
displacements:
  - bottom: {{face: cylinder.inner, value: [0, 0, 0]}}
  - top: {{face: block.zmax, value: [0, 0, -0.3]}}
contact:
  - below: {{{0}: cylinder.outer, {1}: block.zmin}}
load: {{steps: 2}}
"""
CORNER = """bodies:
  - ball: {shape: ball, octant: [-1, -1, -1], radius: 1, patches: [4, 4, 4], layers: 2, young: 1000, poisson: 0.3}
  - floor: {lower: [-1.5, -1.5, -1.4], upper: [0.3, 0.3, -0.98], cells: [6, 6, 2], young: 3000, poisson: 0.3}
  - wall: {lower: [-1.4, -1.5, -0.98], upper: [-0.97, 0.3, 0.3], cells: [2, 6, 5], young: 3000, poisson: 0.3}
  - side: {lower: [-0.97, -1.4, -0.98], upper: [0.3, -0.97, 0.3], cells: [5, 2, 5], young: 3000, poisson: 0.3}
displacements:
  - floor: {face: floor.zmin, value: [0, 0, 0]}
  - wall: {face: wall.xmin, value: [0, 0, 0]}
  - side: {face: side.ymin, value: [0, 0, 0]}
  - x: {face: ball.x0, value: [0, free, free]}
  - y: {face: ball.y0, value: [free, 0, free]}
  - z: {face: ball.z0, value: [free, free, -0.03]}
contact:
  - floor: {mortar: floor.zmax, nonmortar: ball.surface, interference: true}
  - wall: {mortar: wall.xmax, nonmortar: ball.surface, interference: true}
  - side: {mortar: side.ymax, nonmortar: ball.surface, interference: true}
"""
CUP = """bodies:
  - ball: {shape: sphere_shell, octant: [1, 1, -1], inner_radius: 0.4, outer_radius: 1, patches: [3, 3, 3], layers: 2,
           young: 1000, poisson: 0.3}
  - cup: {shape: sphere_shell, octant: [1, 1, -1], inner_radius: 1.02, outer_radius: 1.6, patches: [5, 5, 5], layers: 2,
          young: 1000, poisson: 0.3}
displacements:
  - rim: {face: cup.outer, value: [0, 0, 0]}
  - push: {face: ball.inner, value: [0, 0, -0.06]}
symmetry: [ball.x0, ball.y0, cup.x0, cup.y0]
contact:
  - pair: {mortar: cup.inner, nonmortar: ball.outer}
"""
PIN = """bodies:
  - hole: {shape: tube_arc, axis: y, radii: [10, 16], angles: [80, 280], extent: [0, 1], cells: [6, 40, 1], young: 1000,
           poisson: 0.3}
  - pin: {shape: tube_arc, axis: y, radii: [4.8, 9.8], angles: [90, 270], extent: [0, 1], cells: [6, 36, 1],
          young: 1000, poisson: 0.3}
displacements:
  - rim: {face: hole.outer, value: [0, 0, 0]}
  - down: {face: pin.inner, value: [-0.105, 0, -0.227]}
symmetry: [hole.lmin, hole.lmax, pin.lmin, pin.lmax]
contact:
  - pair: {mortar: pin.outer, nonmortar: hole.inner}
"""
SIDES = ("mortar", "nonmortar")


def swap(scene):
    return scene.replace("nonmortar", "?").replace("mortar", "nonmortar").replace("?", "mortar")


def scenes():
    """Name, scene, linearizations that a load step may take, largest displacement"""
    yield "ring", gap_cycle.SCENE, 8, 4
    yield "ring swapped", swap(gap_cycle.SCENE), 14, 4
    yield "coarse in fine", TUBES.format(4, 24, *SIDES), 4, 0.03
    yield "coarse in fine, swapped", swap(TUBES.format(4, 24, *SIDES)), 5, 0.03
    yield "fine in coarse", TUBES.format(24, 4, *SIDES), 5, 0.03
    yield "crossed", CROSS.format("linear", 1000, -0.15, *SIDES), 6, 0.15
    yield "crossed, one hard", CROSS.format("linear", 1e6, -0.15, *SIDES[::-1]), 6, 0.15
    yield "crossed, finite strain", CROSS.format("neohookean", 1000, -0.4, *SIDES), 8, 0.4
    yield "edge", EDGE.format(*SIDES), 12, 0.3
    yield "edge, swapped", EDGE.format(*SIDES[::-1]), 16, 0.3
    yield "ball in a corner", CORNER, 6, 0.05
    yield "ball in a cup", CUP, 6, 0.06
    yield "pin", PIN, 5, 0.25


def write():
    gap_cycle.write(16)
    for name, scene, _, _ in scenes():
        with open(name.replace(",", "").replace(" ", "_") + ".yaml", "w") as file:
            file.write(scene)
        print(name.replace(",", "").replace(" ", "_"))


def judge():
    for name, _, limit, size in scenes():
        run = load(name.replace(",", "").replace(" ", "_"))
        good = run["exit_code"] == 0 and not any(each(run, "gap_unconverged")) and not sum(each(run, "cuts"))
        say("%s: a true gap in every step, none cut, after %d linearizations at most" % (name, limit), good
            and max(each(run, "contact_updates")) <= limit, (run["reason"], each(run, "contact_updates")))
        say(name + ": nothing goes through more than 1e-5 of the largest displacement", good
            and max(each(run, "gap_change")) <= 1e-5 * size and min(each(run, "gap_true")) >= -1e-5 * size,
            each(run, "gap_true"))
        say(name + ": each body in balance to 1e-8", max(each(run, "balance")) <= 1e-8, each(run, "balance"))


if __name__ == "__main__":
    {"write": write, "judge": judge}[sys.argv[1]]()
