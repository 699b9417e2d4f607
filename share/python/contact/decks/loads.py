"""The sections of a scene: bodies, what holds and loads them, contact, ties, load program."""
import numpy as np

from ..meshes.model import KINDS, MeshError
from . import materials
from .geometry import plain
from .steps import STICKS

NAMED_BOUNDARIES = {
    "XSYMM": (1, ), "YSYMM": (2, ), "ZSYMM": (3, ), "PINNED": (1, 2, 3), "ENCASTRE": (1, 2, 3), "XASYMM": (2, 3),
    "YASYMM": (1, 3), "ZASYMM": (1, 2)
}
FINITE = ("saint_venant", "neohookean", "mooney_rivlin", "j2_finite")


def sections(deck, bodies, mesh_file):
    found = {}
    laws = {key: material_law(deck, key) for key in dict.fromkeys(bodies.materials)}
    names = name_materials(laws)
    found["materials"] = [(names[key], law) for key, law in laws.items()]
    found["bodies"] = body_entries(deck, bodies, mesh_file, names, laws)
    contact, ties = contact_entries(deck, bodies)  # first, so that faces have the names of the deck's surfaces
    found["equations"] = equation_entries(deck, bodies)
    found["displacements"], found["symmetry"] = displacement_entries(deck, bodies)
    found["forces"] = force_entries(deck, bodies) + distributed_entries(deck, bodies)
    found["pressures"] = pressure_entries(deck, bodies, laws)
    found["body_forces"] = gravity_entries(deck, bodies, laws)
    found["temperatures"] = temperature_entries(deck, laws)
    found["contact"], found["ties"] = contact, ties + joint_entries(bodies)
    for key, entries in rigid_entries(deck, bodies, mesh_file).items():
        found[key] += entries
    found["cyclic"] = cyclic_entries(deck, bodies)
    program(deck, found)
    return found


def material_law(deck, key):
    material, orientation = key
    if orientation and orientation not in deck.orientations:
        raise MeshError(f"{deck.materials[material].where}: there is no orientation \"{orientation}\"")
    return materials.law(deck.materials[material], deck.finite, deck.orientations.get(orientation), deck.notes)


def name_materials(laws):
    names = {}
    for material, orientation in laws:
        name = plain(material.lower() + (f"_{orientation.lower()}" if orientation else ""))
        while name in names.values() or name in ("linear", "neohookean", "saint_venant", "mooney_rivlin", "orthotropic",
                                                 "j2", "j2_finite", "rigid"):
            name += "_"
        names[material, orientation] = name
    return names


def body_entries(deck, bodies, mesh_file, names, laws):
    found = []
    velocity = initial_velocities(deck, bodies)
    for body, name in enumerate(bodies.names):
        kinds = {bodies.kind(cell) for cell in bodies.cells[body]}
        keys = {"mesh": mesh_file, "volume": name, "material": names[bodies.materials[body]]}
        keys["order"] = max(KINDS[kind].order if kind in KINDS else 1 for kind in kinds)
        if "hexahedron20" in kinds:
            keys["serendipity"] = "true"
        element = element_word(deck, bodies.cells[body], kinds, laws[bodies.materials[body]]["law"])
        if element:
            keys["element"] = element
        if body in velocity:
            keys["initial_velocity"] = velocity[body]
        found.append((name, keys))
    return found


def element_word(deck, cells, kinds, law):
    """The element that CalculiX has by this name; None: the program chooses"""
    letters = {deck.geometry.formulations[cell] for cell in cells}
    if letters == {""}:
        return "full"
    if letters == {"R"} and kinds == {"hexahedron20"}:
        return "reduced"
    return "incompatible" if letters == {"I"} and law in ("linear", "orthotropic", "j2") else None


def initial_velocities(deck, bodies):
    found = {}
    for where, nodes, axis, value in deck.velocities:
        for body, mine in enumerate(bodies.body_nodes):
            inside = mine & set(nodes)
            if inside and inside != mine:
                deck.notes.refuse("INITIAL CONDITIONS", where, f"the velocity is given on a part of the body "
                                  f"\"{bodies.names[body]}\"")
            elif inside:
                found.setdefault(body, [0.0, 0.0, 0.0])[axis] = value
    return found


