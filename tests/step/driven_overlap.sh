# A cone that fills a rigid socket is pushed by its end face, all of whose displacements are prescribed: its rim would
# have to penetrate the socket. The message names pair, vertex and depth, with friction as without
for friction in 0 0.2; do
  cat > socket.yaml <<YAML
bodies:
  - plug: {shape: cone, axis: z, radii: [1, 1.5], extent: [0, 1], cells: [2, 1, 2], young: 1e5, poisson: 0.3}
  - socket: {shape: rigid_revolved, center: [0, 0, 0], direction: [0, 0, 1], points: [2.5, 3, 0.5, -1]}
displacements:
  - seat: {body: socket, value: [0, 0, 0]}
  - push: {face: plug.lmax, value: [0, 0, -0.002]}
contact: [fit: {mortar: socket.surface, nonmortar: plug.surface, friction: $friction}]
YAML
  "$AMGF_DIR/bin/contact" socket.yaml -quiet > message 2>&1
  echo "exit $?"
  sed "s/vertex (.*, 1.)/vertex (X, Y, 1)/" message
done
