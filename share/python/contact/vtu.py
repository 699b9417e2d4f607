"""Writes results as files of VTK: one .vtu a load step, and a .pvd that lists them with their times. ParaView, PyVista,
meshio and VTK read them without HDF5."""
import base64
import os
from xml.sax.saxutils import quoteattr

import h5py
import numpy as np

from . import tools
from .files import ContactError

VTK_CELLS = {4: 10, 10: 24, 8: 12}  # VTK's type of a cell by its number of nodes
VTK_FACES = {3: 5, 4: 9}
TYPES = {"f": "Float64", "i": "Int64", "u": "UInt8"}
SYMMETRIC = [0, 3, 5, 1, 4, 2]  # xx xy xz yy yz zz in VTK's order xx yy zz xy yz xz


def array(name, values):
    """One DataArray, in base64 with the number of bytes before it"""
    values = np.ascontiguousarray(values)
    width = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    data = np.uint64(values.nbytes).tobytes() + values.tobytes()
    return (f'<DataArray type="{TYPES[values.dtype.kind]}" Name={quoteattr(name)}{width} '
            f'format="binary">{base64.b64encode(data).decode()}</DataArray>\n')


def fields_of(path, n, more):
    """(name, values) of the fields with n rows, and more rows without a value; tensors in VTK's order"""
    with h5py.File(path, "r") as file:
        for name, values in file.items():
            if len(values) == n:
                values = values[:].astype(np.float64)
                values = values.reshape(n, -1) if values.size > n else values.ravel()
                values = values[:, SYMMETRIC] if values.ndim > 1 and values.shape[1] == 6 else values
                yield name, np.concatenate([values, np.full((more, *values.shape[1:]), np.nan)])


class Tools:
    """The surfaces of rigid tools"""

    def __init__(self, files, step):
        nodes = np.unique(np.concatenate(files.cells))
        low, high = files.vertices[nodes].min(axis=0), files.vertices[nodes].max(axis=0)
        displacement, at = files.displacement(step), len(files.vertices)
        points, moves, self.faces, bodies = [np.zeros((0, 3))], [np.zeros((0, 3))], [], []
        for body, note in files.surfaces.items():
            cube = files.tools[body]
            own, faces = tools.surface(note, low, high)
            points.append(own)
            moves.append(tools.moved(own, files.vertices[cube], displacement[cube]))
            self.faces += list(faces + at)
            bodies += [body] * len(faces)
            at += len(own)
        self.points, self.displacement = np.concatenate(points), np.concatenate(moves)
        self.body = np.array(bodies, np.int64)


def write_step(files, step, path):
    """One load step"""
    tool = Tools(files, step)
    points, cells = len(files.vertices), len(files.cells)
    sizes = np.array([len(cell) for cell in (*files.cells, *tool.faces)], np.int64)
    kinds = [VTK_CELLS[len(cell)] for cell in files.cells] + [VTK_FACES[len(face)] for face in tool.faces]
    with open(path, "w", encoding="ascii") as out:
        out.write('<?xml version="1.0"?>\n'
                  '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
                  '<UnstructuredGrid>\n')
        more = len(tool.points)
        out.write(f'<Piece NumberOfPoints="{points + more}" NumberOfCells="{len(sizes)}">\n<Points>\n')
        out.write(array("Points", np.concatenate([files.vertices, tool.points])) + "</Points>\n<Cells>\n")
        out.write(
            array("connectivity",
                  np.concatenate([*files.cells, *tool.faces]).astype(np.int64)) + array("offsets", np.cumsum(sizes)) +
            array("types", np.array(kinds, np.uint8)))
        out.write('</Cells>\n<PointData Vectors="displacement">\n')
        for name, values in fields_of(files.files[step], points, more):
            if name == "displacement":
                values[points:] = tool.displacement
            out.write(array(name, values))
        out.write("</PointData>\n<CellData>\n" + array("body", np.concatenate([files.body, tool.body])))
        if cells != points:
            out.writelines(array(*field) for field in fields_of(files.files[step], cells, len(tool.faces)))
        out.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write(files, path):
    """All load steps; path: the .pvd"""
    base, ending = os.path.splitext(path)
    if ending.lower() != ".pvd":
        raise ContactError(f"{path}: its ending is not .pvd")
    lines = []
    for step in sorted(files.files):
        name = f"{base}_{step:04d}.vtu"
        write_step(files, step, name + ".part")
        os.replace(name + ".part", name)
        lines.append(f'<DataSet timestep="{files.times[step]!r}" file={quoteattr(os.path.basename(name))}/>\n')
    with open(path + ".part", "w", encoding="utf-8") as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0">\n<Collection>\n' + "".join(lines) +
                  "</Collection>\n</VTKFile>\n")
    os.replace(path + ".part", path)
    return path
