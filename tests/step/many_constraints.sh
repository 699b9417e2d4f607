# 6,561 constraints of contact without friction: no dense matrix of them is stored, and the answer is that of a bar
cat > many.yaml <<'SCENE'
bodies:
  - base: {lower: [0, 0, 0], upper: [80, 80, 2], cells: [80, 80, 2], young: 1000, poisson: 0}
  - block: {lower: [0, 0, 2], upper: [80, 80, 4], cells: [80, 80, 2], young: 1000, poisson: 0}
displacements:
  - ground: {face: base.zmin, value: [0, 0, 0]}
  - press: {face: block.zmax, value: [0, 0, -0.01]}
contact:
  - pair: {mortar: base.zmax, nonmortar: block.zmin}
SCENE
for n in 1 2; do
  mpiexec --oversubscribe -n $n "$AMGF_DIR/bin/contact" many.yaml -quiet -summary many_$n.json || echo "exit code $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

for n in 1, 2:
    run = load(f"many_{n}")
    force = run["steps"][-1]["pairs"][0]["normal_force"]
    each = (run["peak_memory_bytes"] - run["memory"]["start"]) / run["dofs"]
    say(f"ranks: {n}: E A d / h = 16000 to 1e-6", within(force, 16000, 1e-6), force)
    say(f"ranks: {n}: peak above the start: below 4 kB an unknown", each < 4000, each)
CHECK
