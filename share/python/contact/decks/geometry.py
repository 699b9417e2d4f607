"""Nodes, elements, sets and surfaces of a deck, numbered through all parts and instances, and the bodies they make."""
import re

import numpy as np

from ..meshes import abaqus
from ..meshes.model import FACETS, KINDS, Mesh, MeshError, connected_parts


class Geometry:
    """points: (n, 3); elements: [(kind, nodes)]; nsets, elsets, surfaces: {name in capitals: list}"""

    def __init__(self, deck):
        self.points, self.elements = np.zeros((0, 3)), []
        self.node_numbers, self.element_numbers, self.formulations = [], [], []
        self.nsets, self.elsets, self.surfaces, self.nodes_at, self.elements_at = {}, {}, {}, {}, {}
        self.spellings = {}
        alone = [(name, name, None) for name in deck.parts if name] if not deck.instances else deck.instances
        self.labels = {"": [""]}  # {part in capitals: its instances}
        for label, name, move in [*alone, ("", "", None)]:
            part = abaqus.named(deck.parts, name)
            if part is None:
                raise MeshError(f"the instance \"{label}\" is of the part \"{name}\", which is not given")
            if label:
                self.labels.setdefault(name.upper(), []).append(label)
            if part.nodes or not label:
                self.add(part, label.upper(), move, deck.sets.get(label.upper()) if deck.instances else part)
        for where, name, sets in deck.node_surfaces:
            self.nsets[name.upper()] = [node for one in sets for node in self.nodes_of(where, one)]

    def add(self, part, label, move, outside):
        """outside: a part with the sets that have no prefix"""
        points = np.array(list(part.nodes.values()), float).reshape(-1, 3)
        first = len(self.points)
        at = {number: first + place for place, number in enumerate(part.nodes)}
        self.node_numbers += list(part.nodes)
        self.points = np.concatenate([self.points, points if move is None else move(points)])
        prefix = f"{label}." if label else ""
        for number, place in at.items():
            self.nodes_at[prefix + str(number)] = place
        place = {}
        for number, (kind, nodes) in part.elements.items():
            place[number] = self.elements_at[prefix + str(number)] = len(self.elements)
            self.element_numbers.append(number)
            self.formulations.append(part.formulations[number])
            try:
                self.elements.append((kind, [at[int(node)] for node in nodes]))
            except KeyError as missing:
                raise MeshError(f"the element {number} has the node {missing}, which is not given") from None
        for start, sets in {"": outside, prefix: part}.items():
            if sets:
                self.add_sets(start, sets, at, place)
                self.add_surfaces(start, sets.surfaces, prefix)

    def add_surfaces(self, start, surfaces, prefix):
        for name, sides in surfaces.items():
            found = self.surfaces.setdefault(start + name.upper(), [])
            for where, element, side in sides:
                found += [(cell, side_number(where, name, side)) for cell in self.cells_of(where, element, prefix)]

    def add_sets(self, start, sets, at, place):
        """Adds sets of nodes and elements. start: begins their names"""
        for name, numbers in sets.nsets.items():
            self.nsets.setdefault(start + name.upper(), []).extend(at[number] for number in numbers if number in at)
            self.spellings[start + name.upper()] = name
        for name, numbers in sets.elsets.items():
            cells = [place[number] for number in numbers if number in place]
            self.elsets.setdefault(start + name.upper(), []).extend(cells)

    def cells_of(self, where, name, prefix=""):
        """Elements by the name of a set or a number"""
        for key in (prefix + name.upper(), name.upper()):
            if key in self.elsets:
                return self.elsets[key]
            if key in self.elements_at:
                return [self.elements_at[key]]
        raise MeshError(f"{where}: there is no solid element and no set of solid elements \"{name}\"")

    def nodes_of(self, where, name):
        """Nodes by the name of a set or a number"""
        if name.upper() in self.nsets:
            return self.nsets[name.upper()]
        if name.upper() in self.nodes_at:
            return [self.nodes_at[name.upper()]]
        raise MeshError(f"{where}: there is no node and no set of nodes \"{name}\"")

    def name_of(self, nodes):
        """The name of the set that has exactly these nodes; None: there is none"""
        return next((self.spellings[key] for key, those in self.nsets.items() if set(those) == nodes), None)

    def side_nodes(self, cell, side):
        kind, nodes = self.elements[cell]
        return [nodes[place] for place in KINDS[kind].sides[side]]


def side_number(where, name, side):
    if not re.fullmatch(r"S[1-6]", side):
        raise MeshError(f"{where}: the surface \"{name}\" has \"{side}\" where a side S1 to S6 is expected")
    return int(side[1]) - 1


