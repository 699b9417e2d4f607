# A rigid rod with a hinge at its end is pulled to the side, along each axis: angle of a pendulum, energy
contact=$AMGF_DIR/bin/contact
rod() {
  cat > $1.yaml <<YAML
bodies:
  - rod: {lower: $2, upper: $3, cells: [1, 1, 1], material: rigid, density: 1000}
displacements:
  - hinge: {body: rod, value: [0, 0, 0], rotation: $4, center: [0, 0, 0]}
body_forces:
  - pull: {body: rod, value: $5}
load: {expression: "1"}
dynamics: {time_step: 0.0025, end_time: 0.5}
YAML
  "$contact" $1.yaml -quiet -error_estimate 0 -summary $1.json 2> err || { echo "exit $?"; cat err; }
}
rod x "[0, -0.1, -0.1]" "[2, 0.1, 0.1]" "[0, 0, free]" "[0, 2000, 0]"
rod y "[-0.1, 0, -0.1]" "[0.1, 2, 0.1]" "[free, 0, 0]" "[0, 0, 2000]"
rod z "[-0.1, -0.1, 0]" "[0.1, 0.1, 2]" "[0, free, 0]" "[2000, 0, 0]"
"$PYTHON" - <<'CHECK'
import math
from summaries import load, say, within

angle = speed = 0
pull, parts = 2 / (4 / 3 + 0.2**2 / 12), 100  # angular acceleration at the start; parts of a time step
turns = []
for _ in range(200 * parts):
    h = 0.0025 / parts
    middle = angle + h / 2 * speed
    speed += h * pull * math.cos(middle)
    angle = middle + h / 2 * speed
    turns.append(angle)
for name, axis in ("x", 2), ("y", 0), ("z", 1):
    steps = load(name)["steps"]
    found = [math.radians(step["rigid_bodies"][0]["rotation"][axis]) for step in steps]
    off = max(abs(a - b) for a, b in zip(found, turns[parts - 1::parts]))
    say(f"rod along {name}: the angle of a pendulum to 1e-4 radians at any time", len(found) == 200 and off < 1e-4, off)
    say(f"rod along {name}: the work becomes kinetic energy to 1e-4",
        within(steps[-1]["motions"][0]["kinetic_energy"], steps[-1]["work"], 1e-4), steps[-1]["work"])
CHECK
