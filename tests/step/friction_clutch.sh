# A disc is pressed on a rigid plate and turned: two displacements of one face, of which one is a rotation, follow ramps
# of their own and add up. The torque under uniform pressure is known. friction_clutch.py checks it.
cat > clutch.yaml <<'YAML'
bodies:
  - disc: {shape: cylinder, axis: z, radius: 50, extent: [0, 20], cells: [4, 3, 2], material: neohookean, young: 1000,
           poisson: 0}
  - plate: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
displacements:
  - fix: {body: plate, value: [0, 0, 0]}
  - press: {face: disc.lmax, value: [0, 0, -0.2], ramp: down}
  - turn: {face: disc.lmax, value: [0, 0, 0], rotation: [0, 0, 4], center: [0, 0, 20], ramp: turn}
ramps:
  - down: {factors: [1, 1, 1]}
  - turn: {factors: [0, 1, -1]}
contact:
  - rub: {mortar: plate.surface, nonmortar: disc.lmin, friction: 0.3}
YAML
"$AMGF_DIR/bin/contact" clutch.yaml -quiet -error_estimate 0 -summary clutch.json
echo "exit $?"
"$PYTHON" "$AMGF_DIR/tests/step/friction_clutch.py"
