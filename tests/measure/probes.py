"""Holds the probes, fields and tables of probes.sh's stack against its exact answer: pressure 2, free to widen."""
import csv
import json
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

P = 2.0
# young, poisson: both widen alike, and too little to be seen in the area that the contact pressure is over
LAYERS = ((1e5, 0.3), (5e4, 0.15))


def exact(x, body, factor):
    """Displacement; the stress is -P along z alone"""
    young, poisson = LAYERS[body]
    strain = -P * factor / young
    lift = -P * factor / LAYERS[0][0] if body else 0.0
    return np.array([-poisson * strain * x[0], -poisson * strain * x[1], lift + strain * (x[2] - body)])


def near(a, b, tolerance=1e-8):
    return bool(np.allclose(a, b, rtol=0, atol=tolerance * max(1e-5, np.max(np.abs(b)))))


def stress_is(point, factor):
    values = [point["stress_" + c] for c in ("xx", "yy", "zz", "xy", "yz", "zx")]
    return near(values, [0, 0, -P * factor, 0, 0, 0]) and near(point["von_mises"], P * factor) and near(
        [point["principal_%d" % i] for i in (1, 2, 3)], [0, 0, -P * factor])


def table(name):
    with open(name, newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def vector(row, key):
    return [row[key + "_" + axis] for axis in "xyz"]


def judge_summary():
    for step in json.load(open("stack.json"))["steps"]:
        for point in step["probes"] + step["lines"]:
            body = int(point["name"] in ("corner", "above", "seam"))
            contact = point["contact_pressure"], point["contact_gap"], point["contact_status"]
            paired = point["place"][2] == 1.0
            good = near(point["displacement"], exact(point["place"], body, step["load"])), stress_is(
                point,
                step["load"]), near(contact, [P * step["load"], 0, 1], 1e-4) if paired else contact == (None, None,
                                                                                                        None)
            if not all(good):
                print("WRONG", point["name"], good)
        print("step %d: %s; %d points of lines" %
              (step["step"], " ".join(point["name"] for point in step["probes"]), len(step["lines"])))


def judge_tables():
    history, height, seam = table("stack.csv"), table("stack_height.csv"), table("stack_seam.csv")
    good = all(
        near(vector(row, "below.displacement"), exact([1.1, 0.2, 1], 0, row["load"]))
        and near(row["below.contact_pressure"], P * row["load"], 1e-4) and np.isnan(row["inside.contact_gap"])
        for row in history)
    print("history %s, lines of %s points at %s" % (good, len(height) // 2, [row["arc"] for row in height[5:]]))
    print("along them",
          all(near(vector(row, "displacement"), exact(vector(row, "place"), 0, row["time"] / 2)) for row in height),
          all(stress_is(row, row["time"] / 2) for row in height + seam))


def fields(name):
    grid = ElementTree.parse(name).getroot().findall("./Domain/Grid/Grid")[-1]
    found = {}
    for item in [
            grid.find("Geometry/DataItem"),
            grid.find("Topology/DataItem"), *(a.find("DataItem") for a in grid.iter("Attribute"))
    ]:
        if item is not None:
            file, dataset = item.text.split(":/")
            with h5py.File(file) as values:
                found[dataset] = values[dataset][...]
            if found[dataset].shape != tuple(int(n) for n in item.get("Dimensions").split()):
                print("WRONG shape of", dataset)
    return found


def judge_fields():
    mesh, cloud = fields("stack.xmf"), fields("stack_gauss.xmf")
    p = mesh["vertices"][mesh["cells"]]
    volume = np.prod(p.max(axis=1) - p.min(axis=1), axis=1)
    energy = json.load(open("stack.json"))["steps"][-1]["energy"]
    tensor = [0, 0, 0, 0, 0, -P]  # xx xy xz yy yz zz
    print("fields", near((mesh["strain_energy_density"] * volume).sum(), energy), near(mesh["nodal_stress"], tensor),
          near(mesh["stress"], tensor), near(mesh["nodal_von_mises"], P), near(mesh["principal_stress"], [0, 0, -P]))
    print("quadrature points",
          len(cloud["gauss_points"]) == 8 * len(volume), near(cloud["gauss_stress"], tensor),
          near(cloud["gauss_points"].min(), mesh["vertices"].min() + (0.5 - 12**-0.5) / 2))


judge_summary()
judge_tables()
judge_fields()
