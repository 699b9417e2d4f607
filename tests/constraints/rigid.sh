# Rigid motions of faces and of rigid bodies against closed forms, statics and Hertz, some on three ranks.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 || echo "$2: exit code $?"
}
for scene in punch turn twist held plane; do run 1 $scene; done
for scene in roller rolled; do run 3 $scene; done
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid.py" judge
sed 's/, rotation.*$/, rotation: [0, 0, 10], center: [0, 0, 4]}\n  - side: {face: bar.xmin, value: [0, 0, 0]}/' \
  twist.yaml > both.yaml
"$contact" both.yaml -quiet 2>&1 || echo "exit code $?"
