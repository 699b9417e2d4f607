# Equations between displacements of points: a lever of two bars, values that follow ramps, along any directions, chains
# of equations, points within cells, equations beside symmetry planes and ties, and a body that only equations hold, on
# one rank and on three
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/equations.py" write
for scene in lever ramp chain inner oblique plane tied hung finite time; do
  "$contact" $scene.yaml -quiet -summary $scene.json -elasticity_ksp_rtol 1e-13 || echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json -elasticity_ksp_rtol 1e-13 ||
    echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/constraints/equations.py" judge
for scene in held zero lone outside rigid twice; do "$contact" $scene.yaml -quiet 2>&1 || echo "exit code $?"; done
