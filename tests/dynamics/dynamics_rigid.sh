# Scenes of rigid bodies only; a rigid mass that strikes a bar (dynamics_rigid.py)
contact=$AMGF_DIR/bin/contact
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || echo "exit $?"; cat err; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py" scenes
for scene in mass damped ball struck still; do run $scene.yaml -output $scene; done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py"
