"""NAFEMS contact benchmark 2 with friction: a round punch with a rounded edge on a base, axisymmetric, here a sector of
both, one cell wide.

python3 friction_punch.py scenes writes meshes and scenes; python3 friction_punch.py judges the runs that
friction_punch.sh has made.

A. Konter, Advanced finite element contact benchmarks, 2006: punch of diameter and height 100, edge rounded by 10, base
of diameter and height 200, pressed by 100 MPa; displacement of the base at the middle. It is a mean of codes, whose
meshes differ.
"""
import math
import sys

from summaries import load, say, within

PUBLISHED = {0: -0.13294, 0.1: -0.13079}  # by coefficient of friction [mm]
CELLS = 6, 12
ANGLE, HOLE = math.radians(5), 0.05  # of the sector, and about the axis, where cells must not end in an edge
# radii of the punch's flat and outside, of its edge, and of where the base's small cells end
FLAT, RIM, EDGE, REACH = 40, 50, 10, 46
SIDES = "start", "end", "low", "high"


def steps(lower, upper, n, growth):
    """The ends of n steps, the last so many times the first"""
    sizes = [growth**(i / max(1, n - 1)) for i in range(n)]
    return [lower + (upper - lower) * sum(sizes[:i + 1]) / sum(sizes) for i in range(n)]


class Mesh:
    """Blocks of hexahedra between two planes through the axis, as a Gmsh file"""

    def __init__(self):
        self.nodes, self.cells, self.facets, self.volumes = [], [], [], []

    def add(self, volume, radii, levels, height):
        """A block with nodes at these radii, and at a height for each level from 0 to 1"""
        first, n = len(self.nodes) + 1, len(levels)
        self.volumes.append(volume)
        tag = len(self.volumes)
        self.nodes += [(r * math.cos(ANGLE * s), r * math.sin(ANGLE * s), height(r, t)) for r in radii for t in levels
                       for s in (0, 1)]

        def node(i, k, s):
            return first + 2 * (i * n + k) + s

        for i in range(len(radii) - 1):
            for k in range(n - 1):
                self.cells.append(
                    (tag, [node(i + a, k + b, s) for b in (0, 1) for a, s in ((0, 0), (1, 0), (1, 1), (0, 1))]))
                self.facets += [(10 * tag + s,
                                 [node(i, k, s),
                                  node(i + 1, k, s),
                                  node(i + 1, k + 1, s),
                                  node(i, k + 1, s)]) for s in (0, 1)]
            self.facets += [(10 * tag + 2 + h, [node(i, k, 0),
                                                node(i + 1, k, 0),
                                                node(i + 1, k, 1),
                                                node(i, k, 1)]) for h, k in enumerate((0, n - 1))]

    def write(self, file):
        names = [f'3 {v + 1} "{volume}"' for v, volume in enumerate(self.volumes)]
        names += [
            f'2 {10 * (v + 1) + s} "{volume}_{side}"' for v, volume in enumerate(self.volumes)
            for s, side in enumerate(SIDES)
        ]
        elements = [(3, facet) for facet in self.facets] + [(5, cell) for cell in self.cells]
        with open(file, "w") as out:
            print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), *names,
                  "$EndPhysicalNames\n$Nodes", len(self.nodes), sep="\n", file=out)
            for i, x in enumerate(self.nodes):
                print(i + 1, "%.15g %.15g %.15g" % x, file=out)
            print("$EndNodes\n$Elements", len(elements), sep="\n", file=out)
            for i, (kind, (tag, nodes)) in enumerate(elements):
                print(i + 1, kind, 2, tag, tag, *nodes, file=out)
            print("$EndElements", file=out)


def punch_height(radius, level):
    bottom = EDGE - math.sqrt(max(0, EDGE**2 - (radius - FLAT)**2)) if radius > FLAT else 0
    return bottom + (100 - bottom) * level


def punch(cells):
    inside = [HOLE, *steps(HOLE, 24, cells, 1), *steps(24, FLAT, 2 * cells, 0.1)]
    edge = [FLAT + EDGE * math.sin(math.pi / 2 * i / (2 * cells)) for i in range(1, 2 * cells + 1)]
    mesh = Mesh()
    mesh.add("punch", inside + edge, [0, *steps(0, 1, 3 * cells, 30)], punch_height)
    mesh.add("base", inside + steps(FLAT, REACH, 2 * cells, 1) + steps(REACH, 100, 2 * cells, 10),
             [1, *(1 - t for t in steps(0, 1, 3 * cells + 2, 30))][::-1], lambda radius, level: 200 * (level - 1))
    return mesh


def scene(mesh, friction):
    end = f"[{-math.sin(ANGLE)!r}, {math.cos(ANGLE)!r}, 0]"
    law = f", friction: {friction}" if friction else ""
    return f"""problem: punch
bodies:
  - punch: {{mesh: {mesh}, volume: punch, young: 210000, poisson: 0.3, element: full}}
  - base: {{mesh: {mesh}, volume: base, young: 70000, poisson: 0.3, element: full}}
displacements:
  - floor: {{face: base.base_low, value: [0, 0, 0]}}
symmetry:
  - punch_start: {{face: punch.punch_start, normal: y}}
  - punch_end: {{face: punch.punch_end, normal: {end}}}
  - base_start: {{face: base.base_start, normal: y}}
  - base_end: {{face: base.base_end, normal: {end}}}
pressures:
  - load: {{face: punch.punch_high, value: 100}}
contact:
  - touch: {{mortar: base.base_high, nonmortar: punch.punch_low, smooth: false{law}}}
probes:
  - middle: {{point: [{HOLE}, 0, 0], body: base}}
"""


def displacement(name):
    return load(name)["steps"][-1]["probes"][0]["displacement"][2]


if len(sys.argv) > 1 and sys.argv[1] == "scenes":
    for cells in CELLS:
        punch(cells).write(f"punch_{cells}.msh")
        for friction in PUBLISHED:
            with open(f"punch_{cells}_{friction}.yaml", "w") as file:
                file.write(scene(f"punch_{cells}.msh", friction))
else:
    for cells in CELLS:
        found = {friction: displacement(f"punch_{cells}_{friction}") for friction in PUBLISHED}
        for friction, u in found.items():
            say(f"{cells} cells, friction {friction}: displacement within 1 % of the published one",
                within(u, PUBLISHED[friction], 0.01), u)
        say(f"{cells} cells: what friction takes off it within 2 % of what is published",
            within(found[0.1] - found[0], PUBLISHED[0.1] - PUBLISHED[0], 0.02), found)
    one, three = (displacement(f"punch_6_0.1{ranks}") for ranks in ("", "_3"))
    say("3 ranks as 1", within(three, one, 1e-8), three)
    fine = displacement("punch_12_0.1")
    say("the finer mesh is closer", abs(fine - PUBLISHED[0.1]) < abs(one - PUBLISHED[0.1]), fine)
