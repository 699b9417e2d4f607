# What a scene should have said of its contact: overlaps at the start, a pair that never meets, a body that nothing
# stops. A warning stands once on stderr and in the summary; -scene_check says it beforehand. Last, a reader that has
# seen enough, and the exit codes that the guide and -help list.
contact=$AMGF_DIR/bin/contact

# stone HEIGHT PULL KEYS: on a table at 1
stone() {
  cat > stone.yaml <<YAML
bodies:
  - table: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 1], young: 1000, poisson: 0.3}
  - stone: {lower: [1, 1, $1], upper: [3, 3, 2], cells: [2, 2, 1], young: 1000, poisson: 0.3}
displacements:
  - floor: {face: table.zmin, value: [0, 0, 0]}
symmetry: [x: {face: stone.xmin, normal: x}, y: {face: stone.ymin, normal: y}]
body_forces:
  - pull: {body: stone, value: [0, 0, $2]}
contact:
  - lie: {mortar: table.zmax, nonmortar: stone.zmin$3}
YAML
}

try() {
  echo "$1"
  shift
  "$contact" stone.yaml -quiet -summary stone.json "$@" > out 2> err
  echo "  exit $?"
  sed -e 's/fell from .*; body/fell; body/' -e 's/fell from .*/fell/' -e 's/axis along .*:/axis ...:/' -e 's/^/  /' err
  "$PYTHON" -c 'import json; print("  warnings in the summary: %d" % len(json.load(open("stone.json"))["warnings"]))'
}

# sides NAME MORTAR NONMORTAR WAY: a block above another one is moved by WAY, with a pair of faces that do not meet
sides() {
  cat > stone.yaml <<YAML
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1000, poisson: 0.3}
  - high: {lower: [0.2, 0.2, 1.05], upper: [0.8, 0.8, 1.3], cells: [3, 3, 3], young: 1000, poisson: 0.3}
displacements: [foot: {face: low.zmin, value: [0, 0, 0]}, head: {face: high.zmax, value: $4}]
contact:
  - wrong: {mortar: low.$2, nonmortar: high.$3}
YAML
  try "$1"
}
sides "pressed, sides that do not meet" xmax xmin "[0, 0, -0.3]"
sides "pressed, tops" zmax zmax "[0, 0, -0.3]"
sides "moved sideways, tops" zmax zmax "[0.5, 0, 0]"
stone 0.7 -1 "" && try "overlap"
"$contact" stone.yaml -scene_check | sed -n '/^Contact at/,$p'
stone 0.7 -1 ", interference: 0.2" && try "more overlap than declared"
stone 0.7 -1 ", interference: 0.3" && try "as much as declared"
stone 0.7 -1 ", interference: 0.299" && try "as much as declared, up to the error of curved faces"
stone 0.7 -1 ", interference: true" && try "any overlap declared"
stone 1 -1 ", interference: true" && try "declared, but none"
stone 1 -1 "" && try "none"
stone 1 -1 ", interference: -1" && "$contact" stone.yaml -scene_check 2>&1 | grep contact:
stone 1 1 "" && try "nothing stops it"
# Guided on its top alone, and pressed beside the table: it tips. One whose curved underside a table meets may tip, too:
# the optimizer crept along that motion to its limit of iterations
stone 1 0 "" && sed -i -e '/^symmetry/d' -e '/pull/,/^contact/{/pull/d}' \
  -e 's/^body_forces:/pressures:\n  - push: {face: stone.zmax, value: 1}/' \
  -e 's/\[1, 1, 1\], upper: \[3/[3.4, 1, 1], upper: [9/' \
  -e 's/^displacements:/&\n  - guide: {face: stone.zmax, value: [0, 0, free]}/' stone.yaml && try "tips"
cat > stone.yaml << 'YAML'
bodies:
  - table: {lower: [-1.5, -0.5, -1], upper: [1.5, 0.5, 0], cells: [6, 3, 2], young: 1000, poisson: 0.3,
            element: incompatible}
  - stone: {shape: half_ellipse, axis: y, depth: -z, center: [0, 0, 0.995], semi_axes: [1, 1.2], extent: [-0.4, 0.4],
            patches: [2, 2, 2], layers: 2, young: 3000, poisson: 0}
displacements:
  - floor: {face: table.zmin, value: [0, 0, 0]}
  - guide: {face: stone.flat, value: [0, 0, free]}
tractions:
  - load: {face: stone.flat, value: [0, 0, -0.5]}
contact:
  - lie: {mortar: stone.arc, nonmortar: table.zmax, gap: node, smooth: false, interference: true}
YAML
# The last attempt says either that contact did not converge, or that the objective has no lower bound
try "rocks" | sed -e 's/exit [23]/exit 2 or 3/' \
  -e 's/failed: .*\(contact did not converge\|unbounded below\).*/failed: it rocks/'
stone 1.01 0 ", distance: 0.5" &&
  sed -i 's/^displacements:/&\n  - held: {face: stone.zmax, value: [free, free, -0.005]}/' stone.yaml &&
  try "never met"
"$contact" stone.yaml -scene_check | sed -n '/^Contact at/,$p'
for ranks in 3; do
  mpiexec --oversubscribe -n $ranks "$contact" stone.yaml -quiet 2>&1 | grep -c 'contact pair "lie" was open'
done

"$contact" "$AMGF_DIR/share/scenes/cantilever.yaml" -load_steps 100 -elasticity_ksp_monitor 2> err | head -n 1
echo "exit ${PIPESTATUS[0]}, $(wc -l < err) lines on stderr"

help=$("$contact" -help 2> /dev/null | sed -n 's/^  \([0-7]\)  .*/\1/p' | tr '\n' ' ')
readme=$(sed -n '/^| exit code/,/^$/s/^| \([0-7]\) | .*/\1/p' "$AMGF_DIR/share/doc/guide.md" | tr '\n' ' ')
header=$(sed -n 's/^  RUN_[A-Z_]* *= \([0-9]*\),*.*/\1/p' "$AMGF_DIR/include/report.h" | tr '\n' ' ')
[ "$help" = "$readme" ] && [ "$help" = "$header" ] && echo "exit codes: ${help}in the guide, -help and report.h" ||
  echo "exit codes: $help; $readme; $header"
