"""Holds the summaries and fields that beam_sphere.sh wrote against each other, and with the argument `long` those of
beam_sphere_long.sh against the published figures of mesh 1."""
import sys

import h5py
import numpy as np

from summaries import each, load, mean, say, within


def newton(run):
    return mean(each(run, "ip_iterations"))


def pcg(run):
    return mean([k for step in run["steps"] for k in step["ksp_iterations"] if k])


def dent(name):
    """How far the shell's pole lies below the ridge around it at the end, on its middle surface r = 0.9 in the plane z
    = 0."""
    with h5py.File(name + ".h5") as mesh, h5py.File(name + "_0006.h5") as step:
        vertices, body, cells = mesh["vertices"][:], mesh["body"][:].ravel(), mesh["cells"][:]
        moved = vertices + step["displacement"][:]
    shell = np.zeros(len(vertices), bool)
    shell[np.unique(cells[body == 1])] = True
    arc = shell & (np.abs(np.linalg.norm(vertices, axis=1) - 0.9) < 1e-6) & (np.abs(vertices[:, 2]) < 1e-9)
    pole = moved[arc][np.argmin(np.abs(vertices[arc, 1])), 0]
    return moved[arc, 0].max() - pole


if sys.argv[1:] == ["long"]:
    for name, iterations, krylov, rows in (("linear", 15, 15, 197), ("neo_hookean", 17, 17, 210)):
        run = load(name + "_published")
        say(name + ": 7902 unknowns", run["dofs"] == 7902, run["dofs"])
        say(name + ": constraints within 20 %% of %d" % rows, within(max(each(run, "constraints")), rows, 0.2),
            each(run, "constraints"))
        say(name + ": interior-point iterations within 30 %% of %d" % iterations, within(newton(run), iterations, 0.3),
            newton(run))
        say(name + ": mean PCG iterations within 35 %% of %d" % krylov, within(pcg(run), krylov, 0.35), pcg(run))
    sys.exit()
linear, energy, quadratic = load("linear"), load("neo_hookean"), load("tangent")
say("linear: equilibrium to 1e-8", max(each(linear, "equilibrium")) <= 1e-8, each(linear, "equilibrium"))
say("true energy: equilibrium to 1e-8", max(each(energy, "equilibrium")) <= 1e-8, each(energy, "equilibrium"))
say("one tangent a load step: a tenth of the forces or more out of balance",
    min(each(quadratic, "equilibrium")) > 0.1, each(quadratic, "equilibrium"))
dents = dent("linear"), dent("neo_hookean")
say("the neo-Hookean wall has turned in by more than 0.17, five times as far as the linear one",
    dents[1] > 0.17 > 5 * dents[0], dents)
