# The beam-sphere benchmarks on mesh 1: the published configuration against the published figures, the defaults, and what finite
# strain does to the shell. Figures and tolerances are in beam_sphere.py.
contact=$AMGF_DIR/bin/contact
scenes=$AMGF_DIR/share/scenes
published=$AMGF_DIR/share/options/published.opts

run() {
  name=$1
  scene=$2
  shift 2
  timeout 1200 "$contact" "$scenes/$scene.yaml" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}

run linear_published beam_sphere_linear -options_file "$published"
run linear beam_sphere_linear -output linear
run neo_hookean_published beam_sphere_neo_hookean -options_file "$published" -displacement_bounds 4
run neo_hookean beam_sphere_neo_hookean -output neo_hookean -contact_updates 1 # until the gap is true: four times as long
"$PYTHON" "$AMGF_DIR/tests/beam_sphere.py"
