# NAFEMS contact benchmark 2, a punch with a rounded edge, with friction and without, on two meshes (friction_punch.py)
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/step/friction_punch.py" scenes
for name in punch_6_0 punch_6_0.1 punch_12_0 punch_12_0.1; do
  "$AMGF_DIR/bin/contact" "$name.yaml" -quiet -summary "$name.json"; done
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" punch_6_0.1.yaml -quiet -summary punch_6_0.1_3.json
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/step/friction_punch.py"
