"""Input decks of Abaqus and CalculiX: nodes, solid elements, sets and surfaces. Parts and instances keep their
names."""
import copy
import os
import re

import numpy as np

from .model import FACETS, KINDS, Mesh, MeshError

SOLIDS = {
    "C3D4": "tetra", "C3D10": "tetra10", "C3D8": "hexahedron", "C3D20": "hexahedron20", "C3D27": "hexahedron27",
    "C3D6": "wedge", "C3D15": "wedge15", "C3D5": "pyramid"
}
SHELLS = {"3": "triangle", "4": "quad", "6": "triangle6", "8": "quad8", "9": "quad9"}
SHELL_TYPES = re.compile(r"(?:S|CPS|CPE|CAX|STRI|M3D|SFM3D|R3D|CGAX)(\d)\d?[A-Z]*\d?$")
NUMBER_OF_NODES = {"wedge": 6, "triangle": 3, "quad": 4, "triangle6": 6, "quad8": 8, "quad9": 9}


def element_kind(word):
    """(kind, dimension) of an element type; (None, 0) of one that is passed over"""
    for name, kind in sorted(SOLIDS.items(), key=lambda item: -len(item[0])):
        if re.fullmatch(name + r"[A-Z]*", word):
            return kind, 3
    if word.startswith("C3D") or word.startswith("SC"):
        return word, 3
    match = SHELL_TYPES.match(word)
    return (SHELLS[match[1]], 2) if match and match[1] in SHELLS else (None, 0)


def lines(path, seen=()):
    """(file, number, text) of all lines but comments, with those of included files"""
    if path in seen:
        raise MeshError(f"{path} includes itself")
    try:
        with open(path, encoding="latin-1") as file:
            for number, line in enumerate(file, 1):
                text = line.strip()
                if not text or text.startswith("**"):
                    continue
                if text.upper().replace(" ", "").startswith("*INCLUDE,"):
                    name = text.split("=", 1)[1].strip().strip('"')
                    yield from lines(os.path.join(os.path.dirname(path), name), (*seen, path))
                else:
                    yield path, number, text
    except OSError as error:
        raise MeshError(f"{path}: {error.strerror}") from None


def keyword_blocks(path):
    """(where, keyword, parameters, data lines) of each keyword. A line with parameters may end in a comma and continue
    in the next line; data have no ="""
    block, goes_on = None, False
    for file, number, text in lines(path):
        if text.startswith("*"):
            if block:
                yield block
            keyword, *words = text[1:].split(",")
            block = (f"{file}, line {number}", " ".join(keyword.upper().split()), read_parameters(words), [])
            goes_on = text.endswith(",")
        elif goes_on and "=" in text:
            block[2].update(read_parameters(text.split(",")))
            goes_on = text.endswith(",")
        elif block:
            block[3].append(text)
            goes_on = False
    if block:
        yield block


def read_parameters(words):
    pairs = [word.partition("=") for word in words if word.strip()]
    return {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}


class Part:
    """Nodes, elements, sets and surfaces as a deck numbers them"""

    def __init__(self):
        self.nodes, self.elements, self.nsets, self.elsets, self.surfaces = {}, {}, {}, {}, {}
        self.shells = {}  # element: (kind, nodes)
        self.formulations = {}  # element: letters after the number of nodes, such as R in C3D20R


def integers(where, data):
    try:
        return [int(word) for text in data for word in text.split(",") if word.strip()]
    except ValueError:
        raise MeshError(f"{where}: whole numbers are expected") from None


def read_nodes(part, where, parameters, data):
    for text in data:
        words = [word for word in text.split(",") if word.strip()]
        try:
            part.nodes[int(words[0])] = [float(word.upper().replace("D", "E")) for word in words[1:4]]
        except (ValueError, IndexError):
            raise MeshError(f"{where}: \"{text}\" is not a node's number and three coordinates") from None
        if len(part.nodes[int(words[0])]) != 3:
            raise MeshError(f"{where}: \"{text}\" is not a node's number and three coordinates")
    if parameters.get("NSET"):
        part.nsets.setdefault(parameters["NSET"], []).extend(int(text.split(",")[0]) for text in data)


