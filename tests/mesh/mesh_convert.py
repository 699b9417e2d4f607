"""Meshes for mesh_convert.sh in the formats of other programs, and what contact-mesh makes of them: python
mesh_convert.py write|judge.

A block of 1 x 1 x 2, two volumes of unlike stiffness one upon the other. Decks are written by hand, the rest by meshio.
"""
import sys

import meshio
import netCDF4
import numpy as np

from summaries import load, say

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
HEXAHEDRON = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
TETRAHEDRON = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
ABAQUS_SIDES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
WEDGES = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
KINDS = {
    "hexahedron": "C3D8", "hexahedron20": "C3D20R", "hexahedron27": "C3D27", "tetra": "C3D4", "tetra10": "C3D10",
    "wedge": "C3D6"
}


def block(kind):
    """Points of the grid of quarters, used ones alone, and cells whose lower half comes first"""
    number, points = {}, []

    def node(x):
        key = tuple(np.round(8 * x).astype(int))
        if key not in number:
            number[key] = len(points)
            points.append(x)
        return number[key]

    cells = []
    for k, j, i in np.ndindex(4, 2, 2):
        corner = (CORNERS + (i, j, k)) / 2.0
        parts = TETRAHEDRA if kind.startswith("tetra") else WEDGES if kind == "wedge" else (range(8), )
        for part in parts:
            x = corner[list(part)]
            edges = {"hexahedron20": HEXAHEDRON, "hexahedron27": HEXAHEDRON, "tetra10": TETRAHEDRON}.get(kind, ())
            nodes = [*x, *(x[[a, b]].mean(axis=0) for a, b in edges)]
            if kind == "hexahedron27":
                nodes += [x.mean(axis=0), *(x[list(side)].mean(axis=0) for side in ABAQUS_SIDES)]
            cells.append([node(place) for place in nodes])
    return np.array(points), np.array(cells)


def deck(name, kind):
    """Numbers that begin at 101 and 1001, a set by generate, a set of nodes, a surface of sides of an element set"""
    points, cells = block(kind)
    with open(f"{name}.inp", "w") as file:
        file.write("** a comment\n*Heading\n two blocks\n*NODE, NSET=Nall\n")
        for number, x in enumerate(points, 101):
            file.write(f"{number}, {x[0]}, {x[1]}, {x[2]}\n")
        file.write(f"*Element, type={KINDS[kind]}\n")
        for number, cell in enumerate(cells, 1001):
            words = [str(number), *map(str, cell + 101)]
            file.write(",\n".join(", ".join(words[i:i + 16]) for i in range(0, len(words), 16)) + "\n")
        half = len(cells) // 2
        file.write(f"*Elset, elset=lower, generate\n1001, {1000 + half}, 1\n*ELSET, ELSET=upper\n")
        numbers = [str(1001 + row) for row in range(half, len(cells))]
        file.write("".join(", ".join(numbers[i:i + 10]) + ",\n" for i in range(0, len(numbers), 10)))
        if kind.startswith("hexahedron"):
            file.write(f"*ELSET, ELSET=last, GENERATE\n{1001 + len(cells) - 4}, {1000 + len(cells)}\n"
                       f"*SURFACE, NAME=top, TYPE=ELEMENT\nlast, S2\n")
        else:
            file.write("*NSET, NSET=top\n" + "".join(f"{101 + node}\n" for node in np.flatnonzero(points[:, 2] == 2)))
        file.write("*NSET, NSET=bottom\n" + "".join(f"{101 + node}\n" for node in np.flatnonzero(points[:, 2] == 0)))
        file.write("*NSET, NSET=joint\n" + "".join(f"{101 + node}\n" for node in np.flatnonzero(points[:, 2] == 1)))
        file.write("*NSET, NSET=one\n101\n*STEP\n*STATIC\n*END STEP\n")


