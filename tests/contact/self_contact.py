"""Bodies in contact with themselves: self_contact.py write makes meshes and scenes, judge and
long check the results.

The slit of width 0 in a block under uniaxial pressure must change nothing. The jaws of the clamp are one face in
contact with itself, or two named faces of an ordinary pair, or the clamp's whole surface.
"""
import sys

import h5py
import numpy as np

import hexahedra
from summaries import load, say

SLIT = """problem: slit
bodies:
  - block: {shape: gmsh, mesh: slit.msh, volume: body, young: 1, poisson: 0.3}
displacements:
  - floor: {face: block.zmin, value: [free, free, 0]}
  - x: {face: block.xmin, value: [0, free, free]}
  - y: {face: block.ymin, value: [free, 0, free]}
  - press: {face: block.zmax, value: [free, free, -0.04]}
contact:
  - slit: {SIDES}
load: {steps: 1}
"""
CLAMP = """problem: clamp
bodies:
  - clamp: {shape: gmsh, mesh: clamp.msh, volume: body, material: neohookean, young: 1, poisson: 0.3BODY}
displacements:
  - floor: {face: clamp.zmin, value: [0, 0, 0]}
  - y: {face: clamp.ymin, value: [free, 0, free]}
  - press: {face: clamp.zmax, value: [0.1, free, -0.6]}
contact:
  - jaws: {SIDES}
load: {steps: 2}
"""
NAMED = "mortar: clamp.upper, nonmortar: clamp.lower"
CLAMPS = {
    "jaws": ("self: clamp.inner", ""),
    "named": (NAMED, ""),
    "whole": ("self: clamp", ""),
    "jaws_friction": ("self: clamp.inner, friction: 0.3", ""),
    "named_friction": (NAMED + ", friction: 0.3", ""),
    "jaws_order2": ("self: clamp.inner, gap: dual", ", order: 2"),
    "named_order2": (NAMED + ", gap: dual", ", order: 2"),
}

BELLOWS_SCENE = """problem: bellows
bodies:
  - bellows: {shape: gmsh, mesh: bellows.msh, volume: body, material: neohookean, young: 1, poisson: 0.3}
displacements:
  - floor: {face: bellows.zmin, value: [0, 0, 0]}
  - press: {face: bellows.zmax, value: [0, 0, -0.5]}
  - near: {face: bellows.ymin, value: [free, 0, free]}
  - far: {face: bellows.ymax, value: [free, 0, free]}
contact:
PAIRS
load: {steps: 4}
"""
BELLOWS = {
    "bellows": "  - folds: {self: bellows, distance: 1.5}",
    "bellows_named": ("  - first: {mortar: bellows.upper_1, nonmortar: bellows.lower_1}\n"
                      "  - second: {mortar: bellows.upper_2, nonmortar: bellows.lower_2}"),
}


def write_slit():
    """The vertices of the slit's upper face are not above those of the lower one"""
    size = (6, 2, 4)
    points, cells, places = hexahedra.grid(size, doubled=lambda i, j, k, cell: int(k == 2 and 1 < i < 5 and cell == 2))
    faces = hexahedra.outer_faces(cells, places, size, "slit")
    upper = {
        v
        for cell, place in zip(cells, places) if place[2] == 2 for v in cell
        if points[v][2] == 2 and 1 < points[v][0] < 5
    }
    points = [[x + 0.3 * (v in upper), y, z] for v, (x, y, z) in enumerate(points)]
    hexahedra.write("slit.msh", points, cells, faces)


def write_clamp():
    """A U on its side: two legs, joined at one end"""
    size, heights = (6, 1, 5), [0, 0.5, 1.0, 1.3, 1.8, 2.3]
    points, cells, places = hexahedra.grid(size, keep=lambda i, j, k: k != 2 or i < 1)
    faces = hexahedra.outer_faces(cells, places, size, "inner")
    for name, k in (("lower", 2), ("upper", 3)):
        faces[name] = [quad for quad in faces["inner"] if all(points[v][2] == k for v in quad)]
    hexahedra.write("clamp.msh", [[x, y, heights[z]] for x, y, z in points], cells, faces)


