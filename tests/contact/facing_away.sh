# A pair whose faces look away from each other is named before the run: the sides of a wedge between two rigid planes,
# swapped. Contact acted at the wedge's tip alone, without a word
contact=$AMGF_DIR/bin/contact
wedge() {
  cat > wedge.yaml <<YAML
bodies:
  - wedge: {shape: wedge, axis: y, corners: [0, 0, 2, -1, 2, 1], extent: [0, 1], side_cells: 3, length_cells: 2,
            young: 1000, poisson: 0.3}
  - left: {shape: rigid_plane, point: [0, 0, 0], normal: [2, 0, 1], size: 1}
  - right: {shape: rigid_plane, point: [0, 0, 0], normal: [-2, 0, 1], size: 1}
displacements: [l: {body: left, value: [0, 0, 0]}, r: {body: right, value: [0, 0, 0]}]
symmetry: [wedge.lmin, wedge.lmax]
forces: [push: {face: wedge.side2, value: [0, 0, -10]}]
contact:
  - a: {mortar: left.surface, nonmortar: wedge.$1, friction: 0.2}
  - b: {mortar: right.surface, nonmortar: wedge.$2, friction: 0.2}
YAML
  mpiexec -n $3 "$contact" wedge.yaml -quiet -summary wedge.json 2>&1 | $4 | sed 's/^/  /'
  "$contact" wedge.yaml -scene_check | grep -c WARNING
}
echo "each side on its plane:"; wedge side1 side3 1 cat
echo "swapped:"; wedge side3 side1 1 "grep away"
echo "swapped, on 3 ranks:"; wedge side3 side1 3 "grep away"
