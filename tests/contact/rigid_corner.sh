# Corners of rigid profiles between the vertices of the other face
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_corner.py" scenes
for scene in beam_6.25 beam_6.5 beam_6.75 oblique revolved rounded bump; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> /dev/null || echo "$scene: exit code $?"; done
mpiexec --oversubscribe -n 3 "$contact" oblique.yaml -quiet -summary oblique_3.json || echo "three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_corner.py"
