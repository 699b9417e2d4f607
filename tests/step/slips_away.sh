# A flat wedge between a floor and an inclined lid that moves down by 0.002 slips out without friction, to a place where no force acts on it: a warning says so. Held at its thick end it remains
contact=$AMGF_DIR/bin/contact
for hold in "" ", hold: {face: wedge.side1, value: [0, free, free]}"; do
  cat > wedge.yaml <<YAML
bodies:
  - wedge: {shape: wedge, axis: y, corners: [0, 0, 0.1, 0, 0, 2], extent: [0, 1], side_cells: 2, length_cells: 1, young: 1000, poisson: 0.3, material: neohookean}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - lid: {shape: rigid_plane, point: [0, 0, 0.1], normal: [-0.1, 0, -2]}
symmetry: [wedge.lmin, wedge.lmax]
displacements: [stay: {body: floor, value: [0, 0, 0]}, press: {body: lid, value: [0, 0, -0.002]}$hold]
contact:
  - low: {mortar: floor.surface, nonmortar: wedge.side3}
  - high: {mortar: lid.surface, nonmortar: wedge.side2}
load: {steps: 1}
YAML
  for ranks in 1 2; do
    mpiexec --oversubscribe -n $ranks "$contact" wedge.yaml -quiet -error_estimate 0 > out 2>&1
    echo "$([ "$hold" ] && echo held || echo free), $ranks ranks: exit $?, $(grep -o 'slips away in load step 1' out || echo no warning)"
  done
done
