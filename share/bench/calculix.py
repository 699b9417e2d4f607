#!/usr/bin/env python3
"""make bench-calculix: the two-block problem by CalculiX (ccx), a finite element program that engineers use, beside contact, on the same meshes.

    share/bench/calculix.py [--meshes 2 4] [--limit SECONDS] [--folder build/calculix] [--page FILE]

CalculiX solves with SPOOLES, on one core: its mortar pairs, and its face-to-face pairs with a penalty. Without ccx on the path there is nothing to compare.
"""
import argparse
import os
import re
import resource
import shutil
import subprocess
import sys

from runner import environment, read_summary
from store import CONTACT

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENE = os.path.join(TOP, "share", "scenes", "two_block.yaml")
STEPS = (-5 / 14, -5 / 7)  # displacement of the block's top
# name: corners, cells of the scene as it is, Young's modulus and Poisson's ratio
BODIES = {
    "SLAB": ((-4.5, -2.0, -4.5), (4.5, 2.0, -1.5), (20, 6, 3), (1.0, 0.499)),
    "BLOCK": ((-3.5, -0.5, -1.5), (-2.5, 0.5, -0.5), (4, 4, 4), (1000.0, 0.0)),
}
# Two bars of the same section, the upper one pushed down: the force is known
BARS = {"SLAB": ((0.0, 0.0, -1.0), (1.0, 1.0, 0.0), (2, 2, 2), (1.0, 0.0)), "BLOCK": ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2, 2, 2), (1000.0, 0.0))}
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
OURS = {"contact": (), "contact, consistent gap": ("-contact_updates", "20"), "contact, by AMG": ("-tao_ipfilter_pc_amgf_factor", "false")}


