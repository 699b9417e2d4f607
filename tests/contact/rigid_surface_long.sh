# A rigid sphere and a rigid cone without facets on a half-space, against Hertz and Sneddon
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py" scenes
for scene in sphere cone; do "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json; done
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py" exact
