# Tractions and forces on faces, springs and weak springs against closed forms and statics, on one rank and on three.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/supports.py" write
for scene in pull twist bed float stack; do
  "$contact" $scene.yaml -quiet -summary $scene.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 || echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 || echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/supports.py" judge
for scene in float stack; do
  sed '/weak_springs/d' $scene.yaml > loose.yaml
  "$contact" loose.yaml -quiet 2>&1
done
"$contact" pull.yaml -quiet -effects_view | grep -E '^(traction|springs|weak springs)' | cut -c1-24 | sed 's/ *$//'
