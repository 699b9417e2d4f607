"""What -check says of a mesh: sizes, volumes, areas, the shape of cells."""
import numpy as np

from .model import KINDS, corner_volumes

# Corners that the edges at each corner of a hexahedron lead to, right-handed
NEIGHBOURS = ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))
HEXAHEDRON_TETRAHEDRA = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 6, 4, 5), (3, 4, 6, 7), (1, 3, 4, 6))


def scaled_jacobian(kind, cells, points):
    """The smallest one of each cell's corners: 1 for a cube, 0 for a flat cell; sqrt(2) times that for tetrahedra"""
    x = points[cells]
    if KINDS[kind].ncorners == 8:
        rows = [[x[:, b] - x[:, a] for b in ends] for a, ends in enumerate(NEIGHBOURS)]
        factor = 1.0
    else:
        rows = [[x[:, b] - x[:, a]
                 for b in ends]
                for a, ends in enumerate(((1, 2, 3), (2, 0, 3), (0, 1, 3), (2, 1, 0)))]
        factor = np.sqrt(2.0)
    worst = np.full(len(cells), np.inf)
    for u, v, w in rows:
        lengths = np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1) * np.linalg.norm(w, axis=1)
        worst = np.minimum(worst, factor * np.einsum("ci,ci->c", np.cross(u, v), w) / np.where(lengths > 0, lengths, 1))
    return worst


def cell_volumes(kind, cells, points):
    """Of the cells with straight edges"""
    if KINDS[kind].ncorners == 4:
        return corner_volumes(kind, cells, points) / 6
    return sum(corner_volumes("tetra", cells[:, list(part)], points) for part in HEXAHEDRON_TETRAHEDRA) / 6


def facet_areas(facets, ncorners, points):
    x = points[facets[:, :ncorners]]
    if ncorners == 3:
        return np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
    return np.linalg.norm(np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]), axis=1) / 2
