# The beam-sphere benchmarks on mesh 1: the published configuration against the published figures (beam_sphere.py)
run() {
  timeout 1200 "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/beam_sphere_$1.yaml" -quiet \
    -summary "$1_published.json" -options_file "$AMGF_DIR/share/options/published.opts" $2 || echo "$1: exit code $?"
}

run linear
run neo_hookean "-displacement_bounds 4"
"$PYTHON" "$AMGF_DIR/tests/step/beam_sphere.py" long