def grid(lower, upper, cells, first_node, first_element):
    """Nodes (number, x, y, z), elements (number, eight nodes), and the numbers of both at the bottom and at the top"""
    nx, ny, nz = (n + 1 for n in cells)
    number = lambda i, j, k: first_node + i + nx * (j + ny * k)
    nodes = [(number(i, j, k), *(a + (b - a) * m / n for a, b, m, n in zip(lower, upper, (i, j, k), cells))) for k in range(nz) for j in range(ny) for i in range(nx)]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    places = [(i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]
    elements = [(first_element + n, *(number(i + a, j + b, k + c) for a, b, c in corners)) for n, (i, j, k) in enumerate(places)]
    layer = cells[0] * cells[1]
    ends = {"BOTTOM": ([n for n, *_ in nodes[: nx * ny]], [e[0] for e in elements[:layer]]), "TOP": ([n for n, *_ in nodes[-nx * ny :]], [e[0] for e in elements[-layer:]])}
    return nodes, elements, ends


def numbers(values):
    """Sixteen a line, as ccx reads them"""
    values = list(map(str, values))
    return ",\n".join(", ".join(values[k : k + 16]) for k in range(0, len(values), 16))


def deck(factor, pair, bodies=None, displacements=STEPS):
    """The text of ccx's input file: each box with `factor` times as many cells along each axis as the scene has; full integration, small displacements"""
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
        text += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{young}, {poisson}", f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}"]
    text += ["*SURFACE INTERACTION, NAME=TOUCH", behaviour, f"*CONTACT PAIR, INTERACTION=TOUCH, TYPE={kind}", "FBLOCKBOTTOM, FSLABTOP", "*BOUNDARY", "SLABBOTTOM, 1, 3"]
    for down in displacements:
        text += ["*STEP, INC=100", "*STATIC, SOLVER=SPOOLES", "1., 1.", "*BOUNDARY", "BLOCKTOP, 1, 2, 0.", f"BLOCKTOP, 3, 3, {down:.12g}"]
        text += ["*NODE PRINT, NSET=BLOCKTOP, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(text) + "\n"


def measured(command, limit, folder):
    """User seconds, MB at the peak, exit code; None where the limit ended it"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    memory = os.path.join(folder, "memory")
    try:
        code = subprocess.run(["/usr/bin/time", "-f", "%M", "-o", memory, *command], cwd=folder, env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit, check=False).returncode
    except subprocess.TimeoutExpired:
        return None
    with open(memory) as file:
        peak = float(file.read().split()[-1]) / 1e3
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, peak, code


def forces_of_calculix(base):
    """What the block's top is pushed down with at the end of each step, which may take several increments"""
    with open(base + ".dat") as file:
        totals = re.findall(r"total force \(fx,fy,fz\).*?time\s+(\S+)\s*\n\s*\n\s*\S+\s+\S+\s+(\S+)", file.read())
    return list({round(float(time)): -float(z) for time, z in totals}.values())


def run(name, factor, folder, limit):
    """(seconds, MB, forces of the load steps); a sentence where there are none"""
    base = os.path.join(folder, f"{factor}_{re.sub('[^a-z0-9]+', '_', name.lower())}")
    if name in PAIRS:
        with open(base + ".inp", "w") as file:
            file.write(deck(factor, name))
        ended = measured(["ccx", os.path.basename(base)], limit, folder)
    else:
        ended = measured([CONTACT, SCENE, "-quiet", "-error_estimate", "0", "-refine", str(factor.bit_length() - 1), "-summary", base + ".json", *OURS[name]], limit, folder)
    if ended is None:
        return f"no end in {limit:g} s"
    seconds, memory, code = ended
    if code:
        return f"exit code {code}"
    forces = forces_of_calculix(base) if name in PAIRS else [-step["reaction"][2] for step in read_summary(base)["steps"]]
    return (seconds, memory, forces) if len(forces) == len(STEPS) else "no forces"


def bar_rows(folder, limit):
    """Force on the two bars at the last step, and its error"""
    for name in PAIRS:
        base = os.path.join(folder, "bars_" + re.sub("[^a-z0-9]+", "_", name.lower()))
        with open(base + ".inp", "w") as file:
            file.write(deck(1, name, BARS, BAR_STEPS))
        ended = measured(["ccx", os.path.basename(base)], limit, folder)
        found = forces_of_calculix(base)[-1] if ended and not ended[2] else None
        yield f"| {name} | {found:.6g} | {100 * (found / BAR_FORCE - 1):.2g} % |" if found else f"| {name} | no end | |"


def row(factor, name, result):
    if isinstance(result, str):
        return f"| {factor} | {name} | {result} | | | |"
    seconds, memory, forces = result
    return f"| {factor} | {name} | {seconds:.3g} | {memory:.0f} | " + " | ".join(f"{force:.5g}" for force in forces) + " |"


def page(rows, bars):
    return "\n".join([
        "# Comparison with CalculiX", "",
        "`make bench-calculix` makes this page. CalculiX uses the solver SPOOLES. Times are user seconds of",
        "the whole run on one core. Memory is the peak of the run.", "",
        "## An exact solution", "",
        "Two bars of the same section and of length 1 are pushed together by 0.2. Their Young's moduli are 1", f"and 1,000. The force is 0.2/(1 + 1/1000) = {BAR_FORCE:.6g}.", "",
        "| CalculiX | force | error |", "| --- | --- | --- |", *bars, "",
        "For hard contact CalculiX uses a contact stiffness of 50 times the smaller Young's modulus, in its",
        "mortar method too. The faces therefore penetrate, and its forces on the two blocks below are 12 to",
        "24 % lower than ours. With a contact stiffness of 1e6 CalculiX computes the exact force. `contact`",
        "computes the exact force up to rounding.", "",
        "## Two blocks", "",
        "Both programs use the same mesh of hexahedra, full integration, and small displacements. \"contact\"",
        "linearizes the gap once per load step, as the scene specifies; \"consistent gap\" updates it until it",
        "is consistent. The stresses at the edges of the block are singular, and full integration locks.",
        "Forces therefore decrease with the cell size in both programs.", "",
        "| mesh | program | time [s] | memory [MB] | force, step 1 | force, step 2 |", "| --- | --- | --- | --- | --- | --- |", *rows]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--meshes", type=int, nargs="+", default=[2, 4], help="cells along an axis over those of the scene, powers of two")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a run")
    parser.add_argument("--folder", default=os.path.join(TOP, "build", "calculix"))
    parser.add_argument("--page", help="file to write; else the page is printed")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("bench-calculix: ccx is not on the path. Install Debian's calculix-ccx.")
        return 0
    os.makedirs(arguments.folder, exist_ok=True)
    rows = [row(factor, name, run(name, factor, arguments.folder, arguments.limit)) for factor in arguments.meshes for name in (*OURS, *PAIRS)]
    text = page(rows, list(bar_rows(arguments.folder, arguments.limit)))
    if arguments.page:
        with open(arguments.page, "w") as file:
            file.write(text)
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
