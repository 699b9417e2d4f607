"""Checks of serendipity.sh: an independent computation of hexahedra of 20 nodes, and a uniform pressure."""
import itertools
import os
import sys

import numpy as np

sys.path[:0] = [os.path.join(os.environ["AMGF_DIR"], *folder) for folder in (("tests", "lib"), ("share", "python"))]
from contact.files import Files  # noqa: E402
from summaries import load, say  # noqa: E402

NODES = np.array([place for place in itertools.product((-1, 0, 1), repeat=3) if sum(x == 0 for x in place) <= 1], float)
YOUNG, POISSON = 1000.0, 0.3


def shapes(x):
    """Shape functions at a point of the cube, and their gradients by complex steps"""
    def values(at):
        found = []
        for node in NODES:
            value = np.prod([(1 + at[d] * node[d]) / 2 if node[d] else 1 - at[d]**2 for d in range(3)])
            found.append(value if 0 in node else value * (at @ node - 2))
        return np.array(found)

    steps = [values(np.array(x, complex) + 1e-30j * axis).imag / 1e-30 for axis in np.eye(3)]
    return values(np.array(x)), np.array(steps).T


def stiffness(half):
    """Of a brick with edges 2 half, by 27 points"""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    points, weights = np.polynomial.legendre.leggauss(3)
    found = np.zeros((20, 3, 20, 3))
    for i, j, k in itertools.product(range(3), repeat=3):
        grad = shapes((points[i], points[j], points[k]))[1] / half
        weight = weights[i] * weights[j] * weights[k] * np.prod(half)
        mixed = np.einsum("ac,bd->acbd", grad, grad)
        found += weight * (lame * mixed + shear * mixed.transpose(0, 3, 2, 1) +
                           shear * np.einsum("ad,bd,ce->acbe", grad, grad, np.eye(3)))
    return found.reshape(60, 60)


def cells():
    half = np.array([0.5, 0.5, 0.5])
    places, of_cell = {}, []
    for first in (0.5, 1.5):
        of_cell.append([places.setdefault(tuple(np.array([first, 0.5, 0.5]) + half * node), len(places))
                        for node in NODES])
    full = np.zeros((len(places), 3, len(places), 3))
    for numbers in of_cell:
        full[np.ix_(numbers, range(3), numbers, range(3))] += stiffness(half).reshape(20, 3, 20, 3)
    force = np.zeros((len(places), 3))
    force[places[2.0, 1.0, 1.0]] = [1, -2, 5]
    free = np.repeat([place[0] > 0 for place in places], 3)
    moved = np.zeros(3 * len(places))
    matrix = full.reshape(len(moved), -1)
    moved[free] = np.linalg.solve(matrix[np.ix_(free, free)], force.ravel()[free])
    return dict(zip(places, moved.reshape(-1, 3)))


def check():
    exact = cells()
    size = max(np.abs(value).max() for value in exact.values())
    for ranks in (1, 2):
        files = Files(f"cells_{ranks}")
        moves = files.displacement(files.step(None))
        found = {tuple(np.round(place, 9)): move for place, move in zip(files.vertices, moves)}
        off = max(np.abs(found[place] - move).max() for place, move in exact.items())
        say(f"{ranks} ranks: displacements of the nodes", off < 1e-8 * size, (off, size))
        for at in ((0, 0, 0), (0, 0, 1)):
            middle = np.array([1.5, 0.5, 0.5]) + np.array(at) / 2
            mean = sum(weight * found[tuple(middle + (node - at) / 2)] for weight, node in zip(shapes(at)[0], NODES)
                       if abs(weight) > 1e-12)
            off = np.abs(found[tuple(middle)] - mean).max()
            say(f"{ranks} ranks: the node at {tuple(middle)} follows", off < 1e-9 * size, (off, size))
        run = load(f"pressed_{ranks}")
        pair = run["steps"][-1]["pairs"][0]
        say(f"{ranks} ranks: force of the contact", abs(pair["normal_force"] - 6) < 1e-8, pair)
        files = Files(f"pressed_{ranks}")
        moves, top = files.displacement(files.step(None)), files.vertices[:, 2] == 2
        off = np.abs(moves[top, 2] + 6 / 1000 + 6 / 2000).max()
        say(f"{ranks} ranks: uniform strain through the contact", off < 1e-8, off)


check()
