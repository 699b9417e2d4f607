"""Scenes for shrink_spheres.sh, octants of thick concentric spheres that overlap, and Lame's answer: python
shrink_spheres.py write|judge."""
import sys

import h5py
import numpy as np

from summaries import load, say

YOUNG, POISSON, OVERLAP = 1000, 0.3, 0.01
INNER, OUTER = (1, 2 + OVERLAP / 2), (2 - OVERLAP / 2, 3)
PATCHES = ((4, 5), (6, 5), (6, 7))  # half the facets on a quarter circle, of the inner and the outer sphere

SCENE = """bodies:
  - inner: {{shape: sphere_shell, inner: {{radius: {a}}}, outer: {{radius: {b}}}, patches: [{n}, {n}, {n}], layers: 4,
            young: {young}, poisson: {poisson}, element: full}}
  - outer: {{shape: sphere_shell, inner: {{radius: {c}}}, outer: {{radius: {d}}}, patches: [{m}, {m}, {m}], layers: 4,
            young: {young}, poisson: {poisson}, element: full}}
symmetry: [inner.x0, inner.y0, inner.z0, outer.x0, outer.y0, outer.z0]
contact:
  - fit: {{mortar: {mortar}, nonmortar: {nonmortar}, interference: true}}
"""


def names():
    return [("spheres_%d_%d_%s" % (n, m, side), n, m, side) for n, m in PATCHES for side in ("in", "out")]


def write():
    for name, n, m, side in names():
        mortar, nonmortar = ("outer.inner", "inner.outer") if side == "in" else ("inner.outer", "outer.inner")
        with open(name + ".yaml", "w") as file:
            file.write(
                SCENE.format(a=INNER[0], b=INNER[1], c=OUTER[0], d=OUTER[1], n=n, m=m, young=YOUNG, poisson=POISSON,
                             mortar=mortar, nonmortar=nonmortar))


def lame():
    """The pressure"""
    (a, b), (c, d) = INNER, OUTER
    soft = b * ((1 - 2 * POISSON) * b**3 +
                (1 + POISSON) * a**3 / 2) / (b**3 - a**3) + c * ((1 - 2 * POISSON) * c**3 +
                                                                 (1 + POISSON) * d**3 / 2) / (d**3 - c**3)
    return OVERLAP * YOUNG / soft


def pressures(name):
    with h5py.File(name + "_0001.h5") as step:
        return step["contact_pressure"][...][~np.isnan(step["contact_gap"][...])] / lame()


def energy(name):
    return load(name)["steps"][0]["energy"] / (0.5 * lame() * OVERLAP * 4 * np.pi * 2**2 / 8)


def judge():
    for name, *_ in names():
        p = pressures(name)
        say(name + ": mean pressure within 1.2 % of Lame", abs(p.mean() - 1) <= 0.012, p.mean())
        say(name + ": pressure at every vertex within 3 % of its mean",
            abs(p / p.mean() - 1).max() <= 0.03, (p.min(), p.max()))
        say(name + ": energy within 2 % of Lame", abs(energy(name) - 1) <= 0.02, energy(name))
    p = pressures("refined")
    say("refined: mean pressure within 0.3 % of Lame, at every vertex within 1.5 % of it",
        abs(p.mean() - 1) <= 3e-3 and abs(p / p.mean() - 1).max() <= 0.015, (p.min(), p.mean(), p.max()))


write() if sys.argv[1] == "write" else judge()
