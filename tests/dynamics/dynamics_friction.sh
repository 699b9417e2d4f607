# Work of friction in a collision: rigid and elastic blocks fly obliquely onto a
# floor with friction. dynamics_friction.py writes the scenes and checks.
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_friction.py" scenes
for scene in *.yaml; do
  "$AMGF_DIR/bin/contact" "$scene" -quiet -summary "${scene%.yaml}.json" 2> /dev/null
done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_friction.py" check
