# Rings and cones from Gmsh files of first and second order, refined onto their circles: shrink fits against Lame, and
# against a fine mesh
"$PYTHON" "$AMGF_DIR/tests/mesh/gmsh_rings.py" write
run() { # scene, refinements
  "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -refine "$2" -output "${1}_$2" -summary "${1}_$2.json" ||
    echo "$1: exit code $?"
}
for nodes in 8 20 27; do
  run "rings_${nodes}_2.2" 0
  run "rings_${nodes}_2.2" 1
  run "rings_${nodes}_4.1" 0
done
run rings_20_2.2 2
run cones 0
run cones 1
"$AMGF_DIR/bin/contact" facets.yaml -quiet -refine 1 -summary facets.json || echo "facets: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/mesh/gmsh_rings.py" judge
"$AMGF_DIR/bin/contact" rings_20_2.2.yaml -refine 2 -scene_check | sed -n '/^Contact at/,$p' > one
for ranks in 2 3; do
  mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" rings_20_2.2.yaml -refine 2 -scene_check |
    sed -n '/^Contact at/,$p' | cmp - one && echo "$ranks ranks: the same gaps at the start"
done
# Two nodes amid edges exchanged, of which order 2 is inside out
for nodes in 20 27; do
  awk 'NF > 20 && !n++ { node = $14; $14 = $15; $15 = node } { print }' rings_${nodes}_2.2.msh > swapped.msh
  sed "s/mesh: rings_${nodes}_2.2.msh/mesh: swapped.msh, order: 2/" rings_${nodes}_2.2.yaml > swapped.yaml
  "$AMGF_DIR/bin/contact" swapped.yaml -quiet 2>&1 || echo "$nodes nodes, exit code $?"
  mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" swapped.yaml -quiet 2>&1 | grep -c "contact: error"
done
