"""Runs the notebook of share/python cell by cell, and the package's calls (python_package.sh)"""
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

import contact

FOLDER = sys.argv[1]


def notebook():
    with open(os.path.join(FOLDER, "press.ipynb")) as file:
        cells = ["".join(cell["source"]) for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
    names, here = {}, os.getcwd()
    os.chdir(FOLDER)
    for cell in cells:
        exec(compile(cell.replace("print(", "str("), "press.ipynb", "exec"), names)
    os.chdir(here)
    print(
        f"notebook: {len(cells)} cells, a picture of more than 5,000 bytes: {os.path.getsize(names['picture']) > 5000},"
        f" which the last cell shows: {cells[-1].endswith('picture') and names['picture']._repr_png_()[1:4] == b'PNG'}")


def calls():
    run = contact.run("two_block.yaml", output="here", refine=0, error_estimate=0)
    again = contact.load("here.xmf")
    with h5py.File("here_0002.h5", "r") as file:
        same = np.array_equal(file["displacement"][:], again.displacement())
    print("load steps:", run.steps, "; displacement as in the file:", same)
    print("energy of the history is that of the summary:",
          np.allclose(run.history["energy"], [step["energy"] for step in run.summary["steps"]], rtol=1e-13))
    print("one pair's force under its last word:",
          np.array_equal(run.history["normal_force"], run.history["blocks.normal_force"]))
    print("its force as vectors:", np.array_equal(run.history["force"][:, 2], run.history["blocks.force_z"]),
          run.history["force"].shape)
    print(run)
    print("cells and points fit:",
          len(run.field("von_mises")) == len(run.cells),
          len(run.field("pressure")) == len(run.points))
    two = contact.run("two_block.yaml", output="two", ranks=2, refine=0, error_estimate=0)
    print("two ranks: the same energy:", np.allclose(two.history["energy"], run.history["energy"], rtol=1e-8))


def vtk():
    """Read back by VTK: times, places, fields, cells"""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    run = contact.load("here")
    path = run.write_vtk("written.pvd")
    sets = ElementTree.parse(path).getroot().findall("./Collection/DataSet")
    print("times:", [float(item.get("timestep")) for item in sets] == list(run.history["time"]))
    for step, item in zip(run.steps, sets):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(item.get("file"))
        reader.Update()
        grid = reader.GetOutput()
        data, cells = grid.GetPointData(), grid.GetCellData()
        print("step", step, "cells and points:",
              grid.GetNumberOfCells() == len(run.cells),
              np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), run.points))
        print(
            "fields:", np.array_equal(vtk_to_numpy(data.GetArray("displacement")), run.displacement(step)),
            np.array_equal(vtk_to_numpy(cells.GetArray("von_mises")), run.field("von_mises", step)),
            np.array_equal(
                vtk_to_numpy(cells.GetArray("stress"))[:, [0, 1, 3]].T,
                [run.field("stress_" + name, step) for name in ("xx", "yy", "xy")]))
    done = subprocess.run([sys.executable, "-B", os.path.join(FOLDER, "contact_mesh.py"), "here.xmf", "again.pvd"])
    with open("again_0002.vtu") as one, open("written_0002.vtu") as other:
        print("contact-mesh writes the same:", done.returncode == 0 and one.read() == other.read())


def refused():
    run = contact.load("here")
    for call in (
            lambda: contact.run("nothing.yaml"),
            lambda: contact.run("two_block.yaml", output="bad", refine="abc"),
            lambda: contact.load("nothing"),
            lambda: run.history["heat"],
            lambda: run.field("heat"),
            lambda: run.field("von_mises", step=7),
            lambda: run.plot("heat"),
            lambda: run.write_vtk("here.vtk"),
    ):
        try:
            print("accepted:", call())
        except contact.ContactError as error:
            print(str(error).replace(os.getcwd() + "/", ""))


notebook()
calls()
vtk()
refused()
