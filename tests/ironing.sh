# The ironing benchmark: sizes of the published mesh 1, and the defaults against the published configuration on a coarser one.
# Figures and tolerances are in ironing.py.
contact=$AMGF_DIR/bin/contact
scenes=$AMGF_DIR/share/scenes
published=$AMGF_DIR/share/options/published.opts

run() {
  name=$1
  scene=$2
  shift 2
  timeout 300 "$contact" "$scenes/$scene.yaml" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}

run coarse_published ironing -refine 0 -options_file "$published" -tao_ipfilter_tol 1e-9
run coarse ironing -refine 0
run ironing ironing
"$PYTHON" "$AMGF_DIR/tests/ironing.py"
