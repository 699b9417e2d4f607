# The first load step of bodies that only contact holds: where it starts, on any number of ranks and with messages in
# another order (step_start.py)
contact=$AMGF_DIR/bin/contact

# a block between two planes, shortened along x: free (planes 0.05 away), or held by both planes
block() { # places of the planes
  cat > block.yaml <<YAML
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [10, 10, 10], material: neohookean, young: 10, poisson: 0.3}
  - floor: {shape: rigid_plane, point: [0, 0, $1], normal: [0, 0, 1]}
  - lid: {shape: rigid_plane, point: [0, 0, $2], normal: [0, 0, -1]}
symmetry: [block.ymin]
displacements: [f: {body: floor, value: [0, 0, 0]}, l: {body: lid, value: [0, 0, 0]},
    s: {face: block.xmin, value: [0, free, free]}, t: {face: block.xmax, value: [-0.2, free, free]}]
contact:
  - below: {mortar: floor.surface, nonmortar: block.zmin}
  - above: {mortar: lid.surface, nonmortar: block.zmax}
load: {factors: [1]}
YAML
}
start() { # name, ranks
  timeout 60 mpiexec --oversubscribe -n $2 "$contact" block.yaml -error_estimate 0 -summary "$1_$2.json" \
    > "$1_$2.log" 2>&1 || echo "$1, $2 ranks: exit code $?"
}
block -0.05 1.05
for ranks in 1 2; do start free $ranks; done
block 0 1
start held 1

# a wedge in a groove, of friction 0.2: messages to rank 0 are late by up to 3 ms
cat > wedge.yaml <<'YAML'
bodies:
  - wedge: {shape: wedge, axis: y, corners: [0, 0, 2, -1, 2, 1], extent: [0, 1], side_cells: 6, length_cells: 3,
      young: 1000, poisson: 0.3, material: neohookean}
  - left: {shape: rigid_plane, point: [0, 0, 0], normal: [2, 0, 1]}
  - right: {shape: rigid_plane, point: [0, 0, 0], normal: [-2, 0, 1]}
symmetry: [wedge.lmin, wedge.lmax]
displacements: [l: {body: left, value: [0, 0, 0]}, r: {body: right, value: [0, 0, 0]},
    push: {face: wedge.side2, value: [free, free, -0.05]}]
contact:
  - a: {mortar: left.surface, nonmortar: wedge.side1, friction: 0.2}
  - b: {mortar: right.surface, nonmortar: wedge.side3, friction: 0.2}
load: {factors: [0.5]}
YAML
mpicc -shared -fPIC "$AMGF_DIR/tests/lib/delay.c" -o delay.so -ldl
timeout 240 mpiexec --oversubscribe -x LD_PRELOAD="$PWD/delay.so" -n 2 "$contact" wedge.yaml -quiet -error_estimate 0 \
  -summary wedge.json || echo "wedge: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/step/step_start.py"
