# Hexahedra of 20 nodes (serendipity). Two cells are compared with stiffness matrices of an independent program, on one
# and two ranks. Bodies of such cells come into contact. Wrong input is refused.
contact=$AMGF_DIR/bin/contact
judge="$AMGF_DIR/tests/step/serendipity.py"
cat > cells.yaml <<'YAML'
problem: cells
bodies:
  - beam: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [2, 1, 1], order: 2, serendipity: true, element: full,
           young: 1000, poisson: 0.3}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
forces:
  - corner: {body: beam, point: [2, 1, 1], value: [1, -2, 5]}
YAML
cat > pressed.yaml <<'YAML'
problem: pressed
bodies:
  - below: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], order: 2, serendipity: true,
            young: 1000, poisson: 0.3}
  - above: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [3, 3, 3], order: 2, serendipity: true,
            young: 2000, poisson: 0.3}
displacements:
  - foot: {face: below.zmin, value: [free, free, 0]}
  - x_below: {face: below.xmin, value: [0, free, free]}
  - y_below: {face: below.ymin, value: [free, 0, free]}
  - x_above: {face: above.xmin, value: [0, free, free]}
  - y_above: {face: above.ymin, value: [free, 0, free]}
pressures:
  - top: {face: above.zmax, value: 6}
contact:
  - touch: {mortar: below.zmax, nonmortar: above.zmin}
YAML
for n in 1 2; do
  mpiexec --oversubscribe -n $n "$contact" cells.yaml -quiet -output cells_$n || echo "cells, $n ranks: exit code $?"
  mpiexec --oversubscribe -n $n "$contact" pressed.yaml -quiet -summary pressed_$n.json -output pressed_$n ||
    echo "pressed, $n ranks: exit code $?"
done
"$PYTHON" -B "$judge"
sed 's/order: 2/order: 1/' cells.yaml > linear.yaml
"$contact" linear.yaml -quiet 2>&1; echo "exit code $?"
