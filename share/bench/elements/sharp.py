#!/usr/bin/env python3
"""Compares the forces of elements of order 1 and 2 where contact ends at an edge, mesh by mesh: sharp.md

    share/bench/elements/sharp.py [--only NAME] [--limit SECONDS] [--folder build/bench] [--largest]
"""
import argparse
import os
import re
import sys

TOP = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(TOP, "share", "bench"))
import machine  # noqa: E402
from references import richardson  # noqa: E402
from runs import Runs  # noqa: E402

# Ironing ends after the second load step of its sliding
SHORTER = (("steps: 10", "steps: 5"), ("1/3, 2/3, 1, 1, 1, 1, 1, 1, 1, 1", "1/3, 2/3, 1, 1, 1"),
           ("0, 0, 0, 1/7, 2/7, 3/7, 4/7, 5/7, 6/7, 1", "0, 0, 0, 1/7, 2/7"))
PUNCH = """bodies:
  - slab: {lower: [0, 0, -2], upper: [3, 0.2, 0], cells: [12, 1, 8], young: 1, poisson: 0.3}
  - punch: %s
displacements:
  - bottom: {face: slab.zmin, value: [0, 0, 0]}
  - top: {face: punch.zmax, value: [0, 0, -0.05]}
symmetry:
  - slab.xmin
  - slab.ymin
  - slab.ymax
  - middle: {face: punch.xmin, normal: x}
  - front: {face: punch.ymin, normal: y}
  - back: {face: punch.ymax, normal: y}
contact:
  - press: {mortar: slab.zmax, nonmortar: punch.zmin}
"""
SHARP = "{lower: [0, 0, 0], upper: [1, 0.2, 1], cells: [6, 1, 6], young: 1000, poisson: 0}"
ROUND = "{mesh: %s, volume: punch, young: 1000, poisson: 0}"
LEVELS = {1: (0, 1, 2, 3), 2: (0, 1, 2)}  # refinements by order
# problem: the same for a mesh that is finer from the start
LESS = {
    "two_block linear": {1: (0, 1, 2), 2: (0, 1)}, "two_block": {1: (0, 1, 2), 2: (0, 1)},
    "ironing": {1: (0, 1), 2: (0, )}
}
# 699,486 and 89,370 unknowns
LARGEST = {("two_block", 1): (3, ), ("two_block", 2): (2, ), ("ironing", 1): (2, ), ("ironing", 2): (1, )}
TITLES = {
    "two_block linear": "two_block, gap linearized once, one load step",
    "two_block": "two_block, consistent gap, two load steps",
    "sharp punch": "flat punch with a sharp edge, plane strain",
    "rounded punch": "flat punch with a rounded edge, plane strain", "ironing": "ironing, pressed and slid by 2/7"
}


def example(name):
    with open(os.path.join(TOP, "share", "scenes", name + ".yaml")) as file:
        return file.read()


def rounded(factor, path):
    """An Abaqus deck of the punch: half of it, 1 wide, flat to 0.6, then an arc of radius 0.8"""
    nx, nz, radius, flat = 6 * factor, 6 * factor, 0.8, 0.6
    bottom = lambda x: 0.0 if x <= flat else radius - (radius**2 - (x - flat)**2)**0.5  # noqa: E731
    number = lambda i, j, k: 1 + i + (nx + 1) * (j + 2 * k)  # noqa: E731
    lines, sets = ["*NODE"], {"xmin": [], "ymin": [], "ymax": [], "zmin": [], "zmax": []}
    for k in range(nz + 1):
        for j in range(2):
            for i in range(nx + 1):
                x, low = i / nx, bottom(i / nx)
                lines.append(f"{number(i, j, k)}, {x:.15g}, {0.2 * j}, {low + (1 - low) * k / nz:.15g}")
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=punch")
    for k in range(nz):
        for i in range(nx):
            e = 1 + i + nx * k
            corners = [
                number(i + a, b, k + c)
                for a, b, c in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
            ]
            lines.append(", ".join(map(str, (e, *corners))))
            sets["ymin"].append((e, 3))
            sets["ymax"].append((e, 5))
            if i == 0:
                sets["xmin"].append((e, 6))
            if k == 0:
                sets["zmin"].append((e, 1))
            if k == nz - 1:
                sets["zmax"].append((e, 2))
    for name, sides in sets.items():
        lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT", *(f"{e}, S{side}" for e, side in sides)]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def scene(problem, order, level, folder):
    """The text of a scene, whose bodies are of an order"""
    if problem.startswith("two_block"):
        text = re.sub(r"^(contact_updates|refine| +element):.*\n", "", example("two_block"), flags=re.M)
        if problem == "two_block linear":
            text = text.replace("load: {steps: 2}", "contact_updates: 1")
    elif problem == "ironing":
        text = re.sub(r"^(refine| +element):.*\n", "", example("ironing"), flags=re.M)
        for old, new in SHORTER:
            text = text.replace(old, new)
    elif problem == "sharp punch":
        text = PUNCH % SHARP
    else:
        rounded(2**level, os.path.join(folder, f"punch_{level}.inp"))
        text = PUNCH % (ROUND % f"punch_{level}.inp")
        text = text.replace("cells: [12, 1, 8]", f"cells: [{12 * 2**level}, 1, {8 * 2**level}]")
    element = f"order: {order}, element: bbar"
    text = re.sub(r"(poisson: [\d.]+)\}", rf"\1, {element}}}", text)
    text = re.sub(r"^( +)(poisson: [\d.]+)$", rf"\1\2\n\1order: {order}\n\1element: bbar", text, flags=re.M)
    return text + ("" if problem == "rounded punch" else f"refine: {level}\n")


