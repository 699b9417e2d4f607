"""Holds the runs of shrink_fit.sh against Lame's solution, each ring on its own radii, in plane strain."""
import h5py
import numpy as np

from summaries import load, say

YOUNG, POISSON, HEIGHT, OVERLAP = 210000, 0.3, 2, 0.03
INNER, OUTER = (15, 25.015), (24.985, 40)


def lame():
    """Pressure times radius"""
    ratio = POISSON / (1 - POISSON)
    inner = (INNER[1]**2 + INNER[0]**2) / (INNER[1]**2 - INNER[0]**2) - ratio
    outer = (OUTER[1]**2 + OUTER[0]**2) / (OUTER[1]**2 - OUTER[0]**2) + ratio
    return OVERLAP * YOUNG / (1 - POISSON**2) / (inner + outer)


def pressures(name):
    """Times radius, at the nonmortar vertices"""
    with h5py.File(name + ".h5") as mesh, h5py.File(name + "_0001.h5") as step:
        rows = ~np.isnan(step["contact_gap"][...])
        radius = np.hypot(*mesh["vertices"][...][rows, :2].T)
        return radius * step["contact_pressure"][...][rows] / lame()


def energy(name):
    return load(name)["steps"][0]["energy"] / (0.5 * lame() * OVERLAP * HEIGHT * np.pi / 2)


def updates(name):
    return load(name)["steps"][0]["contact_updates"]


def main():
    for facets in ("24_30", "30_24", "20_32"):
        for side in ("in", "out"):
            name = "rings_%s_%s" % (facets, side)
            p = pressures(name)
            say(name + ": mean pressure within 0.5 % of Lame", abs(p.mean() - 1) <= 0.005, p.mean())
            say(name + ": pressure at every vertex within 2 % of its mean",
                abs(p / p.mean() - 1).max() <= 0.02, (p.min(), p.max()))
            say(name + ": energy within 0.5 % of Lame", abs(energy(name) - 1) <= 0.005, energy(name))
            say(name + ": a true gap after four linearizations at most", updates(name) <= 4, updates(name))
    one = pressures("rings_24_30_in")
    for ranks in ("two", "three"):
        other = pressures(ranks + "_ranks")
        say(ranks + " ranks: the same pressures to 1e-6",
            np.abs(np.sort(other) - np.sort(one)).max() <= 1e-6,
            np.abs(np.sort(other) - np.sort(one)).max())
        say(ranks + " ranks: the same energy to 1e-12",
            abs(energy(ranks + "_ranks") - energy("rings_24_30_in")) <= 1e-12,
            energy(ranks + "_ranks") - energy("rings_24_30_in"))
    p = pressures("facets")
    say("facets: mean pressure 10 % or more below Lame", p.mean() <= 0.9, p.mean())
    p = pressures("node")
    say("node: mean pressure within 0.5 % of Lame", abs(p.mean() - 1) <= 0.005, p.mean())
    say("node: energy within 0.5 % of Lame", abs(energy("node") - 1) <= 0.005, energy("node"))


if __name__ == "__main__":
    main()
