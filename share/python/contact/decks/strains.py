"""Strains at the nodes of a deck, as CalculiX extrapolates them: from points in the cells to corners, whose means the
nodes of edges get, and the mean over the cells around a node. Values at the points of integration of its cells."""
import itertools

import numpy as np

HEXAHEDRON = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1),
                       (-1, 1, 1)], float)
TETRAHEDRON = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
WEDGE = np.array([(x, y, z) for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))], float)
BRICK_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TETRA_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
FIRST = list(itertools.product((0, 1), repeat=3))
SIMPLEX = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
GAUSS = HEXAHEDRON / 3**0.5
INNER = 0.1381966011250105 + 0.4472135954999579 * TETRAHEDRON
# corners, edges, powers of the shape functions, points of the strains, powers that are extrapolated from the points
CELLS = {
    "hexahedron": (HEXAHEDRON, [], FIRST, GAUSS, FIRST),
    "hexahedron20": (HEXAHEDRON, BRICK_EDGES, [p for p in itertools.product((0, 1, 2), repeat=3) if p.count(2) < 2],
                     GAUSS, FIRST),
    "tetra": (TETRAHEDRON, [], SIMPLEX, TETRAHEDRON[:1] + 0.25, SIMPLEX[:1]),
    "tetra10": (TETRAHEDRON, TETRA_EDGES, [p for p in itertools.product((0, 1, 2), repeat=3) if sum(p) < 3], INNER,
                SIMPLEX),
    "wedge": (WEDGE, [], [p for p in FIRST if p[:2] != (1, 1)], np.array([[1 / 3, 1 / 3, 0]]), SIMPLEX[:1]),
}
CELLS["hexahedron27"] = CELLS["hexahedron20"]  # without the nodes inside its sides
# points of integration, the first coordinate fastest
TWO, THREE = (np.array(list(itertools.product(places, repeat=3)))[:, ::-1] for places in
              ((-3**-0.5, 3**-0.5), (-0.6**0.5, 0.0, 0.6**0.5)))
INTEGRATED = {
    "hexahedron": (TWO, np.zeros((1, 3))), "hexahedron20": (THREE, TWO), "hexahedron27": (THREE, TWO),
    "tetra": (TETRAHEDRON[:1] + 0.25, ) * 2, "tetra10": (INNER, ) * 2,
    "wedge": (np.array([[1 / 3, 1 / 3, z] for z in (-3**-0.5, 3**-0.5)]), ) * 2
}


def powers(points, exponents):
    """(points, exponents): x^i y^j z^k"""
    return np.prod(points[:, None, :]**np.array(exponents)[None], axis=2)


def slopes(points, exponents):
    """(points, 3, exponents): derivatives of x^i y^j z^k"""
    exponents = np.array(exponents)
    lowered = np.maximum(exponents[None] - np.eye(3, dtype=int)[:, None], 0)
    return np.stack([exponents[:, d] * powers(points, lowered[d]) for d in range(3)], axis=1)


def shape_nodes(kind):
    """Places of the nodes of a cell"""
    corners, edges = CELLS[kind][:2]
    return np.concatenate([corners, corners[np.array(edges, int).reshape(-1, 2)].mean(axis=1)])


def interpolate(kind, reduced, values):
    """(points, columns): values at the points of integration of a cell from those at its nodes"""
    nodes, shape = shape_nodes(kind), CELLS[kind][2]
    return powers(INTEGRATED[kind][reduced], shape) @ np.linalg.inv(powers(nodes, shape)) @ values[:len(nodes)]


def cell_strains(kind, x, u, finite):
    """(cells, nodes, 6): strains xx, yy, zz, xy, yz, zx at the nodes of cells of one kind. x, u: (cells, nodes, 3);
    finite: Green's strain"""
    corners, edges, shape, points, fit = CELLS[kind]
    ends = np.array(edges, int).reshape(-1, 2)
    nodes = shape_nodes(kind)
    dN = slopes(points, shape) @ np.linalg.inv(powers(nodes, shape))
    x, u = x[:, :len(nodes)], u[:, :len(nodes)]
    H = np.linalg.solve(dN @ x[:, None], dN @ u[:, None])  # (cells, points, 3, 3): H[i][k] = d u_k / d x_i
    strain = (H + np.swapaxes(H, 2, 3)) / 2 + (H @ np.swapaxes(H, 2, 3) / 2 if finite else 0.0)
    values = strain[:, :, [0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
    at_corners = powers(corners, fit) @ np.linalg.inv(powers(points, fit)) @ values
    return np.concatenate([at_corners, at_corners[:, ends].mean(axis=2)], axis=1)


def node_strains(geometry, cells, u, finite):
    """(nodes of the deck, 6) from the displacements u of the nodes"""
    total, count, kinds = np.zeros((len(geometry.points), 6)), np.zeros(len(geometry.points)), {}
    for cell in cells:
        kind, nodes = geometry.elements[cell]
        kinds.setdefault(kind, []).append(nodes)
    for kind, nodes in kinds.items():
        nodes = np.array(nodes)
        strain = cell_strains(kind, geometry.points[nodes], u[nodes], finite)
        nodes = nodes[:, :strain.shape[1]]
        np.add.at(total, nodes, strain)
        np.add.at(count, nodes, 1)
    return total / np.maximum(count, 1)[:, None]
