"""ADJUST of contact pairs: moves nodes of the slave surface onto the master surface, without strain."""
import numpy as np


def triangles(geometry, sides):
    """Corners of the triangles of facets, (n, 3, 3), counterclockwise seen from outside"""
    found = []
    for cell, side in sides:
        nodes = geometry.side_nodes(cell, side)
        corners = nodes[:4] if len(nodes) in (4, 8, 9) else nodes[:3]
        inner = geometry.points[geometry.elements[cell][1]].mean(axis=0)
        x = geometry.points[corners]
        if np.dot(np.cross(x[1] - x[0], x[2] - x[0]), x[0] - inner) < 0:
            x = x[::-1]
        found += [x[[0, k, k + 1]] for k in range(1, len(x) - 1)]
    return np.array(found)


def closest(point, corners):
    """The closest point on each triangle: the best of the foot of the perpendicular and the feet on the three edges"""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    foot = point - np.einsum("ij,ij->i", point - a, normal)[:, None] * normal
    inside = np.ones(len(a), bool)
    best, least = foot.copy(), np.full(len(a), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        edge = end - start
        inside &= np.einsum("ij,ij->i", np.cross(edge, foot - start), normal) >= 0
        along = np.clip(np.einsum("ij,ij->i", point - start, edge) / np.einsum("ij,ij->i", edge, edge), 0, 1)
        place = start + along[:, None] * edge
        distance = np.linalg.norm(point - place, axis=1)
        best[distance < least] = place[distance < least]
        least = np.minimum(least, distance)
    best[inside] = foot[inside]
    return best, normal


def distances(geometry, nodes, sides):
    """Distances of nodes from facets, negative inside"""
    corners, found = triangles(geometry, sides), []
    for node in nodes:
        places, normals = closest(geometry.points[node], corners)
        off = geometry.points[node] - places
        k = np.linalg.norm(off, axis=1).argmin()
        found.append(float(np.dot(off[k], normals[k])))
    return np.array(found)


def adjust(geometry, nodes, sides, distance):
    """Moves the nodes that are nearer than `distance`, or inside by less than the size of a facet, onto the facets.
    Returns how many were moved, and the largest movement"""
    corners = triangles(geometry, sides)
    size = np.sqrt(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).max())
    moved, largest = 0, 0.0
    for node in set(nodes):
        point = geometry.points[node]
        places, normals = closest(point, corners)
        off = np.linalg.norm(point - places, axis=1)
        k = off.argmin()
        limit = distance if np.dot(point - places[k], normals[k]) >= 0 else size
        if 0 < off[k] <= limit:
            geometry.points[node] = places[k]
            moved, largest = moved + 1, max(largest, float(off[k]))
    return moved, largest
