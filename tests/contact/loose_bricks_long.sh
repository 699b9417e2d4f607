# A wall of 92 loose bricks in running bond, with friction on a rigid plane, whose pairs are found: the plane carries
# the weight, each brick is in balance, and the wall is symmetric
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - <<'SCENE'
text, n = "bodies:\n  - ground: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}\n", 0
for z in range(8):
    ends = list(range(12)) if z % 2 == 0 else [0] + [k + 0.5 for k in range(11)] + [11]
    for low, high in zip(ends, ends[1:]):
        text += (f"  - b{n}: {{lower: [{low + 0.01}, 0, {0.3 * z}], upper: [{high - 0.01}, 0.5, {0.3 * z + 0.3}], "
                 "cells: [2, 1, 1], young: 1e4, poisson: 0.2}\n")
        n += 1
print(n, "bricks")
text += """contact: [auto: {friction: 0.6}]
weak_springs: true
displacements: [ground: {body: ground, value: [0, 0, 0]}]
body_forces: [weight: {value: [0, 0, -2]}]
"""
open("wall.yaml", "w").write(text)
SCENE
"$contact" wall.yaml -quiet -summary wall.json || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

step = load("wall")["steps"][-1]
weight = sum(4 * (11 - gaps * 0.02) for gaps in (11, 12)) * 0.5 * 0.3 * 2
say("the ground carries the weight", within(step["reaction"][2], weight, 1e-8), (step["reaction"], weight))
say("each brick is in balance", step["balance"] < 1e-7, step["balance"])
feet = [pair["force"][2] for pair in step["pairs"] if pair["name"].endswith("_ground") and pair["normal_force"] > 0]
say("the wall is symmetric", len(feet) == 11 and all(within(a, b, 1e-3) for a, b in zip(feet, reversed(feet))), feet)
CHECK
