# contact: auto in dynamics finds bodies that meet because of their weight, a force or a spin, and none that lie behind
# a body which they would have to pass. A direction with a prescribed displacement has no free motion.
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - <<'SCENES'
BRICK = ("  - brick: {lower: [-0.2, -0.1, 1], upper: [0.2, 0.1, 1.1], cells: [2, 2, 1], young: 1e5, poisson: 0.3, "
         "density: 1%s}\n")
FLOOR = "  - floor: {lower: [-1, -1, -0.1], upper: [%s, 1, 0], cells: [2, 2, 1], material: rigid}\n"
WALL = "  - wall: {lower: [%s, -1, -0.2], upper: [%s, 1, 3], cells: [1, 2, 3], material: rigid}\n"
WEIGHT = "body_forces:\n  - weight: {body: brick, value: [0, 0, -10]}\n"
TIMES = "dynamics: {time_step: 0.05, end_time: %s}\ncontact: auto\n"


def scene(name, bodies, loads, end, held=""):
    still = [b.split(":")[0].strip(" -") for b in bodies if "rigid" in b]
    with open(name + ".yaml", "w") as out:
        out.write("bodies:\n" + "".join(bodies) + "displacements:\n" +
                  "".join(f"  - {b}: {{body: {b}, value: [0, 0, 0]}}\n" for b in still) + held + loads + TIMES % end)


scene("falls", [BRICK % "", FLOOR % 1], WEIGHT, 0.6)
scene("pushed", [BRICK % "", WALL % (5, 5.2)], "forces:\n  - push: {face: brick.xmin, value: [0.5, 0, 0]}\n", 1)
scene("thrown", [BRICK % ", initial_velocity: [6, 0, 0]", FLOOR % 6, WALL % (5, 5.2)], WEIGHT, 2)
scene("turns", [
    BRICK % ", initial_spin: [0, 3, 0]",
    "  - stop: {lower: [0.15, -0.1, 0.5], upper: [0.16, 0.1, 0.8], cells: [1, 1, 1], material: rigid}\n"
], "", 1)
scene("held", [BRICK % "", FLOOR % 1], WEIGHT, 0.6, "  - rail: {face: brick.zmin, value: [free, free, 0]}\n")
SCENES
for name in falls pushed thrown turns held; do
  for ranks in 1 3; do
    mpiexec --oversubscribe -n $ranks "$contact" $name.yaml -scene_check 2>&1 |
      sed -n "s/^  \(.*: mortar .*\), gap.*/$name: \1/p; s/.*\(finds no two surfaces\).*/$name: \1/p" > pairs$ranks
  done
  cat pairs1
  cmp pairs1 pairs3
done
"$contact" falls.yaml -quiet -summary falls.json
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say

steps = load("falls")["steps"]
pushed = [step["time"] for step in steps if abs(step["contact_force"][2]) > 0.01]
say("falls: it meets the floor when a body has fallen by 1", bool(pushed) and abs(pushed[0] - 0.2**0.5) < 0.05, pushed)
CHECK
