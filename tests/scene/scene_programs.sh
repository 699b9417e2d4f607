# Load programs by expressions and tables: the factors of a run are those that python finds, and -load_steps cuts them
# as any other.
contact=$AMGF_DIR/bin/contact
cat > programs.yaml <<'YAML'
bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3}
symmetry: [bar.xmin, bar.ymin, bar.zmin]
pressures:
  - a: {face: bar.xmax, value: 1}
  - b: {face: bar.ymax, value: 1, ramp: wave}
  - c: {face: bar.zmax, value: 1, ramp: table}
load: {steps: 8, expression: s^2*(3-2*s)}
ramps:
  - wave: {expression: "-sin(2*PI*t/8)^2 + max(0,
           t-4)/2^2 - 1e-1*-2 + 2^-1^2 - 7/2/2 + abs(cos(t)) - exp(-t)*sqrt(t) + min(log(t), tanh(t)) + tan(s)"}
  - table: {times: [1, 2.5, 6], values: [1, -1/2, 3]}
YAML
for steps in 8 16; do
  "$contact" programs.yaml -quiet -load_steps $steps -summary programs.json || echo "exit code $?"
  "$PYTHON" - <<'PY'
import json
from math import *

program = [
    lambda t: (t / 8)**2 * (3 - 2 * t / 8),
    lambda t: -(sin(2 * pi * t / 8)**2) + max(0, t - 4) / 4 + 0.2 + 2**-1 - 1.75 + abs(cos(t)) - exp(-t) * sqrt(t) +
    min(log(t), tanh(t)) + tan(t / 8),
    lambda t: 1 if t < 1 else 1 - (t - 1) if t < 2.5 else -0.5 + (t - 2.5) if t < 6 else 3,
]
steps = json.load(open("programs.json"))["steps"]
cut = len(steps) // 8


def expected(f, time):
    step, part = divmod(time, cut)
    return (1 - part / cut) * (f(step) if step else 0) + (part / cut * f(step + 1) if part else 0)


print(
    "%d steps:" % len(steps),
    all(
        abs(ramp["factor"] - expected(f, step["time"])) < 1e-13
        for step in steps
        for ramp, f in zip(step["ramps"], program)))
PY
done
