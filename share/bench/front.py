#!/usr/bin/env python3
"""The front page of the bench, README.md and front.png: six problems, error against time, and what 10 %, 1 % and 0.1 %
cost.

    share/bench/front.py [--only NAME] [--limit SECONDS] [--folder build/bench]
    share/bench/front.py --scene "PROBLEM, MESH, SETTING"        prints a scene of the page
"""
import argparse
import math
import os
import sys

import machine
from elements.choice import SCENES
from problems import PROBLEMS, TOP, two_block_zones
from runs import Runs

ORDER1 = {
    "default": (("element", "auto"), ), "full": (("element", "full"), ), "bbar": (("element", "bbar"), ),
    "incompatible": (("element", "incompatible"), )
}
ORDER2 = {"order 2": (("element", "full"), ("order", "2")), "order 2, bbar": (("element", "bbar"), ("order", "2"))}
RECOMMENDED = "order 2, bbar"
# setting: options of runs of the default element; the first loosen and tighten the solver
OPTIONS = {
    "tolerance 1e-2": ("-tao_ipfilter_tol", "1e-2"), "tolerance 1e-10": ("-tao_ipfilter_tol", "1e-10"),
    "one contact update": ("-contact_updates", "1"),
    "published.opts": ("-options_file", os.path.join(TOP, "share", "options", "published.opts"))
}
TARGETS = (0.1, 0.01, 0.001)
# setting: options of runs that choose their own meshes, from the first one of the problem
ACCURACY = {
    f"accuracy {target}, {name}": ("-accuracy", target, *options)
    for target in ("1e-1", "1e-2", "1e-3")
    for name, options in (("adaptive", ("-accuracy_adaptive", )), ("order 2", ("-accuracy_order", "2")))
}
EDGE_LIMIT = 300  # seconds of a run


def edges(n):
    return f"bbar, edges refined {n} times"


EDGES = {edges(n): n for n in (1, 2, 3)}


def richardson(sizes, values):
    """Limit and order of values that differ from it by a constant times size^order, from three; the last value and no
    order where the differences are not those of a power. By bisection: the ratio of the differences grows with the
    order"""
    (a, b, c), first, second = sizes, values[0] - values[1], values[1] - values[2]
    ratio = lambda order: (a**order - b**order) / (b**order - c**order)  # noqa: E731
    low, high = 0.05, 8.0
    if second == 0 or not ratio(low) <= first / second <= ratio(high):
        return values[2], math.nan
    for _ in range(60):
        order = (low + high) / 2
        low, high = (order, high) if ratio(order) < first / second else (low, order)
    return values[2] - second * c**order / (b**order - c**order), order


def front(points):
    """Points (time, error) that no other point beats in both, sorted by time"""
    best, kept = math.inf, []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


class NoReference(Exception):
    """Why the errors of a problem are not known"""


def measured(case, record):
    if record["failed"]:
        raise NoReference(record["failed"])
    return case.measure(record)


class Shipped:
    """A problem of problems.py, measured by the contact force, or the energy where nothing touches; finest: the mesh of
    the reference"""

    edges = ()

    def __init__(self, name, order1, order2, quantity, finest):
        self.problem, self.order1, self.order2, self.quantity, self.finest = PROBLEMS[
            name], order1, order2, quantity, finest
        self.title, self.contact = self.problem.title, quantity == "contact force"
        self.always = ("-contact_updates", "20") if self.contact else ()

    def scene(self, level, setting):
        text = self.problem.scene(level, (ORDER1 | ORDER2).get(setting, ORDER1["default"]))
        return "\n".join(line for line in text.split("\n")
                         if not line.startswith("refine:")) + f"\nrefine: {self.problem.levels[level].refine}\n"

    def measure(self, record):
        return record["force"] if self.contact else record["energy"]

    def reference(self, runs, name):
        """Value, and half the difference of the two elements of order 2"""
        found = [
            measured(
                self,
                runs.get(f"{name}, {self.finest}, {setting}", self.scene(self.finest, setting), self.always,
                         5 * runs.limit)) for setting in ORDER2
        ]
        mean = sum(found) / len(found)
        return mean, abs(found[0] - found[-1]) / (2 * mean), f"mean of both elements of order 2 on mesh {self.finest}"


