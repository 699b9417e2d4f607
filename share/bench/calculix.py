#!/usr/bin/env python3
"""The two-block problem by CalculiX (ccx), a finite element program that engineers use, beside contact, on the same
meshes: calculix.md

    share/bench/calculix.py [--meshes 1 2] [--limit SECONDS] [--folder build/bench]

CalculiX solves with SPOOLES, on one core: its mortar pairs, and its face-to-face pairs with a penalty. Without ccx on
the path there is nothing to compare.
"""
import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

import machine
from runner import environment, read_summary, user_seconds
from runs import CONTACT, source_version

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENE = os.path.join(TOP, "share", "scenes", "two_block.yaml")
STEPS = (-5 / 14, -5 / 7)  # displacement of the block's top
# name: corners, cells of the scene as it is, Young's modulus and Poisson's ratio
BODIES = {
    "SLAB": ((-4.5, -2.0, -4.5), (4.5, 2.0, -1.5), (20, 6, 3), (1.0, 0.499)),
    "BLOCK": ((-3.5, -0.5, -1.5), (-2.5, 0.5, -0.5), (4, 4, 4), (1000.0, 0.0)),
}
# Two bars of the same section, the upper one pushed down: the force is known
BARS = {
    "SLAB": ((0.0, 0.0, -1.0), (1.0, 1.0, 0.0), (2, 2, 2), (1.0, 0.0)),
    "BLOCK": ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2, 2, 2), (1000.0, 0.0))
}
BAR_STEPS = (-0.1, -0.2)
BAR_FORCE = 0.2 / (1 + 1e-3)


def linear(stiffness):
    return f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiffness}, 1e-6"


