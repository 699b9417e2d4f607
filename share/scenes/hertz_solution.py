"""Hertz's solutions of the scenes hertz_sphere, hertz_cylinder and ssnv104, and a run's figures beside the one at its
computed force.

python hertz_solution.py sphere|cylinder|ssnv104 NAME   prints the figures of a run, written with -output NAME -summary
NAME.json

Hertz's places and areas are those of the undeformed bodies. His pressure is fitted to the nodal forces of the mortar
method, contact_pressure times contact_area, over the nodal areas.
"""
import json
import math
import sys

import h5py
import numpy as np

FACES = np.array([[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])


class Sphere:
    """The quarter of half a ball that the scene shows, against a rigid plane"""

    radius, modulus, approach, share = 50.0, 20000 / 0.91, 1.25e-3, 1 / 4

    def distance(self, x):
        return np.hypot(x[:, 0], x[:, 1])

    def on_surface(self, x):
        return np.abs(np.linalg.norm(x - [0, 0, self.radius], axis=1) - self.radius) < 1e-9 * self.radius

    def at(self, force):
        """peak pressure, radius, approach"""
        a = (3 * force * self.radius / (4 * self.modulus))**(1 / 3)
        return 3 * force / (2 * math.pi * a**2), a, a**2 / self.radius

    def loaded(self):
        """force and energy at the scene's approach, of the whole"""
        force = 4 / 3 * self.modulus * self.radius**0.5 * self.approach**1.5
        return force, 0.4 * force * self.approach


class SSNV104(Sphere):
    approach = 2.0


class Cylinder:
    """Half of half a cylinder, its force a length of the axis"""

    radius, modulus, approach, share = 1.0, 1000 / 0.91, 7.7308e-5, 0.005 / 2

    def distance(self, x):
        return np.abs(x[:, 0])

    def on_surface(self, x):
        return np.abs(np.hypot(x[:, 0], x[:, 2] - self.radius) - self.radius) < 1e-9 * self.radius

    def at(self, force):
        a = math.sqrt(4 * force * self.radius / (math.pi * self.modulus))
        return 2 * force / (math.pi * a), a, force / (math.pi * self.modulus) * (2 * math.log(4 * self.radius / a) - 1)

    def loaded(self):
        """force and energy at the scene's approach, a length; the approach grows with the force, the energy is its
        work"""
        low, high = 1e-12, 1e4
        for _ in range(200):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.at(middle)[2] < self.approach else (low, middle)
        return low, low * self.approach / 2 - low**2 / (4 * math.pi * self.modulus)


def areas(x, facets):
    """integral of each vertex's hat function"""
    points, weights = np.polynomial.legendre.leggauss(3)
    area = np.zeros(len(x))
    for s, ws in zip(points, weights):
        for t, wt in zip(points, weights):
            shape = np.array([(1 - s) * (1 - t), (1 + s) * (1 - t), (1 + s) * (1 + t), (1 - s) * (1 + t)]) / 4
            slope_s = np.array([-(1 - t), 1 - t, 1 + t, -(1 + t)]) / 4
            slope_t = np.array([-(1 - s), -(1 + s), 1 + s, 1 - s]) / 4
            along_s, along_t = np.einsum("a,qad->qd", slope_s, x[facets]), np.einsum("a,qad->qd", slope_t, x[facets])
            weight = ws * wt * np.linalg.norm(np.cross(along_s, along_t), axis=1)
            for a in range(4):
                np.add.at(area, facets[:, a], weight * shape[a])
    return area


def measure(problem, name):
    with h5py.File(name + ".h5") as file:
        x, cells = file["vertices"][...], file["cells"][...].reshape(-1, 8)
    with h5py.File(name + "_0001.h5") as file:
        pressure, covered = file["contact_pressure"][...].ravel(), file["contact_area"][...].ravel()
        u, gap = file["displacement"][...].reshape(-1, 3), file["contact_gap"][...].ravel()
    with open(name + ".json") as file:
        summary = json.load(file)
    facets = cells[:, FACES].reshape(-1, 4)
    facets = facets[problem.on_surface(x)[facets].all(axis=1)]
    area, r = areas(x, facets), problem.distance(x)
    average = np.divide(pressure * covered, area, out=np.zeros_like(area), where=area > 0)
    inner = average > average.max() / 2
    slope, square = np.polyfit(r[inner]**2, average[inner]**2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    on = problem.on_surface(x) & ~np.isnan(gap)
    force = abs(summary["steps"][0]["contact_force"][2]) / problem.share
    p0, a, approach = problem.at(force)
    fit_p0, fit_a = math.sqrt(square), math.sqrt(-square / slope)
    return {
        "unknowns": summary["dofs"],
        "updates": summary["steps"][0]["contact_updates"],
        "force": force,
        "peak pressure": fit_p0,
        "contact radius": fit_a,
        "contact radius, deformed": np.interp(fit_a, *np.sort([r[on], problem.distance(x + u)[on]])),
        "largest nodal pressure": pressure.max(),
        "errors": {
            "peak pressure": fit_p0 / p0 - 1, "contact radius": fit_a / a - 1,
            "approach": problem.approach / approach - 1
        },
        "nodal error": pressure.max() / p0 - 1,
    }


SOLUTIONS = {"sphere": Sphere, "cylinder": Cylinder, "ssnv104": SSNV104}

if __name__ == "__main__":
    print(json.dumps(measure(SOLUTIONS[sys.argv[1]](), sys.argv[2]), indent=2))
