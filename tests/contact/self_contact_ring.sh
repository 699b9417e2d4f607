# A rubber ring that is pinched until its inside touches itself, against a quarter of it on a plane
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact_ring.py" write
for scene in quarter half; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> $scene.log || echo "$scene: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact_ring.py" judge
