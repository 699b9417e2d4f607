"""Holds the arithmetic of share/bench against sequences with known answers, and its records against runs."""
import contextlib
import io
import math
import os
import re

import calculix
import runs
from front import front, richardson
from problems import PROBLEMS, TOP
from runner import execute, last_words, read_summary
from runs import CONTACT
from summaries import say


def check_extrapolation():
    sizes = (1, 1 / 2, 1 / 3)
    limit, order = richardson(sizes, [3 - 0.7 * h**1.5 for h in sizes])
    say("Richardson: limit and order", abs(limit - 3) < 1e-12 and abs(order - 1.5) < 1e-12, (limit, order))
    limit, order = richardson((1, 1 / 2, 1 / 4), (1.0, 1.1, 1.3))
    say("Richardson: nothing is extrapolated from differences that grow", limit == 1.3 and math.isnan(order),
        (limit, order))


def check_front():
    points = [(1.0, 5.0), (2.0, 6.0), (3.0, 1.0), (3.5, 1.0), (0.5, 9.0)]
    say("front", front(points) == [(0.5, 9.0), (1.0, 5.0), (3.0, 1.0)], front(points))


def check_scenes():
    text = PROBLEMS["two_block"].scene("3", (("element", "bbar"), ))
    say("scene: cells and element", "[60, 18, 9]" in text and "[12, 12, 12]" in text
        and text.count("element: bbar") == 2 and "steps: 1}" in text, text)
    for name, told in ("hertz_sphere", 9.157), ("hertz_cylinder", 0.02158):
        solution = PROBLEMS[name].solution
        force, energy = solution.loaded()
        say(f"{name}: force of the scene's comment", abs(force / told - 1) < 1e-3, force)
        path = [(f, solution.at(f)[2]) for f in (force * (i + 1e-9) / 2000 for i in range(2001))]
        work = sum((f + g) / 2 * (b - a) for (f, a), (g, b) in zip(path, path[1:]))
        say(f"{name}: the energy is the work of the force", abs(work / energy - 1) < 1e-5, (work, energy))
    say("the sentence of a run that failed",
        last_words("a\ncontact: error: no scene\n--\n") == "contact: error: no scene", None)


def check_kept():
    """A run that its limit ended, or that the program refused, is a record; what has been run with the same scene is
    not run again"""
    scene = PROBLEMS["cantilever"].scene("0", (("element", "bbar"), ))
    made = runs.Runs("kept", 60)
    with contextlib.redirect_stdout(io.StringIO()):
        first, again = (made.get("cantilever", scene, ("-refine", "0")) for _ in range(2))
        other = made.get("cantilever", scene.replace("poisson: 0.3", "poisson: 0.2"), ("-refine", "0"))
        wrong = made.get("wrong", scene.replace("poisson: 0.3", "poisson: 7"))
        slow = made.get("slow", scene, ("-refine", "2"), 0.05)
    say("kept: the same record", first == again and first["failed"] == "" and first["unknowns"] == 3075, (first, again))
    say("kept: another scene under that name is run", other["energy"] != first["energy"], first)
    say("kept: a refused scene says why", wrong["failed"].startswith("refused: "), None)
    say("kept: a time limit is told", slow["failed"] == "time limit 0.05 s", None)


def check_calculix():
    """The input file has the nodes and cells of the scene, and no cell without its nodes"""
    for factor, nodes, cells in (1, 713, 424), (2, 4460, 3392):
        blocks = re.split(r"^\*", calculix.deck(factor, "CalculiX, mortar, hard"), flags=re.M)
        lines = {
            kind: [
                list(map(float, line.split(","))) for block in blocks if block.startswith(kind + ",")
                for line in block.splitlines()[1:]
            ]
            for kind in ("NODE", "ELEMENT")
        }
        known = {int(line[0]) for line in lines["NODE"]}
        say(f"CalculiX, mesh {factor}: nodes and cells", (len(known), len(lines["ELEMENT"])) == (nodes, cells)
            and all(set(map(int, line[1:])) <= known for line in lines["ELEMENT"]), (len(known), len(lines["ELEMENT"])))


def check_memory():
    """A program's peak is its own, not that of the process which started it, as getrusage() has it"""
    large = b"1" * 700_000_000
    execute([
        CONTACT,
        os.path.join(TOP, "share", "scenes", "cantilever.yaml"), "-refine", "0", "-quiet", "-summary", "own.json"
    ], 60)
    peak = read_summary("own")["peak_memory_bytes"]
    say("memory is the program's own", 1e7 < peak < len(large) - 1e8, peak)


check_extrapolation()
check_calculix()
check_front()
check_scenes()
check_memory()
check_kept()
