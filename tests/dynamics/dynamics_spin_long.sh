# A rod of finite strain spins freely for 1,000 time steps of 0.1 radians, 16 turns: angular momentum, energy and
# momentum
contact=$AMGF_DIR/bin/contact
cat > spin.yaml <<'YAML'
bodies:
  - rod: {lower: [-1, -0.1, -0.1], upper: [1, 0.1, 0.1], cells: [6, 1, 1], material: neohookean, young: 1e3,
          poisson: 0.3, density: 1, initial_spin: [0, 0, 2]}
dynamics: {time_step: 0.05, end_time: 50}
YAML
"$contact" spin.yaml -quiet -error_estimate 0 -output spin || echo "exit $?"
"$PYTHON" - <<'PY'
from histories import history
from summaries import say

run = history("spin")
for name in "angular_momentum_z", "total_energy":
    values = run["dynamics." + name]
    say(f"{name} after 1,000 steps and at any instant: to 1e-4",
        len(values) == 1000 and max(abs(v / values[0] - 1) for v in values) < 1e-4, (min(values), max(values)))
say("momentum stays zero", max(abs(v) for k in "xyz" for v in run[f"dynamics.momentum_{k}"]) < 1e-6, "")
PY
