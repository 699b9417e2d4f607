# Reactions of faces and of bodies in the dynamic schemes: a block and a sector at rest against statics, a pendulum that
# swings against its equation of motion
"$PYTHON" -B "$AMGF_DIR/tests/dynamics/dynamics_reactions.py" scenes
for scene in block sector pendulum; do
  for scheme in impact generalized_alpha; do
    "$AMGF_DIR/bin/contact" ${scene}_$scheme.yaml -quiet -error_estimate 0 -summary ${scene}_$scheme.json ||
      echo "$scene, $scheme: exit code $?"
  done
done
"$PYTHON" -B "$AMGF_DIR/tests/dynamics/dynamics_reactions.py" judge
