"""Reads the files that contact -output BASE wrote.

BASE.xmf names the bodies, the units and the load steps. BASE.h5 holds the mesh, and BASE_0001.h5, ... one load step
each.
"""
import os
import re
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

KINDS = {6: 4, 38: 10, 9: 8}  # numbers of nodes of XDMF's kinds of cells
LENGTHS = ("m", "mm", "cm", "um", "km", "in", "ft")
FORCES = ("N", "kN", "MN", "mN", "lbf")
STRESSES = ("Pa", "kPa", "MPa", "GPa", "N/mm^2", "N/mm2", "N/m^2", "psi", "ksi")
COMPONENTS = {3: ("x", "y", "z"), 6: ("xx", "xy", "xz", "yy", "yz", "zz")}


class ContactError(Exception):
    """One sentence that says what is wrong"""


class Files:
    """The fields that one run wrote"""

    def __init__(self, base):
        self.base = base
        try:
            root = ElementTree.parse(base + ".xmf").getroot()
        except (OSError, ElementTree.ParseError):
            raise ContactError(f"there is no readable {base}.xmf; run contact with -output {base}")
        notes = {item.get("Name"): item.get("Value") for item in root.iter("Information")}
        self.bodies = [notes[f"body {b}"] for b in range(len(notes)) if f"body {b}" in notes]
        self.units = notes.get("units", "")
        self.surfaces = {b: notes[f"surface {b}"] for b in range(len(self.bodies)) if f"surface {b}" in notes}
        folder = os.path.dirname(base)
        self.files, self.times = {}, {}
        for grid in root.iterfind(".//Grid/Grid"):
            item = grid.find("./Attribute[@Name='displacement']/DataItem")
            file = os.path.join(folder, item.text.strip().rsplit(":", 1)[0])
            step = int(re.search(r"_(\d+)\.h5$", file).group(1))
            if os.path.exists(file):
                self.files[step], self.times[step] = file, float(grid.find("./Time").get("Value"))
        if not self.files:
            raise ContactError(f"{base}.xmf lists no load step whose file exists")
        with h5py.File(base + ".h5", "r") as mesh:
            self.cells, self.vertices = self.read_cells(mesh), mesh["vertices"][:]
            self.body = mesh["body"][:].ravel()
            rows = mesh["tools"][:] if "tools" in mesh else []
            self.tools = {row[0]: row[1:] for row in rows}  # nodes of a cube that moves with the body

    @staticmethod
    def read_cells(mesh):
        """The nodes of each cell"""
        if "cells" in mesh:
            return list(mesh["cells"][:])
        numbers, cells, at = mesh["mixed_cells"][:].ravel(), [], 0
        while at < len(numbers):
            n = KINDS[numbers[at]]
            cells.append(numbers[at + 1:at + 1 + n])
            at += 1 + n
        return cells

    def step(self, number):
        """The number of a load step that exists; the last one for None"""
        if number is None:
            return max(self.files)
        if number not in self.files:
            raise ContactError(
                f"{self.base}.xmf has no load step {number}: it has {min(self.files)} to {max(self.files)}")
        return number

    def body_numbers(self, text):
        """Numbers of the bodies that a list of names asks for"""
        numbers = []
        for name in text.split(","):
            if name in self.bodies:
                numbers.append(self.bodies.index(name))
            elif name.isdigit() and int(name) < len(self.bodies):
                numbers.append(int(name))
            else:
                raise ContactError(f"{self.base}.xmf has no body {name}: it has {', '.join(self.bodies)}")
        return numbers

    def field(self, step, name):
        """One number for each vertex or cell: a scalar, the length of a vector, or a component (displacement_z)"""
        with h5py.File(self.files[step], "r") as file:
            if name in file:
                values = file[name][:]
                if values.ndim > 1 and values.shape[1] == 6:
                    raise ContactError(f"{name} has six components: ask for one, as {name}_xx")
                return np.linalg.norm(values, axis=1) if values.ndim > 1 else values
            whole, _, component = name.rpartition("_")
            if whole in file and file[whole].ndim > 1:
                names = COMPONENTS[file[whole].shape[1]]
                if component in names:
                    return file[whole][:, names.index(component)]
            there = ", ".join(file)
        raise ContactError(f"{self.files[step]} has no field {name}: it has {there}")

    def displacement(self, step):
        with h5py.File(self.files[step], "r") as file:
            return file["displacement"][:]

    def paired(self, step):
        """Which vertices belong to a contact pair"""
        with h5py.File(self.files[step], "r") as file:
            return ~np.isnan(file["contact_gap"][:]) if "contact_gap" in file else np.zeros(len(self.vertices), bool)

    def pairs(self, step, field):
        """Which vertices belong to each contact pair; of a field of one pair (contact_pressure_NAME), to that one"""
        with h5py.File(self.files[step], "r") as file:
            names = [name for name in file if name.startswith("contact_gap_")] or ["contact_gap"]
            own = [name for name in names if field.endswith(name[len("contact_gap"):])]
            return [~np.isnan(file[name][:]) for name in own or names if name in file]

    def in_contact(self, step):
        """Which vertices are closed"""
        with h5py.File(self.files[step], "r") as file:
            return file["contact_status"][:] > 0.5 if "contact_status" in file else np.zeros(len(self.vertices), bool)

    def unit(self, field):
        """The unit of a field: by name where the scene's note gives length, force and stress, else in general terms"""
        given = [unit.strip() for unit in self.units.split(",")]
        length = next((unit for unit in given if unit in LENGTHS), "length")
        force = next((unit for unit in given if unit in FORCES), "force")
        stress = next((unit for unit in given if unit in STRESSES), f"{force}/{length}²")
        if field.startswith("strain_energy"):
            return stress if stress in STRESSES else "energy/volume"
        if field.startswith(("displacement", "contact_gap", "contact_slip")):
            return length
        if field.startswith("contact_area"):
            return length + "²"
        if field.startswith("contact_force"):
            return force
        if field.endswith("plastic_strain"):
            return "1"
        if field == "velocity":
            return length + "/time"
        return stress
