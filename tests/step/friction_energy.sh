# Forces of pairs that turn, and where the work of the loads goes (friction_energy.py), also
# after a restart
"$PYTHON" "$AMGF_DIR/tests/step/friction_energy.py" scenes
contact=$AMGF_DIR/bin/contact
# Blocks that turn by 45 degrees in one step, and a pin that moves by a hundred times its interference: the default
# tolerance of the slip and of the gap, 1e-6 of the motion, is 1e-5 of the forces
for scene in sticks rubs slides eases pin; do
  timeout 1200 "$contact" $scene.yaml -quiet -contact_update_tol 1e-8 -summary $scene.json; done
for scene in sticks_7 slides_7 seam swapped teeth apart ring low_once low_slowly high_once high_slowly \
  limited_once limited_slowly; do
  timeout 1200 "$contact" $scene.yaml -quiet -summary $scene.json
done
timeout 1200 "$contact" pin.yaml -quiet -contact_update_tol 1e-8 -checkpoint_every 4 -checkpoint pin.h5 \
  -summary part.json
timeout 1200 "$contact" pin.yaml -quiet -contact_update_tol 1e-8 -restart pin.h5 -summary pin_restarted.json
"$PYTHON" "$AMGF_DIR/tests/step/friction_energy.py"
# The table has the balance where there is friction
"$contact" pin.yaml -tables_view | sed -n '/stored/,/^$/p' |
  awk 'NR == 1 || $1 == 6 { print NR == 1 ? $0 : $1 " " $(NF - 1) " %" }'
# A load step from rest to a large pressure: the trapezoidal rule for the work of contact forces is too coarse, and a
# warning says so
cat > press.yaml <<'YAML'
bodies:
  - bore: {shape: rigid_revolved, center: [0, 0, 0], direction: [0, 0, 1], points: [10, 100, 10, -100]}
  - ring: {shape: tube_arc, axis: z, radii: [8, 10.2], angles: [0, 45], extent: [0, 2], cells: [2, 3, 1],
           material: neohookean, young: 4, poisson: 0.48}
symmetry: [ring.amin, ring.amax]
displacements:
  - bore: {body: bore, value: [0, 0, 0]}
  - hub: {face: ring.inner, value: [0, 0, 0]}
contact:
  - press: {mortar: bore.surface, nonmortar: ring.outer, friction: 0.2, interference: 0.25, ramp: load}
YAML
"$contact" press.yaml -quiet -error_estimate 0 2>&1 | sed 's/([^)]*)/(...)/'
# Three load steps, of which the second and the third are too large
sed 's/ramp: load/ramp: in/' press.yaml > three.yaml
printf 'load_steps: 3\nramps:\n  - in: {factors: [0.2, 0.4, 1]}\n' >> three.yaml
"$contact" three.yaml -quiet -error_estimate 0 2>&1 | sed 's/([^)]*)/(...)/'
