"""The results of a run as numpy arrays, and as objects of pandas and pyvista where these are installed."""
import csv
import glob
import json
import os
import subprocess
import sys

import numpy as np

from . import vtu
from .files import ContactError, Files
from .places import script

FIELDS = {"pressure": "contact_pressure", "gap": "contact_gap", "status": "contact_status", "slip": "contact_slip"}


def read_table(path):
    """{column: array} of a CSV file; a column with a word in it is an array of texts"""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            heading, *rows = csv.reader(file)
    except (OSError, ValueError):
        raise ContactError(f"there is no readable table {path}") from None

    def column(i):
        words = [row[i] for row in rows]
        try:
            return np.array([float(word) for word in words])
        except ValueError:
            return np.array(words)

    return {name: column(i) for i, name in enumerate(heading)}


class Table(dict):
    """{column: array}. A name without its first words serves if only one column ends in it: force_z for block.force_z.
    A name without _x, _y, _z gives the three columns as vectors: force for block.force_x, block.force_y,
    block.force_z"""

    def __missing__(self, name):
        if name + "_x" in self:
            return np.stack([self[f"{name}_{axis}"] for axis in "xyz"], axis=-1)
        found = [column for column in self if column.endswith("." + name)]
        if len(found) == 1:
            return self[found[0]]
        vectors = [column[:-2] for column in self if column.endswith(f".{name}_x")]
        if not found and len(vectors) == 1:
            return self[vectors[0]]
        found = found or vectors
        near = ", ".join(found or [column for column in self if name.split(".")[-1] in column][:12] or list(self)[:12])
        raise ContactError(f"the table has {'several columns' if found else 'no column'} \"{name}\": {near}")

    def to_pandas(self):
        import pandas

        return pandas.DataFrame(dict(self))


class Picture(str):
    """The name of a picture's file; a notebook shows the picture"""

    def _repr_png_(self):
        with open(self, "rb") as file:
            return file.read()


class Run:
    """What contact -output BASE -summary BASE.json wrote. Everything is read when it is first asked for"""

    def __init__(self, base):
        self.base = base
        self._cache = {}

    def _once(self, name, make):
        if name not in self._cache:
            self._cache[name] = make()
        return self._cache[name]

    def __repr__(self):
        """One line: scene, size, how the run ended"""
        summary = self.summary
        steps = [step for step in summary["steps"] if step["converged"]]
        return (f"<run of {summary['problem']}: {summary['dofs']:,} unknowns, {len(steps)} load steps done, exit "
                f"code {self.exit_code}, {len(self.warnings)} warnings>")

    @property
    def summary(self):
        """The summary, as a dictionary"""
        return self._once("summary", self._read_summary)

    def _read_summary(self):
        try:
            with open(self.base + ".json", encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            raise ContactError(
                f"there is no readable summary {self.base}.json; run contact with -summary {self.base}.json") from None

    @property
    def exit_code(self):
        return self.summary["exit_code"]

    @property
    def warnings(self):
        return self.summary["warnings"]

    @property
    def history(self):
        """The history, one number a load step: run.history["energy"]"""
        return self._once("history", lambda: Table(read_table(self.base + ".csv")))

    @property
    def lines(self):
        """{name: table} of the probes along lines"""
        names = sorted(glob.glob(glob.escape(self.base) + "_*.csv"))
        return {name[len(self.base) + 1:-4]: Table(read_table(name)) for name in names}

    @property
    def files(self):
        """The fields' files: bodies, vertices, cells, load steps"""
        return self._once("files", lambda: Files(self.base))

    @property
    def steps(self):
        """Numbers of the load steps whose fields were written"""
        return sorted(self.files.files)

    @property
    def points(self):
        return self.files.vertices

    @property
    def cells(self):
        return self.files.cells

    def field(self, name, step=None):
        """One number for each vertex or cell in a load step, the last by default: run.field("von_mises"),
        run.field("displacement_z")"""
        return self.files.field(self.files.step(step), FIELDS.get(name, name))

    def displacement(self, step=None):
        """One vector for each vertex"""
        return self.files.displacement(self.files.step(step))

    def to_pyvista(self, step=None):
        """A pyvista.UnstructuredGrid of the bodies, with all fields of a load step"""
        import h5py
        import pyvista

        step = self.files.step(step)
        cells = np.concatenate([[len(cell), *cell] for cell in self.cells])
        grid = pyvista.UnstructuredGrid(cells, np.array([vtu.VTK_CELLS[len(cell)] for cell in self.cells], np.uint8),
                                        self.points)
        with h5py.File(self.files.files[step], "r") as file:
            for name, values in file.items():
                if len(values) in (grid.n_points, grid.n_cells):
                    (grid.point_data if len(values) == grid.n_points else grid.cell_data)[name] = values[:]
        grid.cell_data["body"] = self.files.body
        return grid

    def write_vtk(self, path=None):
        """Writes the fields of all load steps as .vtu files and a .pvd, whose name it returns"""
        return vtu.write(self.files, os.fspath(path or self.base + ".pvd"))

    def plot(self, field, picture=None, step=None, **options):
        """Draws a field on the deformed bodies and returns the picture's file: options are those of share/plot/draw.py,
        only="slab" """
        picture = picture or f"{self.base}_{field}.png"
        words = [word for key, value in options.items() for word in (f"--{key.replace('_', '-')}", str(value))]
        if step is not None:
            words += ["--step", str(step)]
        done = subprocess.run(
            [sys.executable, "-B", script("plot/draw.py"), self.base, picture, "--field",
             FIELDS.get(field, field), *words], capture_output=True, text=True)
        if done.returncode:
            raise ContactError((done.stderr.strip().splitlines() or ["the picture failed"])[-1])
        return Picture(picture)


def load(base):
    """The results that contact -output BASE wrote"""
    base = os.fspath(base)
    base = base[:-len(".xmf")] if base.endswith(".xmf") else base
    if not any(os.path.exists(base + ending) for ending in (".xmf", ".csv", ".json")):
        raise ContactError(f"there are no results {base}.xmf, {base}.csv or {base}.json")
    return Run(base)