def point_keys(deck, bodies, keyword, where, node, names=("body", "point")):
    """The keys of a point of a body; empty if no solid element has the node"""
    body = next((b for b, mine in enumerate(bodies.body_nodes) if node in mine), None)
    if body is None:
        deck.notes.refuse(keyword, where, nodes_text(deck, [node]))
        return {}
    return {names[0]: bodies.names[body], names[1]: deck.geometry.points[node]}


def equation_entries(deck, bodies):
    """Equations, and displacements along axes of *TRANSFORM"""
    found = []
    for where, terms in deck.equations:
        keys = {}
        for (node, parts), names in zip(terms.items(),
                                        (("body", "point", "direction"), ("to", "to_point", "to_direction"))):
            direction = sum(factor * deck.axis(node, dof) for dof, factor in parts)
            keys.update({**point_keys(deck, bodies, "EQUATION", where, node, names), names[2]: direction})
        found.append((f"equation_{len(found) + 1}", keys))
    for (node, axis), values in deck.displacements.values.items():
        if isinstance(axis, tuple):
            value, ramp = deck.ramps.split(values, deck.displacements.starts.get((node, axis), 0.0))
            keys = point_keys(deck, bodies, "BOUNDARY", deck.displacements.lines[node, axis], node)
            keys.update(direction=axis, **({"value": value} if value else {}), **({"ramp": ramp} if ramp else {}))
            found.append((f"equation_{len(found) + 1}", keys))
    return found


def grouped(deck, histories):
    """[(ramp, {component: value}, keys)]: components along axes with one ramp on the same nodes are together"""
    sets = {}
    for (node, axis), values in histories.values.items():
        if isinstance(axis, tuple) or node in deck.rotations:
            continue
        value, ramp = deck.ramps.split(values, histories.starts.get((node, axis), 0.0))
        sets.setdefault((axis, value, ramp), set()).add(node)
    merged = {}
    for (axis, value, ramp), nodes in sets.items():
        merged.setdefault((ramp, frozenset(nodes)), {})[axis] = value
    return [(ramp, values, nodes) for (ramp, nodes), values in merged.items()]


def displacement_entries(deck, bodies):
    found, planes = [], []
    for number, (ramp, values, nodes) in enumerate(grouped(deck, deck.displacements), 1):
        faces, points, loose = bodies.divide_nodes(f"held_{number}", nodes)
        if loose:
            deck.notes.approximate("BOUNDARY", deck.displacements.lines[loose[0], min(values)], nodes_text(deck, loose))
        value = [values.get(axis, "free") for axis in range(3)]
        end = {"ramp": ramp} if ramp else {}
        for body, face in faces:
            name = f"{bodies.names[body]}.{face}"
            axis = next(iter(values))
            if len(values) == 1 and not any(values.values()) and is_plane(bodies, body, face, axis):
                planes.append((f"plane_{len(planes) + 1}", {"face": name, "normal": "xyz"[axis]}))
            else:
                found.append((f"held_{len(found) + 1}", {"face": name, "value": value, **end}))
        for body, node in points:
            found.append((f"held_{len(found) + 1}",
                          {"body": bodies.names[body], "point": deck.geometry.points[node], "value": value, **end}))
    return found, planes


def nodes_text(deck, nodes):
    shown = ", ".join(str(deck.geometry.node_numbers[node]) for node in nodes[:6])
    return f"nodes of no solid element, left out: {shown}" + (f" and {len(nodes) - 6} more" if len(nodes) > 6 else "")


def is_plane(bodies, body, face, axis):
    """Whether a face is in a plane normal to an axis"""
    nodes = [
        node for cell, side in bodies.faces[face.upper()][1][body] for node in bodies.geometry.side_nodes(cell, side)
    ]
    x = bodies.geometry.points[nodes][:, axis]
    size = np.ptp(bodies.geometry.points[sorted(bodies.body_nodes[body])], axis=0).max()
    return np.ptp(x) <= 1e-6 * size


