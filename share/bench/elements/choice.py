#!/usr/bin/env python3
"""Compares the element that auto chooses with all others, on scenes that were not used for its rule:
{choice,second,third}.md

    share/bench/elements/choice.py [--only NAME] [--limit SECONDS] [--folder build/bench]
"""
import argparse
import math
import os
import re
import sys

TOP = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.join(TOP, "share", "bench")]
import machine  # noqa: E402
from runs import Runs  # noqa: E402

ELEMENTS = {
    "auto": "", "full": "element: full", "bbar": "element: bbar", "incompatible": "element: incompatible",
    "order 2": "element: full, order: 2", "order 2, bbar": "element: bbar, order: 2"
}
LEVELS = {1: (0, 1), 2: (0, )}  # refinements by order
REFERENCE = 1  # refinements of the runs by order 2 whose mean is the reference
WORDS = {
    "choice": "",
    "second": """`auto` gave bodies of finite strain with a Poisson's ratio of at most 0.4 the element `full` until
this page showed that `bbar` is better. Four of these scenes therefore decided that part of the
rule. [Five more scenes](third.md) were measured after the change.
""",
    "third": """The rule for finite strain changed after the first two sets had been measured. These scenes were
measured once, afterwards.
"""
}


def read_scenes():
    """page: {title: (the quantity that is compared, the scene)}"""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes.yaml")) as file:
        parts = re.split(r"^--- # (.*): (.*): (.*)\n", file.read(), flags=re.M)[1:]
    pages = {name: {} for name in WORDS}
    for name, title, quantity, text in zip(*(parts[k::4] for k in range(4))):
        pages[name][title] = quantity, text
    return pages


PAGES = read_scenes()
SCENES = {title: scene for scenes in PAGES.values() for title, scene in scenes.items()}


def run(title, element, level, runs):
    """Unknowns, quantity, user seconds; in their place why there is no answer"""
    quantity, text = SCENES[title]
    text = text.replace(", E}", f", {ELEMENTS[element]}}}" if ELEMENTS[element] else "}") + f"refine: {level}\n"
    record = runs.get(f"{title}, {element}, {level}", text, ("-contact_updates", "20"))
    return record["failed"] or (record["unknowns"], record[quantity], record["seconds"])


def results(titles, runs):
    """title: (reference, its uncertainty, {(element, refinement): (unknowns, error, seconds) or a sentence})"""
    found = {}
    for title in titles:
        entries = {(element, level): run(title, element, level, runs)
                   for element in ELEMENTS for level in LEVELS[2 if "order 2" in element else 1]}
        finest = [
            entry[1]
            for element in ("order 2", "order 2, bbar")
            if not isinstance(entry := run(title, element, REFERENCE, runs), str)
        ]
        mean = sum(finest) / len(finest) if finest else math.nan
        uncertain = abs(finest[0] - finest[-1]) / abs(mean) if finest else math.nan
        found[title] = mean, uncertain, {
            key: entry if isinstance(entry, str) else (entry[0], abs(entry[1] / mean - 1), entry[2])
            for key, entry in entries.items()
        }
    return found


def answers(entries):
    """Those of runs that have one"""
    return {key: entry for key, entry in entries.items() if not isinstance(entry, str)}


def best_of_mesh(entries, level):
    """Whether the error of auto is at most 1.2 times the least of order 1 on the same mesh"""
    return entries["auto", level][1] <= 1.2 * min(
        entry[1] for (element, at), entry in entries.items() if at == level and "order 2" not in element)


def on_front(entries, level):
    """Whether no run that takes at most its time has an error below 1/1.2 of its error"""
    mine = entries["auto", level]
    return all(other[1] >= mine[1] / 1.2 for other in entries.values() if other[2] <= mine[2])


def answer(good):
    return "yes" if good else "no"


INTRODUCTION = """If a scene names no element, the program chooses one (`element: auto`). This page compares the
chosen element with all others on scenes that were not used to find the rule of `auto`. Errors are
those of the contact force, or of the energy if there is no contact. The reference is the mean of
`full` and `bbar` of order 2 on the mesh refined once; half of their difference is its uncertainty.
Times are user seconds on one core, the least of several runs if a run takes less than 0.5 s.
`refused`: the element does not exist for the law of the body.
Two criteria say whether the choice was good:

| column | meaning |
| --- | --- |
| best of order 1 | the error of `auto` is at most 1.2 times the smallest error of all elements of order 1 \
on the same mesh |
| on the front | no run that is at least as fast has an error more than 20 % smaller |

If `auto` is not on the front, order 2 on a coarser mesh is better. The scene must then request
`order: 2`. On the same mesh, order 2 has six to eight times as many unknowns.
"""


