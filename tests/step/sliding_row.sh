# Fourteen blocks in a row, of which the first is pushed: each slides on the floor, and block k is pushed with the
# friction of all behind it
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - <<'SCENE'
n = 14
block = "  - s{}: {{lower: [{}, 0, 0], upper: [{}, 1, 0.5], cells: [1, 1, 1], young: 1e3, poisson: 0.2}}\n"
blocks = "".join(block.format(k, k, k + 1) for k in range(n))
open("row.yaml", "w").write(f"""bodies:
  - floor: {{lower: [-1, 0, -1], upper: [{n + 3}, 1, 0], cells: [1, 1, 1], material: rigid}}
{blocks}contact: [auto: {{friction: 0.3}}]
displacements: [foot: {{body: floor, value: [0, 0, 0]}}, push: {{face: s0.xmin, value: [0.5, free, free]}}]
symmetry: [{", ".join(f"s{k}.ymin" for k in range(n))}]
body_forces: [weight: {{value: [0, 0, -1]}}]
""")
SCENE
"$contact" row.yaml -quiet -summary row.json || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

n, step = 14, load("row")["steps"][-1]
force = {pair["name"]: pair["force"] for pair in step["pairs"]}
say("push: friction of all blocks", within(step["reaction"][0], 0.3 * 0.5 * n, 1e-4), step["reaction"])
# the pushes are inclined a little, so that the weight on each foot is not the block's own: sums from block k on are
# exact
feet = [force[f"s{k}_floor"] for k in range(n)]
say("each foot slides", all(abs(foot[0] + 0.3 * foot[2]) < 1e-5 for foot in feet), feet)
pushes = [force[f"s{k}_s{k - 1}"][0] for k in range(1, n)]
friction = [-sum(foot[0] for foot in feet[k:]) for k in range(1, n)]
say("each push is the friction behind it", all(abs(a - b) < 1e-5 for a, b in zip(pushes, friction)), pushes)
CHECK
