#!/usr/bin/env python3
"""make bench-front: the accuracy page, README.md and front.png: six problems, error against time, and what 10 %, 1 % and 0.1 % cost.

    share/bench/front.py [--only NAME] [--limit SECONDS] [--folder build/front]
    share/bench/front.py --scene "PROBLEM, MESH, SETTING"        prints a scene of the page
"""
import argparse
import datetime
import math
import os
import resource
import subprocess
import sys

import machine
import references
from elements.choice import SCENES
from plots import front
from problems import PROBLEMS, TOP, force, last
from runner import environment, keep, last_words, read_summary
from store import CONTACT, source_version

ORDER1 = {"default": (("element", "auto"),), "full": (("element", "full"),), "bbar": (("element", "bbar"),), "incompatible": (("element", "incompatible"),)}
ORDER2 = {"order 2": (("element", "full"), ("order", "2")), "order 2, bbar": (("element", "bbar"), ("order", "2"))}
RECOMMENDED = "order 2, bbar"
TRUE = ("-contact_updates", "20")
# setting: options of runs of the default element; the first loosen and tighten the solver
OPTIONS = {"tolerance 1e-2": ("-tao_ipfilter_tol", "1e-2"), "tolerance 1e-10": ("-tao_ipfilter_tol", "1e-10"), "one contact update": ("-contact_updates", "1"), "published.opts": ("-options_file", os.path.join(TOP, "share", "options", "published.opts"))}
TARGETS = (0.1, 0.01, 0.001)
# setting: options of runs that choose their own meshes, from the first one of the problem
ACCURACY = {f"accuracy {target}, {name}": ("-accuracy", target, *options) for target in ("1e-1", "1e-2", "1e-3") for name, options in (("adaptive", ("-accuracy_adaptive",)), ("order 2", ("-accuracy_order", "2")))}


class Shipped:
    """A problem of problems.py, measured by the contact force, or the energy where nothing touches"""

    def __init__(self, name, order1, order2, quantity, finest=None):
        self.problem, self.order1, self.order2, self.quantity, self.finest = PROBLEMS[name], order1, order2, quantity, finest
        self.title, self.contact = self.problem.title, quantity == "contact force"
        self.reference = None if finest else self.problem.exact(references.values(references.load()))[quantity]

    def scene(self, level, keys):
        text = self.problem.scene(level, keys)
        return "\n".join(line for line in text.split("\n") if not line.startswith("refine:")) + f"\nrefine: {self.problem.levels[level].refine}\n"

    def measure(self, summary):
        return force(summary) if self.contact else last(summary)["energy"]


class Text:
    """A scene of elements/choice.py with a reference of its own"""

    contact, quantity, finest = True, "contact force", "2"

    reference = None

    def __init__(self, title):
        self.title = title
        self.order1, self.order2 = ("0", "1", "2"), ("0", "1")

    def scene(self, level, keys):
        return SCENES[self.title][1].replace(", E}", ", " + ", ".join(map(": ".join, keys)) + "}") + f"refine: {level}\n"

    @staticmethod
    def measure(summary):
        return force(summary)


# Where a finest mesh is named, the reference is of order 2 on it: there `full` and `bbar` differ by less than 0.01 % for punch and ring.
# Hertz's formula is of half-spaces: the force of the scene's ball is 0.2 % above it
CASES = {
    "hertz_cylinder": Shipped("hertz_cylinder", ("coarse", "medium", "0"), ("coarse", "medium"), "contact force"),
    "hertz_sphere": Shipped("hertz_sphere", ("coarse", "medium"), ("coarse",), "contact force", "0"),
    "two_block": Shipped("two_block", ("1", "2", "3"), ("1",), "contact force"),
    "cantilever": Shipped("cantilever", ("0", "1"), ("0",), "energy"),
    "punch": Text("elastic punch, sharp, nu 0.3"),
    "ring": Text("ring between plates, nu 0.3"),
}


