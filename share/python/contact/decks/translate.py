"""Translates a deck: reads its keywords, builds bodies, and collects the sections of a scene."""
import os

import numpy as np

from ..meshes import abaqus, gmsh
from ..meshes.model import KINDS, MeshError
from . import geometry, loads, materials, scene
from .adjust import adjust, distances
from .notes import Notes
from .steps import STICKS, Amplitude, Histories, Ramps, Step

MESH = {
    "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE",
    "END INSTANCE"
}
# Keywords that leave the answer as it is: headings, output requests, controls of the solution
HARMLESS = {
    "HEADING", "PREPRINT", "NODE PRINT", "NODE FILE", "NODE OUTPUT", "EL PRINT", "EL FILE", "ELEMENT OUTPUT", "OUTPUT",
    "CONTACT PRINT", "CONTACT FILE", "CONTACT OUTPUT", "ENERGY OUTPUT", "ENERGY FILE", "ENERGY PRINT", "SECTION PRINT",
    "CONTROLS", "CONTACT CONTROLS", "SECTION CONTROLS", "RESTART", "MONITOR", "FILE FORMAT", "TIME POINTS",
    "PHYSICAL CONSTANTS", "USER NODE", "END STEP", "ENDSTEP", "STEP"
}
MATERIAL = {"ELASTIC", "PLASTIC", "HYPERELASTIC", "EXPANSION", "DENSITY"}
HEAT = {"CONDUCTIVITY", "SPECIFIC HEAT", "GAP CONDUCTANCE", "GAP HEAT GENERATION"}
PROCEDURES = {
    "STATIC", "DYNAMIC", "FREQUENCY", "BUCKLE", "HEAT TRANSFER", "COUPLED TEMPERATURE-DISPLACEMENT",
    "UNCOUPLED TEMPERATURE-DISPLACEMENT", "MODAL DYNAMIC", "STEADY STATE DYNAMICS", "COMPLEX FREQUENCY", "SENSITIVITY",
    "GREEN", "VISCO", "ELECTROMAGNETICS", "CFD", "FEASIBLE DIRECTION", "CRACK PROPAGATION"
}