def run(problem, order, level, runs):
    """Unknowns, vertical force, contact updates of the last load step, user seconds, exit code; in their place why
    there is no answer"""
    record = runs.get(f"{problem}, {order}, {level}", scene(problem, order, level, runs.folder),
                      () if problem == "two_block linear" else ("-contact_updates", "40"))
    return record["failed"] or (record["unknowns"], abs(
        record["forces"][2]), record["updates"], record["seconds"], record["code"])


def limit_of(found):
    """The force that the last three meshes tend to; none if the differences between them hardly fall"""
    forces = [entry[1] for entry in found if not isinstance(entry, str)][-3:]
    if len(forces) < 3 or abs(forces[2] - forces[1]) > 0.75 * abs(forces[1] - forces[0]):
        return None
    return richardson([0.5**n for n in range(3)], forces)[0]


WORDS = """If contact ends at a sharp edge, the exact pressure is infinite there. This page compares the forces
of elements of order 1 and 2 in such problems, and in one with a rounded edge, mesh by mesh. The
element is `bbar`. Contact updates continue until the gap is consistent, unless the problem says
otherwise. Forces of plane problems are those of a layer of thickness 0.2. The limit is extrapolated
from the last three meshes. No limit is given if there are only two, or if the last difference is
more than 0.75 times the one before.

Elements of order 2 have errors proportional to the cell size at a sharp edge, as those of order 1
have. At a rounded edge both converge faster.

For faces of order 2 that are plane before they deform, the gap is measured between facets. Smooth
surfaces through their deformed nodes overshoot where the face bends sharply beside an edge of the
other body. No consistent gap was found with them.

The block of two_block is pressed into the slab by 0.24 of the thickness of the slab, whose law is
that of small strains. Its surface beside the edge becomes steeper with each refinement, and folds
on fine meshes: see the [guide](../../doc/guide.md). The force with a consistent gap therefore still
changes by several per cent from mesh to mesh. If the gap is linearized once, the force has a limit,
which meshes that are refined at the edges show. [The front page](../README.md) uses this problem.
"""


def figure(results, path):
    """Force over the last force of order 2 against the cell size"""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    problems = [name for name in TITLES if any(problem == name for problem, _ in results)]
    fig, axes = plt.subplots(1, len(problems), figsize=(3.4 * len(problems), 3.2), squeeze=False)
    for name, axis in zip(problems, axes[0]):
        for order, style in ((1, "o-"), (2, "D-")):
            points = [(0.5**level, entry[1])
                      for level, entry in results.get((name, order), {}).items()
                      if not isinstance(entry, str)]
            if points:
                axis.semilogx(*zip(*points), style, label=f"order {order}", base=2)
        axis.set_title(TITLES[name].replace(", ", ",\n", 1), fontsize=9)
        axis.set(xlabel="cell size, relative", ylabel="force")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(path, dpi=80)


def page(results, loads):
    yield "# Order 2 where contact ends at an edge\n"
    yield "`make bench` made this page. Back to [the front page](../README.md).\n"
    yield "| | |\n| --- | --- |"
    yield from machine.header(loads)
    yield "| times | user CPU seconds of whole runs on one core |"
    yield ""
    yield WORDS
    yield "![force against cell size](sharp.png)\n"
    yield ("| problem | order | refinement | unknowns | force | contact updates, last load step | user time [s] | "
           "exit code | limit of the force |")
    yield "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    for (problem, order), found in results.items():
        limit = limit_of(list(found.values()))
        for level, entry in found.items():
            ending = f"{limit:.4g}" if limit and level == max(found) else ""
            cells = f"{entry.replace('|', '/')} | | | | " if isinstance(
                entry, str) else f"{entry[0]:,} | {entry[1]:.5g} | {entry[2]} | {entry[3]:.2f} | {entry[4]}"
            yield f"| {TITLES[problem]} | {order} | {level} | {cells} | {ending} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="", help="problems whose name has this")
    parser.add_argument("--finest", type=int, default=9, help="refinements at most")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds a run")
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    parser.add_argument("--largest", action="store_true", help="meshes of up to 699,486 unknowns, too: half an hour")
    arguments = parser.parse_args()
    runs = Runs(os.path.join(arguments.folder, "kept", "sharp"), arguments.limit)
    results = {}
    for problem in (name for name in TITLES if arguments.only in name):
        for order in (1, 2):
            levels = LESS.get(problem, LEVELS)[order] + (LARGEST.get((problem, order), ()) if arguments.largest else ())
            results[problem,
                    order] = {level: run(problem, order, level, runs)
                              for level in levels
                              if level <= arguments.finest}
    folder = os.path.join(arguments.folder, "pages", "elements")
    os.makedirs(folder, exist_ok=True)
    figure(results, os.path.join(folder, "sharp.png"))
    with open(os.path.join(folder, "sharp.md"), "w") as file:
        file.write("\n".join(page(results, runs.loads)) + "\n")


if __name__ == "__main__":
    main()
