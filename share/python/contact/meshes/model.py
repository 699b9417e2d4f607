"""A mesh as the scene knows it: volumes with names, and faces with names.

Cells and facets have the node order of Abaqus, which is VTK's but for the 27-node hexahedron.
"""
import numpy as np


class MeshError(Exception):
    """One sentence that says what is wrong with a file"""


# Corners of the sides S1, S2, ... of a cell, as Abaqus numbers them
TETRAHEDRON_SIDES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
HEXAHEDRON_SIDES = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
HEXAHEDRON_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))


class Kind:
    """A kind of cell. sides: the nodes of each side, corners first; facet: what a side is called"""

    def __init__(self, name, corners, sides, edges=(), centres=0):
        self.name = name
        self.ncorners = corners
        self.nnodes = corners + len(edges) + (1 + centres if centres else 0)
        self.order = 2 if edges else 1
        middle = {frozenset(edge): corners + number for number, edge in enumerate(edges)}
        self.sides = []
        for number, side in enumerate(sides):
            ends = zip(side, side[1:] + side[:1])
            nodes = list(side) + [middle[frozenset(pair)] for pair in ends if middle]
            self.sides.append(nodes + ([corners + len(edges) + 1 + number] if centres else []))
        self.edges = [(*edge, corners + number) for number, edge in enumerate(edges)]
        self.facet = {3: "triangle", 6: "triangle6", 4: "quad", 8: "quad8", 9: "quad9"}[len(self.sides[0])]


KINDS = {
    kind.name: kind
    for kind in (
        Kind("tetra", 4, TETRAHEDRON_SIDES),
        Kind("tetra10", 4, TETRAHEDRON_SIDES, TETRAHEDRON_EDGES),
        Kind("hexahedron", 8, HEXAHEDRON_SIDES),
        Kind("hexahedron20", 8, HEXAHEDRON_SIDES, HEXAHEDRON_EDGES),
        Kind("hexahedron27", 8, HEXAHEDRON_SIDES, HEXAHEDRON_EDGES, 6),
    )
}
FACETS = {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4}  # numbers of corners

# VTK's 27-node hexahedron in Abaqus' order: the centre, then the sides S1 to S6
VTK_TO_ABAQUS_27 = [*range(20), 26, 24, 25, 22, 21, 23, 20]


class Mesh:
    """points: (n, 3); blocks: [(kind, cells)]; volumes: {name: {block: rows}}; faces: {name: [(facet kind, facets)]}"""

    def __init__(self, points):
        self.points = np.asarray(points, float).reshape(-1, 3)
        self.blocks, self.volumes, self.faces = [], {}, {}

    def add_block(self, kind, cells):
        """A block of cells of one kind, and its number; wedges become tetrahedra"""
        cells = np.asarray(cells, int)
        if kind == "wedge":
            kind, cells = "tetra", split_wedges(cells)
        if kind not in KINDS:
            raise MeshError(f"it has cells of type {kind}; tetrahedra of 4 or 10 nodes, hexahedra of 8, 20 or 27 and "
                            f"wedges of 6 are read")
        self.blocks.append((kind, cells))
        return len(self.blocks) - 1

    def add_volume(self, name, rows):
        """rows: {block: rows}. Cells that another volume has too are in both"""
        mine = self.volumes.setdefault(name, {})
        for block, these in rows.items():
            if len(these):
                mine[block] = np.union1d(mine.get(block, np.array([], int)), np.asarray(these, int))

    def add_face(self, name, kind, facets):
        facets = np.asarray(facets, int).reshape(-1, len(facets[0]) if len(facets) else 1)
        if len(facets):
            self.faces.setdefault(name, []).append((kind, facets))

    def add_sides(self, name, block, rows, side):
        """Side number `side`, from 0, of cells of a block"""
        kind, cells = self.blocks[block]
        if side >= len(KINDS[kind].sides):
            raise MeshError(f"the surface \"{name}\" has a side {side + 1}; a {kind} has {len(KINDS[kind].sides)}")
        self.add_face(name, KINDS[kind].facet, cells[np.asarray(rows, int)][:, KINDS[kind].sides[side]])

    def boundary(self):
        """[(block, row, side)] of the sides of one cell, or of two cells that are in unlike volumes, and the corners of
        each"""
        first, corners, owners = [], [], []
        labels, _ = self.volume_labels()
        for block, (kind, cells) in enumerate(self.blocks):
            for side, nodes in enumerate(KINDS[kind].sides):
                ends = cells[:, nodes[:FACETS[KINDS[kind].facet]]]
                padded = np.full((len(cells), 4), -1)
                padded[:, :ends.shape[1]] = ends
                corners.append(np.sort(padded, axis=1))
                first.append(
                    np.column_stack([np.full(len(cells), block),
                                     np.arange(len(cells)),
                                     np.full(len(cells), side)]))
                owners.append(labels[block])
        if not first:
            return np.zeros((0, 3), int), np.zeros((0, 4), int)
        first, corners, owners = np.concatenate(first), np.concatenate(corners), np.concatenate(owners)
        _, at, inverse, counts = np.unique(corners, axis=0, return_index=True, return_inverse=True, return_counts=True)
        unlike = np.zeros(len(at), bool)
        unlike[inverse.ravel()[owners != owners[at][inverse.ravel()]]] = True
        kept = np.sort(at[(counts == 1) | unlike])
        return first[kept], corners[kept]

    def volume_labels(self):
        """For each block a number for each cell, the same for cells of the same volumes; the volumes of each number"""
        sets = [[() for _ in cells] for _, cells in self.blocks]
        for number, rows in enumerate(self.volumes.values()):
            for block, these in rows.items():
                for row in these:
                    sets[block][row] += (number, )
        known = {}
        numbers = [np.array([known.setdefault(label, len(known)) for label in labels], int) for labels in sets]
        return numbers, list(known)

    def add_node_sets(self, sets):
        """A set of nodes is a face where it holds all corners of sides on the boundary. Returns the names of those that
        do not"""
        sides, corners = self.boundary() if sets else (None, None)
        left = []
        for name, nodes in sets.items():
            inside = np.zeros(len(self.points) + 1, bool)
            inside[np.asarray(nodes, int)] = True
            inside[-1] = True  # where a triangle has no fourth corner
            found = sides[inside[corners].all(axis=1)]
            for block, side in sorted({(int(b), int(s)) for b, _, s in found}):
                self.add_sides(name, block, found[(found[:, 0] == block) & (found[:, 2] == side), 1], side)
            if not len(found):
                left.append(name)
        return left

    def finish(self):
        """Turns inverted cells, and makes a volume of the cells that are in none"""
        if not self.blocks:
            raise MeshError("it has no cells of dimension 3")
        self.blocks = [(kind, turned(kind, cells, self.points)) for kind, cells in self.blocks]
        spare = {}
        for block, (_, cells) in enumerate(self.blocks):
            used = [rows[block] for rows in self.volumes.values() if block in rows]
            rows = np.setdiff1d(np.arange(len(cells)), np.concatenate(used)) if used else np.arange(len(cells))
            if len(rows):
                spare[block] = rows
        if spare:
            self.add_volume("rest" if self.volumes else "all", spare)
        self.volumes = {name: rows for name, rows in self.volumes.items() if rows}
        self.add_parts()

    def add_parts(self):
        """Adds a volume NAME.part_1, NAME.part_2, ... for each part of a volume whose parts share no nodes"""
        for name, rows in list(self.volumes.items()):
            parts = connected_parts([self.blocks[block][1][these] for block, these in rows.items()], len(self.points))
            nparts = 1 + max(int(part.max()) for part in parts)
            for number in range(nparts if nparts > 1 else 0):
                self.add_volume(f"{name}.part_{number + 1}",
                                {block: these[part == number]
                                 for (block, these), part in zip(rows.items(), parts)})

    def kinds_of(self, name):
        return sorted({self.blocks[block][0] for block in self.volumes[name]})


