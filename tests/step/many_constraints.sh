# 6,561 contacts, without friction and with stick. No dense matrix of the contacts is stored. The force is that of a
# bar in compression.
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
mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" many.yaml -quiet -summary many_2.json || echo "exit code $?"
sed 's/zmin}$/zmin, stick: true}/' many.yaml > stick.yaml
"$AMGF_DIR/bin/contact" stick.yaml -quiet -summary stick_1.json || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, petsc_release, say, within

many = 4000 if petsc_release() < (3, 20) else 4900  # tests/run/memory_peak.sh says why
for name, most in ("many_2", many), ("stick_1", 10000):
    run = load(name)
    force = run["steps"][-1]["pairs"][0]["normal_force"]
    each = (run["peak_memory_bytes"] - run["memory"]["start"]) / run["dofs"]
    say(f"{name}: E A d / h = 16000 to 1e-6", within(force, 16000, 1e-6), force)
    say(f"{name}: peak above the start: below {most} bytes an unknown", each < most, each)
CHECK
