# Leaves clamped together at one end, with cells that do not match, on one rank and on two (clamped_leaves.py).
# clamped_leaves_long has three leaves on two ranks.
test=$AMGF_DIR/tests/contact/clamped_leaves.py
scenes=${scenes:-three_matching three_mortar three_node two_matching two_dual sticking three_coarser three_finer
  three_alike_dual three_alike_node six_matching}
ranks=${ranks:-two_dual}
"$PYTHON" "$test" scenes $scenes
for scene in $scenes; do timeout 200 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json; done
timeout 200 mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" $ranks.yaml -quiet -summary ${ranks}_ranks.json
"$PYTHON" "$test" $scenes ${ranks}_ranks