def force_entries(deck, bodies):
    found = []
    for ramp, values, nodes in grouped(deck, deck.forces):
        if not any(values.values()):
            continue
        for node in sorted(nodes):
            place = point_keys(deck, bodies, "CLOAD", deck.forces.lines[node, min(values)], node)
            if place:
                keys = {**place, "value": [values.get(axis, 0.0) for axis in range(3)]}
                found.append((f"force_{len(found) + 1}", {**keys, **({"ramp": ramp} if ramp else {})}))
    return found


def pressure_entries(deck, bodies, laws):
    groups, found = {}, []
    for side, values in deck.pressures.values.items():
        value, ramp = deck.ramps.split(values, deck.pressures.starts.get(side, 0.0))
        if value:
            groups.setdefault((value, ramp), []).append(side)
    friction = any(i.friction for i in deck.interactions.values())
    for number, ((value, ramp), sides) in enumerate(groups.items(), 1):
        for body, face in bodies.add_face(f"loaded_{number}", sides):
            keys = {"face": f"{bodies.names[body]}.{face}", "value": value}
            if laws[bodies.materials[body]]["law"] in FINITE:
                if friction or deck.steps[0].kind == "dynamic":
                    deck.notes.approximate(
                        "DLOAD", deck.pressures.lines[sides[0]], "the pressure keeps its direction, "
                        "because pressures that follow faces exclude friction and dynamics")
                else:
                    keys["follows"] = True
            found.append((f"pressure_{len(found) + 1}", {**keys, **({"ramp": ramp} if ramp else {})}))
    return found


def gravity_entries(deck, bodies, laws):
    groups = {}
    for (cells, axis), values in deck.bodies_loads.values.items():
        value, ramp = deck.ramps.split(values, deck.bodies_loads.starts.get((cells, axis), 0.0))
        if value:
            groups.setdefault((cells, ramp), [0.0, 0.0, 0.0])[axis] = value
    found = []
    for (cells, ramp), value in groups.items():
        where = next(line for (these, _), line in deck.bodies_loads.lines.items() if these == cells)
        for body, mine in enumerate(bodies.cells):
            inside = cells.intersection(mine)
            if inside and len(inside) < len(mine):
                deck.notes.refuse("DLOAD", where, f"gravity acts on a part of the body \"{bodies.names[body]}\"")
            elif inside:
                density = laws[bodies.materials[body]].get("density", 0.0)
                if not density:
                    raise MeshError(f"{where}: gravity acts on the body \"{bodies.names[body]}\" without *DENSITY")
                found.append((f"gravity_{len(found) + 1}", {
                    "body": bodies.names[body], "value": [density * one for one in value],
                    **({"ramp": ramp} if ramp else {})
                }))
    return found


def temperature_entries(deck, laws):
    """Uniform temperatures: the same at all nodes"""
    if not any("expansion" in law for law in laws.values()):
        return []
    zero, values = 0.0, []
    for step, where, data in deck.temperature_steps:
        rows = [text.split(",") for text in data]
        given = {float(row[1]) for row in rows}
        nodes = {node for row in rows for node in deck.geometry.nodes_of(where, row[0].strip())}
        if len(given) > 1 or len(nodes) < len(deck.geometry.points):
            deck.notes.refuse("TEMPERATURE", where, "the temperature is not the same at all nodes")
            return []
        if step is None:
            zero = given.pop()
        else:
            values.append((step, given.pop()))
    table, now = [], zero
    for step in deck.steps:
        end = next((value for other, value in values if other is step), now)
        table += [now + (end - now) * time / step.period - zero for time in step.times()]
        now = end
    value, ramp = deck.ramps.split(table)
    return [("temperature", {"value": value, **({"ramp": ramp} if ramp else {})})] if value else []


def surface_faces(deck, bodies, where, name, master=""):
    """[(body, face)] of a surface of sides or nodes. master: surface that it is in contact with"""
    if name.upper() in deck.geometry.surfaces:
        return bodies.add_face(name, deck.geometry.surfaces[name.upper()])
    nodes = deck.geometry.nodes_of(where, name)
    faces, points, _ = bodies.divide_nodes(name, nodes)
    if not faces:
        faces = bodies.add_face(name, bodies.facets_facing(nodes, deck.geometry.surfaces.get(master.upper(), [])))
        if faces:
            deck.notes.approximate(
                "SURFACE", where, f"\"{name}\" holds no whole facet: contact of all facets at its "
                f"nodes that face the master surface")
    if not faces:
        deck.notes.refuse(
            "CONTACT PAIR", where, f"the surface \"{name}\" holds no whole facet: contact of points and "
            f"edges is not supported")
    elif points:
        deck.notes.approximate(
            "SURFACE", where, f"{len(points)} nodes of \"{name}\" belong to no whole facet of it: no "
            f"contact there")
    return faces


