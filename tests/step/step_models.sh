# What a load step may call for: dead loads, the two models of finite strain, updates of the gap, cut steps, bounds.
# step_models.py holds the summaries against exact values and against each other.
contact=$AMGF_DIR/bin/contact

run() {
  name=$1
  shift
  "$contact" "$name.yaml" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}

# nu = 0 makes the bar one-dimensional: pressure and weight have exact nodal solutions
cat > bar.yaml <<'YAML'
bodies:
  - bar: {shape: box, lower: [0, 0, 0], upper: [1, 2, 3], cells: [1, 2, 4], young: 10, poisson: 0}
displacements:
  - x: {face: bar.xmin, value: [0, free, free]}
  - y: {face: bar.ymin, value: [free, 0, free]}
  - z: {face: bar.zmin, value: [free, free, 0]}
ramps:
  - squeeze: {factors: [1, 1]}
  - weigh: {factors: [0, 1]}
pressures:
  - top: {face: bar.zmax, value: 0.5, ramp: squeeze}
body_forces:
  - weight: {value: [0, 0, -0.3], ramp: weigh}
load: {steps: 2}
YAML
run bar

# a stiff linear block pressed into a neo-Hookean one that is the softer the more it is turned
press() {
  cat > "$1.yaml" <<YAML
bodies:
  - base: {shape: box, lower: [-2, -2, -2], upper: [2, 2, 0], cells: [6, 6, 3], material: neohookean, young: 1,
           poisson: 0.3}
  - block: {shape: box, lower: [-0.5, -0.5, 0], upper: [0.5, 0.5, 1], cells: [2, 2, 2], young: 100, poisson: 0}
displacements:
  - bottom: {face: base.zmin, value: [0, 0, 0]}
  - top: {face: block.zmax, value: [0, 0, -0.6]}
contact:
  - press: {mortar: base.zmax, nonmortar: block.zmin}
load: {steps: $2}
model: $3
contact_updates: $4
YAML
}
press energy 2 energy 1
press quadratic 2 quadratic 1
press updated_2 2 energy 20
press updated_5 5 energy 20
press untrue 2 energy 2
for name in energy quadratic untrue; do run "$name"; done
for name in updated_2 updated_5; do run "$name" \
  -contact_update_tol 8e-7; done # of the largest displacement, which is above the 0.6 that the block is pressed in by

# one step that is too large turns elements inside out; cut, it ends where small steps end
cat > squash.yaml <<'YAML'
bodies:
  - cube: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], material: neohookean, young: 1,
           poisson: 0.3}
displacements:
  - bottom: {face: cube.zmin, value: [0, 0, 0]}
  - top: {face: cube.zmax, value: [0, 0, -0.7], rotation: [0, 0, 90], center: [0.5, 0.5, 1]}
YAML
cp squash.yaml gentle.yaml
sed 's/, rotation.*/}/' squash.yaml > press.yaml # large, but carried into the body no element is inverted
run press
run squash
run gentle -load_steps 10
"$contact" squash.yaml -quiet -load_max_cuts 0 2>&1 |
  grep -c 'contact: load step 1 failed: the prescribed displacements invert an element at the start of the load step'
"$PYTHON" "$AMGF_DIR/tests/step/step_models.py"
