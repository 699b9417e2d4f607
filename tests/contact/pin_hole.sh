# A pin in a hole of nearly its radius, facets that do not match, against Persson: three loads, under force and under
# displacement control, both choices of sides, and one refinement
"$PYTHON" "$AMGF_DIR/tests/contact/pin_hole.py" write
for scene in *.yaml; do
  name=${scene%.yaml}
  "$AMGF_DIR/bin/contact" "$scene" -quiet -output "$name" -summary "$name.json" > /dev/null ||
    echo "$name: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/contact/pin_hole.py" judge
