# Large sliding in 20 steps: the force follows a smooth trend, whatever the meshes of the two faces do to one another.
# The nonmortar face that slides with the contact, four cells across, keeps it best; of one that the contact moves over,
# five cells are hardly enough. sliding.py writes the scenes and judges.
contact=$AMGF_DIR/bin/contact

"$PYTHON" "$AMGF_DIR/tests/contact/sliding.py" write
for name in die flat dual pin; do
  "$contact" $name.yaml -quiet -error_estimate 0 -summary $name.json || echo "$name: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/contact/sliding.py" judge
