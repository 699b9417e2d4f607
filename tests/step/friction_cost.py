"""What friction costs: linear solves in five load steps of the ironing benchmark's published mesh.

The die slides in three of the load steps, with a coefficient of friction of 0.3 and without friction.

Two thin leaves of 16,740 unknowns: directions converge slowly, even with factors of K, so that the whole matrix is
factored instead. The limit of solves is a fifth of what the directions take.

python3 friction_cost.py scenes writes the scenes; python3 friction_cost.py judges the runs of friction_cost.sh.
"""
import os
import re
import sys

from summaries import each, load, say

STEPS = 5
NAMES = "without", "with"
LEAVES = """bodies:
  - low: {lower: [0, 0, 0], upper: [100, 20, 1], cells: [60, 16, 2], young: 200000, poisson: 0.3}
  - top: {lower: [0, 0, 1], upper: [80, 20, 2], cells: [54, 14, 2], young: 200000, poisson: 0.3}
displacements:
  - low: {face: low.xmin, value: [0, 0, 0]}
  - top: {face: top.xmin, value: [0, 0, 0]}
contact:
  - pair: {mortar: low.zmax, nonmortar: top.zmin, friction: 0.2}
forces:
  - tip: {face: low.xmax, value: [0, 0, 2]}
"""


def shortened(scene):
    """The first load steps: ramps lose the other factors"""

    def cut(match):
        return "{factors: [" + ", ".join(match[1].split(", ")[:STEPS]) + "]}"

    return re.sub(r"\{factors: \[(.*)\]\}", cut, scene).replace("steps: 10", f"steps: {STEPS}")


def calls(name, event):
    """Number of calls of PETSc events: solves with factors, or factorizations"""
    with open(name + ".log") as file:
        found = re.findall(rf"^{event} +(\d+)", file.read(), re.MULTILINE)
    return sum(map(int, found))


if sys.argv[1:] == ["scenes"]:
    with open(os.environ["AMGF_DIR"] + "/share/scenes/ironing.yaml") as file:
        text = shortened(file.read())
    for name, law in zip(NAMES, ("", ", friction: 0.3")):
        with open(name + ".yaml", "w") as file:
            file.write(text.replace("die.outer}", "die.outer" + law + "}"))
    with open("leaves.yaml", "w") as file:
        file.write(LEAVES)
else:
    without, rubs = map(load, NAMES)
    say("every step converges, none is cut", rubs["converged"] and not sum(each(rubs, "cuts")), rubs["reason"])
    pairs = [step["pairs"][0] for step in rubs["steps"]]
    ratios = [pair["shear_force"] / pair["normal_force"] for pair in pairs]
    say("the friction force is 0.28 to 0.31 of the normal force", all(0.28 < ratio < 0.31 for ratio in ratios), ratios)
    counts = [sum(each(run, "amg_applications")) for run in (without, rubs)]
    say("solves with the factors of K: at most twice as many as without friction", counts[1] <= 2 * counts[0], counts)
    counts = [calls(name, "Mat(?:Mat)?Solve") for name in NAMES]
    say("all solves: at most six times as many", counts[1] <= 6 * counts[0], counts)
    count = calls("with", "Mat(?:Chol|LU)FctrNum")
    say("factorizations: at most 30 a load step", count <= 30 * STEPS, count)
    leaves = load("leaves")
    count = sum(each(leaves, "amg_applications"))
    say("two thin leaves: at most 300 solves with the preconditioner of K", leaves["converged"] and count <= 300, count)
