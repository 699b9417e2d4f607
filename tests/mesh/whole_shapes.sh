# Whole tubes and cylinders: energies and volumes under refinement, contact in a ring; two oblique motions of one face
"$PYTHON" -B "$AMGF_DIR/tests/mesh/whole_shapes.py" write
run() { "$AMGF_DIR/bin/contact" "$1.yaml" -refine "$2" -quiet -error_estimate 0 -summary "$1_$2.json" \
  || echo "$1, refine $2: exit code $?"; }
for refine in 0 1 2; do run whole $refine; run quarter $refine; run rod $refine; done
run rod_order2 1; run kirsch 0; run oblique 0; run straight 0; run pin 1; run fit 0; run fit_finite 0; run fit_springs 0
"$PYTHON" -B "$AMGF_DIR/tests/mesh/whole_shapes.py" judge
for name in refused graded; do "$AMGF_DIR/bin/contact" $name.yaml -quiet 2>&1 || echo "exit code $?"; done
