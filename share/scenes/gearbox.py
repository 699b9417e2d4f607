"""A gearbox-like stack of many parts, as a deck of Abaqus (gearbox.inp, by Gmsh) and a scene (gearbox.yaml).

    python3 share/scenes/gearbox.py                       # six bolts, 33 parts
    python3 share/scenes/gearbox.py --bolts 3 --size 2    # 21 parts, coarse cells
    bin/contact gearbox.yaml -report gearbox.html

Base, housing and cover are clamped by bolts with washers and nuts. Inside, a shaft with a collar stands between two
spacers, with a gear on the collar; bushes guide it. The bolts are tightened in load step 1. From then on they are
locked, and the gear is loaded. Contact is found by itself. Gmsh (`apt install gmsh`) makes the cells: hexahedra, by
sweeps of quadrilaterals. Lengths in mm.
"""
import argparse
import math
import subprocess

HOLES = 46.0  # radius of the circle of bolts
SEAM = 36.0  # radius of the housing
CLEARANCE = 0.01  # between housing and cover before the bolts are tightened; they then clamp shaft and gear


class Deck:
    """Text for Gmsh: patches of four sides with equal cells, and sweeps of them along z"""

    def __init__(self, size):
        self.size = size
        # of a patch beside a hole; 12 or more around a circle stay one surface
        self.cells_across = max(3, round(4 / size))
        self.lines = ["Mesh.RecombineAll = 1;", "Mesh.SaveGroupsOfElements = 1;", "General.Verbosity = 1;"]
        self.sweeps = []  # after all patches, since they number points and curves by themselves
        self.parts = []
        self.faces = []
        self.next = 1
        self.known = {}  # lines by their end points

    def number(self, n=1):
        first = self.next
        self.next += n
        return first

    def cells(self, length, size):
        """Number of cells along a length"""
        return max(1, round(length / (size * self.size)))

    def point(self, x, y, z):
        point = self.number()
        self.lines.append(f"Point({point}) = {{{x:.12g}, {y:.12g}, {z:.12g}}};")
        return point

    def line(self, a, b, n, center=None):
        """A line or an arc between two points, with n cells; negative: the other way"""
        if (b, a) in self.known:
            return -self.known[b, a]
        if (a, b) not in self.known:
            line = self.known[a, b] = self.number()
            kind, points = ("Circle", f"{a}, {center}, {b}") if center else ("Line", f"{a}, {b}")
            self.lines.append(f"{kind}({line}) = {{{points}}}; Transfinite Curve {{{line}}} = {n + 1};")
        return self.known[a, b]

    def circle(self, x, y, z, radius, n, arcs=4, turn=0.0):
        """Points and arcs of a circle, with n cells on each arc"""
        center = self.point(x, y, z)
        angles = [turn + 2 * math.pi * k / arcs for k in range(arcs)]
        points = [self.point(x + radius * math.cos(angle), y + radius * math.sin(angle), z) for angle in angles]
        for k in range(arcs):
            self.line(points[k], points[(k + 1) % arcs], n, center)
        return points

    def patch(self, corners, along, across):
        """The patch between four points; `along`: cells from the first to the second"""
        surface = self.number()
        sides = [self.line(corners[k], corners[(k + 1) % 4], across if k % 2 else along) for k in range(4)]
        self.lines.append(f"Curve Loop({surface}) = {{{', '.join(map(str, sides))}}};")
        self.lines.append(f"Plane Surface({surface}) = {{{surface}}}; Transfinite Surface {{{surface}}};")
        return surface

    def between(self, inner, outer, n, across):
        """Patches between two rings of points; the second side of each is the outer one"""
        m = len(inner)
        return [self.patch([inner[k], outer[k], outer[(k + 1) % m], inner[(k + 1) % m]], across, n) for k in range(m)]

    def disc(self, x, y, z, radius, n):
        """A disc: its patches, and the points of its circle"""
        turn = math.atan2(y, x)
        outer = self.circle(x, y, z, radius, n, 4, turn)
        core = [
            self.point(x + 0.55 * radius * math.cos(turn + k * math.pi / 2),
                       y + 0.55 * radius * math.sin(turn + k * math.pi / 2), z) for k in range(4)
        ]
        return self.between(core, outer, n, 1) + [self.patch(core, n, n)], outer

    def sweep(self, name, surfaces, height, layers):
        """Appends volumes to the part `name`; returns their far surfaces"""
        tops = []
        for surface in surfaces:
            out = f"e{self.number()}"
            self.sweeps.append(
                f"{out}[] = Extrude {{0, 0, {height:.12g}}} {{ Surface{{{surface}}}; Layers{{{layers}}}; Recombine; }};"
            )
            self.parts.append((name, f"{out}[1]"))
            tops.append(f"{out}[0]")
        return tops

    def ring(self, name, x, y, radii, z, size, arcs=4):
        n, turn = self.cells_across, math.atan2(y, x)
        inner, outer = (self.circle(x, y, z[0], radius, n, arcs, turn) for radius in radii)
        surfaces = self.between(inner, outer, n, self.cells(radii[1] - radii[0], size))
        return self.sweep(name, surfaces, z[1] - z[0], self.cells(z[1] - z[0], size))

    def plate(self, name, radii, z, holes, hole, size):
        """A ring of six sectors, with holes for bolts in some of them; returns the far surfaces beside the rim"""
        n, step = self.cells_across, math.pi / 3
        rim, seam, bore = (self.circle(0, 0, z[0], radius, n, 6, -step / 2) for radius in (radii[1], SEAM, radii[0]))
        surfaces = self.between(bore, seam, n, self.cells(SEAM - radii[0], 8)) if radii[0] < SEAM else []
        if not surfaces:
            seam = bore
        outside = []
        for k in range(6):
            inner, outer = [seam[k], seam[(k + 1) % 6]], [rim[k], rim[(k + 1) % 6]]
            if k not in holes:
                outside.append(self.patch([inner[0], outer[0], outer[1], inner[1]], n, n))
                continue
            x, y = HOLES * math.cos(k * step), HOLES * math.sin(k * step)
            points = self.circle(x, y, z[0], hole, n, 4, k * step - math.pi / 4)
            corners = [outer[0], outer[1], inner[1], inner[0]]
            # equal in all plates, since Gmsh joins their faces
            around = self.between(points, corners, n, self.cells(6, 4))
            outside.append(around[0])
            surfaces += around[1:]
        layers = self.cells(z[1] - z[0], size)
        self.sweep(name, surfaces, z[1] - z[0], layers)
        return self.sweep(name, outside, z[1] - z[0], layers)

    def names(self):
        return list(dict.fromkeys(name for name, _ in self.parts))

    def text(self):
        groups = [
            f"Physical Volume(\"{name}\") = {{{', '.join(v for n, v in self.parts if n == name)}}};"
            for name in self.names()
        ]
        groups += [f"Physical Surface(\"{name}\") = {{{', '.join(surfaces)}}};" for name, surfaces in self.faces]
        return "\n".join(self.lines + self.sweeps + groups) + "\n"


