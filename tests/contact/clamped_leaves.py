"""Leaves with a common clamp at one end, the last one bent at its tip. Their cells do not match.

python3 clamped_leaves.py scenes N writes the scenes with N leaves; python3 clamped_leaves.py judges the runs.

Beam theory: equal leaves bend alike, and each needs an equal part of the force at the tip. They touch near the tip only. Rows of the nodes in the clamp would measure how differently the two faces are interpolated beside it; their forces were 4 to 100,000 times as large as the others.
"""
import sys

from leaves import leaves
from summaries import load, say


def mismatched(n, gap):
    return leaves(n, f", gap: {gap}").replace("[0, 0, 0.3], upper: [10, 1, 0.6], cells: [20,", "[0, 0, 0.3], upper: [10, 1, 0.6], cells: [23,")


def scenes(n):
    yield "matching", leaves(n, ", gap: mortar")
    yield from ((gap, mismatched(n, gap)) for gap in GAPS)
    # a displacement that is prescribed along the normal does not keep nodes from sticking
    yield "sticking", leaves(n, ", stick: true")


GAPS = ("mortar", "dual", "node")
FORCE = 3 * 1000 * 0.3**3 / 12 / 10**3  # of one leaf whose tip is bent by 1

if sys.argv[1:2] == ["scenes"]:
    for name, text in scenes(int(sys.argv[2])):
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    energy = load("matching")["steps"][-1]["energy"]
    for name in ("matching", *GAPS, "mortar_2"):
        run = load(name)
        step = run["steps"][-1]
        forces = [pair["normal_force"] / FORCE / n for n, pair in enumerate(step["pairs"], 1)]
        say(f"{name}: solved, in equilibrium, with the energy of matching cells", run["converged"] and step["balance"] < 1e-6 and abs(step["energy"] / energy - 1) < 1e-3, (run["reason"], step["balance"], step["energy"]))
        say(f"{name}: the normal forces are those of beam theory, to a factor of 1.8", all(1 / 1.8 < force < 1.8 for force in forces), forces)
    one, two = (load(name)["steps"][-1]["pairs"] for name in ("mortar", "mortar_2"))
    off = [b["normal_force"] / a["normal_force"] - 1 for a, b in zip(one, two)]
    say("2 ranks as 1", max(map(abs, off)) < 1e-5, off)
    say("sticking: no warning of nodes without friction", not load("sticking")["warnings"], load("sticking")["warnings"])