class Exact(Shipped):

    def reference(self, runs, name):
        return self.problem.solution.share * self.problem.solution.loaded()[0], None, "Hertz's formula"


class TwoBlock(Shipped):
    """The gap is linearized once: the contact problem of small displacements, whose force has a limit"""

    edges = ("1", "2")

    def __init__(self):
        super().__init__("two_block", ("1", "2", "4"), ("1", "2"), "contact force", None)
        self.always = ("-contact_updates", "1")

    def scene(self, level, setting):
        if setting not in EDGES:
            return super().scene(level, setting)
        return super().scene(level, "bbar") + two_block_zones(EDGES[setting])

    def reference(self, runs, name):
        """The edges refined until the force has a limit; then what the rest of the mesh still changes, whose error is
        that of cells squared"""
        force = lambda level, n: measured(self,
                                          runs.get(f"{name}, {level}, {edges(n)}", self.scene(level, edges(n)), self.
                                                   always, EDGE_LIMIT))  # noqa: E731
        at_edge, _ = richardson((1, 1 / 2, 1 / 4), [force("2", n) for n in (1, 2, 3)])
        rest = (force("4", 1) - force("2", 2)) / 3 * 4
        return at_edge + rest, abs(rest) / 4 / at_edge + abs(
            force("2", 3) - at_edge) / 2 / at_edge, "extrapolated from four meshes that are refined at the edges"


class Text:
    """A scene of elements/choice.py"""

    contact, quantity, finest, always, edges = True, "contact force", "2", ("-contact_updates", "20"), ()
    reference = Shipped.reference

    def __init__(self, title):
        self.title = title
        self.order1, self.order2 = ("0", "1", "2"), ("0", "1")

    def scene(self, level, setting):
        keys = (ORDER1 | ORDER2).get(setting, ORDER1["default"])
        return SCENES[self.title][1].replace(", E}",
                                             ", " + ", ".join(map(": ".join, keys)) + "}") + f"refine: {level}\n"

    @staticmethod
    def measure(record):
        return record["force"]


CASES = {
    "hertz_cylinder": Exact("hertz_cylinder", ("coarse", "medium", "0"), ("coarse", "medium"), "contact force", None),
    "hertz_sphere": Shipped("hertz_sphere", ("coarse", "medium", "0"), ("coarse", "medium"), "contact force", "0"),
    "two_block": TwoBlock(),
    "cantilever": Shipped("cantilever", ("0", "1"), ("0", ), "energy", "1"),
    "punch": Text("elastic punch, sharp, nu 0.3"),
    "ring": Text("ring between plates, nu 0.3"),
}


def settings(case):
    """(setting, mesh, options) of all runs"""
    for level in case.order1:
        yield from ((name, level, case.always) for name in ORDER1)
    for level in case.order2:
        yield from ((name, level, case.always) for name in ORDER2)
    for level in case.edges:
        yield from ((name, level, case.always) for name in EDGES)
    for name, options in OPTIONS.items():
        if case.contact and not (name == "one contact update" and case.always[1] == "1"):
            yield name, case.order1[0 if name == "published.opts" else 1], (*case.always, *options)
    for name, options in ACCURACY.items():
        yield name, case.order1[0], (*(() if case.always[-1:] == ("20", ) else case.always), *options)


def scene_of(case, level, setting):
    return case.scene(level, "full" if setting == "published.opts" else setting)


