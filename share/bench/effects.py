#!/usr/bin/env python3
"""What an effect costs that a scene does not call for: wall time and peak memory of a scene in which it is switched off, with
what belongs to it left in the file, over those of a scene that never had it. One command, one table.

    share/bench/effects.py [--contact bin/contact] [--refine 2] [--repeat 5]

Runs alternate, so that a change of the machine's speed meets both; ratios are those of the medians.
"""
import argparse
import os
import statistics
import sys
import tempfile

from runner import execute, last_words, read_summary

PLAIN = """bodies:
  - lower: {shape: box, lower: [0, 0, 0], upper: [4, 4, 2], cells: [8, 8, 4], young: 1, poisson: 0.3%(body)s}
  - upper: {shape: box, lower: [1, 1, 2], upper: [3, 3, 4], cells: [4, 4, 4], young: 1, poisson: 0.3%(body)s}
displacements:
  - bottom: {face: lower.zmin, value: [0, 0, 0]}
  - foot: {face: upper.zmin, value: [0, 0, 0]}
  - top: {face: upper.zmax, value: [0, 0, -0.1]}
%(rest)s"""

# effect: (what remains in a body, what remains in the file) when it is switched off
EFFECTS = {
    "contact": ("", "faces:\n  - patch: {of: lower.zmax, lower: [1, 1, -inf], upper: [3, 3, inf]}\ncontact_updates: 5\n"),
    "finite strain": (", material: linear", "model: energy\n"),
    "mean dilatation": (", element: full", ""),
    "pressure": ("", "ramps:\n  - blow: {factors: [1]}\nload: {steps: 1}\n"),
    "body force": ("", "ramps:\n  - weight: {factors: [1]}\nload: {steps: 1}\n"),
    "displacement bounds": ("", "displacement_bounds: 0\n"),
    "weak springs": ("", "weak_springs: false\n"),
    "thermal strain": (", expansion: 1e-5", ""),
    "ramps, tables": ("", "ramps:\n  - later: {times: [0, 1], values: [0, 1]}\n"),
    "library": ("", "materials:\n  - other: {law: mooney_rivlin, c10: 1, c01: 1, bulk: 1}\n"),
    "AMG filter": ("", "solver: {tao_ipfilter_filter_switch: 10}\n"),
}


def write(folder, name, body, rest):
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as file:
        file.write(PLAIN % {"body": body, "rest": rest})
    return path


def run(args, scene, folder):
    base = os.path.join(folder, "summary")
    code, said, _ = execute([args.contact, scene, "-quiet", "-refine", str(args.refine), "-summary", base + ".json"], None)
    if code:
        sys.exit("effects.py: %s: %s" % (scene, last_words(said)))
    report = read_summary(base)
    on = [effect["name"] for effect in report["effects"] if effect["on"] and effect["name"] != "error estimate"]
    if on:
        sys.exit("effects.py: %s: switched on: %s" % (scene, ", ".join(on)))
    return report["time"]["total"], report["peak_memory_bytes"], report["dofs"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--contact", default="bin/contact")
    parser.add_argument("--refine", type=int, default=2)
    parser.add_argument("--repeat", type=int, default=5)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        never = write(folder, "never", "", "")
        _, _, dofs = run(args, never, folder)
        print("%d unknowns, medians of %d runs each, in turn\n" % (dofs, args.repeat))
        print("%-20s %12s %12s %8s %8s" % ("switched off", "off [s]", "never [s]", "time", "memory"))
        worst = 0.0
        for effect, (body, rest) in EFFECTS.items():
            off = write(folder, "off", body, rest)
            pairs = [(run(args, off, folder), run(args, never, folder)) for _ in range(args.repeat)]
            time = [statistics.median(p[i][0] for p in pairs) for i in (0, 1)]
            memory = [statistics.median(p[i][1] for p in pairs) for i in (0, 1)]
            worst = max(worst, abs(time[0] / time[1] - 1), abs(memory[0] / memory[1] - 1))
            print("%-20s %12.3f %12.3f %8.3f %8.3f" % (effect, *time, time[0] / time[1], memory[0] / memory[1]), flush=True)
        print("\nlargest difference: %.1f %%" % (100 * worst))


if __name__ == "__main__":
    main()
