# Rigid motions of faces and of rigid bodies against closed forms, statics and Hertz, on one rank and on three.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid.py" write
for scene in punch turn twist roller rolled held plane; do
  "$contact" $scene.yaml -quiet -summary $scene.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 ||
    echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json -elasticity_ksp_rtol 1e-13 \
    -tao_ipfilter_tol 1e-11 || echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid.py" judge
sed 's/, rotation.*$/, rotation: [0, 0, 10], center: [0, 0, 4]}\n  - side: {face: bar.xmin, value: [0, 0, 0]}/' \
  twist.yaml > both.yaml
"$contact" both.yaml -quiet 2>&1 || echo "exit code $?"
