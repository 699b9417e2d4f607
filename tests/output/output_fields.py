"""Reads NAME.xmf and the HDF5 files it refers to, and checks them against what output_fields.c wrote."""
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np


def read(folder, item):
    name, dataset = item.text.split(":")
    with h5py.File(os.path.join(folder, name), "r") as file:
        values = file[dataset][...]
    if values.shape != tuple(int(n) for n in item.get("Dimensions").split()):
        raise SystemExit(f"{item.text}: {values.shape} in the file, {item.get('Dimensions')} in the XDMF")
    if values.dtype.itemsize != int(item.get("Precision")):
        raise SystemExit(f"{item.text}: {values.dtype} in the file, {item.get('Precision')} bytes in the XDMF")
    return values


def volumes(x, cells):
    """Volume of each box in VTK's order, negative where it is inside out."""
    p = x[cells]
    edges = [p[:, i] - p[:, 0] for i in (1, 3, 4)]
    far = p[:, 0] + edges[0] + edges[1] + edges[2]
    if not np.allclose(far, p[:, 6]) or not np.allclose(p[:, 0] + edges[0] + edges[1], p[:, 2]):
        raise SystemExit("cells are not in VTK's order")
    return np.einsum("ij,ij->i", np.cross(edges[0], edges[1]), edges[2])


def main(base):
    root = ElementTree.parse(base + ".xmf").getroot()
    folder = os.path.dirname(base)
    print("bodies", [i.get("Value") for i in root.iter("Information")])
    for grid in root.iterfind("./Domain/Grid/Grid"):
        time = float(grid.find("Time").get("Value"))
        fields = {a.get("Name"): read(folder, a.find("DataItem")) for a in grid.iter("Attribute")}
        x = read(folder, grid.find("Geometry/DataItem"))
        cells = read(folder, grid.find("Topology/DataItem"))
        body = fields["body"][:, 0]
        volume = volumes(x, cells)
        mean = x[cells].mean(axis=1)[:, 0]
        surface = (x[:, 2] == 1) & (x[:, 0] >= 1) & (x[:, 0] <= 2) & (x[:, 1] <= 1)
        upper = np.zeros(len(x), bool)
        upper[cells[body == 1]] = True
        rows = surface & upper
        repeat = x[:, 1] == 0
        pressure = np.where(rows, (1 + x[:, 0]) * np.where(repeat, 5 / 3, 1), 0)  # means weighted by areas 1 and 2
        area = np.where(rows, np.where(repeat, 3, 1), 0)
        status = np.where(rows, repeat & (x[:, 0] > 1), np.nan)
        force = np.where(rows[:, None], np.stack([x[:, 0] * (1 + repeat), 2.0 * (1 + repeat), area], axis=1), 0)
        gap = np.where(rows, -x[:, 0], np.nan)
        order = [1, 4, 6, 2, 5, 3]  # xx xy xz yy yz zz, each a multiple of the mean x
        checks = {
            "displacement": np.allclose(fields["displacement"], time * (x + 10 * np.roll(x, -1, axis=1)), atol=1e-14),
            "stress": np.allclose(fields["stress"], mean[:, None] * order, atol=1e-13),
            "von_mises": np.allclose(fields["von_mises"], 7 * mean, atol=1e-13),
            "contact_pressure": np.allclose(fields["contact_pressure"], pressure, atol=1e-14),
            "contact_gap": np.allclose(fields["contact_gap"], gap, atol=1e-14, equal_nan=True),
            "contact_area": np.allclose(fields["contact_area"], area, atol=1e-14),
            "contact_status": np.allclose(fields["contact_status"], status, equal_nan=True),
            "contact_force": np.allclose(fields["contact_force"], force, atol=1e-14),
            "first_pair": np.allclose(fields["contact_pressure_first"], np.where(rows, 1 + x[:, 0], 0), atol=1e-14),
            "second_pair": np.allclose(fields["contact_gap_second"], np.where(rows & repeat, 1 - x[:, 0], np.nan),
                                       atol=1e-14, equal_nan=True),
        }
        print(f"time {time}: {len(x)} vertices, {len(np.unique(x[~upper], axis=0))} and "
              f"{len(np.unique(x[upper], axis=0))} apart,"
              f" {len(cells)} cells, volumes {volume[body == 0].sum():.12g} {volume[body == 1].sum():.12g}, "
              f"smallest {volume.min():.12g}, {rows.sum()} rows")
        print("  " + " ".join(f"{name}:{'ok' if good else 'WRONG'}" for name, good in checks.items()))


main(sys.argv[1])
