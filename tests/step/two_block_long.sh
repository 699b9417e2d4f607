# The two-block benchmark on mesh 1: the published configuration against the published figures and the defaults
# (two_block.py)
contact=$AMGF_DIR/bin/contact
scene=$AMGF_DIR/share/scenes/two_block.yaml
timeout 1200 "$contact" "$scene" -quiet -summary published.json -contact_free \
  -options_file "$AMGF_DIR/share/options/published.opts" || echo "published: exit code $?"
timeout 1200 "$contact" "$scene" -quiet -summary coarse.json || echo "defaults: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/step/two_block.py" long