def settings(case):
    """(setting, mesh, keys of the bodies, options) of all runs"""
    always = TRUE if case.contact else ()
    for level in case.order1:
        yield from ((name, level, keys, always) for name, keys in ORDER1.items())
    for level in case.order2:
        yield from ((name, level, keys, always) for name, keys in ORDER2.items())
    for name, options in OPTIONS.items():
        if case.contact:
            keys = ORDER1["full" if name == "published.opts" else "default"]
            yield name, case.order1[0 if name == "published.opts" else 1], keys, (*always, *options)
    for name, options in ACCURACY.items():
        yield name, case.order1[0], ORDER1["default"], options


def run_once(case, base, keys, options, limit, level):
    with open(base + ".yaml", "w") as file:
        file.write(case.scene(level, keys))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        done = subprocess.run([CONTACT, base + ".yaml", "-quiet", *(() if "-accuracy" in options else ("-error_estimate", "0")), *options, "-summary", base + ".json"], env=environment(), capture_output=True, text=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None
    summary = read_summary(base)
    if done.returncode not in (0, 3, 4) or not summary or not summary["steps"]:
        print(base, done.returncode, last_words(done.stderr), flush=True)
        return None
    return {"unknowns": summary["dofs"], "value": case.measure(summary), "seconds": resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before}


def run(name, folder, limit):
    """All runs of a problem: setting, mesh, error and what they cost"""
    case, rows = CASES[name], []
    for setting, level, keys, options in settings(case):
        base = os.path.join(folder, f"{name}_{level}_{setting}".replace(" ", "_").replace(",", ""))
        entry = keep(base + ".kept", lambda: run_once(case, base, keys, options, limit, level))  # noqa: B023
        if entry:
            rows.append(entry | {"problem": name, "setting": setting, "mesh": level})
    reference = case.reference
    if reference is None:
        finest = [row["value"] for setting in ORDER2 if (row := keep(os.path.join(folder, f"{name}_reference_{setting}.kept".replace(" ", "_")), lambda: run_once(case, os.path.join(folder, name + "_reference"), ORDER2[setting], TRUE, 10 * limit, case.finest)))]  # noqa: B023
        reference = sum(finest) / len(finest)
    for row in rows:
        row["error"] = abs(row["value"] / reference - 1)
    return rows


def find(rows, setting, mesh=None):
    return next((row for row in rows if row["setting"] == setting and mesh in (None, row["mesh"])), None)


def figure(found, folder):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    fig, axes = plt.subplots(2, 3, figsize=(12, 7))
    cloud = lambda row: "-accuracy, " + row["setting"].split(", ")[1] if row["setting"] in ACCURACY else row["setting"]  # noqa: E731
    names = list(dict.fromkeys(cloud(row) for rows in found.values() for row in rows))
    for (name, rows), axis in zip(found.items(), axes.flat):
        for index, setting in enumerate(names):
            points = [(row["seconds"], max(row["error"], 1e-6)) for row in rows if cloud(row) == setting]
            if points:
                axis.loglog(*zip(*points), "ox^vsdP*<>+1"[index], color=f"C{index}" if index < 10 else ("k", "m")[index - 10], label=setting, markersize=5, linestyle="none", alpha=0.8)
        axis.plot(*zip(*front([(row["seconds"], max(row["error"], 1e-6)) for row in rows])), "k-", linewidth=0.8, drawstyle="steps-post", label="Pareto front")
        for setting, marker in (("default", "s"), (RECOMMENDED, "D")):
            row = find(rows, setting)
            if row:
                axis.plot(row["seconds"], max(row["error"], 1e-6), marker, markersize=13, fillstyle="none", color="k", label=f"{'the default' if setting == 'default' else 'recommended'}, first mesh")
        axis.set(title=CASES[name].title, xlabel="user time [s]", ylabel=f"error of the {CASES[name].quantity}")
        axis.grid(alpha=0.3)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="lower center", ncol=6, fontsize=8)
    fig.tight_layout(rect=(0, 0.07, 1, 1))
    fig.savefig(os.path.join(folder, "front.png"), dpi=80)


def percent(value):
    return f"{100 * value:.2g} %"