def read_elements(part, where, parameters, data):
    word = parameters.get("TYPE", "").upper()
    kind, dim = element_kind(word)
    if not dim:
        return
    if kind not in KINDS and kind not in NUMBER_OF_NODES:
        raise MeshError(f"{where}: elements of type {word} are not read; C3D4, C3D10, C3D8, C3D20, C3D27 and C3D6 are")
    n = KINDS[kind].nnodes if kind in KINDS else NUMBER_OF_NODES[kind]
    numbers = integers(where, data)
    if len(numbers) % (n + 1):
        raise MeshError(f"{where}: the elements of type {word} do not have {n} nodes each")
    table = np.array(numbers, int).reshape(-1, n + 1)
    for row in table:
        (part.elements if dim == 3 else part.shells)[int(row[0])] = (kind, row[1:])
    part.formulations.update(dict.fromkeys(table[:, 0].tolist(), re.sub(r"C3D\d*", "", word)))
    if parameters.get("ELSET"):
        part.elsets.setdefault(parameters["ELSET"], []).extend(int(number) for number in table[:, 0])


def read_set(known, name, where, parameters, data):
    """Numbers, ranges, and names of sets that are known already"""
    found = known.setdefault(name, [])
    for text in data:
        words = [word.strip().strip('"') for word in text.split(",") if word.strip()]
        if "GENERATE" in parameters:
            first, last, *step = integers(where, [text])
            found.extend(range(first, last + 1, *step))
            continue
        for word in words:
            if re.fullmatch(r"[+-]?\d+", word):
                found.append(int(word))
            elif (other := named(known, word)) is not None:
                found.extend(other)
            else:
                raise MeshError(f"{where}: there is no set \"{word}\"")


def named(table, name):
    """Names of decks do not depend on their case"""
    return next((value for key, value in table.items() if key.upper() == name.upper()), None)


def read_surface(part, where, parameters, data):
    """A surface of sides of elements, or of nodes"""
    name = parameters.get("NAME", "")
    if not name:
        raise MeshError(f"{where}: a surface without NAME")
    if parameters.get("TYPE", "ELEMENT").upper() == "NODE":
        read_set(part.nsets, name, where, {}, [word for text in data for word in text.split(",")[:1]])
        return
    for text in data:
        words = [word.strip() for word in text.split(",")] + [""]
        part.surfaces.setdefault(name, []).append((where, words[0], words[1].upper()))


class Deck:
    """All parts, and the instances that an assembly makes of them"""

    def __init__(self, path, blocks):
        """blocks: those of keyword_blocks()"""
        self.path, self.parts, self.instances = path, {"": Part()}, []
        self.sets = {}  # {instance in capitals: a part with the sets of the assembly that belong to this instance}
        self.node_surfaces = []  # surfaces of nodes of the assembly: (where, name, names of sets)
        part, instance = self.parts[""], None
        for where, keyword, parameters, data in blocks:
            if keyword == "PART":
                part = self.parts.setdefault(parameters.get("NAME", ""), Part())
            elif keyword in ("END PART", "END INSTANCE"):
                part, instance = self.parts[""], None
            elif keyword == "INSTANCE":
                instance = (parameters.get("NAME", ""), parameters.get("PART", ""), motion(where, data))
                self.instances.append(instance)
            elif instance is None:
                self.read(part, where, keyword, parameters, data)

    def read(self, part, where, keyword, parameters, data):
        if keyword == "NODE":
            read_nodes(part, where, parameters, data)
        elif keyword == "ELEMENT":
            read_elements(part, where, parameters, data)
        elif keyword == "NSET" and "INSTANCE" not in parameters:
            read_set(part.nsets, parameters.get("NSET", ""), where, parameters, data)
        elif keyword == "ELSET" and "INSTANCE" not in parameters:
            read_set(part.elsets, parameters.get("ELSET", ""), where, parameters, data)
        elif keyword == "SURFACE" and self.instances and parameters.get("TYPE", "").upper() == "NODE":
            sets = [text.split(",")[0].strip() for text in data]
            self.node_surfaces.append((where, parameters.get("NAME", ""), sets))
        elif keyword == "SURFACE":
            read_surface(part, where, parameters, data)
        elif keyword in ("NSET", "ELSET"):
            self.read_instance_set(where, keyword, parameters, data)

    def read_instance_set(self, where, keyword, parameters, data):
        """A set of an assembly"""
        label = parameters["INSTANCE"].upper()
        if label not in (instance.upper() for instance, _, _ in self.instances):
            raise MeshError(f"{where}: there is no instance \"{parameters['INSTANCE']}\"")
        sets = self.sets.setdefault(label, Part())
        read_set(sets.nsets if keyword == "NSET" else sets.elsets, parameters.get(keyword, ""), where, parameters, data)