def assemble(nbolts, size):
    deck = Deck(size)
    n = deck.cells_across
    sectors = range(0, 6, 6 // nbolts)
    holes = [(HOLES * math.cos(math.pi / 3 * k), HOLES * math.sin(math.pi / 3 * k)) for k in sectors]
    base = deck.plate("base", (14, 56), (0, 12), sectors, 4.5, 4)
    deck.plate("housing", (SEAM, 56), (12, 52 - CLEARANCE), sectors, 4.5, 7)
    deck.plate("cover", (14, 56), (52, 62), sectors, 4.5, 4)
    for k, (x, y) in enumerate(holes, 1):
        shank, core = deck.disc(x, y, 64, 4, n)
        head = deck.between(core, deck.circle(x, y, 64, 7, n, 4, math.atan2(y, x)), n, 1)
        deck.sweep(f"bolt{k}", head + shank, 5, 1)
        deck.sweep(f"bolt{k}", shank, -72, deck.cells(72, 4))
        deck.ring(f"washer{k}", x, y, (4.5, 8), (62, 64), 3)
        deck.ring(f"lower_washer{k}", x, y, (4.5, 8), (-2, 0), 3)
        deck.ring(f"nut{k}", x, y, (4, 7), (-8, -2), 3)
    middle, core = deck.disc(0, 0, 22, 10, n)
    collar = deck.between(core, deck.circle(0, 0, 22, 15, n), n, 1)
    top = deck.sweep("shaft", middle, 5, 1)
    deck.sweep("shaft", collar, 5, 1)
    deck.sweep("shaft", top, 41, deck.cells(41, 6))
    deck.sweep("shaft", middle, -26, deck.cells(26, 6))
    deck.ring("lower_spacer", 0, 0, (10.5, 16), (12, 22), 4)
    gear = deck.ring("gear", 0, 0, (10.2, 30), (27, 42), 5)
    deck.ring("upper_spacer", 0, 0, (10.5, 16), (42, 52), 4)
    deck.ring("lower_bush", 0, 0, (10.05, 14), (0, 12), 4, 6)
    deck.ring("upper_bush", 0, 0, (10.05, 14), (52, 62), 4, 6)
    # sides of a sweep are [2], [3], ... in the order of the patch
    deck.faces.append(("rim", [far.replace("[0]", "[3]") for far in base]))
    deck.faces.append(("teeth", [far.replace("[0]", "[3]") for far in gear]))
    return deck, holes


def scene(deck, holes, preload, order):
    n = len(holes)
    lines = [
        "# made by share/scenes/gearbox.py", f"problem: gearbox of {len(deck.names())} parts", "units: mm, N, MPa",
        "bodies:"
    ]
    for name in deck.names():
        constants = "young: 110e3, poisson: 0.3" if "bush" in name else "young: 210e3, poisson: 0.3"
        lines.append(
            f"  - {name}: {{mesh: gearbox.inp, volume: {name}, {constants}{', order: 2' if order == 2 else ''}}}")
    lines += ["displacements:", "  - foot: {face: base.rim, value: [0, 0, 0]}"]
    lines += ["contact:", "  - auto: {friction: 0.15}"]
    lines += [f"  - thread{k}: {{mortar: bolt{k}, nonmortar: nut{k}, tie: 0.01}}" for k in range(1, n + 1)]
    lines += [
        "  - lower_seat: {mortar: base, nonmortar: lower_bush, tie: 0.01}",
        "  - upper_seat: {mortar: cover, nonmortar: upper_bush, tie: 0.01}"
    ]
    lines += ["bolts:"]
    lines += [
        (f"  - m8_{k}: "
         f"{{body: bolt{k}, point: [{x:.6g}, {y:.6g}, 32], axis: [0, 0, 1], force: {preload}, lock: 1, ramp: tighten}}")
        for k, (x, y) in enumerate(holes, 1)
    ]
    lines += ["forces:", "  - teeth: {face: gear.teeth, value: [0, 400, 0], moment: [0, 0, 4000], ramp: drive}"]
    lines += ["ramps:", "  - tighten: {factors: [1, 0]}", "  - drive: {factors: [0, 1]}", "load: {steps: 2}"]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bolts", type=int, default=6, choices=(1, 2, 3, 6))
    parser.add_argument("--size", type=float, default=1.0, help="factor of the size of the cells")
    parser.add_argument("--preload", type=float, default=12000, help="of each bolt [N]")
    parser.add_argument("--order", type=int, default=1)
    arguments = parser.parse_args()
    deck, holes = assemble(arguments.bolts, arguments.size)
    with open("gearbox.geo", "w") as file:
        file.write(deck.text())
    subprocess.run(["gmsh", "-3", "-format", "inp", "gearbox.geo", "-o", "gearbox.inp"], check=True)
    with open("gearbox.yaml", "w") as file:
        file.write(scene(deck, holes, arguments.preload, arguments.order))
    print(f"gearbox.inp, gearbox.yaml: {len(deck.names())} parts")


if __name__ == "__main__":
    main()
