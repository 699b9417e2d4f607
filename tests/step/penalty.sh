# -contact_penalty: with ten times the stiffness a tenth of the penetration, and of the error in energy, on one rank and
# on three; and it says what it cannot do
two_block=$AMGF_DIR/share/scenes/two_block.yaml
solve() {
  "$AMGF_DIR/bin/contact" "$two_block" -refine 0 -quiet -error_estimate 0 "$@"
}
solve -summary exact.json
for stiffness in 10 100; do solve -contact_penalty $stiffness -summary $stiffness.json; done
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" "$two_block" -refine 0 -quiet -error_estimate 0 \
  -contact_penalty 10 -summary 10_3.json
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

exact, loose, stiff, ranks = (load(name)["steps"][-1] for name in ("exact", "10", "100", "10_3"))
error = [1 - step["energy"] / exact["energy"] for step in (loose, stiff)]
say("the penalized energy is the smaller", error[0] > error[1] > 0, error)
say("error in energy falls by ten", within(error[0] / error[1], 10, 0.3), error)
say("penetration falls by ten", within(loose["gap_min"] / stiff["gap_min"], 10, 0.3),
    (loose["gap_min"], stiff["gap_min"]))
say("equilibrium", max(loose["equilibrium"], stiff["equilibrium"]) < 1e-6, (loose["equilibrium"], stiff["equilibrium"]))
say("three ranks", within(ranks["energy"], loose["energy"], 1e-6), (ranks["energy"], loose["energy"]))
PY
# the penetration that a penalty leaves is no sign of faces that the search did not see: each load step is solved once
"$AMGF_DIR/bin/contact" "$two_block" -refine 0 -error_estimate 0 -contact_penalty 10 >said
if grep 'searched again' said; then exit 1; fi
solve -contact_penalty -1 2>&1 | head -1
"$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/beam_sphere_neo_hookean.yaml" -contact_penalty 10 -quiet 2>&1 | head -1