def write_bellows():
    """Three legs, joined at alternate ends, thinner than the search distance"""
    size, heights = (8, 1, 5), [0, 0.4, 0.6, 1.0, 1.2, 1.6]
    points, cells, places = hexahedra.grid(size, keep=lambda i, j, k: k % 2 == 0 or (i < 1 if k == 1 else i > 6))
    faces = hexahedra.outer_faces(cells, places, size, "inner")
    for name, k in (("lower_1", 1), ("upper_1", 2), ("lower_2", 3), ("upper_2", 4)):
        faces[name] = [quad for quad in faces["inner"] if all(points[v][2] == k for v in quad)]
    hexahedra.write("bellows.msh", [[0.5 * x, 0.5 * y, heights[z]] for x, y, z in points], cells, faces)


def write():
    write_slit()
    write_clamp()
    write_bellows()
    for name, sides in BELLOWS.items():
        with open(name + ".yaml", "w") as file:
            file.write(BELLOWS_SCENE.replace("PAIRS", sides))
    for name, sides in (("slit_face", "self: block.slit"), ("slit_body", "self: block")):
        with open(name + ".yaml", "w") as file:
            file.write(SLIT.replace("SIDES", sides))
    for name, (sides, body) in CLAMPS.items():
        with open(name + ".yaml", "w") as file:
            file.write(CLAMP.replace("SIDES", sides).replace("BODY", body))


def judge_slit(name):
    with h5py.File(name + "_0001.h5") as file:
        error = np.abs(file["stress"][...] - [0, 0, 0, 0, 0, -0.01]).max()
    force = load(name)["steps"][0]["pairs"][0]["normal_force"]
    say(name + ": stress as without a slit, to 1e-12", error < 1e-12, error)
    say(name + ": force of 4 x 2 x 0.01, to 1e-8", abs(force / 0.08 - 1) < 1e-8, force)


def compare(name, other, first, last):
    """Energy, work and forces of two runs, in the first load step and in the last"""
    for step, tolerance in ((0, first), (-1, last)):
        one, two = load(name)["steps"][step], load(other)["steps"][step]
        force = two["pairs"][0]["normal_force"]
        differences = [(one[key] - two[key]) / two["work"] for key in ("energy", "work", "contact_work")]
        differences += [(one["pairs"][0][key] - two["pairs"][0][key]) / force
                        for key in ("normal_force", "shear_force")]
        differences += list(np.subtract(one["pairs"][0]["force"], two["pairs"][0]["force"]) / force)
        worst = np.abs(differences).max()
        say("%s and %s, step %d: energy and forces agree to %g" % (name, other, one["step"], tolerance),
            worst < tolerance, worst)


def judge_bellows():
    """Two folds, which are two ordinary pairs; the search distance reaches over both"""
    one, two = load("bellows")["steps"][-1], load("bellows_named")["steps"][-1]
    forces = [sum(p["normal_force"] for p in step["pairs"]) for step in (one, two)]
    errors = [one["energy"] / two["energy"] - 1, forces[0] / forces[1] - 1]
    say("bellows: both folds close, energy and force of two named pairs to 1 %",
        min(p["normal_force"] for p in two["pairs"]) > 0 and max(abs(e) for e in errors) < 1e-2, errors)


def judge_forces(name):
    """Action and reaction, and the balance of the body's forces"""
    step = load(name)["steps"][-1]
    pair = step["pairs"][0]
    size = np.linalg.norm(pair["force"])
    unbalanced = np.abs(np.add(pair["force"], pair["mortar_force"])).max() + np.abs(step["bodies"][0]["residual"]).max()
    say(name + ": action and reaction, to 1e-9", size > 0.1 and unbalanced < 1e-9 * size, (size, unbalanced))


def judge():
    judge_slit("slit_body")
    judge_slit("slit_body_3")
    compare("jaws", "named", 1e-8, 1e-3)  # in step 2 the bottom of the jaws, which is not named, takes part
    compare("whole_2", "named", 1e-2, 2e-3)
    judge_forces("whole_2")


def long():
    judge_slit("slit_face")
    judge_bellows()
    compare("whole_2", "whole", 1e-8, 1e-8)
    compare("whole_3", "whole", 1e-8, 1e-8)
    compare("jaws_friction", "named_friction", 1e-8, 1e-3)
    compare("jaws_friction_3", "jaws_friction", 1e-6, 1e-6)
    compare("jaws_order2", "named_order2", 1e-5, 1e-2)
    judge_forces("jaws_friction")
    judge_forces("jaws_order2")


{"write": write, "judge": judge, "long": long}[sys.argv[1]]()
