# The mass of dynamics_rigid that strikes the bar, in smaller time steps, and the whole run of the ball on 3 ranks
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py" scenes
for scene in ball fine; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -error_estimate 0 -output $scene 2> err || { echo "exit $?"; cat err; }
done
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" ball.yaml -quiet -error_estimate 0 -output ball_3 2> err ||
  { echo "exit $?"; cat err; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_rigid.py" long
