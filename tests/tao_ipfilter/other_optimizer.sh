# The load steps of the two-block problem by an optimizer that no one here wrote, TAO's PDIPM with MUMPS on the whole
# KKT matrix: the same energy and contact force
for name in ours theirs; do
  options=; [ $name = ours ] || options="-options_file $AMGF_DIR/share/options/pdipm.opts"
  # shellcheck disable=SC2086
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -error_estimate 0 \
    -summary $name.json -tao_gatol 1e-10 $options || echo "$name: exit code $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import each, load, say, within
ours, theirs = load("ours"), load("theirs")
say("all load steps", len(ours["steps"]) == len(theirs["steps"]) == 2 and theirs["converged"], theirs["steps"])
energies = list(zip(each(theirs, "energy"), each(ours, "energy")))
say("energy", all(within(*pair, 1e-8) for pair in energies), energies)
forces = list(zip(each(theirs, "contact_force"), each(ours, "contact_force")))
say("contact force", all(within(a[2], b[2], 1e-8) for a, b in forces), forces)
say("equilibrium", max(each(theirs, "equilibrium")) < 1e-9, each(theirs, "equilibrium"))
say("the KKT error is the one that it stops by", 0 < max(each(theirs, "kkt_error")) < 1e-7, each(theirs, "kkt_error"))
PY
