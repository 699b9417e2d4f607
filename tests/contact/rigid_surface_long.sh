# A rigid sphere and a rigid cone without facets on a half-space, against Hertz and Sneddon; cells of order 2 on three
# ranks
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py" scenes
for scene in sphere cone punch; do "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json; done
"$AMGF_DIR/bin/contact" rubber_2.yaml -quiet -summary rubber_2.json
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" rubber_2.yaml -quiet -summary rubber_2_3.json
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py" exact
