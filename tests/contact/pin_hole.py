"""Scenes for pin_hole.sh, and their exact answer: python pin_hole.py write|judge.

A disc of nearly the radius of a hole in an infinite plate, of one material, plane strain, pressed by a force Q a
thickness to a half angle of contact (A. Persson, On the stress distribution of cylindrical elastic bodies in contact,
Chalmers, 1964; M. Ciavarella, P. Decuzzi, Int. J. Solids Struct. 38, 2001). A force at the middle of the disc, a body
force in it and whatever holds a circle about the plate move the two faces by the cosine of the angle alone, which is a
motion of the disc: the pressure does not depend on them.
What is computed has a bore of 1/100 of the disc's radius, a plate that ends at 40 times the hole's, and displacements
of up to 1/700 of the radius, which the exact solution takes for small: together they leave 0.2 % of the pressure.
"""
import sys

import h5py
import numpy as np

from summaries import load, say

RADIUS, CLEARANCE, BORE, YOUNG, POISSON, HEIGHT = 10.0, 0.004, 0.1, 210000.0, 0.3, 0.5
STIFFNESS = YOUNG / (1 - POISSON**2)
HALF_ANGLES = (30, 55, 75)  # degrees, of the three loads under force control
RUNS = [(control, side, mesh) for control in ("force", "displacement") for side in ("pin", "plate")
        for mesh in ("coarse", "fine")
        if mesh == "coarse" or control + side in ("forcepin", "displacementplate")]
REFINED = {"coarse": 1, "fine": 2}

SCENE = """bodies:
  - pin: {{shape: tube_arc, axis: z, center: [{clearance}, 0, 0], radii: [{bore}, {pin}], angles: [0, 180],
          extent: [0, {height}], cells: {pin_cells}, grading: [1/6, 1, 1], young: {young}, poisson: {poisson}}}
  - plate: {{shape: tube_arc, axis: z, radii: [{hole}, 400], angles: [0, 180], extent: [0, {height}],
            cells: {plate_cells}, grading: [120, 1, 1], young: {young}, poisson: {poisson}}}
symmetry: [pin.amin, pin.amax, pin.lmin, pin.lmax, plate.amin, plate.amax, plate.lmin, plate.lmax]
contact:
  - joint: {{mortar: {mortar}, nonmortar: {nonmortar}, distance: 1}}
displacements:
  - rim: {{face: plate.outer, value: [0, 0, 0]}}
{push}
"""


def pressure(angle, half):
    """p R / Q at an angle from the line of the force"""
    b, y = np.tan(half / 2), np.tan(np.minimum(np.abs(angle), half) / 2)
    root, edge = np.sqrt(b * b + 1), np.sqrt(b * b - y * y)
    return 2 / np.pi / root * edge / (1 + y * y) + np.log(
        (root + edge) / (root - edge)) / (2 * np.pi * b**2 * (1 + b * b))


def clearance(half):
    """E' x difference of the radii / Q"""
    square = np.tan(half / 2)**2
    return (2 * (1 - square) - np.log(1 + square) / (1 + square)) / (np.pi * square)


def push(control):
    if control == "displacement":
        return "  - bore: {face: pin.inner, value: [%g, 0, free]}\nload: {factors: [0.3, 0.5, 1]}" % (6 * CLEARANCE)
    forces = [STIFFNESS * CLEARANCE / clearance(np.radians(half)) for half in HALF_ANGLES]
    weight = forces[-1] / (np.pi * ((RADIUS - CLEARANCE)**2 - BORE**2))
    return "body_forces:\n  - weight: {body: pin, value: [%.15g, 0, 0]}\nload: {factors: %s}" % (
        weight, ["%.15g" % (f / forces[-1]) for f in forces])


def write():
    for control, side, mesh in RUNS:
        n = REFINED[mesh]
        mortar, nonmortar = ("plate.inner", "pin.outer") if side == "pin" else ("pin.outer", "plate.inner")
        fill = {
            "pin": RADIUS - CLEARANCE, "hole": RADIUS, "clearance": CLEARANCE, "bore": BORE, "height": HEIGHT / n,
            "young": YOUNG, "poisson": POISSON
        }
        fill |= {
            "mortar": mortar, "nonmortar": nonmortar, "pin_cells": [10 * n, 45 * n, 1],
            "plate_cells": [16 * n, 36 * n, 1]
        }
        with open("%s_%s_%s.yaml" % (control, side, mesh), "w") as file:
            file.write(SCENE.format(push=push(control), **fill).replace("'", ""))


def half_angle(force):
    """By bisection: the more force, the wider"""
    low, high = np.radians(2), np.radians(84.9)
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if STIFFNESS * CLEARANCE / clearance(middle) < force else (low, middle)
    return low


def curve(name, step, side):
    """Angle of the vertices of a face in the slice z = 0, and their pressure"""
    with h5py.File(name + ".h5") as mesh, h5py.File("%s_%04d.h5" % (name, step)) as fields:
        x, body = mesh["vertices"][...], np.zeros(len(mesh["vertices"]), int)
        body[np.unique(mesh["cells"][...][mesh["body"][...].ravel() == 1])] = 1
        at = ~np.isnan(fields["contact_gap"][...]) & (x[:, 2] == 0) & (body == side)
        center = 0 if side else CLEARANCE
        return np.arctan2(x[at, 1], x[at, 0] - center), fields["contact_pressure"][...][at]


def errors(name, step, force, n):
    """Relative to the largest pressure: of the curve over both faces, but for the edge's cell, and but for two of the
    coarse mesh, where what counts is in which part of its cell the edge is; of the largest pressure"""
    half = half_angle(force)
    scale = force / RADIUS
    peak = scale * pressure(0.0, half)
    curves, top = [0, 0], 0
    for side in (0, 1):
        angle, p = curve(name, step, side)
        exact = np.where(angle < half, scale * pressure(angle, half), 0)
        for k, width in enumerate((np.pi / 36 / n, 2 * np.pi / 36)):
            curves[k] = max(curves[k], np.abs(p - exact)[np.abs(angle - half) > width].max() / peak)
        top = max(top, abs(p[np.argmin(angle)] / peak - 1))
    return curves[0], curves[1], top


def judge():
    seen = {}
    for run in RUNS:
        name, n = "_".join(run), REFINED[run[2]]
        summary = load(name)
        forces = [2 * abs(step["pairs"][0]["force"][0]) * n / HEIGHT for step in summary["steps"]]
        seen[run] = np.array([errors(name, k, force, n) for k, force in enumerate(forces, 1)])
        say(name + ": it converges to a true gap", summary["exit_code"] == 0, summary["exit_code"])
        say(name + ": three loads, the pressure within 5 % of the largest at every vertex outside the edge's cell",
            seen[run][:, 0].max() <= 0.05, seen[run][:, 0])
        say(name + ": the largest pressure within 2 %", seen[run][:, 2].max() <= 0.02, seen[run][:, 2])
        say(name + ": the last load closes a half angle of more than 60 degrees",
            np.degrees(half_angle(forces[-1])) > 60, forces)
    for control, side, mesh in RUNS:
        if mesh == "fine":
            coarse, fine = seen[control, side, "coarse"][:, 1:], seen[control, side, "fine"][:, 1:]
            say("%s, %s: refined once, both errors are halved, or below 0.2 %%" % (control, side),
                (fine <= np.maximum(coarse / 2, 2e-3)).all(), (coarse, fine))


write() if sys.argv[1] == "write" else judge()
