#!/usr/bin/env python3
"""Draws the deformed bodies of a finished run from the files contact -output BASE wrote, without a display.

    share/plot/draw.py BASE PICTURE.png [--step N] [--field von_mises|contact_pressure|contact_gap|contact_status|displacement|body]
                       [--scale 1] [--view ELEVATION AZIMUTH] [--up x|y|z] [--only BODY,...] [--hide AXIS<VALUE] [--title TEXT]

Only faces that look at the viewer are drawn, coloured by the mean of the field, shaded by their normal. Fields of contact colour the faces
all of whose vertices are in a contact pair. The last step is that of BASE.xmf, not of an older run.
"""
import argparse
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

# quadrilaterals of a VTK/XDMF hexahedron, outward; triangles of tetrahedra, with the last corner twice, of 10 nodes cut into four at these
HEXAHEDRON = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
TETRAHEDRON = [[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [0, 3, 2, 2]]
EDGES = {(0, 1): 4, (1, 2): 5, (0, 2): 6, (0, 3): 7, (1, 3): 8, (2, 3): 9}
KINDS = {6: 4, 38: 10, 9: 8}  # nodes of XDMF's kinds of cells
LABELS = {"von_mises": "von Mises stress", "contact_pressure": "contact pressure", "contact_gap": "gap", "contact_status": "contact", "displacement": "displacement, norm", "body": "body"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("base")
    parser.add_argument("picture")
    parser.add_argument("--step", type=int, default=0, help="load step; the last one by default")
    parser.add_argument("--field", choices=LABELS, default="von_mises")
    parser.add_argument("--scale", type=float, default=1.0, help="factor of the displacement")
    parser.add_argument("--view", type=float, nargs=2, default=(20, -60), metavar=("ELEVATION", "AZIMUTH"))
    parser.add_argument("--up", choices="xyz", default="z")
    parser.add_argument("--only", help="numbers of the bodies to draw, e.g. 0,2")
    parser.add_argument("--hide", default="", help="leave out the cells whose centre is on this side, e.g. 'y<0'")
    parser.add_argument("--title", default="")
    parser.add_argument("--limit", type=float, help="upper end of the colours")
    return parser.parse_args()


def step_file(args):
    """The step's that is asked for; else the last that the run lists and that exists"""
    if args.step:
        return "%s_%04d.h5" % (args.base, args.step)
    try:
        items = ElementTree.parse(args.base + ".xmf").getroot().iterfind(".//Attribute[@Name='displacement']/DataItem")
    except OSError:
        items = []
    folder = os.path.dirname(args.base)
    steps = [name for name in (os.path.join(folder, item.text.rsplit(":", 1)[0]) for item in items) if os.path.exists(name)]
    if not steps:
        sys.exit("draw.py: no step in %s.xmf; run contact with -output %s" % (args.base, args.base))
    return steps[-1]


def cut(triangle):
    """The four triangles that the middles of its edges cut a triangle into"""
    a, b, c = triangle[:3]
    ab, bc, ca = (EDGES[tuple(sorted(edge))] for edge in ((a, b), (b, c), (c, a)))
    return [[a, ab, ca, ca], [b, bc, ab, ab], [c, ca, bc, bc], [ab, bc, ca, ca]]


FACES = {8: HEXAHEDRON, 4: TETRAHEDRON, 10: [piece for triangle in TETRAHEDRON for piece in cut(triangle)]}


def read_cells(mesh):
    """The nodes of each cell"""
    if "cells" in mesh:
        return list(mesh["cells"][:])
    numbers, cells, at = mesh["mixed_cells"][:].ravel(), [], 0
    while at < len(numbers):
        n = KINDS[numbers[at]]
        cells.append(numbers[at + 1 : at + 1 + n])
        at += 1 + n
    return cells


def load(args):
    """Cells, reference vertices, displacement, a field by cell or by vertex, and which vertices are in contact pairs."""
    name = step_file(args)
    with h5py.File(args.base + ".h5") as mesh, h5py.File(name) as step:
        cells, vertices, body = read_cells(mesh), mesh["vertices"][:], mesh["body"][:].ravel()
        displacement = step["displacement"][:]
        if args.field == "body":
            field = body.astype(float)
        elif args.field == "displacement":
            field = np.linalg.norm(displacement, axis=1)
        elif args.field in step:
            field = step[args.field][:]
        else:
            sys.exit("draw.py: %s has no field %s" % (name, args.field))
        paired = ~np.isnan(step["contact_gap"][:])
    return cells, vertices, body, displacement, field, paired


def colours(args, quads, owner, ncells, field, paired):
    """Mean over the vertices; a field of contact is none of a face beside it, though some vertices are the contact's too"""
    if len(field) == ncells:
        return field[owner]
    if not args.field.startswith("contact_"):
        return field[quads].mean(axis=1)
    return np.where(paired[quads].all(axis=1), field[quads].mean(axis=1), 0.0)


def selected(args, cells, vertices, body):
    keep = np.ones(len(cells), bool)
    if args.only:
        keep &= np.isin(body, [int(b) for b in args.only.split(",")])
    if args.hide:
        axis, side, value = args.hide[0], args.hide[1], float(args.hide[2:])
        centre = np.array([vertices[cell, "xyz".index(axis)].mean() for cell in cells])
        keep &= ~((centre < value) if side == "<" else (centre > value))
    return np.flatnonzero(keep)


def boundary(cells, chosen):
    """Quadrilaterals of the chosen cells that no second chosen cell shares, and the cell of each."""
    quads = np.concatenate([cells[c][FACES[len(cells[c])]] for c in chosen])
    owner = np.repeat(chosen, [len(FACES[len(cells[c])]) for c in chosen])
    key = np.where((quads[:, 2] == quads[:, 3])[:, None] & (np.arange(4) == 3), -1, quads)
    _, first, count = np.unique(np.sort(key, axis=1), axis=0, return_index=True, return_counts=True)
    alone = first[count == 1]
    return quads[alone], owner[alone]


def main():
    args = arguments()
    cells, vertices, body, displacement, field, paired = load(args)
    quads, owner = boundary(cells, selected(args, cells, vertices, body))
    colour = colours(args, quads, owner, len(cells), field, paired)
    order = {"z": [0, 1, 2], "x": [1, 2, 0], "y": [2, 0, 1]}[args.up]
    corners = (vertices + args.scale * displacement)[quads][:, :, order]

    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    elevation, azimuth = np.radians(args.view)
    towards = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    front = normal @ towards > -0.05
    corners, colour, shade = corners[front], colour[front], 0.75 + 0.25 * np.abs(normal[front] @ towards)

    norm = plt.Normalize(min(0.0, colour.min()), args.limit or colour.max())
    rgba = plt.get_cmap("viridis")(norm(colour))
    rgba[:, :3] *= shade[:, None]
    figure = plt.figure(figsize=(8, 6))
    axes = figure.add_subplot(projection="3d", proj_type="ortho")
    axes.add_collection3d(Poly3DCollection(corners, facecolors=rgba, edgecolors=(0, 0, 0, 0.25), linewidths=0.2))
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.0)
    axes.view_init(*args.view)
    axes.set_axis_off()
    figure.colorbar(plt.cm.ScalarMappable(norm, "viridis"), ax=axes, shrink=0.6, label=LABELS[args.field])
    if args.title:
        axes.set_title(args.title)
    figure.savefig(args.picture, dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    main()
