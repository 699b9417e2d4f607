# Friction against published values and closed forms (friction_published.py) on coarse meshes, and blocks that stick
# while they lift off. friction_published_long has fine meshes.
"$PYTHON" "$AMGF_DIR/tests/step/friction_published.py" scenes
run() {
  name=$1
  scene=$2
  shift 2
  timeout 1200 "$@" "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -summary "$name.json" $options
}
for scene in greco_32 torque_42 capstan_90_24 capstan_180_48 pulled hung lift_rough lift_100 roller_8; do
  run $scene $scene; done
options="-output cattaneo_14" run cattaneo_14 cattaneo_14
options="-load_steps 5" run greco_32_5 greco_32
for scene in torque_42 smooth_42; do options="-tao_ipfilter_pc_amgf_factor false" run ${scene}_amg $scene; done
run torque_42_3 torque_42 mpiexec --oversubscribe -n 3
"$PYTHON" "$AMGF_DIR/tests/step/friction_published.py"
