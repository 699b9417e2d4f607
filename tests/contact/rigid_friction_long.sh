# A ball on a rigid plane that has no facets, pressed and pushed: against a plane with facets; on one and three ranks
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_friction.py" scenes
for scene in ball ball_mesh; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> /dev/null || echo "$scene: exit code $?"
done
mpiexec --oversubscribe -n 3 "$contact" ball.yaml -quiet -summary ball_3.json || echo "ball, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_friction.py" ball
