# Shrink fit of thick spheres whose facets do not match, 8 to 14 on a quarter circle, against Lame; and one refinement
"$PYTHON" "$AMGF_DIR/tests/contact/shrink_spheres.py" write
for scene in *.yaml; do
  name=${scene%.yaml}
  "$AMGF_DIR/bin/contact" "$scene" -quiet -output "$name" -summary "$name.json" || echo "$name: exit code $?"
done
"$AMGF_DIR/bin/contact" spheres_4_5_in.yaml -quiet -refine 1 -output refined -summary refined.json ||
  echo "refined: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/shrink_spheres.py" judge