def connected_parts(tables, nnodes):
    """For each table of cells the number of the part of each cell, from 0, in the order of the first cells. Cells that
    share a node are in one part"""
    least = np.arange(nnodes)
    while True:
        before = least.copy()
        for cells in tables:
            np.minimum.at(least, cells, least[cells].min(axis=1)[:, None])
        least = least[least]
        if (least == before).all():
            break
    found = np.concatenate([least[cells[:, 0]] for cells in tables])
    _, first, inverse = np.unique(found, return_index=True, return_inverse=True)
    numbers = np.argsort(np.argsort(first))[inverse.ravel()]
    return np.split(numbers, np.cumsum([len(cells) for cells in tables])[:-1])


def corner_volumes(kind, cells, points):
    """Six times the volume of a tetrahedron; the determinant at the centre of a hexahedron"""
    x = points[cells]
    if KINDS[kind].ncorners == 4:
        edges = [x[:, corner] - x[:, 0] for corner in (1, 2, 3)]
    else:
        sides = (((1, 2, 5, 6), (0, 3, 4, 7)), ((2, 3, 6, 7), (0, 1, 4, 5)), ((4, 5, 6, 7), (0, 1, 2, 3)))
        edges = [
            x[:, up].mean(axis=1) - x[:, down].mean(axis=1)
            for up, down in map(lambda pair: (list(pair[0]), list(pair[1])), sides)
        ]
    return np.einsum("ci,ci->c", np.cross(edges[0], edges[1]), edges[2])


def turned(kind, cells, points):
    """MED numbers cells the other way round: cells of negative volume have two of their sides exchanged"""
    inverted = corner_volumes(kind, cells, points) < 0
    if not inverted.any():
        return cells
    swap = [0, 2, 1, 3] if KINDS[kind].ncorners == 4 else [4, 5, 6, 7, 0, 1, 2, 3]
    middle = {frozenset(edge[:2]): edge[2] for edge in KINDS[kind].edges}
    order = swap + [middle[frozenset((swap[a], swap[b]))] for a, b, _ in KINDS[kind].edges]
    if KINDS[kind].nnodes == 27:
        order += [20, 22, 21, 23, 24, 25, 26]
    cells = cells.copy()
    cells[inverted] = cells[inverted][:, order]
    return cells


def split_wedges(cells):
    """Three tetrahedra for each wedge. The diagonal of a quadrilateral begins at its smallest node, so that neighbours
    agree"""
    tetrahedra = []
    turns = ((0, 1, 2, 3, 4, 5), (1, 2, 0, 4, 5, 3), (2, 0, 1, 5, 3, 4), (3, 5, 4, 0, 2, 1), (4, 3, 5, 1, 0, 2),
             (5, 4, 3, 2, 1, 0))
    for cell in cells:
        a, b, c, d, e, f = cell[list(turns[int(np.argmin(cell))])]
        if min(b, f) < min(c, e):
            tetrahedra += [(a, b, c, f), (a, b, f, e), (a, e, f, d)]
        else:
            tetrahedra += [(a, b, c, e), (a, e, c, f), (a, e, f, d)]
    return np.array(tetrahedra, int).reshape(-1, 4)
