"""Meshes and scenes for gmsh_rings.sh, two thick rings that overlap, and their exact answer: python gmsh_rings.py
write|judge.

Quarters of rings as a mesh file has them: hexahedra with 8, 20 or 27 nodes, those of second order on the true circles
too. And cones, rings whose radii shrink along the axis, which have no closed form: coarse against fine.
"""
import sys

import h5py
import numpy as np

from summaries import load, say

YOUNG, POISSON, HEIGHT, OVERLAP = 1000, 0.3, 1, 0.03
RADII = {"inner": (20, 25.015), "outer": (24.985, 30)}
# cells; along the axis by the taper, change of radius over height
AROUND, ACROSS, ALONG = {"inner": 12, "outer": 15}, 2, {0: 1, -0.2: 2}

CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 1, 0), (2, 0, 1), (1, 2, 0), (2, 2, 1), (0, 2, 1), (1, 0, 2), (0, 1, 2),
         (2, 1, 2), (1, 2, 2)]
MIDDLES = [(1, 1, 0), (1, 0, 1), (0, 1, 1), (2, 1, 1), (1, 2, 1), (1, 1, 2), (1, 1, 1)]
HEXAHEDRA = {8: (5, CORNERS), 20: (17, CORNERS + EDGES), 27: (12, CORNERS + EDGES + MIDDLES)}
REFINED = {8: 1, 20: 2, 27: 1}
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
QUADRILATERALS = {8: (3, 4), 20: (16, 8), 27: (10, 9)}
SIDES = ("in", "out", "begin", "end", "low", "high")  # of the three directions: across, around, along


