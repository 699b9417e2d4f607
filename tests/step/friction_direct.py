"""Blocks with friction on rigid ground, solved once more by other means: trilinear hexahedra assembled here, K
condensed to the vertices in contact by a dense factorization, and Coulomb's law there by Gauss and Seidel's method (M.
Jean, The non-smooth contact dynamics method, Comput. Methods Appl. Mech. Engrg. 177, 1999), vertex after vertex until
nothing changes any longer.

python3 friction_direct.py scenes writes the scenes; python3 friction_direct.py compares the runs that
friction_direct.sh has made with that, and looks whether the law holds at every vertex.
"""
import itertools
import json
import sys

import numpy as np

YOUNG, POISSON = 1000.0, 0.3
DRIVEN = {
    "name": "driven", "size": (2, 1, 1), "cells": (5, 3, 3), "friction": 0.3, "top": [(0, 0, -0.01),
                                                                                      (0.006, 0.003, -0.01),
                                                                                      (0.003, 0.003, -0.008)]
}
# so small that no normal turns
LIFTED = {
    "name": "lifted", "size": (1, 1, 2), "cells": (4, 3, 5), "friction": 0.5, "top": [(-5e-9, 2e-9, -3e-9),
                                                                                      (-4.6e-9, 1.9e-9, -2.9e-9)],
    "pressures": {"xmin": 5e-6}
}
CASES = DRIVEN, LIFTED


def scene(case):
    text = f"""problem: {case["name"]}
bodies:
  - ground: {{lower: [-5, -5, -1], upper: [9, 9, 0], cells: [1, 1, 1], material: rigid}}
  - block: {{lower: [0, 0, 0], upper: {list(case["size"])}, cells: {list(case["cells"])}, young: {YOUNG},
            poisson: {POISSON}, element: full}}
displacements:
  - fix: {{body: ground, value: [0, 0, 0]}}
"""
    for c, name in enumerate("xyz"):
        value = ["free"] * 3
        value[c] = 1
        text += f"  - top{name}: {{face: block.zmax, value: [{', '.join(map(str, value))}], ramp: {name}}}\n"
    if "pressures" in case:
        text += "pressures:\n" + "".join(f"  - {face}: {{face: block.{face}, value: {p}}}\n"
                                         for face, p in case["pressures"].items())
    text += (f"contact:\n"
             f"  - base: {{mortar: ground.zmax, nonmortar: block.zmin, gap: node, friction: {case['friction']}}}\n"
             f"load: {{factors: {[1] * len(case['top'])}}}\n")
    text += "ramps:\n" + "".join(f"  - {name}: {{factors: {[u[c] for u in case['top']]}}}\n"
                                 for c, name in enumerate("xyz"))
    return text + "solver: {tao_ipfilter_tol: 1e-12}\n"


def shape(p):
    """Values and derivatives of the eight trilinear functions at p in [-1, 1]^3"""
    corners = np.array(list(itertools.product((-1, 1), repeat=3)))
    f = 1 + corners * p
    return f.prod(1) / 8, np.stack([corners[:, c] * np.delete(f, c, 1).prod(1) / 8 for c in range(3)], 1)


def element(h):
    """Stiffness of a brick of sides h"""
    shear, lame = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    K = np.zeros((24, 24))
    for p in itertools.product((-(3**-0.5), 3**-0.5), repeat=3):
        g = shape(np.array(p))[1] * 2 / h
        k = lame * np.einsum("ai,bj->aibj", g, g) + shear * np.einsum("aj,bi->aibj", g, g) + shear * np.einsum(
            "ak,bk,ij->aibj", g, g, np.eye(3))
        K += k.reshape(24, 24) * h.prod() / 8
    return K


class Block:
    """Vertices, stiffness, loads and what is prescribed of a case"""

    def __init__(self, case):
        cells, size = np.array(case["cells"]), np.array(case["size"], float)
        self.h = size / cells
        grid = np.array(list(itertools.product(*(range(n + 1) for n in cells))))
        self.number = {tuple(g): i for i, g in enumerate(grid)}
        self.x = grid * self.h
        self.K = np.zeros((self.x.size, self.x.size))
        self.f = np.zeros(self.x.size)
        k = element(self.h)
        for cell in itertools.product(*(range(n) for n in cells)):
            at = np.array([self.number[tuple(np.add(cell, o))] for o in itertools.product((0, 1), repeat=3)])
            dofs = (3 * at[:, None] + np.arange(3)).ravel()
            self.K[np.ix_(dofs, dofs)] += k
        self.size, self.held = size, np.zeros(self.x.size, bool)
        for face, p in case.get("pressures", {}).items():
            self.press(face, p)
        self.held[(3 * self.on("zmax")[:, None] + np.arange(3)).ravel()] = True

    def on(self, face):
        c = "xyz".index(face[0])
        return np.flatnonzero(np.abs(self.x[:, c] - (self.size[c] if face[1:] == "max" else 0)) < 1e-12)

    def press(self, face, p):
        """Of a uniform pressure each corner of a rectangle has a quarter"""
        c = "xyz".index(face[0])
        others = [d for d in range(3) if d != c]
        for v in self.on(face):
            share = np.prod(
                [self.h[d] * (0.5 if min(self.x[v, d], self.size[d] - self.x[v, d]) < 1e-12 else 1.0) for d in others])
            self.f[3 * v + c] -= (1 if face[1:] == "max" else -1) * p * share


