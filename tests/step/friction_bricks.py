"""A wall of loose bricks between a floor and a lid, which friction alone holds: python3 friction_bricks.py scene writes
it, python3 friction_bricks.py judges the runs of friction_bricks.sh.

The 32 bodies have no supports but the floor, and the joints between the bricks are open. The lid is pressed, and pushed
to the side.
"""
import sys

from summaries import load, say

ROWS, COLUMNS, PRESS, PUSH, FRICTION = 5, 6, 100, 20, 0.3


def scene():
    length = 2 * COLUMNS + 2
    plate = f"cells: [{length}, 2, 1], young: 2e5, poisson: 0.3}}"
    lines = ["problem: bricks", "bodies:", f"  - floor: {{lower: [0, 0, -2], upper: [{length}, 2, 0], {plate}"]
    for row in range(ROWS):
        for column in range(COLUMNS):
            x = 2 * column + row % 2 + 0.3
            lines.append(f"  - brick{row}_{column}: "
                         f"{{lower: [{x:.6g}, 0.1, {row}], upper: [{x + 1.9:.6g}, 1.9, {row + 1}], cells: [2, 2, 1], "
                         f"young: 2e5, poisson: 0.3}}")
    lines += [f"  - lid: {{lower: [0, 0, {ROWS}], upper: [{length}, 2, {ROWS + 1}], {plate}"]
    lines += [
        "displacements:", "  - ground: {face: floor.zmin, value: [0, 0, 0]}", "contact:",
        f"  - auto: {{friction: {FRICTION}}}"
    ]
    lines += [
        "forces:", f"  - press: {{face: lid.zmax, value: [0, 0, {-PRESS}]}}",
        f"  - push: {{face: lid.xmax, value: [{PUSH}, 0, 0]}}", "load: {steps: 1}"
    ]
    return "\n".join(lines) + "\n"


def judge():
    run = load("bricks")
    step = run["steps"][-1]
    say("converged", run["converged"], run["reason"])
    reaction = step["faces"][0]["reaction"]
    say("the floor carries the loads",
        all(abs(a - b) < 1e-6 * PRESS for a, b in zip(reaction, [-PUSH, 0, PRESS])), reaction)
    say("forces on each body are in equilibrium", step["balance"] < 1e-8, step["balance"])
    beyond = max((pair["force"][0]**2 + pair["force"][1]**2)**0.5 - FRICTION * pair["normal_force"]
                 for pair in step["pairs"])
    say("friction is within its bound", beyond < 1e-6 * PRESS, beyond)
    say("the work of the loads is stored or dissipated", abs(step["imbalance"]) < 1e-3, step["imbalance"])



if sys.argv[1:] == ["scene"]:
    with open("bricks.yaml", "w") as file:
        file.write(scene())
else:
    judge()