def ring(name, nodes, taper, number):
    """Elements of a ring: (type, physical tag, dimension, nodes); number: of a node by its place on the grid of half
    cells"""
    cells = (ACROSS, AROUND[name], ALONG[taper])
    volume = 1 + list(RADII).index(name)
    kind, places = HEXAHEDRA[nodes]
    at = lambda *place: number.setdefault((name, *place), len(number) + 1)
    for i, j, k in np.ndindex(*cells):
        yield kind, volume, 3, [at(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in places]
    kind, n = QUADRILATERALS[nodes]
    for side in range(6):
        d, end = divmod(side, 2)
        s, t = (d + 1) % 3, (d + 2) % 3
        for i, j in np.ndindex(cells[s], cells[t]):
            place = np.zeros((n, 3), int)
            place[:, d] = 2 * cells[d] * end
            place[:, [s, t]] = np.array(SQUARE[:n]) + (2 * i, 2 * j)
            yield kind, 10 * volume + side, 2, [at(*p) for p in place.tolist()]


def place(taper, name, i, j, k):
    height = HEIGHT * k / 2
    radius = RADII[name][0] + (RADII[name][1] - RADII[name][0]) * i / (2 * ACROSS) + taper * height
    angle = np.pi / 2 * j / (2 * AROUND[name])
    return radius * np.cos(angle), radius * np.sin(angle), height


def write_mesh(file, nodes, version, taper=0):
    number = {}
    elements = [element for name in RADII for element in ring(name, nodes, taper, number)]
    names = [(3, 1 + v, name) for v, name in enumerate(RADII)] + [(2, 10 * (1 + v) + f, name + "_" + side)
                                                                  for v, name in enumerate(RADII)
                                                                  for f, side in enumerate(SIDES)]
    lines = ["$MeshFormat", "%g 0 8" % version, "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += ['%d %d "%s"' % name for name in names] + ["$EndPhysicalNames"]
    nodes_at = ["%.16g %.16g %.16g" % place(taper, *p) for p in number]
    if version < 4:
        lines += ["$Nodes", str(len(number))] + ["%d %s" % at for at in enumerate(nodes_at, 1)] + [
            "$EndNodes", "$Elements", str(len(elements))
        ]
        lines += [
            "%d %d 2 %d %d %s" % (e, kind, tag, tag, " ".join(map(str, n)))
            for e, (kind, tag, _, n) in enumerate(elements, 1)
        ] + ["$EndElements"]
    else:
        by_dimension = [[name for name in names if name[0] == d] for d in range(4)]
        lines += ["$Entities", " ".join(str(len(n)) for n in by_dimension)]
        lines += ["%d 0 0 0 1 1 1 1 %d 0" % (tag, tag) for n in by_dimension for _, tag, _ in n] + ["$EndEntities"]
        lines += ["$Nodes", "1 %d 1 %d" % (len(number), len(number)),
                  "3 1 0 %d" % len(number)] + [str(i) for i in range(1,
                                                                     len(number) + 1)] + nodes_at + ["$EndNodes"]
        lines += ["$Elements", "%d %d 1 %d" % (len(names), len(elements), len(elements))]
        e = 0
        for dimension, tag, _ in names:
            own = [element for element in elements if element[1:3] == (tag, dimension)]
            lines.append("%d %d %d %d" % (dimension, tag, own[0][0], len(own)))
            for _, _, _, n in own:
                e += 1
                lines.append("%d %s" % (e, " ".join(map(str, n))))
        lines.append("$EndElements")
    with open(file + ".msh", "w") as out:
        out.write("\n".join(lines) + "\n")


SCENE = """bodies:
  - inner: {{mesh: {mesh}.msh, volume: inner, young: {young}, poisson: {poisson}, curved: {curved}}}
  - outer: {{mesh: {mesh}.msh, volume: outer, young: {young}, poisson: {poisson}, curved: {curved}}}
symmetry:
{symmetry}
contact:
  - fit: {{mortar: outer.outer_in, nonmortar: inner.inner_out, interference: true}}
"""


def write_scene(name, mesh, curved):
    symmetry = "\n".join("  - %s_%s: {face: %s.%s_%s, normal: %s}" % (ring, side, ring, ring, side, normal)
                         for ring in RADII
                         for side, normal in (("begin", "y"), ("end", "x"), ("low", "z"), ("high", "z")))
    with open(name + ".yaml", "w") as file:
        file.write(SCENE.format(mesh=mesh, young=YOUNG, poisson=POISSON, symmetry=symmetry, curved=curved))


def write():
    for nodes in HEXAHEDRA:
        for version in (2.2, 4.1):
            write_mesh("rings_%d_%g" % (nodes, version), nodes, version)
            write_scene("rings_%d_%g" % (nodes, version), "rings_%d_%g" % (nodes, version), "true")
    write_scene("facets", "rings_20_2.2", "false")
    write_mesh("cones", 8, 4.1, -0.2)
    write_scene("cones", "cones", "true")


def lame():
    """Sum of the pressure over the joint"""
    ratio = POISSON / (1 - POISSON)
    (a, b), (c, d) = RADII["inner"], RADII["outer"]
    soft = (b**2 + a**2) / (b**2 - a**2) - ratio + (d**2 + c**2) / (d**2 - c**2) + ratio
    return OVERLAP * YOUNG / (1 - POISSON**2) / soft * HEIGHT * np.pi / 2


def stand_off(name):
    """Largest distance of the joint's vertices from the circles of its two faces, over the radius"""
    with h5py.File(name + ".h5") as mesh, h5py.File(name + "_0001.h5") as fields:
        x = mesh["vertices"][...][~np.isnan(fields["contact_gap"][...])]
    radius = np.hypot(x[:, 0], x[:, 1])
    return np.minimum(abs(radius - RADII["inner"][1]), abs(radius - RADII["outer"][0])).max() / 25


def fields(name):
    """Places of the inner ring's vertices on the joint, and the pressures there"""
    with h5py.File(name + ".h5") as mesh, h5py.File(name + "_0001.h5") as step:
        x, inner = mesh["vertices"][...], np.zeros(len(mesh["vertices"]), bool)
        inner[np.unique(mesh["cells"][...][mesh["body"][...].ravel() == 0])] = True
        at = inner & ~np.isnan(step["contact_gap"][...])
        return x[at], step["contact_pressure"][...][at]


def judge():
    force = lambda name: load(name)["steps"][-1]["pairs"][0]["normal_force"]
    for nodes in HEXAHEDRA:
        coarse, fine = "rings_%d_2.2_0" % nodes, "rings_%d_2.2_%d" % (nodes, REFINED[nodes])
        errors = [abs(force(name) / lame() - 1) for name in (coarse, fine)]
        say("%d nodes: refined, the vertices of the joint within 5e-6 of its circles" % nodes,
            stand_off(fine) <= 5e-6, stand_off(fine))
        say("%d nodes: the force within 0.5 %% of Lame; refined within 0.1 %%" % nodes, errors[0] <= 5e-3
            and errors[1] <= 1e-3, errors)
        other = abs(force("rings_%d_4.1_0" % nodes) / force(coarse) - 1)
        say("%d nodes: the same by format 4.1, to 1e-7" % nodes, other <= 1e-7, other)
    x, p = fields("cones_0")
    rounds = [p[x[:, 2] == z] for z in np.unique(x[:, 2])]
    off = [abs(around / around.mean() - 1).max() for around in rounds]
    say("cones: around each circle the pressure at every vertex within 3 % of its mean",
        len(rounds) == 3 and max(off) <= 0.03, off)
    say("cones: the force within 1 % of that refined once",
        abs(force("cones_0") / force("cones_1") - 1) <= 0.01, (force("cones_0"), force("cones_1")))
    energies = [load("cones_%d" % refine)["steps"][-1]["energy"] for refine in (0, 1)]
    say("cones: the energy within 2 %", abs(energies[0] / energies[1] - 1) <= 0.02, energies)
    say("curved: false keeps the facets, which interfere", force("facets") >= 1.03 * lame(), force("facets"))


write() if sys.argv[1] == "write" else judge()
