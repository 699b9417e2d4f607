# Rings from Gmsh files of first and second order, refined onto their circles: a shrink fit against Lame
"$PYTHON" "$AMGF_DIR/tests/gmsh_rings.py" write
for nodes in 8 20 27; do
  for refine in 0 2; do
    "$AMGF_DIR/bin/contact" "rings_${nodes}_2.2.yaml" -quiet -refine $refine -output "rings_${nodes}_2.2_$refine" -summary "rings_${nodes}_2.2_$refine.json" || echo "$nodes: exit code $?"
  done
  mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" "rings_${nodes}_4.1.yaml" -quiet -refine 2 -summary "rings_${nodes}_4.1_2.json" || echo "$nodes: exit code $?"
done
"$AMGF_DIR/bin/contact" facets.yaml -quiet -refine 2 -summary facets.json || echo "facets: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/gmsh_rings.py" judge
