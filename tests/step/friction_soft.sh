# Rubber pads and stacks of blocks of unlike stiffness that friction holds (friction_soft.py), on one rank and on three
"$PYTHON" "$AMGF_DIR/tests/step/friction_soft.py" scenes
for scene in tied sticks grips tied_quarter sticks_quarter finite finite_tied finite_quarter finite_sticks \
  finite_sticks_6 leaves rests cubes unlike unlike_sticks tower tower_sticks tower_tied; do
  timeout 100 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err
done
timeout 100 mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" sticks.yaml -quiet \
  -summary sticks_3.json 2> sticks_3.err
"$PYTHON" "$AMGF_DIR/tests/step/friction_soft.py"
