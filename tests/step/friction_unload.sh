# Bodies that are pressed together with friction and unloaded until they are undeformed: a block that touches its rail,
# a die that opens, and a ball; pressed again they carry the same force. A wedge
# that friction holds stays pressed. friction_unload.py writes the scenes and checks.
"$PYTHON" "$AMGF_DIR/tests/step/friction_unload.py" scenes
for scene in block die ball key; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json 2> $scene.err
done
other=${1:-die}
mpiexec -n 2 "$AMGF_DIR/bin/contact" $other.yaml -quiet -error_estimate 0 -summary ${other}_2.json 2> ${other}_2.err
"$PYTHON" "$AMGF_DIR/tests/step/friction_unload.py" check $other