def contact_entries(deck, bodies):
    pairs, ties = [], []
    for where, slave, master, name, kind, adjusted in deck.pairs:
        if name not in deck.interactions:
            raise MeshError(f"{where}: there is no surface interaction \"{name}\"")
        interaction = deck.interactions[name]
        for body, face in surface_faces(deck, bodies, where, slave, master):
            for other, opposite in surface_faces(deck, bodies, where, master):
                keys = {"mortar": f"{bodies.names[other]}.{opposite}", "nonmortar": f"{bodies.names[body]}.{face}"}
                if interaction.law == "TIED":
                    ties.append((f"tied_{len(ties) + 1}", keys))
                    continue
                if kind == "NODE TO SURFACE":
                    keys["gap"] = "node"
                if adjusted:  # the smooth surface through nodes that were moved would overlap the other one
                    keys["smooth"] = False
                keys.update(interaction.soft)
                keys.update(friction_keys(deck, interaction))
                keys.update(activity_keys(deck, bodies, (slave.upper(), master.upper())))
                pairs.append((f"pair_{len(pairs) + 1}", keys))
    for where, _, slave, master, tolerance, cyclic in deck.ties.values():
        if cyclic:
            continue
        for body, face in surface_faces(deck, bodies, where, slave):
            for other, opposite in surface_faces(deck, bodies, where, master):
                keys = {"mortar": f"{bodies.names[other]}.{opposite}", "nonmortar": f"{bodies.names[body]}.{face}"}
                ties.append((f"tie_{len(ties) + 1}", {**keys, **({"distance": float(tolerance)} if tolerance else {})}))
    return pairs, ties


def friction_keys(deck, interaction):
    largest = max(interaction.frictions, default=0.0)
    if largest >= STICKS:
        return {"stick": True}
    if largest == 0.0:
        return {}
    keys = {"friction": largest}
    if min(interaction.frictions) < largest:
        table = np.array(interaction.frictions) / largest
        keys["friction_ramp"] = deck.ramps.name([table[0], *table]) or "load"
    return keys


def activity_keys(deck, bodies, key):
    """A pair that is removed in some steps is opened there by the size of the model; *CLEARANCE changes its gap. The
    gap is larger by (1 - factor) times the interference"""
    steps = sum(step.n for step in deck.steps)
    active = np.array(deck.active[key][1] if key in deck.active else [1.0] * steps)
    size, clearance = float(np.ptp(bodies.geometry.points, axis=0).max()), deck.clearances.get(key, 0.0)
    if active.all() and not clearance:
        return {}
    table = active * (1.0 - clearance / size)
    return {"interference": size, "ramp": deck.ramps.name([table[0], *table]) or "load"}


def rigid_entries(deck, bodies, mesh_file):
    """Rigid bodies on faces: layers of rigid cells, to which the faces are tied"""
    found = {"bodies": [], "ties": [], "displacements": [], "forces": []}
    for number, (where, nodes, reference) in enumerate(deck.rigid, 1):
        name = f"rigid_{number}"
        faces, points, loose = bodies.divide_nodes(name, nodes)
        if points or set(loose) - {reference} or not faces or deck.steps[0].kind == "dynamic":
            deck.notes.refuse("RIGID BODY", where, "only whole facets can be rigid, and only in static steps")
            continue
        found["bodies"].append((name, {"mesh": mesh_file, "volume": name, "material": "rigid"}))
        bodies.rigid[name] = [side for body, face in faces for side in bodies.faces[face.upper()][1][body]]
        for body, face in faces:
            found["ties"].append((f"{name}_{face}", {
                "mortar": f"{name}.{name}_surface", "nonmortar": f"{bodies.names[body]}.{face}"
            }))
        point = deck.geometry.points[reference]
        for ramp, six in motions(deck, deck.displacements, reference, "free"):
            keys = {"body": name, "value": six[:3], "center": point}
            keys["rotation"] = [angle if angle == "free" else np.degrees(angle) for angle in six[3:]]
            found["displacements"].append((f"{name}_{ramp or 'load'}", {**keys, **({"ramp": ramp} if ramp else {})}))
        for ramp, six in motions(deck, deck.forces, reference, 0.0):
            keys = {"body": name, "value": six[:3], "moment": six[3:], "point": point}
            found["forces"].append((f"{name}_{ramp or 'load'}", {**keys, **({"ramp": ramp} if ramp else {})}))
    return found


