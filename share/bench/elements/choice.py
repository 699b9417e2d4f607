#!/usr/bin/env python3
"""Compares the element that auto chooses with all others, on scenes that were not used to find its rule: choice.md, second.md

    share/bench/elements/choice.py [--set first|second] [--only NAME] [--limit SECONDS] [--folder build/choice] [--page FILE]
"""
import argparse
import os
import resource
import subprocess
import sys

TOP = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.join(TOP, "share", "bench")]
import second  # noqa: E402
from runner import environment, keep, last_words, read_summary  # noqa: E402
from store import CONTACT  # noqa: E402

ELEMENTS = {"auto": "", "full": "element: full", "bbar": "element: bbar", "incompatible": "element: incompatible", "order 2": "element: full, order: 2", "order 2, bbar": "element: bbar, order: 2"}
LEVELS = {1: (0, 1), 2: (0,)}  # refinements by order
REFERENCE = 1  # refinements of the runs by order 2 whose mean is the reference
PUNCH = """bodies:
  - slab: {lower: [0, 0, -2], upper: [3, 0.2, 0], cells: [12, 1, 8], young: 1, poisson: %s}
  - punch: {lower: [0, 0, 0], upper: [1, 0.2, 1], cells: [5, 1, 5], young: 10, poisson: 0.3, E}
symmetry: [slab.xmin, slab.ymin, slab.ymax, punch.xmin, punch.ymin, punch.ymax]
displacements:
  - bottom: {face: slab.zmin, value: [0, 0, 0]}
  - top: {face: punch.zmax, value: [0, 0, -0.05]}
contact:
  - press: {mortar: slab.zmax, nonmortar: punch.zmin}
"""
# title: the quantity that is compared, the scene; E stands for keys of the element
SCENES = {
    "beam on a stop, nu 0.3": ("force", """bodies:
  - beam: {lower: [0, 0, 0], upper: [8, 1, 0.5], cells: [16, 2, 2], young: 1000, poisson: 0.3, E}
  - stop: {lower: [7, 0, -0.55], upper: [8, 1, -0.05], cells: [3, 3, 1], material: rigid}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
  - stop: {body: stop, value: [0, 0, 0]}
pressures:
  - load: {face: beam.zmax, value: 0.05}
contact:
  - touch: {mortar: stop.zmax, nonmortar: beam.zmin, distance: 0.5}
"""),
    "elastic punch, sharp, nu 0.3": ("force", PUNCH % "0.3, E"),
    "elastic punch, sharp, nu 0.48": ("force", PUNCH % "0.48, E"),
    "ring between plates, nu 0.3": ("force", """bodies:
  - ring: {shape: tube_arc, axis: y, center: [0, 0, 1], radii: [0.85, 1], angles: [90, 180], extent: [0, 0.1], cells: [2, 24, 1], young: 1000, poisson: 0.3, E}
  - plate: {lower: [0, 0, -0.2], upper: [0.6, 0.1, 0], cells: [1, 1, 1], material: rigid}
symmetry: [ring.lmin, ring.lmax, ring.amax]
displacements:
  - plate: {body: plate, value: [0, 0, 0]}
  - down: {face: ring.amin, value: [free, free, -0.05]}
contact:
  - touch: {mortar: plate.zmax, nonmortar: ring.outer, distance: 0.1}
"""),
    "rubber block between bonded plates, nu 0.49": ("energy", """bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 0.5], cells: [5, 5, 4], material: neohookean, young: 1, poisson: 0.49, E}
symmetry: [block.xmin, block.ymin]
displacements:
  - low: {face: block.zmin, value: [0, 0, 0]}
  - top: {face: block.zmax, value: [0, 0, -0.05]}
load: {steps: 2}
"""),
    "rubber strip on a roller, nu 0.45": ("force", second.STRIP % ("material: neohookean, young: 1, poisson: 0.45", 0.2) + "load: {steps: 2}\n"),
    "shrunk ring, nu 0.3": ("energy", """bodies:
  - hub: {shape: tube_arc, axis: z, radii: [0.6, 1.001], angles: [0, 90], extent: [0, 0.3], cells: [4, 10, 2], young: 1000, poisson: 0.3, E}
  - ring: {shape: tube_arc, axis: z, radii: [0.999, 1.4], angles: [0, 90], extent: [0, 0.2], cells: [4, 12, 2], young: 1000, poisson: 0.3, E}
symmetry: [hub.amin, hub.amax, hub.lmin, ring.amin, ring.amax, ring.lmin]
contact:
  - fit: {mortar: hub.outer, nonmortar: ring.inner, interference: true}
"""),
    "tube under pressure, nu 0.45": ("energy", """bodies:
  - tube: {shape: tube_arc, axis: z, radii: [1, 1.5], angles: [0, 90], extent: [0, 0.25], cells: [4, 10, 1], young: 1000, poisson: 0.45, E}
symmetry: [tube.amin, tube.amax, tube.lmin, tube.lmax]
pressures:
  - bore: {face: tube.inner, value: 1}
"""),
    "plastic imprint of a sharp punch": ("force", """bodies:
  - block: {lower: [0, 0, -1], upper: [1.5, 0.1, 0], cells: [12, 1, 8], material: j2, young: 1000, poisson: 0.3, yield: 1, hardening: 20, E}
  - punch: {lower: [0, 0, 0], upper: [0.5, 0.1, 0.2], cells: [1, 1, 1], material: rigid}
symmetry: [block.xmin, block.ymin, block.ymax]
displacements:
  - floor: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: punch, value: [0, 0, -0.004]}
contact:
  - imprint: {mortar: punch.zmin, nonmortar: block.zmax}
load: {steps: 2}
"""),
    "plate bent by a pressure, nu 0.3": ("energy", """bodies:
  - plate: {lower: [0, 0, 0], upper: [5, 5, 0.4], cells: [10, 10, 2], young: 1000, poisson: 0.3, E}
symmetry: [plate.xmin, plate.ymin]
displacements:
  - x: {face: plate.xmax, value: [0, 0, 0]}
  - y: {face: plate.ymax, value: [0, 0, 0]}
pressures:
  - load: {face: plate.zmax, value: 0.01}
"""),
    "bimetal strip": ("energy", """bodies:
  - low: {lower: [0, 0, 0], upper: [6, 0.5, 0.25], cells: [12, 1, 2], young: 1000, poisson: 0.3, expansion: 1e-3, E}
  - top: {lower: [0, 0, 0.25], upper: [6, 0.5, 0.5], cells: [12, 1, 2], young: 1000, poisson: 0.3, expansion: 0, E}
symmetry: [low.ymin, top.ymin]
displacements:
  - wall_low: {face: low.xmin, value: [0, 0, 0]}
  - wall_top: {face: top.xmin, value: [0, 0, 0]}
temperatures:
  - warm: {body: low, value: 10}
ties:
  - bond: {mortar: low.zmax, nonmortar: top.zmin}
"""),
}


