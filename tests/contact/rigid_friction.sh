# Friction on rigid surfaces that have no facets: forces, torques, dissipation, stick; on one and three ranks
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_friction.py" scenes
for scene in drag moved stick tied turned moment cone mindlin mindlin_mesh; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> /dev/null || echo "$scene: exit code $?"; done
mpiexec --oversubscribe -n 3 "$contact" drag.yaml -quiet -summary drag_3.json || echo "drag, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_friction.py"
