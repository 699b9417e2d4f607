# What is said of loads that friction holds and does not hold (friction_diagnosis.py)
"$PYTHON" "$AMGF_DIR/tests/step/friction_diagnosis.py" scenes
for scene in stands_1 stands_2 stands_3 stands_4 held slides tips clamp driven beside; do
  timeout 1200 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err; done
timeout 1200 mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" clamp.yaml -quiet -summary clamp_3.json 2> clamp_3.err
"$PYTHON" "$AMGF_DIR/tests/step/friction_diagnosis.py"
