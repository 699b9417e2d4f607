# A roller on a slab that ends where the roller ends, on facets as large as the contact, and a block on a coarse face
# (roller_border.py)
"$PYTHON" "$AMGF_DIR/tests/contact/roller_border.py" scenes
for scene in flush_mortar flush_dual flush_node large_facets beside; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err
done
"$PYTHON" "$AMGF_DIR/tests/contact/roller_border.py"
