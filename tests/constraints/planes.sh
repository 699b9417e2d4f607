# Symmetry planes along no axis: uniform stress through a wedge to rounding, their forces, also at edges that they share
# with other faces, finite strain, tied faces across them, on one rank and on three.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/planes.py" write
for scene in one two named finite tied half quarter oblique tubes clamped_0 clamped_20; do
  "$contact" $scene.yaml -quiet -summary $scene.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 ||
    echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json -elasticity_ksp_rtol 1e-13 \
    -tao_ipfilter_tol 1e-11 || echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/constraints/planes.py" judge
sed 's/arc.amin, //; s/^pressures:/displacements:\n  - push: {face: arc.outer, value: [0.1, 0, free]}\npressures:/' \
  one.yaml > off.yaml
"$contact" off.yaml -quiet 2>&1 || echo "exit code $?"
sed 's/, arc.amin//; s/\[arc.amin, /[/' one.yaml > loose.yaml
"$contact" loose.yaml -quiet 2>&1 || echo "exit code $?"
