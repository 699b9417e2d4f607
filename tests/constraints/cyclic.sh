# Cyclic symmetry: a sector against the whole body, on one and three ranks; with contact across the cut; what is refused
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B "$AMGF_DIR/tests/constraints/cyclic.py" scenes
for scene in whole sector digits backwards finite_whole finite pull half quarter fit_whole fit disc_whole disc; do
  "$contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json || echo "$scene: exit code $?"
done
for scene in finite fit; do
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -error_estimate 0 -summary ${scene}_3.json ||
    echo "$scene, three ranks: exit code $?"
done
"$PYTHON" -B "$AMGF_DIR/tests/constraints/cyclic.py" judge
for scene in fifty unlike one same; do "$contact" $scene.yaml -quiet 2>&1 || echo "exit code $?"; done
