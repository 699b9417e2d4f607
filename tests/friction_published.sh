# Friction against published values and closed forms (friction_published.py), each on two meshes, and blocks that stick while they lift off
"$PYTHON" "$AMGF_DIR/tests/friction_published.py" scenes
run() {
  name=$1
  scene=$2
  shift 2
  timeout 1200 "$@" "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -summary "$name.json" $options
}
for scene in greco_32 greco_64 torque_42 torque_84 capstan_90_24 capstan_90_48 capstan_180_48 capstan_180_96 pulled hung lift_rough lift_100 roller_8 roller_16; do run $scene $scene; done
for scene in cattaneo_14 cattaneo_21; do options="-output $scene" run $scene $scene; done
options="-load_steps 5" run greco_32_5 greco_32
for scene in torque_42 smooth_42; do options="-tao_ipfilter_pc_amgf_factor false" run ${scene}_amg $scene; done
for scene in torque_42 capstan_90_24 cattaneo_14 roller_8; do run ${scene}_3 $scene mpiexec --oversubscribe -n 3; done
"$PYTHON" "$AMGF_DIR/tests/friction_published.py"
