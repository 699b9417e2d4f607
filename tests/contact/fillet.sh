# A plane that meets a fillet in a tangent rests on a block: the smooth surface bulges there, and no overlap is
# reported. A real overlap is.
contact=$AMGF_DIR/bin/contact
try() { # cells of the plane and of the fillet, height of the block, further keys of the pair
  "$PYTHON" "$AMGF_DIR/tests/contact/fillet.py" "$@"
  echo "$*: $("$contact" fillet.yaml -quiet 2>&1 | grep -c "overlaps at the start")"
  "$contact" fillet.yaml -scene_check | grep -c "WARNING: they overlap"
}
for cells in 2 4 16; do try $cells 0; done
try 4 0 gap: node
try 4 0.006
try 16 0.0004