def price_table(found):
    """The cheapest run at each target, its mesh and setting"""
    yield "| problem | unknowns, default, first mesh | error | time [s] | " + " | ".join(f"time for {percent(t)} [s]" for t in TARGETS) + " |"
    yield "| --- | --- | --- | --- |" + " --- |" * len(TARGETS)
    for name, rows in found.items():
        default = find(rows, "default")
        cheapest = [min((row for row in rows if row["error"] <= target), key=lambda row: row["seconds"], default=None) for target in TARGETS]
        cells = [f"{row['seconds']:.2f}: `{name}, {row['mesh']}, {row['setting']}`" if row else "not reached" for row in cheapest]
        yield f"| {CASES[name].title} | {default['unknowns']:,} | {percent(default['error'])} | {default['seconds']:.2f} | " + " | ".join(cells) + " |"


def mean_ratio(found, above, below, key):
    """Geometric mean over problems of a figure of one setting over that of another, on the same mesh"""
    product, n = 1.0, 0
    for rows in found.values():
        for row in rows:
            other = find(rows, below, row["mesh"])
            if row["setting"] == above and other and row[key] > 0 and other[key] > 0:
                product, n = product * row[key] / other[key], n + 1
    return product ** (1 / n) if n else math.nan


def same_unknowns(found):
    """Error and time of the recommended setting over those of the default on the next finer mesh, which has about as many unknowns"""
    ratios = []
    for name, rows in found.items():
        case = CASES[name]
        for level in case.order2:
            at = case.order1.index(level) + 1
            fine, coarse = find(rows, RECOMMENDED, level), find(rows, "default", case.order1[at]) if at < len(case.order1) else None
            if fine and coarse:
                ratios.append((fine["error"] / coarse["error"], fine["seconds"] / coarse["seconds"]))
    return tuple(math.prod(max(r[i], 1e-9) for r in ratios) ** (1 / len(ratios)) if ratios else math.nan for i in (0, 1))


def rules(found):
    r = lambda a, b, key: mean_ratio(found, a, b, key)  # noqa: E731
    error, seconds = same_unknowns(found)
    yield "1. Do not name an element in the scene."
    yield "2. For an error of 1 % or less use `order: 2` with `bbar` on a coarser mesh."
    yield "3. Let contact updates continue until the gap is consistent."
    yield "4. Do not change the solver's tolerance. The mesh decides the error."
    yield "5. If contact ends at a sharp edge, compute two meshes and extrapolate. The error is proportional"
    yield "   to the cell size for elements of either order: [sharp edges](elements/sharp.md).\n"
    yield "| rule | compared | ratio of errors | ratio of times |"
    yield "| --- | --- | --- | --- |"
    for rule, text, above, below in ((1, "`auto` and `full` on the same mesh", "default", "full"), (3, "one contact update per load step and consistent gap", "one contact update", "default"), (4, "tolerance 1e-10 and default", "tolerance 1e-10", "default")):
        yield f"| {rule} | {text} | {r(above, below, 'error'):.2g} | {r(above, below, 'seconds'):.2g} |"
    yield f"| 2 | order 2 with `bbar`, and order 1 on the next finer mesh | {error:.2g} | {seconds:.2g} |"



REFERENCES = """Errors are relative to these references:

| problem | reference | its uncertainty |
| --- | --- | --- |
| Hertz cylinder | Hertz's formula | |
| Hertz sphere | elements of order 2 on a fine mesh; the force is 0.2 % larger than that of Hertz's half-space | |
| two-block | value extrapolated from fine meshes | 0.4 % |
| cantilever | value extrapolated from fine meshes | 0.3 % |
| punch, ring | elements of order 2 on a fine mesh | |
""".split("\n")


