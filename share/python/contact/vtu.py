"""Writes results as files of VTK: one .vtu a load step, and a .pvd that lists them with their times. ParaView, PyVista,
meshio and VTK read them without HDF5."""
import base64
import os
from xml.sax.saxutils import quoteattr

import h5py
import numpy as np

from .files import ContactError

VTK_CELLS = {4: 10, 10: 24, 8: 12}  # VTK's type of a cell by its number of nodes
TYPES = {"f": "Float64", "i": "Int64", "u": "UInt8"}
SYMMETRIC = [0, 3, 5, 1, 4, 2]  # xx xy xz yy yz zz in VTK's order xx yy zz xy yz xz


def array(name, values):
    """One DataArray, in base64 with the number of bytes before it"""
    values = np.ascontiguousarray(values)
    width = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    data = np.uint64(values.nbytes).tobytes() + values.tobytes()
    return (f'<DataArray type="{TYPES[values.dtype.kind]}" Name={quoteattr(name)}{width} '
            f'format="binary">{base64.b64encode(data).decode()}</DataArray>\n')


def fields_of(path, n):
    """(name, values) of the fields with n rows; tensors in VTK's order"""
    with h5py.File(path, "r") as file:
        for name, values in file.items():
            if len(values) == n:
                values = values[:].astype(np.float64)
                values = values.reshape(n, -1) if values.size > n else values.ravel()
                yield name, values[:, SYMMETRIC] if values.ndim > 1 and values.shape[1] == 6 else values


def write_step(files, step, path):
    """One load step"""
    sizes = np.array([len(cell) for cell in files.cells], np.int64)
    points, cells = len(files.vertices), len(sizes)
    kinds = np.array([VTK_CELLS[n] for n in sizes], np.uint8)
    with open(path, "w", encoding="ascii") as out:
        out.write('<?xml version="1.0"?>\n'
                  '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
                  '<UnstructuredGrid>\n')
        out.write(f'<Piece NumberOfPoints="{points}" NumberOfCells="{cells}">\n<Points>\n')
        out.write(array("Points", files.vertices.astype(np.float64)) + "</Points>\n<Cells>\n")
        out.write(
            array("connectivity",
                  np.concatenate(files.cells).astype(np.int64)) + array("offsets", np.cumsum(sizes)) +
            array("types", kinds))
        out.write('</Cells>\n<PointData Vectors="displacement">\n')
        out.writelines(array(*field) for field in fields_of(files.files[step], points))
        out.write("</PointData>\n<CellData>\n" + array("body", files.body.astype(np.int64)))
        if cells != points:
            out.writelines(array(*field) for field in fields_of(files.files[step], cells))
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