def cell(entry):
    return entry.split(":")[0] if isinstance(entry,
                                             str) else f"{100 * entry[1]:.2g} %, {entry[2]:.2g} s" if entry else ""


def page(name, found, words, loads):
    yield "# How good is the element that `auto` chooses?\n"
    yield "`make bench` made this page. Back to [the front page](../README.md).\n"
    yield "| | |\n| --- | --- |"
    yield from machine.header(loads)
    yield ""
    yield INTRODUCTION
    if words:
        yield words
    yield f"![error and time relative to auto]({name}.png)\n"
    yield "Number of scenes in which `auto` meets each criterion:\n"
    yield "| refinement | best of order 1 | on the front | scenes |"
    yield "| --- | --- | --- | --- |"
    for level in LEVELS[1]:
        both = [(best_of_mesh(known, level), on_front(known, level))
                for _, _, entries in found.values()
                if ("auto", level) in (known := answers(entries))]
        yield f"| {level} | {sum(a for a, _ in both)} | {sum(b for _, b in both)} | {len(both)} |"
    yield "\nError and time of each run:\n"
    yield "| scene | reference uncertain by | refinement | unknowns | " + " | ".join(
        ELEMENTS) + " | best of order 1 | on the front |"
    yield "| --- | --- | --- | --- |" + " --- |" * (len(ELEMENTS) + 2)
    for title, (_, uncertain, entries) in found.items():
        known = answers(entries)
        for level in LEVELS[1]:
            cells = [cell(entries.get((element, level))) for element in ELEMENTS]
            mine = known.get(("auto", level))
            ours = (answer(best_of_mesh(known, level)), answer(on_front(known, level))) if mine else ("", "")
            yield f"| {title} | {50 * uncertain:.2g} % | {level} | {f'{mine[0]:,}' if mine else ''} | " + " | ".join(
                (*cells, *ours)) + " |"
    yield ""
    yield from ratios(found)


def figure(found, path):
    """Error over that of auto on the same mesh against the same ratio of times"""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    fig, axis = plt.subplots(figsize=(6.5, 4))
    for index, element in enumerate(list(ELEMENTS)[1:]):
        points = [(known[element, 0][2] / known["auto", 0][2],
                   max(known[element, 0][1], 1e-7) / max(known["auto", 0][1], 1e-7))
                  for _, _, entries in found.values()
                  if {(element, 0), ("auto", 0)} <= set(known := answers(entries))]
        if points:
            axis.loglog(*zip(*points), "os^Dv"[index], color=f"C{index}", label=element, markersize=5, linestyle="none",
                        alpha=0.8)
    axis.axhline(1, color="k", linewidth=0.8)
    axis.axvline(1, color="k", linewidth=0.8)
    axis.set(xlabel="user time relative to auto", ylabel="error relative to auto",
             title="One point a scene, refinement 0")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(path, dpi=80)
    plt.close(fig)


def ratios(found):
    """Geometric means over all scenes and meshes"""
    yield "| compared with `auto` on the same mesh, geometric mean | runs | ratio of errors | ratio of times |"
    yield "| --- | --- | --- | --- |"
    for element in list(ELEMENTS)[1:]:
        pairs = [(known[element, level], known["auto", level])
                 for _, _, entries in found.values()
                 for level in LEVELS[1]
                 if {(element, level), ("auto", level)} <= set(known := answers(entries))]
        logs = [[math.log(max(theirs[k], 1e-9) / max(ours[k], 1e-9)) for theirs, ours in pairs] for k in (1, 2)]
        if pairs:
            yield f"| `{element}` | {len(pairs)} | " + " | ".join(f"{math.exp(sum(values) / len(values)):.2g}"
                                                                  for values in logs) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="", help="scenes whose title has this")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds a run")
    parser.add_argument("--folder", type=os.path.abspath, default=os.path.join(TOP, "build", "bench"))
    arguments = parser.parse_args()
    folder = os.path.join(arguments.folder, "pages", "elements")
    os.makedirs(folder, exist_ok=True)
    for name, scenes in PAGES.items():
        runs = Runs(os.path.join(arguments.folder, "kept", name), arguments.limit)
        found = results([title for title in scenes if arguments.only in title], runs)
        if found:
            figure(found, os.path.join(folder, name + ".png"))
            with open(os.path.join(folder, name + ".md"), "w") as file:
                file.write("\n".join(page(name, found, WORDS[name], runs.loads)) + "\n")


if __name__ == "__main__":
    main()
