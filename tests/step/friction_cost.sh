# Linear solves that friction costs (friction_cost.py)
"$PYTHON" "$AMGF_DIR/tests/step/friction_cost.py" scenes
for scene in without with leaves; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json -log_view :$scene.log 2> $scene.err
done
"$PYTHON" "$AMGF_DIR/tests/step/friction_cost.py"
