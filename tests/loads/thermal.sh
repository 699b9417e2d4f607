# Thermal strain: free bodies of all elements in temperatures linear in the place move without stress, held ones are
# pressed as by hand, a gap closes when it gets warm; ramps, ranks and a restart; what is wrong with a temperature.
contact=$AMGF_DIR/bin/contact
cat > bodies.yaml <<'YAML'
bodies:
  - full: {lower: [0, 0, 0], upper: [10, 1, 1], cells: [8, 2, 3], young: 200, poisson: 0.3, expansion: 1e-3}
  - held: {lower: [0, 5, 0], upper: [4, 6, 1], cells: [4, 2, 2], young: 200, poisson: 0.3, expansion: 1e-3,
           element: bbar}
  - slab: {lower: [0, 10, 0], upper: [10, 11, 1], cells: [6, 2, 2], young: 200, poisson: 0.3, expansion: 1e-3,
           element: incompatible}
  - second: {lower: [0, 15, 0], upper: [10, 16, 1], cells: [4, 1, 1], young: 200, poisson: 0.3, expansion: 1e-3,
             order: 2}
  - wood: {lower: [0, 20, 0], upper: [10, 21, 1], cells: [4, 1, 1], material: orthotropic, young: [12, 1, 0.7],
           poisson: [0.35, 0.4, 0.3], shear: [0.8, 0.1, 0.6], first_axis: [1, 1, 0], second_axis: [-1, 1, 0],
           expansion: [1e-3, 3e-3, 5e-3]}
  - cold: {lower: [0, 25, 0], upper: [10, 26, 1], cells: [4, 1, 1], young: 200, poisson: 0.3}
displacements:
  - a: {face: held.xmin, value: [0, free, free]}
  - b: {face: held.xmax, value: [0, free, free]}
weak_springs: 1e-9
ramps:
  - late: {values: [0, 0, 1], times: [0, 1, 2]}
load: {steps: 2}
temperatures:
  - all: {value: 20}
  - across: {body: full, value: "40*z - 3*y", ramp: late}
  - slab: {body: slab, value: "40*(z - 0.5)"}
  - second: {body: second, value: 40*z}
  - wood: {body: wood, value: 4*x}
YAML
cat > gap.yaml <<'YAML'
bodies:
  - bar: {lower: [0, 0, 0], upper: [10, 1, 1], cells: [5, 2, 2], young: 200, poisson: 0.3, expansion: 1e-3}
  - wall: {lower: [10.1, -1, -1], upper: [11, 2, 2], cells: [1, 2, 2], material: rigid}
displacements: [{wall: {body: wall, value: [0, 0, 0]}}]
symmetry: [bar.xmin, bar.ymin, bar.zmin]
contact:
  - stop: {mortar: wall.xmin, nonmortar: bar.xmax}
temperatures:
  - heat: {value: 15}
load: {steps: 4}
YAML
run() {
  name=$1
  ranks=$2
  scene=$3
  shift 3
  mpiexec --oversubscribe -n "$ranks" "$contact" "$scene.yaml" -quiet -ksp_rtol 1e-13 -elasticity_ksp_rtol 1e-13 \
    -tao_gatol 1e-10 -output "$name" -summary "$name.json" "$@" || echo "$name: exit code $?"
}
run bodies 1 bodies
run bodies_3 3 bodies
run gap 1 gap -checkpoint_every 3 -checkpoint gap.state
run again 3 gap -restart gap.state
run gap_3 3 gap
"$PYTHON" "$AMGF_DIR/tests/loads/thermal.py"
try() {
  sed "$1" bodies.yaml > other.yaml
  "$contact" other.yaml -quiet 2>&1
  echo "exit code $?"
}
try 's/value: 20/value: 20*q/'
try 's/value: 20/value: log(x)/'
try 's/all: {value/all: {body: cold, value/'
try '/cold: {/s/young/material: neohookean, expansion: 1e-5, young/'