class Bodies:
    """Connected parts of the elements of one material. Faces are found by name when something asks for them"""

    def __init__(self, geometry, sections):
        """sections: [(set name, elements, material)]"""
        self.geometry = geometry
        material_of, set_of = {}, {}
        for name, cells, material in sections:
            for cell in cells:
                material_of[cell], set_of[cell] = material, name
        self.left = [cell for cell in range(len(geometry.elements)) if cell not in material_of]
        part = self.parts(list(material_of))
        self.number, self.names, self.materials, self.cells = {}, [], [], []
        groups = {}
        for cell in material_of:
            groups.setdefault((part[cell], set_of[cell]), []).append(cell)
        counts = {}
        for _, name in groups:
            counts[name] = counts.get(name, 0) + 1
        taken = {}
        for (_, name), cells in groups.items():
            taken[name] = taken.get(name, 0) + 1
            body = len(self.names)
            self.names.append(self.unique(plain(name) + (f"_{taken[name]}" if counts[name] > 1 else "")))
            self.materials.append(material_of[cells[0]])
            self.cells.append(cells)
            for cell in cells:
                self.number[cell] = body
        self.find_sides()
        self.faces, self.known = {}, {}
        self.rigid = {}  # {name: sides}: rigid layers on these sides

    def unique(self, name):
        while name.upper() in (other.upper() for other in self.names):
            name += "_"
        return name

    def parts(self, cells):
        """{element: number of its connected part}"""
        kinds = {}
        for cell in cells:
            kinds.setdefault(self.geometry.elements[cell][0], []).append(cell)
        tables = [np.array([self.geometry.elements[cell][1] for cell in rows]) for rows in kinds.values()]
        if not tables:
            raise MeshError("no solid element has a *SOLID SECTION")
        found = {}
        for rows, numbers in zip(kinds.values(), connected_parts(tables, len(self.geometry.points))):
            found.update(zip(rows, numbers.tolist()))
        return found

    def find_sides(self):
        """Sides of one cell, and joints: sides of two cells in unlike bodies"""
        sides = {}
        for cell in self.number:
            for side in range(len(KINDS[self.kind(cell)].sides) if self.kind(cell) in KINDS else 0):
                corners = self.corners(cell, side)
                sides.setdefault(frozenset(corners), []).append((cell, side))
        self.boundary, self.joints = [], {}
        for both in sides.values():
            bodies = sorted({self.number[cell] for cell, _ in both})
            if len(both) == 1 or len(bodies) == 2:
                self.boundary += both
            if len(bodies) == 2:
                self.joints.setdefault(tuple(bodies), []).extend(both)
        self.body_nodes = [set() for _ in self.names]
        for cell, body in self.number.items():
            self.body_nodes[body].update(self.geometry.elements[cell][1])

    def kind(self, cell):
        return self.geometry.elements[cell][0]

    def corners(self, cell, side):
        nodes = self.geometry.side_nodes(cell, side)
        return nodes[:FACETS[KINDS[self.kind(cell)].facet]]

    def add_face(self, name, sides):
        """Names of the faces, one for each body that has some of these sides: [(body, face)]. The same sides have one
        name"""
        by_body = {}
        for side in sides:
            if side[0] in self.number:
                by_body.setdefault(self.number[side[0]], set()).add(side)
        found = []
        for body, these in sorted(by_body.items()):
            key = frozenset(these)
            if key not in self.known:
                label, count = plain(name), 1
                while label.upper() in self.faces and self.names_clash(label, body, key):
                    count += 1
                    label = f"{plain(name)}_{count}"
                self.known[key] = label
                self.faces.setdefault(label.upper(), (label, {}))[1][body] = sorted(these)
            found.append((body, self.known[key]))
        return found

    def names_clash(self, label, body, _):
        return body in self.faces[label.upper()][1]

    def divide_nodes(self, name, nodes):
        """([(body, face)], [(body, node)]): facets whose nodes are all in the set, and the nodes of no such facet. A
        face has the name of the set of its nodes if there is one"""
        inside = set(nodes)
        sides, covered, faces = {}, {}, []
        for cell, side in self.boundary:
            mine = self.geometry.side_nodes(cell, side)
            if inside.issuperset(mine):
                sides.setdefault(self.number[cell], []).append((cell, side))
                covered.setdefault(self.number[cell], set()).update(mine)
        for body, these in sorted(sides.items()):
            faces += self.add_face(self.geometry.name_of(covered[body]) or name, these)
        points = [(body, node)
                  for body, mine in enumerate(self.body_nodes)
                  for node in sorted(inside & mine)
                  if node not in covered.get(body, ())]
        held = set().union(*self.body_nodes)
        return faces, points, sorted(inside - held)

    def normal(self, cell, side):
        """Outward normal of a side, as long as its area"""
        x = self.geometry.points[self.corners(cell, side)]
        normal = np.cross(x[2] - x[0], x[-1] - x[1]) / 2
        outward = x.mean(axis=0) - self.geometry.points[self.geometry.elements[cell][1]].mean(axis=0)
        return normal if np.dot(normal, outward) > 0 else -normal

    def facets_facing(self, nodes, others):
        """Boundary sides that face the sides `others`: they have one of the nodes, and the angle between their normal
        and the reversed mean normal of the others is below 60 degrees"""
        mean, inside = sum((self.normal(*side) for side in others), np.zeros(3)), set(nodes)
        found = []
        for side in self.boundary:
            normal = self.normal(*side)
            if inside.intersection(self.geometry.side_nodes(*side)) and 2 * np.dot(
                    normal, mean) < -np.linalg.norm(normal) * np.linalg.norm(mean):
                found.append(side)
        return found

    def mesh(self):
        """A mesh with a volume for each body and the faces that were asked for"""
        mesh, place = Mesh(self.geometry.points), {}
        for body, name in enumerate(self.names):
            kinds = {}
            for cell in self.cells[body]:
                kinds.setdefault(self.kind(cell), []).append(cell)
            if len({KINDS[kind].ncorners if kind in KINDS else 4 for kind in kinds}) > 1:
                raise MeshError(f"the body \"{name}\" has cells of the kinds {' and '.join(sorted(kinds))}; a body has "
                                f"either hexahedra or tetrahedra, of which wedges are made")
            for kind, cells in kinds.items():
                block = mesh.add_block(kind, [self.geometry.elements[cell][1] for cell in cells])
                copies = len(mesh.blocks[block][1]) // len(cells)
                for row, cell in enumerate(cells):
                    place[cell] = (block, row)
                mesh.add_volume(name, {block: np.arange(copies * len(cells))})
        for label, bodies in self.faces.values():
            for cell, side in (pair for pairs in bodies.values() for pair in pairs):
                mesh.add_sides(label, place[cell][0], [place[cell][1]], side)
        for name, sides in self.rigid.items():
            self.add_rigid(mesh, name, sides)
        abaqus.merge_facets(mesh)
        mesh.finish()
        return mesh

    def add_rigid(self, mesh, name, sides):
        """A layer of cells of order 1 on the outside of facets: hexahedra on quadrilaterals, tetrahedra on triangles"""
        facets = [self.corners(*side) for side in sides]
        normals = [normal / np.linalg.norm(normal)**0.5 for normal in (self.normal(*side) for side in sides)]
        nodes = sorted({node for facet in facets for node in facet})
        at = {node: len(mesh.points) + k for k, node in enumerate(nodes)}
        around = {node: [] for node in nodes}
        for facet, normal in zip(facets, normals):
            for node in facet:
                around[node].append(normal)
        inner, n = self.geometry.points[nodes], len(nodes)
        apexes = [self.geometry.points[facet].mean(axis=0) + normal for facet, normal in zip(facets, normals)]
        mesh.points = np.concatenate([mesh.points, inner, inner + [np.mean(around[node], axis=0) for node in nodes],
                                      apexes])
        for kind, count in (("hexahedron", 4), ("tetra", 3)):
            rows = [[*(at[node] for node in facet),
                     *([at[node] + n for node in facet] if count == 4 else [at[nodes[0]] + 2 * n + k])]
                    for k, facet in enumerate(facets) if len(facet) == count]
            if rows:
                block = mesh.add_block(kind, rows)
                mesh.add_volume(name, {block: np.arange(len(rows))})
                mesh.add_sides(f"{name}_surface", block, np.arange(len(rows)), 0)


def local_axes(kind, one, two, point):
    """Rows: the axes of a *TRANSFORM at a point. R: one is on the first axis, two in the plane of the first two. C: the
    points are on the axis of a cylinder; the axes are radial, tangential and axial"""
    if kind.startswith("C"):
        third = (two - one) / np.linalg.norm(two - one)
        first = point - one - np.dot(point - one, third) * third
    else:
        first, third = one, np.cross(one, two)
    first, third = first / np.linalg.norm(first), third / np.linalg.norm(third)
    axes = np.array([first, np.cross(third, first), third])
    return np.where(abs(axes) < 1e-12, 0.0, axes)


def plain(name):
    """A name as scenes have them"""
    name = re.sub(r"[^A-Za-z0-9_-]", "_", name)
    return name if name[:1].isalpha() else "S" + name