PAIRS = {
    "CalculiX, mortar, hard": ("MORTAR", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD"),
    "CalculiX, mortar, stiffness 1e6": ("MORTAR", linear("1e6")),
    "CalculiX, penalty of 50 E": ("SURFACE TO SURFACE", linear("50.")),
    "CalculiX, penalty of 1e4 E": ("SURFACE TO SURFACE", linear("1e4")),
}
OURS = {
    "contact": (), "contact, consistent gap": ("-contact_updates", "20"),
    "contact, by AMG": ("-tao_ipfilter_pc_amgf_factor", "false")
}


def grid(lower, upper, cells, first_node, first_element):
    """Nodes (number, x, y, z), elements (number, eight nodes), and the numbers of both at the bottom and at the top"""
    nx, ny, nz = (n + 1 for n in cells)
    number = lambda i, j, k: first_node + i + nx * (j + ny * k)
    nodes = [(number(i, j, k), *(a + (b - a) * m / n
                                 for a, b, m, n in zip(lower, upper, (i, j, k), cells)))
             for k in range(nz) for j in range(ny) for i in range(nx)]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    places = [(i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]
    elements = [(first_element + n, *(number(i + a, j + b, k + c)
                                      for a, b, c in corners))
                for n, (i, j, k) in enumerate(places)]
    layer = cells[0] * cells[1]
    ends = {
        "BOTTOM": ([n for n, *_ in nodes[:nx * ny]], [e[0] for e in elements[:layer]]),
        "TOP": ([n for n, *_ in nodes[-nx * ny:]], [e[0] for e in elements[-layer:]])
    }
    return nodes, elements, ends


def numbers(values):
    """Sixteen a line, as ccx reads them"""
    values = list(map(str, values))
    return ",\n".join(", ".join(values[k:k + 16]) for k in range(0, len(values), 16))


def deck(factor, pair, bodies=None, displacements=STEPS):
    """The text of ccx's input file: each box with `factor` times as many cells along each axis as the scene has; full
    integration, small displacements"""
    kind, behaviour = PAIRS[pair]
    text, nodes_so_far, elements_so_far = [], 0, 0
    for name, (lower, upper, cells, (young, poisson)) in (bodies or BODIES).items():
        nodes, elements, ends = grid(lower, upper, [factor * n for n in cells], nodes_so_far + 1, elements_so_far + 1)
        nodes_so_far, elements_so_far = nodes_so_far + len(nodes), elements_so_far + len(elements)
        text += ["*NODE, NSET=N" + name, *(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}" for n, x, y, z in nodes)]
        text += [f"*ELEMENT, TYPE=C3D8, ELSET={name}", *(", ".join(map(str, e)) for e in elements)]
        for end, (at, beside) in ends.items():
            text += [f"*NSET, NSET={name}{end}", numbers(at), f"*ELSET, ELSET=E{name}{end}", numbers(beside)]
            text += [f"*SURFACE, NAME=F{name}{end}, TYPE=ELEMENT", f"E{name}{end}, S{1 if end == 'BOTTOM' else 2}"]
        text += [
            f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{young}, {poisson}",
            f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}"
        ]
    text += [
        "*SURFACE INTERACTION, NAME=TOUCH", behaviour, f"*CONTACT PAIR, INTERACTION=TOUCH, TYPE={kind}",
        "FBLOCKBOTTOM, FSLABTOP", "*BOUNDARY", "SLABBOTTOM, 1, 3"
    ]
    for down in displacements:
        text += [
            "*STEP, INC=100", "*STATIC, SOLVER=SPOOLES", "1., 1.", "*BOUNDARY", "BLOCKTOP, 1, 2, 0.",
            f"BLOCKTOP, 3, 3, {down:.12g}"
        ]
        text += ["*NODE PRINT, NSET=BLOCKTOP, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(text) + "\n"


def measured(command, limit, folder):
    """User seconds, MB at the peak, exit code; None where the limit ended it"""
    before = user_seconds()
    memory = os.path.join(folder, "memory")
    try:
        code = subprocess.run(["/usr/bin/time", "-f", "%M", "-o", memory, *command], cwd=folder, env=environment(),
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit,
                              check=False).returncode
    except subprocess.TimeoutExpired:
        return None
    with open(memory) as file:
        peak = float(file.read().split()[-1]) / 1e3
    return user_seconds() - before, peak, code


def forces_of_calculix(base):
    """What the block's top is pushed down with at the end of each step, which may take several increments"""
    with open(base + ".dat") as file:
        totals = re.findall(r"total force \(fx,fy,fz\).*?time\s+(\S+)\s*\n\s*\n\s*\S+\s+\S+\s+(\S+)", file.read())
    return list({round(float(time)): -float(z) for time, z in totals}.values())


def keep(base, text, produce):
    """What produce() returns, kept in a file until the text or the sources change"""
    key = hashlib.sha256((source_version() + text).encode()).hexdigest()[:16]
    if os.path.exists(base + ".kept"):
        with open(base + ".kept") as file:
            record = json.load(file)
        if record["key"] == key:
            return record["result"]
    result = produce()
    with open(base + ".kept", "w") as file:
        json.dump({"key": key, "result": result}, file)
    print(
        f"calculix: {os.path.basename(base)}: {result if isinstance(result, str) else format(result[0], '.2f') + ' s'}",
        flush=True)
    return result


def by_calculix(base, text, steps, limit):
    """(seconds, MB, forces of the load steps); a sentence where there are none"""

    def produce():
        with open(base + ".inp", "w") as file:
            file.write(text)
        return result_of(measured(["ccx", os.path.basename(base)], limit, os.path.dirname(base)),
                         lambda: forces_of_calculix(base), steps, limit)

    return keep(base, text, produce)


def by_contact(base, factor, options, limit):
    command = [
        CONTACT, SCENE, "-quiet", "-error_estimate", "0", "-refine",
        str(factor.bit_length() - 1), "-summary", base + ".json", *options
    ]
    forces = lambda: [-step["reaction"][2] for step in read_summary(base)["steps"]]  # noqa: E731
    return keep(base, " ".join(command[1:]),
                lambda: result_of(measured(command, limit, os.path.dirname(base)), forces, len(STEPS), limit))


def result_of(ended, forces, steps, limit):
    if ended is None:
        return f"time limit {limit:g} s"
    seconds, memory, code = ended
    if code:
        return f"exit code {code}"
    found = forces()
    return (seconds, memory, found) if len(found) == steps else "no forces"


def run(name, factor, folder, limit):
    base = os.path.join(folder, f"{factor}_{re.sub('[^a-z0-9]+', '_', name.lower())}")
    return by_calculix(base, deck(factor, name), len(STEPS), limit) if name in PAIRS else by_contact(
        base, factor, OURS[name], limit)


def bar_rows(folder, limit):
    """Force on the two bars at the last step, and its error"""
    for name in PAIRS:
        result = by_calculix(os.path.join(folder, "bars_" + re.sub("[^a-z0-9]+", "_", name.lower())),
                             deck(1, name, BARS, BAR_STEPS), len(BAR_STEPS), limit)
        yield f"| {name} | {result} | |" if isinstance(
            result, str) else f"| {name} | {result[2][-1]:.6g} | {100 * (result[2][-1] / BAR_FORCE - 1):.2g} % |"


def row(factor, name, result):
    if isinstance(result, str):
        return f"| {factor} | {name} | {result} | | | |"
    seconds, memory, forces = result
    return f"| {factor} | {name} | {seconds:.3g} | {memory:.0f} | " + " | ".join(f"{force:.5g}"
                                                                                 for force in forces) + " |"


def ccx_version():
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout
    found = re.search(r"[Vv]ersion (\S+)", said)
    return found.group(1) if found else "unknown"


def softer(rows):
    """How far the forces of CalculiX's hard contact by mortar are below ours with a consistent gap"""
    found = {(factor, name): result for factor, name, result in rows if not isinstance(result, str)}
    shares = [
        100 * (1 - theirs / ours) for (factor, name), result in found.items()
        if name == "CalculiX, mortar, hard" and (factor, "contact, consistent gap") in found
        for theirs, ours in zip(result[2], found[factor, "contact, consistent gap"][2])
    ]
    return f"{min(shares):.0f} to {max(shares):.0f} %" if shares else "some per cent"


def page(rows, bars):
    yield from ("# Comparison with CalculiX\n", "`make bench` made this page. Back to [the front page](README.md).\n",
                "| | |\n| --- | --- |")
    yield from (line for line in machine.header([]) if "load average" not in line)
    yield f"| CalculiX | {ccx_version()}, solver SPOOLES |"
    yield "| times, memory | user CPU seconds of whole runs on one core; peak of the run |\n"
    yield "## An exact solution\n"
    yield "Two bars of the same section and of length 1 are pushed together by 0.2. Their Young's moduli are 1"
    yield f"and 1,000. The force is 0.2/(1 + 1/1000) = {BAR_FORCE:.6g}.\n"
    yield "| CalculiX | force | error |\n| --- | --- | --- |"
    yield from bars
    yield f"""
For hard contact CalculiX uses a contact stiffness of 50 times the smaller Young's modulus, in its
mortar method too. The faces therefore penetrate. Its forces on the two blocks below are {softer(rows)}
lower than ours with a consistent gap. With a contact stiffness of 1e6 CalculiX computes the exact
force. `contact` computes the exact force up to rounding.

## Two blocks

Both programs use the same mesh of hexahedra, full integration, and small displacements. "contact"
linearizes the gap once per load step, as the scene specifies; "consistent gap" updates it until it
is consistent. The stresses at the edges of the block are singular, and full integration locks.
Forces therefore decrease with the cell size in both programs.

![time against force](calculix.png)

| mesh | program | time [s] | memory [MB] | force, step 1 | force, step 2 |
| --- | --- | --- | --- | --- | --- |"""
    yield from (row(*entry) for entry in rows)


def figure(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    fig, axis = plt.subplots(figsize=(7, 4))
    for index, name in enumerate((*OURS, *PAIRS)):
        points = [(result[0], result[2][-1])
                  for _, which, result in rows
                  if which == name and not isinstance(result, str)]
        if points:
            axis.semilogx(*zip(*points), "os^Dv*P"[index] + ("-" if name in OURS else "--"), color=f"C{index}",
                          label=name, markersize=5, linewidth=0.8)
    axis.set(xlabel="user time [s]", ylabel="force, step 2", title="One point a mesh")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--meshes", type=int, nargs="+", default=[1, 2],
                        help="cells along an axis over those of the scene, powers of two")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds a run")
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("calculix.py: ccx is not on the path, so that calculix.md is not made. Install Debian's calculix-ccx.")
        return
    folder, pages = os.path.join(arguments.folder, "kept", "calculix"), os.path.join(arguments.folder, "pages")
    for path in (folder, pages):
        os.makedirs(path, exist_ok=True)
    rows = [(factor, name, run(name, factor, folder, arguments.limit))
            for factor in arguments.meshes
            for name in (*OURS, *PAIRS)]
    bars = list(bar_rows(folder, arguments.limit))
    figure(rows, os.path.join(pages, "calculix.png"))
    with open(os.path.join(pages, "calculix.md"), "w") as file:
        file.write("\n".join(page(rows, bars)) + "\n")
    print(os.path.join(pages, "calculix.md"))


if __name__ == "__main__":
    sys.exit(main())
