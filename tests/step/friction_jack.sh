# A jack of two wedges, lifted by the lower one, whose vertices at an edge of the floor can move in no direction: no
# force of friction can act there, and Newton's method waits for none (friction_jack.py)
cat > jack.yaml <<YAML
bodies:
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - wall: {shape: rigid_plane, point: [10, 0, 0], normal: [-1, 0, 0]}
  - low: {shape: wedge, axis: y, corners: [0, 0, 3, 0, 0, 12], extent: [0, 3], side_cells: 6, length_cells: 3,
          young: 1e5, poisson: 0.3}
  - up: {shape: wedge, axis: y, corners: [3, 0, 3, 10, 0.5, 10], extent: [0, 3], side_cells: 5, length_cells: 2,
         young: 1e5, poisson: 0.3}
displacements: [f: {body: floor, value: [0, 0, 0]}, w: {body: wall, value: [0, 0, 0]}, p: {face: low.side1,
    value: [0.4, free, free], ramp: push}]
symmetry: [low.lmin, up.lmin]
forces: [weight: {face: up.side1, value: [0, 0, -300]}]
contact:
  - ground: {mortar: floor.surface, nonmortar: low.side3, friction: 0.15}
  - slope: {mortar: low.side2, nonmortar: up.side3, friction: 0.15}
  - guide: {mortar: wall.surface, nonmortar: up.side2}
load: {factors: [1, 1, 1, 1, 1]}
ramps: [push: {factors: [0, 0.25, 0.5, 0.75, 1]}]
YAML
timeout 1200 "$AMGF_DIR/bin/contact" jack.yaml -quiet -error_estimate 0 -summary jack.json || echo "exit code: $?"
"$PYTHON" "$AMGF_DIR/tests/step/friction_jack.py"
