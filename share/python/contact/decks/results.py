"""Results of a deck's run as the files of CalculiX: .frd for cgx, PrePoMax and FreeCAD, .dat with NODE PRINT and
EL PRINT."""
import math
import os

import h5py
import numpy as np

from ..meshes.model import MeshError
from .strains import interpolate, node_strains

# CalculiX' number of a kind of cell in .frd files, and its nodes as places in the deck's order
CELLS = {
    "hexahedron": (1, range(8)), "wedge": (2, range(6)), "tetra": (3, range(4)),
    "hexahedron20": (4, [*range(12), *range(16, 20), *range(12, 16)]), "tetra10": (6, range(10)),
    "hexahedron27": (4, [*range(12), *range(16, 20), *range(12, 16)])
}
DISPLACEMENT = [("D1", 2, 1, 0), ("D2", 2, 2, 0), ("D3", 2, 3, 0), ("ALL", 2, 0, 0)]
FORCE = [("F1", 2, 1, 0), ("F2", 2, 2, 0), ("F3", 2, 3, 0), ("ALL", 2, 0, 0)]
STRESS = [("SXX", 4, 1, 1), ("SYY", 4, 2, 2), ("SZZ", 4, 3, 3), ("SXY", 4, 1, 2), ("SYZ", 4, 2, 3), ("SZX", 4, 3, 1)]
STRAIN = [("E" + name[1:], *place) for name, *place in STRESS]
CONTACT = [("COPEN", 4, 1, 1), ("CSLIP1", 4, 2, 2), ("CSLIP2", 4, 3, 3), ("CPRESS", 4, 1, 2), ("CSHEAR1", 4, 2, 3),
           ("CSHEAR2", 4, 3, 1)]
PLASTIC = [("PE", 1, 0, 0)]
OURS_TO_STRESS = [0, 3, 5, 1, 4, 2]  # xx, yy, zz, xy, yz, zx among xx, xy, xz, yy, yz, zz
DAT_STRESS = [0, 3, 5, 1, 2, 4]  # xx, yy, zz, xy, xz, yz


def nearest(points, places, size):
    """For each point the number of the place that is nearest; -1 if there is none within rounding"""
    tolerance, direction = 1e-5 * size, np.array([0.5773, 0.6180, 0.5342])
    order = np.argsort(places @ direction)
    along, wanted = (places @ direction)[order], points @ direction
    low, high = np.searchsorted(along, wanted - tolerance), np.searchsorted(along, wanted + tolerance, side="right")
    found = np.full(len(points), -1)
    for k, (first, last) in enumerate(zip(low, high)):
        if last > first:
            near = order[first:last]
            distance = np.abs(places[near] - points[k]).max(axis=1)
            if distance.min() <= tolerance:
                found[k] = near[distance.argmin()]
    return found


