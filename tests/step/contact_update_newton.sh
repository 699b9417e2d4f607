# Newton's method for the contact updates: at most five updates a load step on curved faces, where fixed point iterations take six; on one rank and on two
for ranks in 1 2; do
  mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/beam_sphere_linear.yaml" -quiet -summary $ranks.json
  echo "$ranks ranks: exit $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

ENERGY = 5.764757  # with -contact_gap_tolerance of 1e-8
for ranks in "1", "2":
    steps = load(ranks)["steps"]
    updates = [step["contact_updates"] for step in steps]
    say(f"{ranks} ranks: at most 5 updates a load step, 4 in the mean", max(updates) <= 5 and sum(updates) <= 4 * len(updates), updates)
    say("energy", within(steps[-1]["energy"], ENERGY, 1e-6), steps[-1]["energy"])
PY