def page(found, pages):
    where = machine.describe()
    yield "# What accuracy costs in time\n"
    yield f"`make bench-front` made this page on {datetime.date.today()} from commit {source_version()}.\n"
    yield "| | |"
    yield "| --- | --- |"
    yield f"| machine | {where['processor']}, one core; other programs were running |"
    yield "| libraries | " + ", ".join(f"{n} {v}" for n, v in where["versions"].items()) + " |"
    yield "| times | user CPU seconds of whole runs |"
    yield "| contact gaps | consistent, unless a setting says otherwise |\n"
    yield from REFERENCES
    yield "![error against time, six problems](front.png)\n"
    yield "## Time for a given error\n"
    yield from price_table(found)
    yield "\nTo repeat a run, create its scene from problem, mesh and setting in the table. Then add the options\nof the setting:\n"
    yield '    share/bench/front.py --scene "hertz_cylinder, coarse, order 2, bbar" > scene.yaml'
    yield "    bin/contact scene.yaml -contact_updates 20\n"
    yield "| setting | further options |"
    yield "| --- | --- |"
    yield from (f"| {name} | `{' '.join(os.path.relpath(word, TOP) if word.endswith('.opts') else word for word in options)}` |" for name, options in (OPTIONS | ACCURACY).items())
    yield ""
    yield "## Five rules\n"
    yield from rules(found)
    yield "\n## Ratios to the published configuration\n"
    yield "The table compares `published.opts` and the element `full` with the default settings on the first\nmesh:\n"
    yield "| problem | published.opts [s] | its error | default [s] | its error | ratio of times |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for name, rows in found.items():
        theirs, ours = find(rows, "published.opts"), find(rows, "default")
        if theirs:
            yield f"| {CASES[name].title} | {theirs['seconds']:.2f} | {percent(theirs['error'])} | {ours['seconds']:.2f} | {percent(ours['error'])} | {theirs['seconds'] / ours['seconds']:.1f} |"
    yield "\n## All runs\n"
    yield f"[All {sum(map(len, found.values()))} runs of this page](front.csv): setting, mesh, unknowns, error, user seconds.\n"
    yield "## Further pages\n"
    yield "| page | |"
    yield "| --- | --- |"
    yield from pages


def index(folder):
    """A line for every page of a knob, and for the others"""
    yield "| [elements/choice.md](elements/choice.md) | the element that is chosen if a scene names none, for eleven scenes |"
    yield "| [elements/second.md](elements/second.md) | the same for eleven other scenes: finite strain, friction, plasticity, torsion |"
    yield "| [elements/sharp.md](elements/sharp.md) | order 1 and 2 where contact ends at an edge |"
    yield "| [calculix.md](calculix.md) | comparison with CalculiX: times, forces, and why they differ |"
    yield "| [effects.md](effects.md) | cost of effects that a scene does not use |"
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else ():
        if name.endswith(".md"):
            with open(os.path.join(folder, name)) as file:
                yield f"| [knobs/{name}](knobs/{name}) | {file.readline().lstrip('# ').strip()} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="", help="problems whose name has this")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds a run")
    parser.add_argument("--folder", default=os.path.join(TOP, "build", "front"))
    parser.add_argument("--scene", help="problem, mesh and setting whose scene is printed")
    arguments = parser.parse_args()
    if arguments.scene:
        name, level, setting = arguments.scene.split(", ", 2)
        print(CASES[name].scene(level, (ORDER1 | ORDER2).get(setting, ORDER1["default"])), end="")
        return
    os.makedirs(arguments.folder, exist_ok=True)
    found = {name: run(name, arguments.folder, arguments.limit) for name in CASES if arguments.only in name}
    with open(os.path.join(arguments.folder, "front.csv"), "w") as file:
        keys = ("problem", "mesh", "setting", "unknowns", "error", "seconds")
        file.write(",".join(keys) + "\n" + "".join(",".join(f'"{row[k]}"' if "," in str(row[k]) else f"{row[k]:.4g}" if isinstance(row[k], float) else str(row[k]) for k in keys) + "\n" for rows in found.values() for row in rows))
    figure(found, arguments.folder)
    with open(os.path.join(arguments.folder, "README.md"), "w") as file:
        file.write("\n".join(page(found, index(os.path.join(TOP, "share", "bench", "knobs")))) + "\n")
    print(os.path.join(arguments.folder, "README.md"))


if __name__ == "__main__":
    sys.exit(main())
