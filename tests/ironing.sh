# The ironing benchmark: sizes of the published mesh 1, and the defaults against the published configuration on a coarser one.
# Figures and tolerances are in ironing.py.
run() {
  name=$1
  shift
  timeout 300 "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/ironing.yaml" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}

run coarse_published -refine 0 -options_file "$AMGF_DIR/share/options/published.opts" -tao_ipfilter_tol 1e-9
run coarse -refine 0 -contact_smooth false # the same bodies: published runs keep the facets
run ironing
"$PYTHON" "$AMGF_DIR/tests/ironing.py"