def others(kind):
    points, cells = block(kind)
    half = len(cells) // 2
    ends = {
        name: [
            tuple(side)
            for cell in cells
            for side in (cell[[0, 3, 2, 1]], cell[[4, 5, 6, 7]])
            if np.all(points[list(side), 2] == z)
        ][:4]
        for name, z in (("bottom", 0), ("top", 2), ("joint", 1))
    }
    parts = [(kind, cells[:half]), (kind, cells[half:])] + [("quad", np.array(ends[name])) for name in ends]
    numbers = [np.full(len(part), tag, np.int32) for tag, (_, part) in enumerate(parts, 1)]
    meshio.write("cells.vtu", meshio.Mesh(points, parts[:2], cell_data={"part": numbers[:2]}))
    med = meshio.Mesh(points, [("hexahedron", cells[:, [4, 5, 6, 7, 0, 1, 2, 3]]),
                               ("quad", np.concatenate([part for _, part in parts[2:]]))],
                      cell_data={"cell_tags": [np.repeat([-1, -2], half),
                                               np.repeat([-3, -4, -5], 4)]})
    med.cell_tags = {-1: ["lower"], -2: ["upper"], -3: ["bottom"], -4: ["top"], -5: ["joint"]}
    med.point_tags = {}
    meshio.write("turned.med", med)
    meshio.write(
        "blocks.e",
        meshio.Mesh(
            points, parts[:2],
            point_sets={"bottom": np.flatnonzero(points[:, 2] == 0), "joint": np.flatnonzero(points[:, 2] == 1)}))
    with netCDF4.Dataset("blocks.e", "a") as file:
        for dimension, size in (("num_side_sets", 1), ("num_side_ss1", len(ends["top"])), ("len_name", 33)):
            if dimension not in file.dimensions:
                file.createDimension(dimension, size)
        for variable, names in (("eb_names", ("lower", "upper")), ("ss_names", ("top", ))):
            table = file.createVariable(variable, "S1",
                                        ("num_el_blk" if variable == "eb_names" else "num_side_sets", "len_name"))
            for row, name in enumerate(names):
                table[row, :len(name)] = [letter.encode() for letter in name]
        file.createVariable("elem_ss1", "i4", ("num_side_ss1", ))[:] = np.arange(len(cells) - 3, len(cells) + 1)
        file.createVariable("side_ss1", "i4", ("num_side_ss1", ))[:] = 6


SCENE = """problem: blocks
bodies:
  - lower: {{mesh: {file}, volume: {lower}, young: 1000, poisson: 0.3, scale: {scale}}}
  - upper: {{mesh: {file}, volume: {upper}, young: 100, poisson: 0.3, scale: {scale}}}
displacements:
  - ground: {{face: lower.bottom, value: [0, 0, 0]}}
  - press: {{face: upper.top, value: [0, 0, {press}]}}
ties:
  - joint: {{mortar: lower.joint, nonmortar: upper.joint}}
"""


def scene(name, file, scale=1.0):
    with open(name + ".yaml", "w") as out:
        out.write(SCENE.format(file=file, lower="lower", upper="upper", scale=scale, press=-0.01 * scale))


def write():
    for kind in KINDS:
        deck(kind, kind)
        scene(kind, kind + ".inp")
    others("hexahedron")
    scene("med", "turned.med")
    scene("exodus", "blocks.e")
    scene("gmsh", "back.msh")
    scene("deck", "back.inp")
    scene("scaled", "hexahedron.inp", 1000.0)


def judge():
    energies = {name: load(name)["steps"][-1]["energy"] for name in sys.argv[2:]}
    for name, energy in energies.items():
        energy /= 1e9 if name == "scaled" else 1
        limit = 0.05 if name in KINDS else 1e-9
        if abs(energy / energies["hexahedron"] - 1) > limit:
            say(f"{name}: energy {energy}, that of hexahedra {energies['hexahedron']}")
    print(len(energies), "scenes compared")


TOUCHING = """problem: touching
bodies:
  - lower: {{mesh: touching.inp, volume: {lower}, young: 1000, poisson: 0}}
{upper}displacements:
  - ground: {{face: lower.bottom, value: [0, 0, 0]}}
pressures:
  - load: {{face: {top}, value: 10}}
{contact}"""


def touching():
    """Two cubes of one element set whose nodes at z = 1 coincide, listed upper cell first. Under a pressure of 10, with
    E = 1000 and no lateral strain, each stores 10^2 / (2 E) = 0.05"""
    with open("touching.inp", "w") as file:
        file.write("*NODE\n")
        for number, x in enumerate([*CORNERS, *(CORNERS + (0, 0, 1))], 1):
            file.write(f"{number}, {x[0]}, {x[1]}, {x[2]}\n")
        file.write("*ELEMENT, TYPE=C3D8, ELSET=all\n2, 9, 10, 11, 12, 13, 14, 15, 16\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
                   "*SURFACE, NAME=bottom\n1, S1\n*SURFACE, NAME=top\n2, S2\n"
                   "*SURFACE, NAME=under\n1, S2\n*SURFACE, NAME=over\n2, S1\n")
    upper = "  - upper: {mesh: touching.inp, volume: all.part_1, young: 1000, poisson: 0}\n"
    contact = "contact:\n  - touch: {mortar: lower.under, nonmortar: upper.over, stick: true}\n"
    for name, text in (("touching", TOUCHING.format(lower="all.part_2", upper=upper, top="upper.top", contact=contact)),
                       ("whole", TOUCHING.format(lower="all", upper="", top="lower.top", contact=""))):
        with open(name + ".yaml", "w") as out:
            out.write(text)


def pressed():
    energy = load("touching")["steps"][-1]["energy"]
    say("two cubes in contact: energy 0.1", abs(energy - 0.1) < 1e-6, energy)


if __name__ == "__main__":
    {"write": write, "judge": judge, "touching": touching, "pressed": pressed}[sys.argv[1]]()