# Parameters that are read, or that leave the answer as it is. Others are refused
LOADS = {"OP", "AMPLITUDE"}
PARAMETERS = {
    "STEP": {"NLGEOM", "INC", "NAME", "UNSYMM", "EXTRAPOLATION"}, "STATIC": {"DIRECT", "SOLVER", "TIME RESET"},
    "DYNAMIC": {"DIRECT", "EXPLICIT", "SOLVER", "ALPHA", "RELATIVE TO ABSOLUTE"}, "BOUNDARY": LOADS, "CLOAD": LOADS,
    "DLOAD": LOADS, "DSLOAD": LOADS, "TEMPERATURE": {"OP"}, "MATERIAL": {"NAME"}, "ELASTIC": {"TYPE"},
    "PLASTIC": {"HARDENING"}, "HYPERELASTIC": {"NEO HOOKE", "MOONEY-RIVLIN"}, "EXPANSION": {"TYPE", "ZERO"},
    "DENSITY": set(), "SOLID SECTION": {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"},
    "SURFACE INTERACTION": {"NAME"}, "FRICTION": {"ROUGH", "SLIP TOLERANCE"},
    "SURFACE BEHAVIOR": {"PRESSURE-OVERCLOSURE", "PENALTY", "AUGMENTED LAGRANGE", "DIRECT"},
    "CONTACT PAIR": {"INTERACTION", "TYPE", "ADJUST", "SMALL SLIDING"},
    "TIE": {"NAME", "POSITION TOLERANCE", "CYCLIC SYMMETRY", "ADJUST", "TYPE", "NO ROTATION"},
    "CYCLIC SYMMETRY MODEL": {"N", "NGRAPH", "TIE", "ELSET"},
    "RIGID BODY": {"NSET", "TIE NSET", "ELSET", "REF NODE", "ROT NODE"},
    "COUPLING": {"CONSTRAINT NAME", "REF NODE", "SURFACE"}, "KINEMATIC": set(), "DISTRIBUTING": set(),
    "EQUATION": set(), "CLEARANCE": {"MASTER", "SLAVE", "VALUE"}, "TRANSFORM": {"NSET", "TYPE"},
    "AMPLITUDE": {"NAME", "TIME", "DEFINITION"}, "ORIENTATION": {"NAME", "SYSTEM", "DEFINITION"},
    "INITIAL CONDITIONS": {"TYPE"}, "MODEL CHANGE": {"TYPE", "ADD", "REMOVE"}, "CHANGE FRICTION": {"INTERACTION"}
}


def numbers(where, data):
    """Rows of numbers; None where a field is empty"""
    try:
        return [[float(word.upper().replace("D", "E")) if word.strip() else None
                 for word in text.split(",")]
                for text in data]
    except ValueError:
        raise MeshError(f"{where}: numbers are expected") from None


class Interaction:
    """A surface interaction: law of the pressure with its key, coefficient of friction at each load step"""

    def __init__(self, where):
        self.where, self.law, self.friction, self.soft = where, "HARD", 0.0, {}
        self.frictions = []


class Translator:

    def __init__(self, path, ignored=()):
        self.path, self.notes = path, Notes(ignored)
        blocks = list(abaqus.keyword_blocks(path))
        self.geometry = geometry.Geometry(abaqus.Deck(path, blocks))
        self.materials, self.orientations, self.amplitudes = {}, {}, {}
        self.interactions, self.pairs, self.ties, self.cyclic = {}, [], {}, []
        self.initial, self.velocities, self.transformed, self.temperature_steps = [], [], {}, []
        self.equations, self.removed, self.clearances = [], set(), {}
        self.rigid, self.rotations = [], {}  # [(where, nodes, reference node)], {node of rotations: reference node}
        self.displacements, self.forces, self.pressures, self.bodies_loads = (Histories() for _ in range(4))
        self.active, self.steps, self.prints, self.printed = {}, [], {}, {}
        self.strains = False  # whether the file .frd has strains
        self.material = self.interaction = None
        self.coupling, self.distributed = {}, []  # parameters of the last *COUPLING; [(where, sides, reference node)]
        self.part, self.starting = "", []
        model, steps = self.split(blocks)
        self.finite = any("NLGEOM" in keys and keys["NLGEOM"].upper() != "NO" for _, keys, _ in steps)
        for block in model:
            self.read_model(*block)
        self.read_steps(steps)
        self.notes.check(path)
        if not self.steps:
            raise MeshError(f"{path}: the deck has no step that is translated; its mesh alone is read by contact-mesh "
                            f"DECK OUT.msh")
        self.ramps = Ramps(self.steps)

    def split(self, blocks):
        """Keywords of the model, and [(where, parameters, keywords)] of the steps"""
        model, steps, inside = [], [], False
        for block in blocks:
            where, keyword, parameters, _ = block
            if keyword == "STEP":
                steps.append((where, parameters, []))
                inside = True
            elif keyword in ("END STEP", "ENDSTEP"):
                inside = False
            elif inside:
                steps[-1][2].append(block)
            else:
                model.append(block)
        return model, steps

    # model

    def read_model(self, where, keyword, parameters, data):
        self.check_parameters(where, keyword, parameters)
        name = "read_" + keyword.lower().replace(" ", "_").replace("-", "_")
        if keyword in MATERIAL:
            if self.material is None:
                raise MeshError(f"{where}: *{keyword} without *MATERIAL")
            self.material.said[keyword] = (where, parameters, numbers(where, data))
            self.notes.translate(keyword, where)
        elif keyword in HEAT:
            pass  # heat is refused with its procedure
        elif keyword in ("PART", "END PART"):
            self.part = parameters.get("NAME", "") if keyword == "PART" else ""
        elif keyword == "ELEMENT":
            self.read_element(where, parameters)
        elif hasattr(self, name):
            getattr(self, name)(where, parameters, data)
            self.notes.translate(keyword, where)
        elif keyword not in MESH | HARMLESS:
            self.notes.refuse(keyword, where, "this keyword is not supported")

    def check_parameters(self, where, keyword, parameters):
        for word in parameters:
            if word and word not in PARAMETERS.get(keyword, parameters):
                self.notes.refuse(keyword, where, f"the parameter {word} is not supported")

    def read_element(self, where, parameters):
        word = parameters.get("TYPE", "").upper()
        kind, dim = abaqus.element_kind(word)
        if dim != 3 or kind not in (*KINDS, "wedge"):
            self.notes.refuse(f"ELEMENT {word}", where, f"elements of type {word} are not supported, only solids")
        elif word.startswith("C3D6"):
            self.notes.approximate("ELEMENT", where, "each wedge is divided into three tetrahedra")
        elif word == "C3D8R" or word == "C3D8I" and self.finite:
            self.notes.approximate("ELEMENT", where, f"{word}: fully integrated, or as the key `element: auto` says")

    def read_material(self, where, parameters, _):
        self.material = materials.Material(parameters.get("NAME", ""), where)
        self.materials[self.material.name.upper()] = self.material

    def read_orientation(self, where, parameters, data):
        """The second line rotates the axes about one of them, in degrees"""
        rows = numbers(where, data)
        if parameters.get("SYSTEM", "RECTANGULAR").upper() not in ("RECTANGULAR", "R") or len(rows[0]) < 6:
            self.notes.refuse("ORIENTATION", where, "only rectangular systems with two points are supported")
            return
        axes = geometry.local_axes("R", np.array(rows[0][:3]), np.array(rows[0][3:6]), None)
        if len(rows) > 1:
            number, angle = int(rows[1][0]) - 1, np.radians((rows[1] + [0.0])[1] or 0.0)
            turned = [(number + 1) % 3, (number + 2) % 3]
            axes[turned] = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]) @ axes[turned]
        self.orientations[parameters.get("NAME", "").upper()] = (axes[0], axes[1])

    def read_solid_section(self, where, parameters, _):
        name, material = parameters.get("ELSET", ""), parameters.get("MATERIAL", "")
        self.starting.append((where, name, material, parameters.get("ORIENTATION", ""), self.part))

    def read_surface_interaction(self, where, parameters, _):
        self.interaction = self.interactions[parameters.get("NAME", "").upper()] = Interaction(where)

    def read_surface_behavior(self, where, parameters, data):
        if self.interaction is None:
            raise MeshError(f"{where}: *SURFACE BEHAVIOR without *SURFACE INTERACTION")
        law = parameters.get("PRESSURE-OVERCLOSURE", "HARD").upper()
        self.interaction.law = law
        if law not in ("HARD", "LINEAR", "EXPONENTIAL", "TABULAR", "TIED"):
            self.notes.refuse("SURFACE BEHAVIOR", where, f"the pressure-overclosure law {law} is not supported")
        elif law == "LINEAR":
            rows = numbers(where, data)
            if not rows or not rows[0][0] > 0.0:
                raise MeshError(f"{where}: a linear pressure-overclosure law needs a stiffness")
            self.interaction.soft = {"contact_stiffness": rows[0][0]}
        elif law == "EXPONENTIAL":
            rows = numbers(where, data)
            if not rows or len(rows[0]) < 2 or not min(rows[0][:2]) > 0.0:
                raise MeshError(f"{where}: an exponential pressure-overclosure law needs a gap and a pressure")
            self.interaction.soft = {"contact_exponential": rows[0][:2]}
        elif law not in ("HARD", "TIED"):
            self.notes.approximate(
                "SURFACE BEHAVIOR", where, f"{law.lower()} pressure-overclosure: hard contact, so "
                f"that faces do not penetrate")

    def read_friction(self, where, parameters, data):
        if self.interaction is None:
            raise MeshError(f"{where}: *FRICTION without *SURFACE INTERACTION")
        rows = numbers(where, data)
        self.interaction.friction = STICKS if "ROUGH" in parameters else rows[0][0] if rows else 0.0
        if rows and len(rows[0]) > 1 and rows[0][1]:
            self.notes.approximate("FRICTION", where, "the stick slope is not used: faces that stick do not slip")

    def read_contact_pair(self, where, parameters, data):
        kind = parameters.get("TYPE", "NODE TO SURFACE").upper()
        for text in data:
            words = [word.strip() for word in text.split(",")]
            if len(words) < 2 or not words[1]:
                self.notes.refuse(
                    "CONTACT PAIR", where, "self contact of one surface is not translated: list the pair "
                    "in the scene as {self: FACE}")
                continue
            adjusted = "ADJUST" in parameters
            self.pairs.append((where, words[0], words[1], parameters.get("INTERACTION", "").upper(), kind, adjusted))
            if adjusted:
                self.adjust(where, parameters["ADJUST"], words[0], words[1])
        if "SMALL SLIDING" in parameters:
            self.notes.approximate("CONTACT PAIR", where, "sliding is not small but of any size")

    def adjust(self, where, value, slave, master):
        """Moves nodes of the slave surface onto the master surface"""
        try:
            distance, only = float(value), None
        except ValueError:
            distance, only = np.inf, set(self.geometry.nodes_of(where, value))
        sides = self.geometry.surfaces.get(slave.upper())
        nodes = self.geometry.nodes_of(where, slave) if sides is None else [
            node for cell, side in sides for node in self.geometry.side_nodes(cell, side)
        ]
        moved, largest = adjust(self.geometry, [node for node in nodes if only is None or node in only],
                                self.surface(where, master), distance)
        self.notes.approximate("CONTACT PAIR", where, f"ADJUST moved {moved} nodes, by at most {largest:.3g}")

    def read_clearance(self, where, parameters, _):
        """*CLEARANCE: the distance of two surfaces, instead of the one that the nodes have"""
        slave, master = parameters.get("SLAVE", ""), parameters.get("MASTER", "")
        sides = self.surface(where, master)
        nodes = {node for cell, side in self.surface(where, slave) for node in self.geometry.side_nodes(cell, side)}
        gaps = distances(self.geometry, nodes, sides)
        size = float(np.ptp(self.geometry.points, axis=0).max())
        if np.ptp(gaps) > 1e-4 * size:
            self.notes.refuse("CLEARANCE", where, "the surfaces are not parallel, so that the distance of the nodes "
                              "cannot be replaced")
        self.clearances[slave.upper(), master.upper()] = float(parameters.get("VALUE", 0.0)) - float(np.mean(gaps))

    def read_tie(self, where, parameters, data):
        words = [word.strip() for word in (data[0].split(",") if data else [])]
        if len(words) < 2:
            raise MeshError(f"{where}: *TIE needs two surfaces")
        tolerance = parameters.get("POSITION TOLERANCE")
        self.ties[parameters.get("NAME", f"tie_{len(self.ties) + 1}").upper()] = [
            where, parameters.get("NAME", ""), words[0], words[1], tolerance, "CYCLIC SYMMETRY" in parameters
        ]

    def read_cyclic_symmetry_model(self, where, parameters, data):
        rows = numbers(where, data)
        if len(rows[0]) < 6:
            raise MeshError(f"{where}: *CYCLIC SYMMETRY MODEL needs two points of the axis")
        self.cyclic.append((where, parameters.get("TIE", "").upper(), rows[0][:3], rows[0][3:6]))

    def read_amplitude(self, where, parameters, data):
        if parameters.get("DEFINITION", "TABULAR").upper() != "TABULAR":
            self.notes.refuse("AMPLITUDE", where, "only tables are supported")
            return
        values = [value for row in numbers(where, data) for value in row if value is not None]
        if not values or len(values) % 2:
            raise MeshError(f"{where}: an amplitude is a table of times and values")
        total = parameters.get("TIME", "STEP TIME").upper() == "TOTAL TIME"
        self.amplitudes[parameters.get("NAME", "").upper()] = Amplitude(list(zip(values[::2], values[1::2])), total)

    def read_boundary(self, where, parameters, data):
        self.initial.append((where, parameters, data))

    def read_transform(self, where, parameters, data):
        rows = numbers(where, data)
        if len(rows[0]) < 6:
            raise MeshError(f"{where}: *TRANSFORM needs the coordinates of two points")
        one, two = np.array(rows[0][:3]), np.array(rows[0][3:6])
        for node in self.geometry.nodes_of(where, parameters.get("NSET", "")):
            self.transformed[node] = geometry.local_axes(parameters.get("TYPE", "R").upper(), one, two,
                                                         self.geometry.points[node])

    def read_equation(self, where, _, data):
        """Equations: the number of terms, and then node, component and factor of each term"""
        rows = numbers(where, data)
        while rows:
            count, words = int(rows.pop(0)[0]), []
            while rows and len(words) < 3 * count:
                words += [word for word in rows.pop(0) if word is not None]
            if len(words) < 3 * count:
                raise MeshError(f"{where}: an equation of {count} terms needs {3 * count} numbers")
            terms = {}  # {node: [(component, factor)]}, the dependent node first
            for number, dof, factor in zip(words[0:3 * count:3], words[1:3 * count:3], words[2:3 * count:3]):
                node = self.geometry.nodes_of(where, str(int(number)))[0]
                terms.setdefault(node, []).append((int(dof) - 1, factor))
            if len(terms) > 2:
                self.notes.refuse("EQUATION", where, f"an equation of {len(terms)} nodes: two at most are supported")
            else:
                self.equations.append((where, terms))

    def read_rigid_body(self, where, parameters, _):
        nodes = [node for key in ("NSET", "TIE NSET") if key in parameters
                 for node in self.geometry.nodes_of(where, parameters[key])]
        for cell in self.geometry.cells_of(where, parameters["ELSET"]) if "ELSET" in parameters else ():
            nodes += self.geometry.elements[cell][1]
        self.add_rigid(where, nodes, parameters)

    def read_coupling(self, where, parameters, _):
        self.coupling = parameters

    def read_kinematic(self, where, _, data):
        """*COUPLING with *KINEMATIC: all displacements of a surface follow a node"""
        rows = numbers(where, data)
        if rows and not {1, 2, 3}.issubset(dof for row in rows for dof in range(int(row[0]), int(row[-1]) + 1)):
            self.notes.refuse("KINEMATIC", where, "all three displacements must be coupled")
        name = self.coupling.get("SURFACE", "")
        sides = self.geometry.surfaces.get(name.upper())
        nodes = self.geometry.nodes_of(where, name) if sides is None else [
            node for cell, side in sides for node in self.geometry.side_nodes(cell, side)
        ]
        self.add_rigid(where, nodes, self.coupling)

    def read_distributing(self, where, *_):
        """*COUPLING with *DISTRIBUTING: a surface on which the forces on a node are distributed"""
        reference = self.geometry.nodes_of(where, self.coupling.get("REF NODE", ""))[0]
        self.distributed.append((where, self.surface(where, self.coupling.get("SURFACE", "")), reference))
        self.rotations[reference] = reference

    def add_rigid(self, where, nodes, parameters):
        """Nodes that move as a rigid body with a reference node"""
        reference = self.geometry.nodes_of(where, parameters.get("REF NODE", ""))[0]
        self.rigid.append((where, nodes, reference))
        self.rotations[reference] = reference
        if "ROT NODE" in parameters:
            self.rotations[self.geometry.nodes_of(where, parameters["ROT NODE"])[0]] = reference

    def rigid_component(self, node, dof):
        """(reference node, 0 to 5) of a displacement or a rotation of a rigid body; None: of none"""
        reference = self.rotations.get(node)
        if reference is None or dof > 6:
            return None
        return reference, dof - 1 if reference == node else dof + 2

    def axis(self, node, dof):
        """Direction of a displacement component of a node"""
        return self.transformed.get(node, np.eye(3))[dof]

    def component(self, node, dof):
        """((node, coordinate axis, or a direction along none), sign) of a displacement component"""
        if node not in self.transformed:
            return (node, dof), 1.0
        axis = self.axis(node, dof)
        along = np.flatnonzero(axis)
        return ((node, int(along[0])), float(axis[along[0]])) if len(along) == 1 else ((node, tuple(axis)), 1.0)

    def read_initial_conditions(self, where, parameters, data):
        kind = parameters.get("TYPE", "").upper()
        if kind == "VELOCITY":
            for text in data:
                name, dof, value = [word.strip() for word in text.split(",")][:3]
                self.velocities.append((where, self.geometry.nodes_of(where, name), int(dof) - 1, float(value)))
        elif kind == "TEMPERATURE":
            self.temperature_steps.append((None, where, data))
        else:
            self.notes.refuse("INITIAL CONDITIONS", where, f"type {kind} is not supported")

    # steps

    def read_steps(self, steps):
        start, begin = 0.0, 0
        given = set()
        for where, parameters, data in self.initial:
            given |= self.prescribe(where, parameters, data)
        for where, parameters, blocks in steps:
            step = self.read_procedure(where, parameters, blocks)
            if step is None:
                continue
            initial, self.renewed = given, None
            given = {"BOUNDARY": set(), "CLOAD": set(), "DLOAD": set(), "GRAV": set()}
            for block in blocks:
                self.read_in_step(step, given, *block)
            if self.renewed and set(self.displacements.rule) - given["BOUNDARY"]:
                self.notes.refuse("BOUNDARY", self.renewed, "OP=NEW releases displacements, which is not supported")
            given["BOUNDARY"] |= initial
            for histories, keyword in ((self.displacements, "BOUNDARY"), (self.forces, "CLOAD"),
                                       (self.pressures, "DLOAD"), (self.bodies_loads, "GRAV")):
                histories.advance(step, begin, start, given[keyword])
            for interaction in self.interactions.values():
                interaction.frictions += [interaction.friction] * step.n
            for table in self.active.values():
                table[1] += [table[0]] * step.n
            start, begin, given = start + step.period, begin + step.n, set()
            self.steps.append(step)
            self.prints[step] = list(self.printed.items())
        if len({step.kind
                for step in self.steps}) > 1 or (self.steps and self.steps[0].kind == "dynamic"
                                                 and len(self.steps) > 1):
            self.notes.refuse("DYNAMIC", self.steps[-1].where, "one dynamic step is supported, without other steps")

    def read_procedure(self, where, parameters, blocks):
        """The step; None if its procedure is not supported"""
        nlgeom = "NLGEOM" in parameters and parameters["NLGEOM"].upper() != "NO"
        step = Step(where, nlgeom)
        for place, keyword, keys, data in blocks:
            if keyword not in PROCEDURES:
                continue
            rows = numbers(place, data[:1])
            if keyword in PARAMETERS:
                self.check_parameters(where, "STEP", parameters)
                self.check_parameters(place, keyword, keys)
            if keyword == "STATIC":
                step.set_static(rows[0] if rows else [], "DIRECT" in keys)
                if self.path_depends():
                    step.n = max(step.n, 2)
            elif keyword == "DYNAMIC":
                step.set_dynamic(rows[0] if rows else [], "EXPLICIT" in keys)
                if "EXPLICIT" in keys:
                    self.notes.approximate("DYNAMIC", place, f"explicit: implicit time steps of {step.increment:g}")
            else:
                self.notes.refuse(keyword, place, "this analysis is not supported: static and dynamic steps are")
                return None
            self.notes.translate(keyword, place)
            return step
        self.notes.refuse("STEP", where, "the step has no procedure that is known")
        return None

    def path_depends(self):
        return any("PLASTIC" in m.said for m in self.materials.values()) or any(i.friction
                                                                                for i in self.interactions.values())

    def read_in_step(self, step, given, where, keyword, parameters, data):
        words = [word.strip().upper() for text in data for word in text.split(",")]
        if keyword in ("NODE PRINT", "EL PRINT"):
            self.request(where, keyword, parameters, words)
        elif keyword in ("EL FILE", "ELEMENT OUTPUT"):
            self.strains = self.strains or "E" in words
        if keyword in PROCEDURES | HARMLESS | MESH:
            return
        self.check_parameters(where, keyword, parameters)
        if keyword == "BOUNDARY":
            given["BOUNDARY"] |= self.prescribe(where, parameters, data)
        elif keyword == "CLOAD":
            self.load_nodes(where, parameters, data, given["CLOAD"])
        elif keyword in ("DLOAD", "DSLOAD"):
            self.load_elements(where, keyword, parameters, data, given)
        elif keyword == "TEMPERATURE":
            self.temperature_steps.append((step, where, data))
        elif keyword == "MODEL CHANGE":
            self.change_model(where, parameters, data)
        elif keyword == "CHANGE FRICTION":
            self.interaction = self.interactions.get(parameters.get("INTERACTION", "").upper())
        elif keyword == "FRICTION":
            self.read_friction(where, parameters, data)
        elif keyword == "AMPLITUDE":
            self.read_amplitude(where, parameters, data)
        else:
            self.notes.refuse(keyword, where, "this keyword is not supported in a step")
            return
        self.notes.translate(keyword, where)

    def request(self, where, keyword, parameters, words):
        """What the file .dat has of sets of nodes and elements, until a later step asks for something else"""
        kind, find, known = ("NSET", self.geometry.nodes_of, ("U", "RF")) if keyword == "NODE PRINT" else (
            "ELSET", self.geometry.cells_of, ("S", ))
        for word in known:
            if kind in parameters and word in words:
                name = parameters[kind]
                self.printed[name, word] = (find(where, name), parameters.get("TOTALS", "NO").upper())

    def amplitude(self, where, parameters):
        if "AMPLITUDE" not in parameters:
            return None
        if parameters["AMPLITUDE"].upper() not in self.amplitudes:
            raise MeshError(f"{where}: there is no amplitude \"{parameters['AMPLITUDE']}\"")
        return self.amplitudes[parameters["AMPLITUDE"].upper()]

    def remove_all(self, parameters, histories, given):
        """OP=NEW: removes all loads that earlier steps gave"""
        if parameters.get("OP", "MOD").upper() == "NEW":
            for key in set(histories.rule) - given:
                histories.remove(key)
                given.add(key)

    def prescribe(self, where, parameters, data):
        """*BOUNDARY: {(node, component)} that it gives"""
        amplitude, given = self.amplitude(where, parameters), set()
        if parameters.get("OP", "MOD").upper() == "NEW":
            self.renewed = where
        for text in data:
            words = [word.strip() for word in text.split(",")]
            nodes = self.geometry.nodes_of(where, words[0])
            if len(words) > 1 and words[1].upper() in loads.NAMED_BOUNDARIES:
                dofs, value = loads.NAMED_BOUNDARIES[words[1].upper()], 0.0
            else:
                try:
                    first = int(words[1])
                    last = int(words[2]) if len(words) > 2 and words[2] else first
                    value = float(words[3]) if len(words) > 3 and words[3] else 0.0
                except (ValueError, IndexError):
                    raise MeshError(f"{where}: \"{text}\" is not a node, components and a value") from None
                dofs = range(first, last + 1)
            for dof, node in ((dof, node) for dof in dofs for node in nodes):
                key, sign = self.rigid_component(node, dof), 1.0
                if dof == 11:
                    self.notes.refuse("BOUNDARY", where, "temperatures are not unknowns here")
                if key is None and dof > 3:
                    continue  # rotations: solid elements have none
                if key is None:
                    key, sign = self.component(node, dof - 1)
                self.displacements.give(key, sign * value, amplitude, where)
                given.add(key)
        return given

    def load_nodes(self, where, parameters, data, given):
        amplitude = self.amplitude(where, parameters)
        self.remove_all(parameters, self.forces, given)
        for text in data:
            words = [word.strip() for word in text.split(",")]
            try:
                dof, value = int(words[1]), float(words[2])
            except (ValueError, IndexError):
                raise MeshError(f"{where}: \"{text}\" is not a node, a component and a force") from None
            for node in self.geometry.nodes_of(where, words[0]):
                key = self.rigid_component(node, dof)
                if key:
                    self.add_load(self.forces, key, value, amplitude, where, given)
                elif dof > 3:
                    self.notes.refuse("CLOAD", where, "moments are supported on the nodes of *RIGID BODY only")
                    break
                else:
                    for axis, factor in enumerate(self.axis(node, dof - 1)):
                        if factor:
                            self.add_load(self.forces, (node, axis), value * factor, amplitude, where, given)

    def add_load(self, histories, key, value, amplitude, where, given):
        """Loads that are given twice in one step are added. given: keys of the step"""
        if key in given and histories.rule[key][0]:
            old, other = histories.rule[key]
            if other is not amplitude:
                self.notes.refuse("AMPLITUDE", where, "two loads on one node or side have different amplitudes")
            value += old
        histories.give(key, value, amplitude, where)
        given.add(key)

    def load_elements(self, where, keyword, parameters, data, given):
        amplitude = self.amplitude(where, parameters)
        self.remove_all(parameters, self.pressures, given["DLOAD"])
        self.remove_all(parameters, self.bodies_loads, given["GRAV"])
        for text in data:
            words = [word.strip() for word in text.split(",")]
            label = words[1].upper() if len(words) > 1 else ""
            if keyword == "DSLOAD" and label == "P":
                sides = self.surface(where, words[0])
            elif label in ("P1", "P2", "P3", "P4", "P5", "P6"):
                sides = [(cell, int(label[1]) - 1) for cell in self.geometry.cells_of(where, words[0])]
            elif label == "GRAV" and len(words) >= 6:
                cells = frozenset(
                    self.geometry.cells_of(where, words[0]) if words[0] else range(len(self.geometry.elements)))
                direction = np.array([float(word) for word in words[3:6]])
                for axis in range(3):
                    self.add_load(self.bodies_loads, (cells, axis),
                                  float(words[2]) * direction[axis], amplitude, where, given["GRAV"])
                continue
            else:
                self.notes.refuse(keyword, where, f"loads of type {label} are not supported: P1 to P6 and GRAV are")
                continue
            for side in sides:
                self.add_load(self.pressures, side, float(words[2]), amplitude, where, given["DLOAD"])

    def change_model(self, where, parameters, data):
        kind = parameters.get("TYPE", "").upper()
        if kind == "ELEMENT" and "REMOVE" in parameters and not self.steps:
            words = [word.strip() for text in data for word in text.split(",") if word.strip()]
            self.removed.update(cell for word in words for cell in self.geometry.cells_of(where, word))
            return
        if kind != "CONTACT PAIR":
            self.notes.refuse(
                "MODEL CHANGE", where, "only contact pairs can be removed and added, and elements removed "
                "in the first step")
            return
        for text in data:
            words = [word.strip().upper() for word in text.split(",")]
            key = (words[0], words[1])
            before = sum(step.n for step in self.steps)
            self.active.setdefault(key, [1.0, [1.0] * before])[0] = 0.0 if "REMOVE" in parameters else 1.0

    def surface(self, where, name):
        """Sides of a surface of elements"""
        if name.upper() not in self.geometry.surfaces:
            raise MeshError(f"{where}: there is no surface \"{name}\" of element sides")
        return self.geometry.surfaces[name.upper()]

    # scene

    def make_bodies(self):
        sections = []
        for where, name, material, orientation, part in self.starting:
            if material.upper() not in self.materials:
                raise MeshError(f"{where}: there is no material \"{material}\"")
            for label in self.geometry.labels[part.upper()]:
                cells = self.geometry.elsets.get((f"{label}." if label else "").upper() + name.upper(), [])
                cells = [cell for cell in cells if cell not in self.removed]
                sections.append((label or name, cells, (material.upper(), orientation.upper())))
        bodies = geometry.Bodies(self.geometry, sections)
        if set(bodies.left) - self.removed:
            raise MeshError(f"{self.path}: {len(bodies.left)} solid elements have no *SOLID SECTION")
        return bodies

    def scene(self, mesh_file):
        """The text of the scene, and its mesh"""
        bodies = self.make_bodies()
        sections = loads.sections(self, bodies, mesh_file)
        single = {"problem": geometry.plain(os.path.splitext(os.path.basename(self.path))[0])}
        heading = [f"{scene.BEGINS[2:]}{os.path.basename(self.path)} by contact-mesh -scene", *self.notes.lines()]
        mesh = bodies.mesh()
        return scene.text(heading, single, sections), mesh, bodies


def translate(path, target, ignored=()):
    """Writes the scene `target` and its mesh, with the ending .msh. Returns the translator and its bodies"""
    stem = os.path.splitext(target)[0]
    if os.path.exists(target):
        with open(target, encoding="utf-8", errors="replace") as file:
            if not file.readline().startswith(scene.BEGINS):
                raise MeshError(f"{target} exists and is no translation of a deck: give another name for the scene")
    translator = Translator(path, ignored)
    text, mesh, bodies = translator.scene(os.path.basename(stem) + ".msh")
    translator.notes.check(path)
    translator.notes.check_ignored(path)
    for name, write in ((stem + ".msh", lambda file: gmsh.write(file, mesh)), (target, lambda file: put(file, text))):
        write(name + ".part")
        os.replace(name + ".part", name)
    return translator, bodies


def put(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
