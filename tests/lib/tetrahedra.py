"""A block of cells, each cut into six tetrahedra, as a Gmsh file: a box, or a quarter of a pipe

    tetrahedra.py write NAME.msh FORMAT ORDER CELLS...     the pipe, format 2.2 or 4.1; order 1 or 2: nodes in the
    middles of the edges, on its circles
    tetrahedra.py box NAME.msh ORDER LOWER UPPER CELLS...  three numbers each
    tetrahedra.py ring NAME.msh ORDER RADII CELLS...       of any radii, 2 long
    tetrahedra.py check                                    what the runs of tetrahedra.sh came to
"""
import itertools
import sys

import numpy as np

INNER, OUTER, LENGTH = 1.0, 2.0, 0.5
EDGES = [(0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1)]  # in Gmsh's order
PIPE_FACES = {"inner": (0, 0), "outer": (0, 1), "bottom": (1, 0), "left": (1, 1), "front": (2, 0), "back": (2, 1)}
BOX_FACES = {"xmin": (0, 0), "xmax": (0, 1), "ymin": (1, 0), "ymax": (1, 1), "zmin": (2, 0), "zmax": (2, 1)}


def pipe(inner, outer, length):
    """Places from parameters in [0, 1]"""

    def place(polar):
        r, angle = inner + (outer - inner) * polar[0], polar[1] * np.pi / 2
        return r * np.cos(angle), r * np.sin(angle), length * polar[2]

    return place


class Block:
    """Nodes are numbered by their parameters, of which middles of edges have halves; faces: the axis and the end of
    each"""

    def __init__(self, order, cells, place, faces):
        self.order, self.cells, self.number = order, np.array(cells), {}
        self.place, self.sides = place, faces
        self.volume, self.faces = [], {name: [] for name in faces}
        for corner in itertools.product(*(range(n) for n in cells)):
            for axes in itertools.permutations(range(3)):
                self.add_cell(np.array(corner), axes)

    def nodes(self, corners, edges):
        middles = [(corners[a] + corners[b]) / 2 for a, b in edges] if self.order == 2 else []
        return [self.number.setdefault(tuple(p), len(self.number) + 1) for p in list(corners) + middles]

    def add_cell(self, corner, axes):
        corners = [corner.astype(float)]
        for axis in axes:
            corners.append(corners[-1] + np.eye(3)[axis])
        if axes not in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            corners[1], corners[2] = corners[2], corners[1]
        self.volume.append(self.nodes(corners, EDGES))
        for name, (axis, end) in self.sides.items():
            triangle = [p for p in corners if p[axis] == end * self.cells[axis]]
            if len(triangle) == 3:
                self.faces[name].append(self.nodes(triangle, EDGES[:3]))

    def blocks(self):
        """Dimension, tag, Gmsh's type and elements"""
        for tag, name in enumerate(self.sides, 1):
            yield 2, tag, 9 if self.order == 2 else 2, self.faces[name]
        yield 3, 7, 11 if self.order == 2 else 4, self.volume

    def lines_of_elements(self, version):
        count = len(self.volume) + sum(len(face) for face in self.faces.values())
        yield str(count) if version == "2.2" else f"7 {count} 1 {count}"
        number = 0
        for dim, tag, kind, elements in self.blocks():
            if version == "4.1":
                yield f"{dim} {tag} {kind} {len(elements)}"
            for nodes in elements:
                number += 1
                tags = f" {kind} 2 {tag} {tag}" if version == "2.2" else ""
                yield f"{number}{tags} " + " ".join(map(str, nodes))

    def write(self, name, version):
        places = [(number, *self.place(np.array(p) / self.cells)) for p, number in self.number.items()]
        with open(name, "w") as file:
            print(f"$MeshFormat\n{version} 0 8\n$EndMeshFormat\n$PhysicalNames\n7", file=file)
            for tag, face in enumerate(self.sides, 1):
                print(f'2 {tag} "{face}"', file=file)
            print('3 7 "block"\n$EndPhysicalNames', file=file)
            if version == "2.2":
                print(f"$Nodes\n{len(places)}", file=file)
                for number, *x in places:
                    print(number, *map(repr, map(float, x)), file=file)
            else:
                entities = [f"{tag} 0 0 0 2 2 1 1 {tag} 0" for tag in range(1, 8)]
                print("$Entities\n0 0 6 1", *entities, "$EndEntities",
                      f"$Nodes\n1 {len(places)} 1 {len(places)}\n3 7 0 {len(places)}", sep="\n", file=file)
                print(*(number for number, *_ in places), sep="\n", file=file)
                for _, *x in places:
                    print(*map(repr, map(float, x)), file=file)
            print("$EndNodes\n$Elements", *self.lines_of_elements(version), "$EndElements", sep="\n", file=file)