SETS = {"first": (SCENES, ""), "second": (second.SCENES, second.FINDING)}  # scenes, and what follows from them


def value(summary, quantity):
    last = summary["steps"][-1]
    return last["energy"] if quantity == "energy" else sum(f**2 for f in last["contact_force"]) ** 0.5


def run(title, element, level, folder, limit):
    """Unknowns, quantity, user seconds; None without an answer"""
    base = os.path.join(folder, f"{title}_{element}_{level}".replace(" ", "_").replace(",", ""))
    return keep(base + ".kept", lambda: run_once(title, element, level, base, limit))


def run_once(title, element, level, base, limit):
    quantity, text = {**SCENES, **second.SCENES}[title]
    text = text.replace(", E}", f", {ELEMENTS[element]}}}" if ELEMENTS[element] else "}")
    with open(base + ".yaml", "w") as file:
        file.write(text + f"refine: {level}\n")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [CONTACT, base + ".yaml", "-quiet", "-error_estimate", "0", "-contact_updates", "20", "-summary", base + ".json"]
    try:
        done = subprocess.run(command, env=environment(), capture_output=True, text=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None
    summary = read_summary(base)
    if done.returncode not in (0, 3) or not summary or not summary["steps"]:
        print(title, element, level, done.returncode, last_words(done.stderr), flush=True)
        return None
    return summary["dofs"], value(summary, quantity), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def results(titles, folder, limit):
    """title: (reference, its uncertainty, {(element, refinement): entry})"""
    found = {}
    for title in titles:
        entries = {}
        for element in ELEMENTS:
            for level in LEVELS[2 if "order 2" in element else 1]:
                entries[element, level] = run(title, element, level, folder, limit)
        finest = [entry[1] for element in ("order 2", "order 2, bbar") if (entry := run(title, element, REFERENCE, folder, limit))]
        if finest:
            mean = sum(finest) / len(finest)
            found[title] = mean, abs(finest[0] - finest[-1]) / abs(mean), {key: (entry[0], abs(entry[1] / mean - 1), entry[2]) for key, entry in entries.items() if entry}
    return found


def best_of_mesh(entries, level):
    """Whether the error of auto is at most 1.2 times the least of order 1 on the same mesh"""
    return entries["auto", level][1] <= 1.2 * min(entry[1] for (element, at), entry in entries.items() if at == level and "order 2" not in element)


def on_front(entries, level):
    """Whether no run that takes at most its time has an error below 1/1.2 of its error"""
    mine = entries["auto", level]
    return all(other[1] >= mine[1] / 1.2 for other in entries.values() if other[2] <= mine[2])


def answer(good):
    return "yes" if good else "no"


INTRODUCTION = """If a scene names no element, the program chooses one (`element: auto`). This page compares the
chosen element with all others on scenes that were not used to find the rule of `auto`. It is made
by `share/bench/elements/choice.py`. Errors are those of the contact force, or of the energy if
there is no contact. The reference is the mean of `full` and `bbar` of order 2 on the mesh refined
once. Times are user seconds on one core. Two criteria say whether the choice was good:

| column | meaning |
| --- | --- |
| best of order 1 | the error of `auto` is at most 1.2 times the smallest error of all elements of order 1 on the same mesh |
| on the front | no other run takes at most the same time and has an error that is smaller by more than 20 % |

If `auto` is not on the front, order 2 on a coarser mesh is better. The scene must then request
`order: 2`. On the same mesh, order 2 has six to eight times as many unknowns.
"""


def page(found, finding):
    yield "# How good is the element that `auto` chooses?\n"
    yield INTRODUCTION
    if finding:
        yield finding
    yield "Number of scenes in which `auto` meets each criterion:\n"
    yield "| refinement | best of order 1 | on the front | scenes |"
    yield "| --- | --- | --- | --- |"
    for level in LEVELS[1]:
        both = [(best_of_mesh(entries, level), on_front(entries, level)) for _, _, entries in found.values() if ("auto", level) in entries]
        yield f"| {level} | {sum(a for a, _ in both)} | {sum(b for _, b in both)} | {len(both)} |"
    yield "\nError and time of each run:\n"
    yield "| scene | reference uncertain by | refinement | unknowns | " + " | ".join(ELEMENTS) + " | best of order 1 | on the front |"
    yield "| --- | --- | --- | --- |" + " --- |" * (len(ELEMENTS) + 2)
    for title, (_, uncertain, entries) in found.items():
        for level in LEVELS[1]:
            cells = [f"{100 * entry[1]:.2g} %, {entry[2]:.2g} s" if (entry := entries.get((element, level))) else "" for element in ELEMENTS]
            mine = entries.get(("auto", level))
            unknowns = f"{mine[0]:,}" if mine else ""
            answers = (answer(best_of_mesh(entries, level)), answer(on_front(entries, level))) if mine else ("", "")
            yield f"| {title} | {100 * uncertain:.2g} % | {level} | {unknowns} | " + " | ".join((*cells, *answers)) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--set", choices=SETS, default="first", help="of scenes")
    parser.add_argument("--only", default="", help="scenes whose title has this")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds a run")
    parser.add_argument("--folder", default=os.path.join(TOP, "build", "choice"))
    parser.add_argument("--page", help="file to write; else the page is printed")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    scenes, finding = SETS[arguments.set]
    text = "\n".join(page(results([title for title in scenes if arguments.only in title], arguments.folder, arguments.limit), finding)) + "\n"
    if arguments.page:
        with open(arguments.page, "w") as file:
            file.write(text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
