# Two balls whose surface meshes are equal and coincide, or are shifted by a little: edges of both meshes cross in
# contact updates. Pressed together in load steps, and in a collision. Three rings whose radial edges coincide.
# nearly_matching.py writes the scenes and checks.
"$PYTHON" "$AMGF_DIR/tests/contact/nearly_matching.py" scenes
for scene in *.yaml; do
  "$AMGF_DIR/bin/contact" "$scene" -quiet -error_estimate 0 -summary "${scene%.yaml}.json" 2> "${scene%.yaml}.err"
done
"$PYTHON" "$AMGF_DIR/tests/contact/nearly_matching.py" check