def run(name, runs):
    """Rows of a problem: setting, mesh, error and cost, the runs without an answer last; and its reference"""
    case, rows, failed = CASES[name], [], []
    for setting, level, options in settings(case):
        record = runs.get(f"{name}, {level}, {setting}", scene_of(case, level, setting), options,
                          EDGE_LIMIT if setting in EDGES else None)
        row = {
            "problem": name, "setting": setting, "mesh": level, "unknowns": record["unknowns"],
            "seconds": record["seconds"], "failed": record["failed"]
        }
        if record["failed"]:
            failed.append(row)
        else:
            rows.append(row | {"value": case.measure(record)})
    try:
        reference = case.reference(runs, name)
    except NoReference as why:
        print(f"front.py: {name} has no reference: {why}", flush=True)
        return [], [
            *failed, {
                "problem": name, "setting": "reference", "mesh": "", "unknowns": 0, "seconds": 0.0,
                "failed": f"no reference, so that the problem is not shown: {why}"
            }
        ], (math.nan, None, "no answer")
    rows += list(extrapolated(name, rows))
    for row in rows:
        row["error"] = abs(row["value"] / reference[0] - 1)
    return rows, failed, reference


def pairs(name, rows):
    """Two runs of a problem with a sharp edge, the second with cells of half the size at the edge"""
    meshes = CASES[name].order1
    for coarse in rows if name in ("two_block", "punch") else ():
        if coarse["setting"] in EDGES:
            yield coarse, find(rows, edges(EDGES[coarse["setting"]] + 1), coarse["mesh"])
        elif coarse["setting"] in ORDER1 | ORDER2:
            yield coarse, next((fine for mesh in meshes[meshes.index(coarse["mesh"]) + 1:][:1]
                                if (fine := find(rows, coarse["setting"], mesh))), None)


def extrapolated(name, rows):
    """By a law of the first order"""
    for coarse, fine in pairs(name, rows):
        if fine:
            setting, mesh = (coarse["setting"] + " and " + str(EDGES[fine["setting"]]),
                             fine["mesh"]) if coarse["setting"] in EDGES else (coarse["setting"],
                                                                               f"{coarse['mesh']} and {fine['mesh']}")
            yield fine | {
                "setting": setting + ", extrapolated", "mesh": mesh, "value": 2 * fine["value"] - coarse["value"],
                "seconds": fine["seconds"] + coarse["seconds"], "pair": (coarse, fine)
            }


def find(rows, setting, mesh=None):
    return next((row for row in rows if row["setting"] == setting and mesh in (None, row["mesh"])), None)


def cloud(row):
    """The runs that are drawn alike"""
    if row["setting"] in ACCURACY:
        return "-accuracy, " + row["setting"].split(", ")[1]
    return "extrapolated" if "extrapolated" in row[
        "setting"] else "bbar, edges refined" if row["setting"] in EDGES else row["setting"]


