#!/usr/bin/env python3
"""Cost of effects that a scene does not use. Compares a scene that contains the keys of an effect, with values that switch it off,
with a scene without these keys. One command makes one table; effects.md contains such a table.

    share/bench/effects.py [--contact bin/contact] [--refine 2] [--repeat 5]             wall time and peak memory
    share/bench/effects.py --instructions [--before OTHER/bin/contact] [--refine 1]      instructions, by valgrind, and peak memory

Runs of both scenes alternate, so that changes of the machine's speed affect both; ratios are ratios of medians. Counts of instructions
are reproducible to 0.1 %, so one run each is sufficient. --before adds a row for another build.
"""
import argparse
import functools
import os
import re
import shutil
import statistics
import sys
import tempfile

from runner import execute, last_words, read_summary

PLAIN = """bodies:
  - lower: {shape: box, lower: [0, 0, 0], upper: [4, 4, 2], cells: [8, 8, 4], young: 1, poisson: 0.3, element: full%(body)s}
  - upper: {shape: box, lower: [1, 1, 2], upper: [3, 3, 4], cells: [4, 4, 4], young: 1, poisson: 0.3, element: full%(body)s}
displacements:
  - bottom: {face: lower.zmin, value: [0, 0, 0]}
  - foot: {face: upper.zmin, value: [0, 0, 0]}
  - top: {face: upper.zmax, value: [0, 0, -0.1]}
%(rest)s"""

# effect: (what remains in a body, what remains in the file) when it is switched off
EFFECTS = {
    "contact": ("", "faces:\n  - patch: {of: lower.zmax, lower: [1, 1, -inf], upper: [3, 3, inf]}\ncontact_updates: 5\n"),
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


def write(folder, name, body, rest):
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as file:
        file.write(PLAIN % {"body": body, "rest": rest})
    return path


def run(args, contact, scene, folder, options=()):
    """Wall time or instructions, and peak memory; the number of unknowns"""
    base = os.path.join(folder, "summary")
    command = [contact, scene, "-quiet", "-refine", str(args.refine), "-summary", base + ".json", *options]
    code, said, _ = execute(command, None)
    if code:
        sys.exit("effects.py: %s: %s" % (scene, last_words(said)))
    report = read_summary(base)
    on = [effect["name"] for effect in report["effects"] if effect["on"] and effect["name"] != "error estimate"]
    if on:
        sys.exit("effects.py: %s: effects must be off, but these are on: %s" % (scene, ", ".join(on)))
    cost = report["time"]["total"]
    if args.instructions:
        _, said, _ = execute(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command], None)
        cost = int(re.search(r"Collected : (\d+)", said).group(1)) / 1e6
    return cost, report["peak_memory_bytes"], report["dofs"]


def compare(args, name, off, never):
    """A row: medians of what two functions return in turn; the larger of the two differences"""
    pairs = [(off(), never()) for _ in range(args.repeat)]
    cost = [statistics.median(p[i][0] for p in pairs) for i in (0, 1)]
    memory = [statistics.median(p[i][1] for p in pairs) for i in (0, 1)]
    print("| %-20s | %12.3f | %12.3f | %8.4f | %8.3f |" % (name, *cost, cost[0] / cost[1], memory[0] / memory[1]), flush=True)
    return max(abs(cost[0] / cost[1] - 1), abs(memory[0] / memory[1] - 1))


def table(args, folder):
    never = write(folder, "never", "", "")
    plain = functools.partial(run, args, args.contact, never, folder)
    if args.instructions:
        plain = functools.cache(plain)
    dofs, unit = plain()[2], "10^6 instructions" if args.instructions else "s"
    print("%d unknowns. Medians of %d runs; runs of both scenes alternate.\n" % (dofs, args.repeat))
    print("| %-20s | off [%s] | never [%s] | off / never | memory, off / never |\n|%s" % ("switched off", unit, unit, " --- |" * 5))
    worst = 0.0
    for effect, (body, rest) in EFFECTS.items():
        off = write(folder, "off", body, rest)
        worst = max(worst, compare(args, effect, lambda off=off: run(args, args.contact, off, folder), plain))
    for effect, options in OPTIONS.items():
        worst = max(worst, compare(args, effect, lambda options=options: run(args, args.contact, never, folder, options), plain))
    print("\nLargest difference: %.2f %%" % (100 * worst))
    if args.before:
        print("\n| %-20s | %12s | %12s | %8s | %8s |\n|%s" % ("plain scene", "now", "before", "now / before", "memory", " --- |" * 5))
        compare(args, "another build", plain, lambda: run(args, args.before, never, folder))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--contact", default="bin/contact")
    parser.add_argument("--before", help="another build, which is compared with --contact")
    parser.add_argument("--instructions", action="store_true", help="count instructions instead of measuring time")
    parser.add_argument("--refine", type=int, default=2)
    parser.add_argument("--repeat", type=int)
    args = parser.parse_args()
    args.repeat = args.repeat or (1 if args.instructions else 5)
    if args.instructions and not shutil.which("valgrind"):
        sys.exit("effects.py: --instructions needs valgrind, which is not installed")
    with tempfile.TemporaryDirectory() as folder:
        table(args, folder)


if __name__ == "__main__":
    main()
