# Contact of two elastic bodies without friction gives them no energy: one rests on the other; two meet head on, with
# either face as the nonmortar one; the same after a restart; also with a law that may yield
contact=$AMGF_DIR/bin/contact
cat > rests.yaml <<'YAML'
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 0.5], cells: [1, 1, 1], young: 1e6, poisson: 0.3, density: 1000}
  - high: {lower: [0.2, 0.3, 0.501], upper: [0.8, 0.9, 0.9], cells: [1, 1, 1], young: 1e6, poisson: 0.3, density: 2000}
displacements:
  - base: {face: low.zmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: high, value: [0, 0, -19620]}
contact:
  - foot: {mortar: low.zmax, nonmortar: high.zmin}
dynamics: {time_step: 0.004, end_time: 1}
YAML
cat > meet.yaml <<'YAML'
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1e6, poisson: 0.3, density: 1000}
  - high: {lower: [0.2, 0.3, 1.01], upper: [0.8, 0.9, 1.61], cells: [3, 3, 2], young: 1e6, poisson: 0.3, density: 2000,
           initial_velocity: [0, 0, -3]}
contact:
  - hit: {mortar: low.zmax, nonmortar: high.zmin}
dynamics: {time_step: 0.0005, end_time: 0.05}
YAML
sed 's/mortar: low.zmax, nonmortar: high.zmin/mortar: high.zmin, nonmortar: low.zmax/' meet.yaml > turned.yaml
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
for scene in rests turned; do run $scene.yaml -summary $scene.json; done
run meet.yaml -checkpoint_every 35 -checkpoint meet.h5 -summary meet.json
run meet.yaml -restart meet.h5 -summary again.json
sed 's/young/material: j2, yield: 1e12, hardening: 1, young/' rests.yaml > yields.yaml
run yields.yaml -summary yields.json
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

total = lambda step: step["motions"][0]["total_energy"]
for name, start in ("rests", 0), ("yields", 0), ("meet", 0.5 * 2000 * 0.6**3 * 9), ("turned", 0.5 * 2000 * 0.6**3 * 9):
    steps = load(name)["steps"]
    gained = [total(step) - step["work"] - start for step in steps]
    limit = 2e-3 * max(map(total, steps))
    say(f"{name}: contact gives less than 0.2 % of the energy", max(gained) < limit
        and min(step["contact_work"] for step in steps) > -limit, (limit, max(gained), steps[-1]["contact_work"]))
meet, again = load("meet")["steps"][-1], load("again")["steps"][-1]
say("meet: the same after a restart", meet["step"] == again["step"] and within(total(again), total(meet), 1e-8),
    (total(meet), total(again)))
CHECK
