# Friction against published values and closed forms (friction_published.py), each on two meshes, and blocks that stick while they lift off
"$PYTHON" "$AMGF_DIR/tests/friction_published.py" scenes
run() {
  name=$1
  scene=$2
  shift 2
  timeout 300 "$@" "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -summary "$name.json"
}
for scene in greco_32 greco_64 torque_42 torque_84 lift_rough lift_100; do run $scene $scene; done
run torque_42_3 torque_42 mpiexec --oversubscribe -n 3
"$PYTHON" "$AMGF_DIR/tests/friction_published.py"