class Results:
    """The fields of a run at the nodes of its deck"""

    def __init__(self, deck, bodies, run):
        self.deck, self.geometry, self.bodies, self.run = deck, deck.geometry, bodies, run
        size = float(np.ptp(run.points, axis=0).max())
        self.vertex = np.full(len(self.geometry.points), -1)
        self.cells = [cell for mine in bodies.cells for cell in mine]
        owner = np.array(run.files.body)
        for body, nodes in enumerate(bodies.body_nodes):
            nodes = np.array(sorted(nodes))
            rows = np.unique(np.concatenate([cell for cell, b in zip(run.cells, owner) if b == body]))
            found = nearest(self.geometry.points[nodes], run.points[rows], size)
            if (found < 0).any():
                number = self.geometry.node_numbers[nodes[np.argmin(found)]]
                raise MeshError(f"node {number} of the deck has no vertex in the results")
            self.vertex[nodes] = rows[found]
        self.nodes = np.flatnonzero(self.vertex >= 0)
        elements = self.geometry.element_numbers  # those of the deck if they are unique
        self.elements = elements if len(set(elements)) == len(elements) else range(1, len(elements) + 1)

    def numbers(self):
        """Numbers of nodes and elements in the files: those of the deck if they are unique"""
        nodes = [self.geometry.node_numbers[node] for node in self.nodes]
        return nodes if len(set(nodes)) == len(nodes) else list(range(1, len(nodes) + 1))

    def times(self):
        """{load step: (number of the deck's step, number of the load step in it, total time)}"""
        found, number, start = {}, 0, 0.0
        for at, step in enumerate(self.deck.steps, 1):
            for k, time in enumerate(step.times(), 1):
                number += 1
                found[number] = (at, k, start + time)
            start += step.period
        return found

    def fields(self, step):
        """[(name, components, values at the nodes)] in a load step"""
        rows = self.vertex[self.nodes]
        with h5py.File(self.run.files.files[step], "r") as file:
            data = {name: values[:] for name, values in file.items()}
        forces = self.reactions(data["reaction"])[self.nodes]
        found = [("DISP", DISPLACEMENT, data["displacement"][rows]), ("FORC", FORCE, forces),
                 ("STRESS", STRESS, data["nodal_stress"][rows][:, OURS_TO_STRESS])]
        if self.deck.strains:
            moved = np.where(self.vertex[:, None] >= 0, data["displacement"][self.vertex], 0.0)
            strain = node_strains(self.geometry, self.cells, moved, self.deck.finite)
            found.append(("TOSTRAIN", STRAIN, strain[self.nodes]))
        if "equivalent_plastic_strain" in data:
            found.append(("PE", PLASTIC, self.at_vertices(data["equivalent_plastic_strain"])[rows][:, None]))
        if "contact_pressure" in data and not np.isnan(data["contact_gap"]).all():
            table = np.zeros((len(rows), 6))
            for name, column in (("contact_gap", 0), ("contact_slip_path", 1), ("contact_pressure", 3),
                                 ("contact_shear", 4)):
                if name in data:
                    values = np.nan_to_num(data[name][rows])
                    table[:, column] = np.linalg.norm(values, axis=1) if values.ndim > 1 else values
            found.append(("CONTACT", CONTACT, table))
        return found

    def reactions(self, values):
        """Reactions at the nodes of the deck. That inside a side of 8 nodes is -1/4 on each corner and 1/2 on each
        other node"""
        found = np.where(self.vertex[:, None] >= 0, values[self.vertex], 0.0)
        inner = np.setdiff1d(np.flatnonzero(np.any(values, axis=1)), self.vertex)
        cells = [cell for cell in self.cells if self.geometry.elements[cell][0] == "hexahedron20"]
        if len(inner) and cells:
            sides = np.array([self.geometry.side_nodes(cell, side) for cell in cells for side in range(6)])
            weights = np.repeat([-0.25, 0.5], 4)
            centres = np.einsum("k,skd->sd", weights, self.geometry.points[sides])
            at = nearest(self.run.points[inner], centres, float(np.ptp(self.run.points, axis=0).max()))
            np.add.at(found, sides[at[at >= 0]], weights[:, None] * values[inner[at >= 0]][:, None])
        return found

    def at_vertices(self, values):
        """Means of the values of the cells around each vertex"""
        total, count = np.zeros(len(self.run.points)), np.zeros(len(self.run.points))
        for cell, value in zip(self.run.cells, values):
            total[cell] += value
            count[cell] += 1
        return total / np.maximum(count, 1)

    def write_frd(self, path):
        numbers, times = self.numbers(), self.times()
        number_of = dict(zip(self.nodes.tolist(), numbers))
        with open(path, "w", encoding="ascii", errors="replace") as file:
            file.write("    1C\n    1UUSER\n    1UPGM               contact-ccx of amgf\n")
            file.write(f"    2C{'':18}{len(numbers):12d}{'':37}1\n")
            for number, node in zip(numbers, self.nodes):
                file.write(f" -1{number:10d}" + reals(self.geometry.points[node]))
            file.write(f" -3\n    3C{'':18}{len(self.cells):12d}{'':37}1\n")
            for cell in self.cells:
                kind, nodes = self.geometry.elements[cell]
                code, order = CELLS[kind]
                file.write(f" -1{self.elements[cell]:10d}{code:5d}{0:5d}{1:5d}\n")
                words = [f"{number_of[nodes[place]]:10d}" for place in order]
                file.write("".join(" -2" + "".join(words[i:i + 10]) + "\n" for i in range(0, len(words), 10)))
            file.write(" -3\n")
            count = 0
            for step in self.run.steps:
                at, k, time = times[step]
                for name, components, values in self.fields(step):
                    count += 1
                    write_block(file, name, components, numbers, values, (count, at, k, step, time))
            file.write(" 9999\n")

    def write_dat(self, path):
        times, number_of = self.times(), dict(zip(self.nodes.tolist(), self.numbers()))
        rigid = {reference for _, reference in self.rigid()}
        number_of.update((node, self.geometry.node_numbers[node])
                         for node, reference in self.deck.rotations.items() if reference in rigid)
        with open(path, "w", encoding="ascii", errors="replace") as file:
            for step in self.run.steps:
                at, _, time = times[step]
                for (name, word), (members, totals) in self.deck.prints[self.deck.steps[at - 1]]:
                    place = f"for set {name.upper()} and time {fortran(time)}\n\n"
                    if word == "S":
                        file.write(f"\n stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) {place}")
                        file.write(self.stress_rows(step, members))
                        continue
                    nodes = [node for node in members if node in number_of]
                    values = self.node_values(step, word)
                    if totals != "ONLY":
                        title = "displacements (vx,vy,vz)" if word == "U" else "forces (fx,fy,fz)"
                        file.write(f"\n {title} {place}")
                        file.write("".join(f"{number_of[node]:10d}" + printed(values[node]) for node in nodes))
                    if word == "RF" and totals != "NO":
                        file.write(f"\n total force (fx,fy,fz) {place}{'':6}" + printed(values[nodes].sum(axis=0)))

    def node_values(self, step, word):
        """Displacements (U) or reactions (RF) at the nodes of the deck; of rigid bodies also rotations and moments"""
        if word == "U":
            values = self.run.displacement(step)[self.vertex]
        else:
            with h5py.File(self.run.files.files[step], "r") as file:
                values = self.reactions(file["reaction"][:])
        for name, reference in self.rigid():
            linear, angular = self.rigid_values(step, word, name, self.geometry.points[reference])
            for node, other in self.deck.rotations.items():
                if other == reference:
                    values[node] = linear if node == reference else angular
        return values

    def rigid(self):
        """[(name, reference node)] of the rigid bodies"""
        named = ((f"rigid_{number}", reference) for number, (_, _, reference) in enumerate(self.deck.rigid, 1))
        return [(name, reference) for name, reference in named if name in self.bodies.rigid]

    def rigid_values(self, step, word, name, point):
        """Displacement of the reference node and rotation of a rigid body, or reaction and moment about this node"""
        summary = next(one for one in self.run.summary["steps"] if one["step"] == step)
        place = next(body for body in summary["rigid_bodies"] if body["name"] == name)
        if word == "U":
            return np.array(place["position"]) - point, np.radians(place["rotation"])
        face = next(face for face in summary["faces"] if face["name"] == name + ".*")
        return face["reaction"], face["moment"] - np.cross(place["position"], face["reaction"])

    def stress_rows(self, step, cells):
        with h5py.File(self.run.files.files[step], "r") as file:
            stress = file["nodal_stress"][:][:, DAT_STRESS]
        rows = ""
        for cell in cells:
            kind, nodes = self.geometry.elements[cell]
            reduced = self.geometry.formulations[cell].startswith("R")
            for k, value in enumerate(interpolate(kind, reduced, stress[self.vertex[nodes]]), 1):
                rows += f"{self.elements[cell]:10d}{k:4d}" + printed(value)
        return rows


