# Equations between displacements of points: a lever of two bars, values that follow ramps, along any directions, chains
# of equations, points within cells, equations beside symmetry planes and ties, and a body that only equations hold,
# some on three ranks
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/equations.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -elasticity_ksp_rtol 1e-13 || echo "$2: exit code $?"
}
for scene in lever ramp inner oblique plane hung time; do run 1 $scene; done
for scene in chain tied finite; do run 3 $scene; done
"$PYTHON" "$AMGF_DIR/tests/constraints/equations.py" judge
for scene in held zero lone outside rigid twice; do "$contact" $scene.yaml -quiet 2>&1 || echo "exit code $?"; done