def gauss_seidel(C, free, friction, before):
    """Forces at the vertices in contact, where C f + free are their places, `before` those of the last step"""
    n = len(free) // 3
    f = np.zeros(3 * n)
    for _ in range(20000):
        last = f.copy()
        for i in range(n):
            s = slice(3 * i, 3 * i + 3)
            at = C[s] @ f + free[s] - C[s, s] @ f[s]
            f[s] = local(C[s, s], at, before[s], friction, f[s])
        if np.abs(f - last).max() <= 1e-13 * np.abs(f).max():
            return f
    raise RuntimeError("no end")


def local(W, at, before, friction, f):
    """One vertex, `at` its place without its own force, from a force f on: normal force and friction by projections in
    turn"""
    for _ in range(5):
        normal = max(0.0, f[2] - (W[2] @ f + at[2]) / W[2, 2])
        b = f[:2] - ((W @ f + at - before)[:2] + W[:2, 2] * (normal - f[2])) / (W[0, 0] + W[1, 1])
        size, bound = np.hypot(*b), friction * normal
        f = np.r_[b * (bound / size if size > bound else 1.0), normal]
    return f


def solve(case):
    """Displacements and forces at the base of each step"""
    block = Block(case)
    base = block.on("zmin")
    rows = (3 * base[:, None] + np.arange(3)).ravel()
    moved = ~block.held
    inverse = np.zeros_like(block.K)
    inverse[np.ix_(moved, moved)] = np.linalg.inv(block.K[np.ix_(moved, moved)])
    C = inverse[np.ix_(rows, rows)]
    before, answers = np.zeros(len(rows)), []
    for top in case["top"]:
        u = np.zeros(block.x.size)
        u.reshape(-1, 3)[block.on("zmax")] = top
        u = u + inverse @ (block.f - block.K @ u)
        f = gauss_seidel(C, u[rows], case["friction"], before)
        u = u + inverse[:, rows] @ f
        before = u[rows]
        answers.append((u.reshape(-1, 3), f.reshape(-1, 3), base))
    return block, answers


def verdict(what, value, limit):
    print(f"{what}: below {limit:g}" if value <= limit else f"{what}: {value:.3g} is above {limit:g}")


def compare(case):
    import h5py

    name = case["name"]
    block, answers = solve(case)
    with h5py.File(name + ".h5") as mesh:
        x = mesh["vertices"][...]
    with open(name + ".json") as file:
        steps = json.load(file)["steps"]
    order = {
        tuple(np.round(p, 9)): i
        for i, p in enumerate(x)
        if p[2] > -1e-9 and min(p) > -1e-9 and (p <= block.size + 1e-9).all()
    }
    at = np.array([order[tuple(np.round(p, 9))] for p in block.x])
    before = np.zeros((len(answers[0][2]), 3))
    for step, (u, f, base) in zip(steps, answers):
        with h5py.File(f"{name}_{step['step']:04d}.h5") as fields:
            found, status = fields["displacement"][...][at], fields["contact_status"][...][at][base]
            force = np.abs(fields["contact_pressure"][...][at][base] * fields["contact_area"][...][at][base])
            shear = np.abs(fields["contact_area"][...][at][base])[:, None] * fields["contact_shear"][...][at][base]
        n, t, slip = f[:, 2], f[:, :2], (found[base] - before)[:, :2]
        sizes = np.hypot(shear[:, 0], shear[:, 1])
        verdict(f"{name}, step {step['step']}, displacements", np.abs(found - u).max() / np.abs(u).max(), 1e-8)
        verdict(f"{name}, step {step['step']}, normal forces", np.abs(force - n).max() / n.max(), 1e-8)
        verdict(f"{name}, step {step['step']}, friction", np.abs(shear[:, :2] - t).max() / n.max(), 1e-8)
        verdict(f"{name}, step {step['step']}, friction beyond its bound",
                (sizes - case["friction"] * force).max() / n.max(), 1e-8)
        verdict(
            f"{name}, step {step['step']}, slip against its friction",
            np.abs(slip *
                   (case["friction"] * force)[:, None] + np.hypot(*slip.T)[:, None] * shear[:, :2])[force > 0].max() /
            n.max() / np.abs(u).max(), 1e-8)
        print(f"{name}, step {step['step']}:",
              " ".join(f"{(status == k).sum()} {word}" for k, word in enumerate(("open", "stick", "slip"))))
        before = found[base]


if sys.argv[1:] == ["scenes"]:
    for case in CASES:
        with open(case["name"] + ".yaml", "w") as file:
            file.write(scene(case))
else:
    for case in CASES:
        compare(case)