def write_block(file, name, components, numbers, values, place):
    count, at, k, step, time = place
    file.write(f"    1PSTEP{count:26d}{k:12d}{at:12d}\n")
    file.write(f"  100CL{100 + step:5d}{time:12.5E}{len(numbers):12d}{'':20}{0:2d}{step:5d}{'':10}{1:2d}\n")
    file.write(f" -4  {name:<8}{len(components):5d}{1:5d}\n")
    for word, kind, row, column in components:
        last = "1ALL" if word == "ALL" else ""
        file.write(f" -5  {word:<8}{1:5d}{kind:5d}{row:5d}{column:5d}{'    ' if last else ''}{last}\n")
    for number, value in zip(numbers, values):
        file.write(f" -1{number:10d}" + reals(value))
    file.write(" -3\n")


def reals(values):
    return "".join(f"{value:12.5E}" for value in values) + "\n"


def printed(values):
    return "".join(f"{value:14.6E}" for value in values) + "\n"


def fortran(value):
    """0.1234567E+01"""
    power = math.floor(math.log10(abs(value))) + 1 if value else 0
    return f"{value / 10.0**power:10.7f}E{power:+03d}"


def write(deck, bodies, run, stem):
    """Writes STEM.frd and STEM.dat"""
    results = Results(deck, bodies, run)
    for ending, put in ((".frd", results.write_frd), (".dat", results.write_dat)):
        put(stem + ending + ".part")
        os.replace(stem + ending + ".part", stem + ending)
