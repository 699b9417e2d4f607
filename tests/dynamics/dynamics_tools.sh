# Rigid surfaces with mass: driven by a force and a moment, and falling on an elastic block (dynamics_tools.py)
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_tools.py" scenes
for scene in driven fall; do
  "$contact" $scene.yaml -quiet -error_estimate 0 -output $scene 2> err || { echo "$scene: exit $?"; cat err; }
done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_tools.py"
"$contact" massless.yaml -quiet 2>&1
echo "exit code $?"