def motion(where, data):
    """The translation and rotation of an instance: a function of points"""
    shift, turn = np.zeros(3), None
    try:
        rows = [[float(word) for word in text.split(",") if word.strip()] for text in data]
    except ValueError:
        raise MeshError(f"{where}: a translation or a rotation is expected") from None
    if rows:
        shift = np.array(rows[0])
    if len(rows) > 1 and len(rows[1]) != 7:
        raise MeshError(f"{where}: a rotation has two points and an angle")
    if len(rows) > 1:
        start, end, angle = np.array(rows[1][:3]), np.array(rows[1][3:6]), np.radians(rows[1][6])
        axis = (end - start) / np.linalg.norm(end - start)
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        turn = (start, np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)

    def move(points):
        points = points + shift
        return points if turn is None else (points - turn[0]) @ turn[1].T + turn[0]

    return move


def add_part(mesh, part, label, points):
    """Adds a part. label: of a set's name"""
    at = {number: len(mesh.points) + place for place, number in enumerate(part.nodes)}
    mesh.points = np.concatenate([mesh.points, points])

    def connect(numbers):
        try:
            return [at[int(number)] for number in numbers]
        except KeyError as missing:
            raise MeshError(f"an element has the node {missing}, which is not given") from None

    place, tables = {}, {}
    for number, (kind, nodes) in part.elements.items():
        tables.setdefault(kind, []).append((number, connect(nodes)))
    for kind, rows in tables.items():
        block = mesh.add_block(kind, [nodes for _, nodes in rows])
        copies = len(mesh.blocks[block][1]) // len(rows)  # three tetrahedra for a wedge
        for row, (number, _) in enumerate(rows):
            place[number] = (block, range(copies * row, copies * (row + 1)), copies)
    for name, numbers in part.elsets.items():
        add_element_set(mesh, part, label(name), numbers, place, connect)
    for name, sides in part.surfaces.items():
        add_surface(mesh, part, label(name), sides, place)
    sets = {label(name): connect(number for number in numbers if number in at) for name, numbers in part.nsets.items()}
    return mesh.add_node_sets(sets)


def add_element_set(mesh, part, name, numbers, place, connect):
    rows = {}
    for number in numbers:
        if number in place:
            rows.setdefault(place[number][0], []).extend(place[number][1])
    mesh.add_volume(name, rows)
    facets = {}
    for number in numbers:
        if number in part.shells:
            kind, nodes = part.shells[number]
            facets.setdefault(kind, []).append(connect(nodes))
    for kind, table in facets.items():
        mesh.add_face(name, kind, table)


def add_surface(mesh, part, name, sides, place):
    for where, element, side in sides:
        numbers = [int(element)] if element.isdigit() else named(part.elsets, element)
        if numbers is None:
            raise MeshError(f"{where}: the surface \"{name}\" has an element set \"{element}\", which is not given")
        if not re.fullmatch(r"S[1-6]", side):
            raise MeshError(
                f"{where}: the surface \"{name}\" has \"{side or 'no side'}\" where a side S1 to S6 is expected")
        for number in numbers:
            block, rows, copies = place.get(number, (None, (), 1))
            if block is None:
                raise MeshError(f"{where}: the surface \"{name}\" has the element {number}, which is no solid")
            if copies > 1:
                raise MeshError(f"{where}: the surface \"{name}\" has sides of wedges; give it as a set of nodes")
            mesh.add_sides(name, block, rows, int(side[1]) - 1)


