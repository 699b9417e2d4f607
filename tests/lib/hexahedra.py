"""Hexahedra on a grid, with holes and slits, as a Gmsh file."""
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
SIDES = {
    "xmin": (0, 4, 7, 3), "xmax": (1, 2, 6, 5), "ymin": (0, 1, 5, 4), "ymax": (3, 7, 6, 2), "zmin": (0, 3, 2, 1),
    "zmax": (4, 5, 6, 7)
}


def grid(size, keep=lambda i, j, k: True, doubled=lambda i, j, k, cell: 0):
    """Points at whole numbers, cells, and the place of each cell; doubled: 1 for the second copy of a vertex, in cells
    at this height"""
    number, points, cells, places = {}, [], [], []
    for k in range(size[2]):
        for j in range(size[1]):
            for i in range(size[0]):
                if not keep(i, j, k):
                    continue
                cell = []
                for a, b, c in CORNERS:
                    at = (i + a, j + b, k + c)
                    key = at + (doubled(*at, k), )
                    if key not in number:
                        number[key] = len(points)
                        points.append(list(at))
                    cell.append(number[key])
                cells.append(cell)
                places.append((i, j, k))
    return points, cells, places


def outer_faces(cells, places, size, rest):
    """The boundary by the six sides of the grid; what is not on them is the face `rest`"""
    seen = {}
    for cell, place in zip(cells, places):
        for side, corners in SIDES.items():
            quad = [cell[a] for a in corners]
            seen.setdefault(frozenset(quad), []).append((place, side, quad))
    faces = {side: [] for side in SIDES}
    faces[rest] = []
    for place, side, quad in (found[0] for found in seen.values() if len(found) == 1):
        axis, end = "xyz".index(side[0]), side[1:] == "max"
        outer = place[axis] == (size[axis] - 1 if end else 0)
        faces[side if outer else rest].append(quad)
    return faces


def write(name, points, cells, faces):
    """Writes the volume `body` and its faces, lists of four vertices each"""
    elements = [(3, 2 + k, quad) for k, quads in enumerate(faces.values()) for quad in quads] + [(5, 1, cell)
                                                                                                 for cell in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(1 + len(faces)), '3 1 "body"']
    lines += ['2 %d "%s"' % (2 + k, face) for k, face in enumerate(faces)
              ] + ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += ["%d %.16g %.16g %.16g" % (k + 1, *point) for k, point in enumerate(points)
              ] + ["$EndNodes", "$Elements", str(len(elements))]
    for k, (kind, tag, nodes) in enumerate(elements):
        lines.append("%d %d 2 %d %d %s" % (k + 1, kind, tag, tag, " ".join(str(v + 1) for v in nodes)))
    with open(name, "w") as file:
        file.write("\n".join(lines + ["$EndElements", ""]))
