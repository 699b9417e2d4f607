# The ironing benchmark: sizes of the published mesh 1, and the defaults against the interior point method with MUMPS on
# a coarser one.
# Figures and tolerances are in ironing.py.
run() {
  name=$1
  shift
  timeout 1200 "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/ironing.yaml" -quiet -summary "$name.json" "$@" ||
    echo "$name: exit code $?"
}

run exact -refine 0 -contact_smooth false -contact_updates 1 -options_file "$AMGF_DIR/share/options/direct.opts" \
  -tao_ipfilter_subspace false -tao_ipfilter_tol 1e-9
run coarse -refine 0 -contact_smooth false -contact_updates 1
run true -refine 0 -load_steps 5
run ironing -contact_updates 1
"$PYTHON" "$AMGF_DIR/tests/step/ironing.py"
