#!/usr/bin/env python3
"""Cost of effects that a scene does not use: effects.md. Compares a scene that contains the keys of an effect, with
values that switch it off, with a scene without these keys, by the number of instructions that valgrind counts, and by
peak memory.

    share/bench/effects.py [--refine 1] [--only EFFECT] [--folder build/bench]

Counts of instructions are reproducible to 0.1 %, whatever else the machine does. Therefore one run each is sufficient,
and runs go on all cores at once.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import sys

import machine
from problems import TOP
from runner import execute, last_words, read_summary
from runs import CONTACT, source_version

PLAIN = """bodies:
  - lower: {shape: box, lower: [0, 0, 0], upper: [4, 4, 2], cells: [8, 8, 4], young: 1, poisson: 0.3,
            element: full%(body)s}
  - upper: {shape: box, lower: [1, 1, 2], upper: [3, 3, 4], cells: [4, 4, 4], young: 1, poisson: 0.3,
            element: full%(body)s}
displacements:
  - bottom: {face: lower.zmin, value: [0, 0, 0]}
  - foot: {face: upper.zmin, value: [0, 0, 0]}
  - top: {face: upper.zmax, value: [0, 0, -0.1]}
%(rest)s"""

# effect: (what remains in a body, what remains in the file) when it is switched off
EFFECTS = {
    "contact": ("",
                "faces:\n  - patch: {of: lower.zmax, lower: [1, 1, -inf], upper: [3, 3, inf]}\ncontact_updates: 5\n"),
    "finite strain": (", material: linear", "model: energy\n"),
    "pressure": ("", "ramps:\n  - blow: {factors: [1]}\nload: {steps: 1}\n"),
    "body force": ("", "ramps:\n  - weight: {factors: [1]}\nload: {steps: 1}\n"),
    "displacement bounds": ("", "displacement_bounds: 0\n"),
    "weak springs": ("", "weak_springs: false\n"),
    "thermal strain": (", expansion: 1e-5", "temperatures: []\n"),
    "ramps, tables": ("", "ramps:\n  - later: {times: [0, 1], values: [0, 1]}\n"),
    "expressions": ("", "ramps:\n  - later: {expression: sin(pi*s/2)}\n"),
    "library, units": ("", "units: mm, N, MPa\nmaterials:\n  - other: {law: mooney_rivlin, c10: 1, c01: 1, bulk: 1}\n"),
    "tractions, forces": ("", "tractions: []\nforces: []\n"),
    "springs": ("", "springs: []\n"),
    "ties": ("", "ties: []\n"),
    "probes": ("", "probes: []\n"),
    "inclined symmetry": ("", "symmetry: []\n"),
    "order 2": (", order: 1", ""),
    "local refinement": ("", "refinements: []\n"),
    "AMG filter": ("", "solver: {tao_ipfilter_filter_switch: 10}\n"),
    "inertia": (", density: 1", ""),
    "plasticity": ("", "materials:\n  - metal: {law: j2, young: 1, poisson: 0.3, yield: 0.01, hardening: 0.1}\n"
                   "  - deformed: {law: j2_finite, young: 1, poisson: 0.3, yield: 0.01}\n"),
}
# effect: options, without which it is off too
OPTIONS = {"checkpoints": ["-checkpoint_every", "0"]}

NEVER = "no effect"
LIMIT = 600  # seconds of a run


def count(name, text, options, args):
    """Instructions [1e6], peak memory [MB], unknowns; in their place why there are none. Kept until scene or sources
    change"""
    base = os.path.join(args.kept, re.sub(r"\W+", "_", name))
    key = hashlib.sha256("\0".join((source_version(), text, str(args.refine), *options)).encode()).hexdigest()[:16]
    if os.path.exists(base + ".kept"):
        with open(base + ".kept") as file:
            record = json.load(file)
        if record["key"] == key:
            return record["result"]
    with open(base + ".yaml", "w") as file:
        file.write(text)
    result = measure(
        base, [CONTACT, base + ".yaml", "-quiet", "-refine",
               str(args.refine), "-summary", base + ".json", *options])
    with open(base + ".kept", "w") as file:
        json.dump({"key": key, "result": result}, file)
    print(f"{name}: {result if isinstance(result, str) else format(result[0], ',.0f') + ' million instructions'}",
          flush=True)
    return result


def measure(base, command):
    """Without valgrind for the memory and the effects that were on, then with it"""
    code, said, limited = execute(command, LIMIT)
    if code or limited:
        return f"exit code {code}: {last_words(said)}"
    report = read_summary(base)
    on = [effect["name"] for effect in report["effects"] if effect["on"] and effect["name"] != "error estimate"]
    if on:
        return "effects must be off, but these are on: " + ", ".join(on)
    _, said, _ = execute(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command], LIMIT)
    found = re.search(r"Collected : (\d+)", said)
    return [int(found.group(1)) / 1e6, report["peak_memory_bytes"] /
            1e6, report["dofs"]] if found else f"no count in {LIMIT} s"


def counts(args):
    """effect: its count, of all effects and of the scene that has none"""
    scenes = {NEVER: (PLAIN % {"body": "", "rest": ""}, ())}
    scenes |= {effect: (PLAIN % {"body": body, "rest": rest}, ()) for effect, (body, rest) in EFFECTS.items()}
    scenes |= {effect: (scenes[NEVER][0], options) for effect, options in OPTIONS.items()}
    scenes = {name: scene for name, scene in scenes.items() if args.only in name or name == NEVER}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(scenes, pool.map(lambda item: count(item[0], *item[1], args), scenes.items())))


def page(found):
    never, found = found[NEVER], {name: result for name, result in found.items() if name != NEVER}
    yield "# Cost of effects that a scene does not use\n"
    yield "`make bench` made this page. Back to [the front page](README.md).\n"
    yield "| | |\n| --- | --- |"
    yield from (row for row in machine.header([]) if "load average" not in row)
    yield ""
    yield "Each row compares two scenes. The first contains the keys of an effect, with values that switch it"
    yield "off. The second does not have these keys. The rule of the program is that an effect which is not"
    yield "used costs nothing. Counts of instructions by valgrind are reproducible to 0.1 %.\n"
    if isinstance(never, str):
        yield f"The scene without effects has no count: {never}"
        return
    good = {name: result for name, result in found.items() if not isinstance(result, str)}
    worst = max(good, key=lambda name: abs(good[name][0] / never[0] - 1), default=None)
    yield "| | |\n| --- | --- |"
    yield f"| unknowns | {never[2]:,} |"
    yield f"| scene without effects | {never[0]:,.1f} million instructions, {never[1]:.1f} MB |"
    yield f"| effects | {len(found)} |"
    yield (f"| largest difference in instructions | "
           f"{100 * abs(good[worst][0] / never[0] - 1):.2f} %, {worst} "
           f"|\n") if worst else ""
    yield "![instructions relative to the scene without the keys](effects.png)\n"
    yield "| effect, switched off | million instructions | relative to the scene without its keys | memory, relative |"
    yield "| --- | --- | --- | --- |"
    for name, result in found.items():
        yield f"| {name} | {result} | | |" if isinstance(
            result, str) else f"| {name} | {result[0]:,.1f} | {result[0] / never[0]:.4f} | {result[1] / never[1]:.3f} |"
    yield "\nThe scene of `contact` also defines a part of a face, which the other scene does not have."


def figure(found, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    good = {name: result for name, result in found.items() if not isinstance(result, str)}
    if NEVER not in good:
        return
    fig, axis = plt.subplots(figsize=(7, 4.5))
    names = [name for name in good if name != NEVER]
    axis.barh(names, [100 * (good[name][0] / good[NEVER][0] - 1) for name in names])
    axis.invert_yaxis()
    axis.set(xlabel="additional instructions of an effect that is switched off [%]")
    axis.grid(alpha=0.3, axis="x")
    fig.tight_layout()
    fig.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--refine", type=int, default=1)
    parser.add_argument("--only", default="", help="effects whose name has this")
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    args = parser.parse_args()
    if not shutil.which("valgrind"):
        print("effects.py: valgrind is not installed, so that effects.md is not made")
        return
    args.kept, pages = os.path.join(args.folder, "kept", "effects"), os.path.join(args.folder, "pages")
    for folder in (args.kept, pages):
        os.makedirs(folder, exist_ok=True)
    found = counts(args)
    figure(found, os.path.join(pages, "effects.png"))
    with open(os.path.join(pages, "effects.md"), "w") as file:
        file.write("\n".join(page(found)) + "\n")
    print(os.path.join(pages, "effects.md"))


if __name__ == "__main__":
    sys.exit(main())