def read(path):
    """The mesh, and the names of the sets of nodes that are no face"""
    deck = Deck(path, keyword_blocks(path))
    mesh, left = Mesh(np.zeros((0, 3))), []
    alone = not deck.instances
    flat = deck.parts[""]
    if flat.nodes:
        left += add_part(mesh, flat, str, np.array(list(flat.nodes.values())))
    if alone:
        for name, part in deck.parts.items():
            if name and part.nodes:
                left += add_whole(mesh, part, name, np.array(list(part.nodes.values())))
    for instance, name, move in deck.instances:
        part = named(deck.parts, name)
        if part is None or not part.nodes:
            raise MeshError(f"the instance \"{instance}\" is of the part \"{name}\", which is not given")
        sets = deck.sets.get(instance.upper(), Part())
        whole = copy.copy(part)  # with the sets of the assembly
        whole.nsets, whole.elsets = {**part.nsets, **sets.nsets}, {**part.elsets, **sets.elsets}
        left += add_whole(mesh, whole, instance, move(np.array(list(part.nodes.values()))))
    merge_facets(mesh)
    mesh.finish()
    return mesh, left


def add_whole(mesh, part, name, points):
    """A part or an instance is a volume; its sets have its name before theirs"""
    before = len(mesh.blocks)
    left = add_part(mesh, part, lambda own: f"{name}.{own}", points)
    mesh.add_volume(name, {block: np.arange(len(mesh.blocks[block][1])) for block in range(before, len(mesh.blocks))})
    return left


def merge_facets(mesh):
    """One table of facets for each kind and face"""
    for name, tables in mesh.faces.items():
        kinds = {}
        for kind, facets in tables:
            kinds.setdefault(kind, []).append(facets)
        mesh.faces[name] = [(kind, np.concatenate(parts)) for kind, parts in kinds.items()]


def write(path, mesh):
    """A flat deck: nodes, solid elements, element sets, surfaces of sides"""
    names = {kind: word for word, kind in SOLIDS.items()}
    sides, corners = mesh.boundary()
    key = {tuple(ends): (int(block), int(row), int(side)) for (block, row, side), ends in zip(sides, corners)}
    first = np.cumsum([0, *(len(cells) for _, cells in mesh.blocks)])
    with open(path, "w") as file:
        file.write("*NODE\n")
        for number, x in enumerate(mesh.points, 1):
            file.write(f"{number}, {x[0]:.17g}, {x[1]:.17g}, {x[2]:.17g}\n")
        for (kind, cells), start in zip(mesh.blocks, first):
            file.write(f"*ELEMENT, TYPE={names[kind]}\n")
            for row, cell in enumerate(cells):
                numbers = [start + row + 1, *(cell + 1)]
                file.write("".join(", ".join(map(str, numbers[i:i + 16])) + (",\n" if i + 16 < len(numbers) else "\n")
                                   for i in range(0, len(numbers), 16)))
        for name, rows in mesh.volumes.items():
            numbers = np.concatenate([first[block] + these + 1 for block, these in rows.items()])
            file.write(f"*ELSET, ELSET={name}\n" + "".join(", ".join(map(str, numbers[i:i + 16])) + "\n"
                                                           for i in range(0, len(numbers), 16)))
        for name, tables in mesh.faces.items():
            file.write(f"*SURFACE, NAME={name}, TYPE=ELEMENT\n")
            for kind, facets in tables:
                for facet in facets:
                    ends = sorted([-1] * (4 - FACETS[kind]) + [int(node) for node in facet[:FACETS[kind]]])
                    if tuple(ends) not in key:
                        raise MeshError(f"the face \"{name}\" has a facet that is no side of one cell on the boundary")
                    block, row, side = key[tuple(ends)]
                    file.write(f"{first[block] + row + 1}, S{side + 1}\n")
