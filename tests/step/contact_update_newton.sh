# Newton's method for the contact updates: at most five updates a load step on curved faces, where fixed point
# iterations take six, on two ranks. At most eight where fixed point iterations move away from the solution,
# without damping
mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/beam_sphere_linear.yaml" -quiet \
  -summary linear.json
echo "two ranks: exit $?"
"$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/beam_sphere_neo_hookean.yaml" -quiet -error_estimate 0 \
  -summary finite.json 2> err
echo "finite strain: exit $?"
"$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/two_block.yaml" -quiet -refine 1 -contact_updates 20 \
  -summary blocks.json
echo "two blocks: exit $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

ENERGY = 5.764763  # with -contact_update_tol 1e-9, with quadrature rules of degree 6, 7 and 8
steps = load("linear")["steps"]
updates = [step["contact_updates"] for step in steps]
say("at most 5 updates a load step, 4 in the mean", max(updates) <= 5 and sum(updates) <= 4 * len(updates), updates)
say("energy", within(steps[-1]["energy"], ENERGY, 1e-6), steps[-1]["energy"])
updates = [step["contact_updates"] for step in load("finite")["steps"]]
say("finite strain: at most 5 updates a load step", max(updates) <= 5, updates)
steps = load("blocks")["steps"]
updates = [step["contact_updates"] for step in steps]
say("two blocks: at most 8 updates a load step", max(updates) <= 8, updates)
damped = [step["gap_damped"] for step in steps]
say("none is damped", not any(damped), damped)
say("energy", within(steps[-1]["energy"], 0.928354, 1e-6), steps[-1]["energy"])
PY
