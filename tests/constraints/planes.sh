# Symmetry planes along no axis: uniform stress through a wedge to rounding, their forces, also at edges that they share
# with other faces, finite strain, tied faces across them, some on three ranks.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/planes.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 || echo "$2: exit code $?"
}
for scene in one two finite half quarter tubes clamped_0 clamped_20; do run 1 $scene; done
for scene in named tied oblique; do run 3 $scene; done
"$PYTHON" "$AMGF_DIR/tests/constraints/planes.py" judge
sed 's/arc.amin, //; s/^pressures:/displacements:\n  - push: {face: arc.outer, value: [0.1, 0, free]}\npressures:/' \
  one.yaml > off.yaml
"$contact" off.yaml -quiet 2>&1 || echo "exit code $?"
sed 's/, arc.amin//; s/\[arc.amin, /[/' one.yaml > loose.yaml
"$contact" loose.yaml -quiet 2>&1 || echo "exit code $?"
