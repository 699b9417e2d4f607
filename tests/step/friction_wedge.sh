# Wedges that are pressed into a groove and pulled out again, by displacements (friction_wedge.py). When the load
# returns to zero, the forces and displacements of the solution vanish, and only rounding errors of the coordinates are
# left
wedge() { # law, friction, slope of the groove, cells, load factor of a last step
  cat > wedge.yaml <<YAML
bodies:
  - wedge: {shape: wedge, axis: y, corners: [0, 0, 2, -$(($3 * 2))e-1, 2, $(($3 * 2))e-1], extent: [0, 1],
      side_cells: $4, length_cells: $(($4 / 2)), young: 1000, poisson: 0.3, material: $1}
  - left: {shape: rigid_plane, point: [0, 0, 0], normal: [2, 0, $(($3 * 2))e-1]}
  - right: {shape: rigid_plane, point: [0, 0, 0], normal: [-2, 0, $(($3 * 2))e-1]}
symmetry: [wedge.lmin, wedge.lmax]
displacements: [l: {body: left, value: [0, 0, 0]}, r: {body: right, value: [0, 0, 0]},
    push: {face: wedge.side2, value: [free, free, -0.05]}]
contact:
  - a: {mortar: left.surface, nonmortar: wedge.side1, friction: $2}
  - b: {mortar: right.surface, nonmortar: wedge.side3, friction: $2}
load: {factors: [0.5, 1, 0.5, 0$5]}
YAML
}
run() {
  wedge "$@"
  timeout 600 mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" wedge.yaml -quiet -error_estimate 0 \
    -summary wedge.json
  echo "$1, friction $2, slope 0.$3, $4 cells, $ranks ranks: exit code $?"
  "$PYTHON" "$AMGF_DIR/tests/step/friction_wedge.py"
}
ranks=1
run neohookean 0.2 2 6 ', -1'
run neohookean 0.6 5 6 ', -1'
run neohookean 0.2 5 6 ', -1'
ranks=2
run saint_venant 0.6 5 8
