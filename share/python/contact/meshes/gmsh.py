"""Writes Gmsh files of format 4.1. Cells that are in several volumes, and facets of several faces, stand there once"""
import numpy as np

from .model import FACETS

# Gmsh's number of a kind, and its nodes as places in Abaqus' order
KIND_NUMBERS = {
    "tetra": 4, "tetra10": 11, "hexahedron": 5, "hexahedron20": 17, "hexahedron27": 12, "triangle": 2, "triangle6": 9,
    "quad": 3, "quad8": 16, "quad9": 10
}
EDGES_20 = [8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14]
ORDERS = {
    "tetra10": [*range(8), 9, 8],
    "hexahedron20": [*range(8), *EDGES_20],
    "hexahedron27": [*range(8), *EDGES_20, 21, 23, 26, 24, 25, 22, 20],
}


class Group:
    """Elements of one dimension that have the same names: an entity of the file"""

    def __init__(self, dim, tags):
        self.dim, self.tags, self.tables = dim, tags, []


def volume_groups(mesh):
    groups = {}
    numbers, volumes = mesh.volume_labels()
    for (kind, cells), labels in zip(mesh.blocks, numbers):
        for label in np.unique(labels):
            rows = np.flatnonzero(labels == label)
            tags = tuple(volume + 1 for volume in volumes[label])
            groups.setdefault(tags, Group(3, tags)).tables.append((kind, cells[rows]))
    return list(groups.values())


def face_groups(mesh, first):
    """first: the tag of the first face"""
    names, facets = {}, {}
    for tag, tables in enumerate(mesh.faces.values(), first):
        for kind, table in tables:
            for facet in table:
                key = (kind, tuple(np.sort(facet[:FACETS[kind]])))
                facets.setdefault(key, facet)
                names.setdefault(key, []).append(tag)
    groups = {}
    for key, facet in facets.items():
        tags = tuple(sorted(set(names[key])))
        groups.setdefault((tags, key[0]), []).append(facet)
    entities = {}
    for (tags, kind), table in groups.items():
        entities.setdefault(tags, Group(2, tags)).tables.append((kind, np.array(table)))
    return list(entities.values())


def write(path, mesh):
    volumes = volume_groups(mesh)
    faces = face_groups(mesh, len(mesh.volumes) + 1)
    names = [(3, name) for name in mesh.volumes] + [(2, name) for name in mesh.faces]
    with open(path, "w") as file:
        file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")
        file.write(f"$PhysicalNames\n{len(names)}\n" +
                   "".join(f"{dim} {tag} \"{name}\"\n" for tag, (dim, name) in enumerate(names, 1)) +
                   "$EndPhysicalNames\n")
        file.write(f"$Entities\n0 0 {len(faces)} {len(volumes)}\n")
        box = " ".join(f"{x:.17g}" for x in (*mesh.points.min(axis=0), *mesh.points.max(axis=0)))
        for groups in (faces, volumes):
            for number, group in enumerate(groups, 1):
                file.write(f"{number} {box} {len(group.tags)} {' '.join(map(str, group.tags))} 0\n")
        file.write("$EndEntities\n")
        write_nodes(file, mesh.points)
        write_elements(file, [(group, number) for groups in (faces, volumes) for number, group in enumerate(groups, 1)])


def write_nodes(file, points):
    file.write(f"$Nodes\n1 {len(points)} 1 {len(points)}\n3 1 0 {len(points)}\n")
    file.write("\n".join(map(str, range(1, len(points) + 1))) + "\n")
    np.savetxt(file, points, fmt="%.17g")
    file.write("$EndNodes\n")


def write_elements(file, entities):
    total = sum(len(table) for group, _ in entities for _, table in group.tables)
    blocks = sum(len(group.tables) for group, _ in entities)
    file.write(f"$Elements\n{blocks} {total} 1 {total}\n")
    first = 1
    for group, number in entities:
        for kind, table in group.tables:
            file.write(f"{group.dim} {number} {KIND_NUMBERS[kind]} {len(table)}\n")
            table = table[:, ORDERS[kind]] if kind in ORDERS else table
            np.savetxt(file, np.column_stack([np.arange(first, first + len(table)), table + 1]), fmt="%d")
            first += len(table)
    file.write("$EndElements\n")
