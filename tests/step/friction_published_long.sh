# friction_published on fine meshes, and more of its scenes on three ranks
"$PYTHON" "$AMGF_DIR/tests/step/friction_published.py" scenes
run() {
  name=$1
  scene=$2
  shift 2
  timeout 1200 "$@" "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -summary "$name.json" $options
}
for scene in greco_64 torque_84 capstan_90_48 capstan_180_96 roller_8 roller_16; do run $scene $scene; done
for scene in cattaneo_14 cattaneo_21; do options="-output $scene" run $scene $scene; done
for scene in cattaneo_14 roller_8; do run ${scene}_3 $scene mpiexec --oversubscribe -n 3; done
"$PYTHON" "$AMGF_DIR/tests/step/friction_published.py" long