def distributed_entries(deck, bodies):
    """Forces and moments on the nodes of *DISTRIBUTING, as tractions"""
    found = []
    for where, sides, reference in deck.distributed:
        faces = bodies.add_face(f"coupled_{len(found) + 1}", sides)
        if len(faces) != 1 or any((reference, axis) in deck.displacements.values for axis in range(6)):
            deck.notes.refuse("DISTRIBUTING", where, "only forces on a surface of one body are distributed")
            continue
        for ramp, six in motions(deck, deck.forces, reference, 0.0):
            keys = {"face": f"{bodies.names[faces[0][0]]}.{faces[0][1]}", "value": six[:3], "moment": six[3:]}
            keys["point"] = deck.geometry.points[reference]
            found.append((f"coupled_{len(found) + 1}", {**keys, **({"ramp": ramp} if ramp else {})}))
    return found


def motions(deck, histories, reference, missing):
    """[(ramp, six components)] of what is given for a rigid body, one for each ramp. missing: stands for components
    that are not given at all"""
    given, ramps = {}, {}
    for axis in range(6):
        if (reference, axis) in histories.values:
            key = (reference, axis)
            value, ramp = deck.ramps.split(histories.values[key], histories.starts.get(key, 0.0))
            given[axis] = value
            if value:
                ramps.setdefault(ramp, set()).add(axis)
    return [(ramp, [given[axis] if axis in axes else 0.0 if axis in given else missing for axis in range(6)])
            for ramp, axes in (ramps or {None: set()}).items()]


def joint_entries(bodies):
    """Ties of bodies of unlike materials that share nodes"""
    found = []
    for number, ((a, b), sides) in enumerate(bodies.joints.items(), 1):
        faces = dict(bodies.add_face(f"joint_{number}", sides))
        found.append((f"joint_{number}",
                      {"mortar": f"{bodies.names[a]}.{faces[a]}", "nonmortar": f"{bodies.names[b]}.{faces[b]}"}))
    return found


def cyclic_entries(deck, bodies):
    found = []
    for where, tie, start, end in deck.cyclic:
        if tie not in deck.ties:
            raise MeshError(f"{where}: there is no *TIE \"{tie}\"")
        _, _, slave, master, _, _ = deck.ties[tie]
        one, two = (dict(surface_faces(deck, bodies, where, name)) for name in (master, slave))
        for body in sorted(set(one) & set(two)):
            found.append((f"cyclic_{len(found) + 1}", {
                "from": f"{bodies.names[body]}.{one[body]}", "to": f"{bodies.names[body]}.{two[body]}",
                "axis": np.subtract(end, start), "center": start
            }))
    return found


def program(deck, found):
    steps = sum(step.n for step in deck.steps)
    if deck.steps[0].kind == "dynamic":
        step = deck.steps[0]
        times = [0.0, *step.times()]
        found["ramps"] = [(name, {"times": times, "values": list(factors)}) for name, factors in deck.ramps.factors]
        found["dynamics"] = [f"  time_step: {step.period / step.n:.12g}", f"  end_time: {step.period:.12g}"]
        if any(interaction.soft for interaction in deck.interactions.values()):
            found["dynamics"].append("  scheme: generalized_alpha")  # which soft contact needs
        return
    found["load"] = [f"  steps: {steps}"]
    found["ramps"] = [(name, {"factors": list(factors[1:])}) for name, factors in deck.ramps.factors]
