# Scenes of rigid bodies only, also on several ranks; a rigid mass that strikes a bar (dynamics_rigid.py)
contact=$AMGF_DIR/bin/contact
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || echo "exit $?"; cat err; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py" scenes
for scene in mass damped ball struck still; do run $scene.yaml -output $scene; done
for ranks in 2; do
  mpiexec --oversubscribe -n $ranks "$contact" rebound.yaml -quiet -error_estimate 0 -output ball_$ranks 2> err ||
    { echo "exit $?"; cat err; }
done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py"
