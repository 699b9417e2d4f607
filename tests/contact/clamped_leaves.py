"""Leaves with a common clamp at one end, the last one bent at its tip. Their cells do not match.

python3 clamped_leaves.py scenes NAME ... writes the scenes; python3 clamped_leaves.py NAME ... judges the runs. NAME:
number of leaves and formulation of the gap, such as two_dual, or sticking.
A run on two ranks has the name of the scene and _ranks.

Beam theory: equal leaves bend alike, and each needs an equal part of the force at the tip. They touch near the tip
only. Rows of the nodes in the clamp would measure how differently the two faces are interpolated beside it; their
forces were 4 to 100,000 times as large as the others.
"""
import sys

from leaves import leaves
from summaries import load, say

LEAVES = {"two": 2, "three": 3, "six": 6}
FORCE = 3 * 1000 * 0.3**3 / 12 / 10**3  # of one leaf whose tip is bent by 1

# gap, numbers of cells along the leaves
CELLS = {
    "three_coarser": ("mortar", 20, 17, 13), "three_finer": ("mortar", 20, 40, 20),
    "three_alike_dual": ("dual", 20, 20, 20), "three_alike_node": ("node", 20, 20, 20)
}


def with_cells(gap, *cells):
    parts = leaves(len(cells), f", gap: {gap}").split("cells: [20,")
    return parts[0] + "".join(f"cells: [{n},{part}" for n, part in zip(cells, parts[1:]))


def scene(name):
    if name == "sticking":  # a displacement that is prescribed along the normal does not keep nodes from sticking
        return leaves(3, ", stick: true")
    if name in CELLS:
        return with_cells(*CELLS[name])
    number, gap = name.split("_")
    if gap == "matching":
        return leaves(LEAVES[number], ", gap: mortar")
    return leaves(LEAVES[number], f", gap: {gap}").replace("[0, 0, 0.3], upper: [10, 1, 0.6], cells: [20,",
                                                           "[0, 0, 0.3], upper: [10, 1, 0.6], cells: [23,")


def judge(name):
    run = load(name)
    step = run["steps"][-1]
    energy = load(name.split("_")[0] + "_matching")["steps"][-1]["energy"]
    forces = [pair["normal_force"] / FORCE / n for n, pair in enumerate(step["pairs"], 1)]
    say(f"{name}: solved, in equilibrium, with the energy of matching cells", run["converged"]
        and step["balance"] < 1e-6 and abs(step["energy"] / energy - 1) < 1e-3,
        (run["reason"], step["balance"], step["energy"]))
    say(f"{name}: the normal forces are those of beam theory, to a factor of 1.3",
        all(1 / 1.3 < force < 1.3 for force in forces), forces)
    if name == "six_matching":  # contact touches most unknowns; the interior point method took 1,439 applications
        say("six_matching: few applications of the preconditioner", step["amg_applications"] < 100,
            step["amg_applications"])


if sys.argv[1] == "scenes":
    for name in sys.argv[2:]:
        with open(name + ".yaml", "w") as file:
            file.write(scene(name))
    sys.exit()
for name in sys.argv[1:]:
    if name == "sticking":
        say("sticking: no warning of nodes without friction", not load(name)["warnings"], load(name)["warnings"])
        continue
    judge(name)
    if name.endswith("_ranks"):
        one, two = (load(run)["steps"][-1]["pairs"] for run in (name.removesuffix("_ranks"), name))
        off = [b["normal_force"] / a["normal_force"] - 1 for a, b in zip(one, two)]
        say(f"{name}: as on one rank", max(map(abs, off)) < 1e-5, off)