def figure(found, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    fig, axes = plt.subplots(2, 3, figsize=(12, 7))
    names = list(dict.fromkeys(cloud(row) for rows, _, _ in found.values() for row in rows))
    seen = {}
    for (name, (rows, _, _)), axis in zip(found.items(), axes.flat):
        for index, setting in enumerate(names):
            points = [(row["seconds"], max(row["error"], 1e-6)) for row in rows if cloud(row) == setting]
            if points:
                axis.loglog(*zip(*points), "ox^vsdP*<>+1hX"[index], color=f"C{index}" if index < 10 else
                            ("k", "m", "c", "y")[index - 10], label=setting, markersize=5, linestyle="none", alpha=0.8)
        axis.plot(*(zip(*front([(row["seconds"], max(row["error"], 1e-6)) for row in rows])) if rows else ([], [])),
                  "k-", linewidth=0.8, drawstyle="steps-post", label="Pareto front")
        for setting, marker in (("default", "s"), (RECOMMENDED, "D")):
            row = find(rows, setting)
            if row:
                axis.plot(row["seconds"], max(row["error"], 1e-6), marker, markersize=13, fillstyle="none", color="k",
                          label=f"{'the default' if setting == 'default' else 'recommended'}, first mesh")
        axis.set(title=CASES[name].title, xlabel="user time [s]", ylabel=f"error of the {CASES[name].quantity}")
        axis.grid(alpha=0.3)
        seen |= dict(zip(*reversed(axis.get_legend_handles_labels())))
    fig.legend(seen.values(), seen.keys(), loc="lower center", ncol=6, fontsize=8)
    fig.tight_layout(rect=(0, 0.09, 1, 1))
    fig.savefig(path, dpi=80)


def percent(value):
    return f"{100 * value:.2g} %" if value < 0.995 else f"{100 * value:.0f} %"


def price_table(found):
    """The cheapest run at each target, its mesh and setting"""
    yield "| problem | unknowns, default, first mesh | error | time [s] | " + " | ".join(f"time for {percent(t)} [s]"
                                                                                         for t in TARGETS) + " |"
    yield "| --- | --- | --- | --- |" + " --- |" * len(TARGETS)
    for name, (rows, _, (_, uncertain, _)) in found.items():
        default = find(rows, "default", CASES[name].order1[0])
        cheapest = [
            min((row for row in rows if row["error"] <= target), key=lambda row: row["seconds"],
                default=None) for target in TARGETS
        ]
        said = lambda row: (f"{row['seconds']:.2f}: `{name}, "
                            f"{row['mesh']}, {row['setting']}`") if row else "not reached"  # noqa: B023, E731
        cells = [
            "not known: the reference is less certain" if uncertain and target < uncertain else said(row)
            for target, row in zip(TARGETS, cheapest)
        ]
        start = (f"{default['unknowns']:,} | "
                 f"{percent(default['error'])} | "
                 f"{default['seconds']:.2f}") if default else "no answer | | "
        yield f"| {CASES[name].title} | {start} | " + " | ".join(cells) + " |"


def reference_table(found):
    yield "| problem | quantity | reference | how it was found | its uncertainty |"
    yield "| --- | --- | --- | --- | --- |"
    for name, (_, _, (value, uncertain, how)) in found.items():
        yield (f"| {CASES[name].title} | {CASES[name].quantity} | {value:.5g} | {how} | "
               f"{'' if uncertain is None else percent(uncertain)} |")


def mean_ratio(found, above, below, key):
    """Geometric mean over problems of a figure of one setting over that of another, on the same mesh"""
    logs = []
    for rows, _, _ in found.values():
        for row in rows:
            other = find(rows, below, row["mesh"])
            if row["setting"] == above and other and row[key] > 0 and other[key] > 0:
                logs.append(math.log(row[key] / other[key]))
    return math.exp(sum(logs) / len(logs)) if logs else math.nan


def same_unknowns(found):
    """Error and time of the recommended setting over those of the default on the next finer mesh, which has about as
    many unknowns"""
    ratios = []
    for name, (rows, _, _) in found.items():
        case = CASES[name]
        for level in case.order2:
            finer = case.order1[case.order1.index(level) + 1:][:1]
            fine, coarse = find(rows, RECOMMENDED, level), find(rows, "default", *finer) if finer else None
            if fine and coarse:
                ratios.append((fine["error"] / coarse["error"], fine["seconds"] / coarse["seconds"]))
    return tuple(
        math.exp(sum(math.log(max(r[i], 1e-9)) for r in ratios) / len(ratios)) if ratios else math.nan for i in (0, 1))


def extrapolation_ratio(found, at_edges):
    """Error of extrapolated forces over that of the second of their two meshes, and of the times"""
    ratios = [[row[key] / row["pair"][1][key]
               for key in ("error", "seconds")]
              for rows, _, _ in found.values()
              for row in rows
              if "pair" in row and ("edges" in row["setting"]) == at_edges]
    return tuple(
        math.exp(sum(math.log(max(r[i], 1e-9)) for r in ratios) / len(ratios)) if ratios else math.nan for i in (0, 1))


def rules(found):
    ratio = lambda a, b: (mean_ratio(found, a, b, "error"), mean_ratio(found, a, b, "seconds"))  # noqa: E731
    yield "1. Do not name an element in the scene."
    yield "2. For an error of 1 % or less use `order: 2` with `bbar` on a coarser mesh."
    yield "3. Let contact updates continue until the gap is consistent."
    yield "4. Do not change the solver's tolerance. The mesh decides the error."
    yield "5. If contact ends at a sharp edge, refine the edge locally, halve the cells there once more, and"
    yield "   extrapolate: twice the second force minus the first. On uniform meshes extrapolate only if the"
    yield "   edges of the two faces lie on each other's grid lines.\n"
    yield "| rule | compared | ratio of errors | ratio of times |"
    yield "| --- | --- | --- | --- |"
    rows = ((1, "`auto` and `full` on the same mesh", ratio("default", "full")),
            (2, "order 2 with `bbar`, and order 1 on the next finer mesh",
             same_unknowns(found)), (3, "one contact update per load step and consistent gap",
                                     ratio("one contact update", "default")), (4, "tolerance 1e-10 and default",
                                                                               ratio("tolerance 1e-10", "default")),
            (5, "two-block, edges refined: extrapolated force and the second of its two meshes",
             extrapolation_ratio(found, True)), (5, "punch and two-block, uniform meshes: the same",
                                                 extrapolation_ratio(found, False)))
    known = lambda value: f"{value:.2g}" if math.isfinite(value) else ""  # noqa: E731
    yield from (f"| {rule} | {text} | {known(error)} | {known(seconds)} |" for rule, text, (error, seconds) in rows)


def two_block_words(rows):
    """Why its error is large on coarse meshes, and the commands that reach 1 %"""
    errors = ", ".join(
        percent(row["error"]) for level in CASES["two_block"].order1 if (row := find(rows, "bbar", level)))
    yield "\n## Why two-block is expensive\n"
    yield "The error is that of the contact force. The block is 1 wide, with four cells across it on mesh 1,"
    yield "and the pressure at its sharp edges is infinite. There the error is proportional to the size of the"
    yield "cells, for elements of either order. It also depends on where the edges lie in the cells of the"
    yield "slab, so that it does not fall regularly from mesh to mesh. The slab is nearly incompressible"
    yield f"(Poisson's ratio 0.499), so that `full` locks. With `bbar` the errors are {errors}"
    yield (f"on meshes {', '.join(CASES['two_block'].order1)}. The gap is linearized once, as in the published "
           f"problem.\n")
    best = min((row for row in rows if "pair" in row and "edges" in row["setting"] and row["error"] <= 0.01),
               key=lambda row: row["seconds"], default=None)
    if not best:
        yield "No run with refined edges reached 1 %."
        return
    yield "Local refinement of the edges, on two meshes, and extrapolation reach 1 %:\n"
    for row, path in zip(best["pair"], ("first.yaml", "second.yaml")):
        yield f"    share/bench/front.py --scene \"two_block, {row['mesh']}, {row['setting']}\" > {path}"
        yield f"    bin/contact {path} -error_estimate 0"
    yield "\n| run | unknowns | force | error | time [s] |"
    yield "| --- | --- | --- | --- | --- |"
    yield from (
        f"| {text} | {row['unknowns']:,} | {row['value']:.4f} | {percent(row['error'])} | {row['seconds']:.2f} |"
        for text, row in (("first", best["pair"][0]), ("second", best["pair"][1]), ("twice the second minus the first",
                                                                                    best)))


def published_table(found):
    yield "\n## Ratios to the published configuration\n"
    yield "The table compares `published.opts` and the element `full` with the default settings on the first\nmesh:\n"
    yield "| problem | published.opts [s] | its error | default [s] | its error | ratio of times |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for name, (rows, _, _) in found.items():
        theirs, ours = find(rows, "published.opts"), find(rows, "default", CASES[name].order1[0])
        if theirs and ours:
            yield (f"| {CASES[name].title} | {theirs['seconds']:.2f} | {percent(theirs['error'])} | "
                   f"{ours['seconds']:.2f} | {percent(ours['error'])} | {theirs['seconds'] / ours['seconds']:.1f} |")


def failures(found):
    failed = [row for _, rows, _ in found.values() for row in rows]
    if failed:
        yield "\nRuns without an answer:\n"
        yield "| problem | mesh | setting | time [s] | how it ended |"
        yield "| --- | --- | --- | --- | --- |"
        yield from ((f"| {CASES[row['problem']].title} | {row['mesh']} | {row['setting']} | {row['seconds']:.1f} | "
                     f"{row['failed'].replace('|', '/')} |") for row in failed)


def page(found, loads, folder):
    there = [(path, title) for path, title in FURTHER if os.path.exists(os.path.join(folder, path))]
    yield "# What accuracy costs in time\n"
    yield "`make bench` made this page and [all pages behind it](#further-pages).\n"
    yield "| | |"
    yield "| --- | --- |"
    yield from machine.header(loads)
    yield "| times | user CPU seconds of whole runs on one core |"
    yield "| contact gaps | consistent, except for two-block, and where a setting says otherwise |\n"
    yield "Errors are relative to these references:\n"
    yield from reference_table(found)
    yield "\n![error against time, six problems](front.png)\n"
    yield "## Time for a given error\n"
    yield from price_table(found)
    yield ("\nTo repeat a run, create its scene from problem, mesh and setting in the table. Then add the options\n"
           "of the setting, for two-block without `-contact_updates 20`:\n")
    yield '    share/bench/front.py --scene "hertz_cylinder, coarse, order 2, bbar" > scene.yaml'
    yield "    bin/contact scene.yaml -contact_updates 20 -error_estimate 0\n"
    yield "| setting | further options |"
    yield "| --- | --- |"
    yield from (
        f"| {name} | `{' '.join(os.path.relpath(word, TOP) if word.endswith('.opts') else word for word in options)}` |"
        for name, options in (OPTIONS | ACCURACY).items())
    yield "| extrapolated | two runs, see rule 5 |"
    if "two_block" in found:
        yield from two_block_words(found["two_block"][0])
    yield "\n## Five rules\n"
    yield from rules(found)
    yield from published_table(found)
    yield "\n## All runs\n"
    yield (f"[All {sum(len(rows) for rows, _, _ in found.values())} runs of this page](front.csv): setting, mesh, "
           f"unknowns, error, user seconds.")
    yield from failures(found)
    yield "\n## Further pages\n"
    yield "| page | |"
    yield "| --- | --- |"
    yield from (f"| [{path}]({path}) | {title} |" for path, title in there)


FURTHER = (
    ("elements/choice.md", "how good the element is that `auto` chooses, for eleven scenes"),
    ("elements/second.md", "the same for eleven other scenes: finite strain, friction, plasticity, torsion"),
    ("elements/third.md", "the same for five scenes that were chosen after the rule had changed"),
    ("calculix.md", "comparison with CalculiX: times, forces, and why they differ"),
    ("effects.md", "cost of effects that a scene does not use"),
)


def write_csv(found, path):
    keys = ("problem", "mesh", "setting", "unknowns", "error", "seconds")
    text = lambda value: f'"{value}"' if "," in str(value) else f"{value:.4g}" if isinstance(value, float) else str(
        value)  # noqa: E731
    with open(path, "w") as file:
        file.write(",".join(keys) + "\n" + "".join(",".join(text(row[k])
                                                            for k in keys) + "\n"
                                                   for rows, _, _ in found.values()
                                                   for row in rows))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="", help="problems whose name has this")
    parser.add_argument("--limit", type=float, default=40.0, help="seconds a run")
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    parser.add_argument("--scene", help="problem, mesh and setting whose scene is printed")
    arguments = parser.parse_args()
    if arguments.scene:
        name, level, setting = arguments.scene.split(", ", 2)
        print(scene_of(CASES[name], level, setting), end="")
        return
    runs = Runs(os.path.join(arguments.folder, "kept", "front"), arguments.limit)
    found = {name: run(name, runs) for name in CASES if arguments.only in name}
    pages = os.path.join(arguments.folder, "pages")
    os.makedirs(pages, exist_ok=True)
    write_csv(found, os.path.join(pages, "front.csv"))
    figure(found, os.path.join(pages, "front.png"))
    with open(os.path.join(pages, "README.md"), "w") as file:
        file.write("\n".join(page(found, runs.loads, pages)) + "\n")
    print(os.path.join(pages, "README.md"))


if __name__ == "__main__":
    sys.exit(main())
