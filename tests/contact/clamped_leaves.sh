# Leaves clamped together at one end, with cells that do not match, on one rank and on two (clamped_leaves.py): two leaves; three in
# clamped_leaves_long
leaves=${1:-2}
"$PYTHON" "$AMGF_DIR/tests/contact/clamped_leaves.py" scenes $leaves
for scene in matching mortar dual node; do timeout 200 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json; done
timeout 200 mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" mortar.yaml -quiet -summary mortar_2.json
timeout 200 "$AMGF_DIR/bin/contact" sticking.yaml -quiet -summary sticking.json
"$PYTHON" "$AMGF_DIR/tests/contact/clamped_leaves.py"
