# Scenes of curved faces whose updates of the gap once went in circles: coarse meshes against fine ones, a ring that
# rolls, edges on curved faces, mesh lines that coincide, a face that ends beside the contact. gap_scenes.py writes them
# and judges.
contact=$AMGF_DIR/bin/contact

"$PYTHON" "$AMGF_DIR/tests/contact/gap_scenes.py" write > names
while read -r name; do
  "$contact" "$name.yaml" -quiet -error_estimate 0 -summary "$name.json" < /dev/null 2> err ||
    echo "$name: exit code $?, $(cat err)"
done < names
"$PYTHON" "$AMGF_DIR/tests/contact/gap_scenes.py" judge
