# Faces that stick while they touch (friction_stick.py), on one rank and on two
"$PYTHON" "$AMGF_DIR/tests/step/friction_stick.py" scenes
for scene in leaves_free leaves leaves_tied leaves_steps leaves_many leaves_near leaves_turned five_leaves held belt \
  belt_rubs touching closing_1 closing_2 closing_3; do
  timeout 100 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err
done
timeout 100 mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" leaves.yaml -quiet \
  -summary leaves_2.json 2> leaves_2.err
"$PYTHON" "$AMGF_DIR/tests/step/friction_stick.py"