def lame():
    """The pressure's work over two, plane strain: u = (1 + nu) p a^2/(E (b^2 - a^2)) ((1 - 2 nu) r + b^2/r)"""
    u = 1.3 * 10 / (1000 * (OUTER**2 - 1)) * (0.4 * INNER + OUTER**2 / INNER)
    return 10 * u * np.pi / 4 * LENGTH


def check():
    import h5py
    from summaries import load, say, within

    step = {name: load(name)["steps"][-1] for name in "p1 p5 old straight bbar r1 r2 whole part".split()}
    energy = {name: s["energy"] for name, s in step.items()}
    say("energy on 5 ranks", within(energy["p5"], energy["p1"], 1e-9), (energy["p5"], energy["p1"]))
    say("format 4.1 as 2.2", within(energy["old"], energy["p1"], 1e-12), (energy["old"], energy["p1"]))
    exact = lame()
    errors = [abs(energy[name] / exact - 1) for name in ("p1", "r1", "r2")]
    say("energy near Lame's", errors[0] < 1e-2, errors)
    say("and nearer on finer meshes, as near as the file's parabolas are to circles", errors[1] < errors[0] / 3
        and errors[2] < 2e-4, errors)
    say("energy of straight cells less near", 3 * errors[0] < abs(energy["straight"] / exact - 1) < 0.1,
        energy["straight"] / exact)
    say("mean dilatation", within(energy["bbar"], exact, 2e-2), energy["bbar"] / exact)
    say("the run that goes on, refined", within(energy["part"], energy["whole"], 1e-9),
        (energy["part"], energy["whole"]))
    probe = step["r1"]["probes"][0]
    r, hoop = 1.5, 10 / 3 * (1 + 4 / 1.5**2)
    u = 1.3 * 10 / 3000 * (0.4 * r + 4 / r) / 2**0.5
    say("displacement at a probe", within(probe["displacement"][0], u, 2e-3), (probe["displacement"], u))
    say("stress there", within(probe["principal_1"], hoop, 0.03), (probe["principal_1"], hoop))
    with h5py.File("pipe.h5") as mesh, h5py.File("pipe_0001.h5") as fields:
        x, numbers, body = mesh["vertices"][:], mesh["mixed_cells"][:].ravel(), mesh["body"][:].ravel()
        displacement, stress = fields["displacement"][:], fields["stress"][:]
    at, kinds = 0, []
    while at < len(numbers):
        kinds.append(numbers[at])
        at += 1 + {38: 10, 9: 8}[numbers[at]]
    kinds = np.array(kinds)
    say("cells: tetrahedra of 10 nodes, and hexahedra", (kinds[body == 0] == 38).all()
        and (kinds[body == 1] == 9).all() and (kinds == 9).sum() == 64, kinds)
    say("a displacement a node, a stress a cell", displacement.shape == x.shape and len(stress) == len(kinds),
        (x.shape, stress.shape))


def main():
    what, *words = sys.argv[1:]
    if what == "check":
        check()
        return
    name, numbers = words[0], [float(word) for word in words[1:]]
    if what == "write":
        block, version = Block(int(words[2]), [int(n) for n in words[3:]], pipe(INNER, OUTER, LENGTH),
                               PIPE_FACES), words[1]
    elif what == "box":
        lower, upper = np.array(numbers[1:4]), np.array(numbers[4:7])
        block, version = Block(int(numbers[0]), [int(n) for n in numbers[7:]], lambda p: lower + p * (upper - lower),
                               BOX_FACES), "2.2"
    else:
        block, version = Block(int(numbers[0]), [int(n) for n in numbers[3:]], pipe(*numbers[1:3], 2),
                               PIPE_FACES), "2.2"
    block.write(name, version)


if __name__ == "__main__":
    main()
