# A rigid ball pressed into a block that has cells refined at the contact, is of order 2, or of tetrahedra: the runs go
# on from a checkpoint on other ranks to the same answer, and the three meshes agree on the ball's force.
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" box base.msh 1 0 0 -2 2 2 0 4 4 3
cat > second.yaml <<'YAML'
bodies:
  - ball: {shape: ball, center: [0, 0, 3], octant: [1, 1, -1], radius: 3, patches: [5, 5, 2], layers: 3,
           material: rigid}
  - base: {lower: [0, 0, -2], upper: [2, 2, 0], cells: [4, 4, 3], order: 2, young: 10, poisson: 0.3}
symmetry:
  - west: {face: base.xmin, normal: x}
  - south: {face: base.ymin, normal: y}
  - floor: {face: base.zmin, normal: z}
displacements:
  - down: {body: ball, value: [0, 0, -0.2]}
contact:
  - touch: {mortar: ball.surface, nonmortar: base.zmax}
load: {steps: 3}
YAML
(sed 's/order: 2, //' second.yaml && printf 'refinements:\n  - zone: {near: touch, levels: 1, distance: 0.3}\n') \
  > refined.yaml
sed 's/lower.*order: 2, /mesh: base.msh, volume: block, order: 2, /' second.yaml > tetrahedra.yaml
options="-quiet -tao_ipfilter_tol 1e-12 -contact_update_tol 1e-12"
for scene in refined second tetrahedra; do
  mpiexec --oversubscribe -n 2 "$contact" $scene.yaml $options -summary $scene.json -checkpoint_every 2 \
    -checkpoint $scene.h5 || echo "$scene: exit code $?"
  ranks=1
  [ $scene != refined ] || ranks=3
  mpiexec --oversubscribe -n $ranks "$contact" $scene.yaml $options -restart $scene.h5 -summary part.json ||
    echo "$scene, $ranks ranks: exit code $?"
  "$PYTHON" "$AMGF_DIR/tests/checkpoint/restart.py" "$scene, from two ranks to $ranks" 1e-9 $scene.json part.json
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" - <<'PY'
from summaries import load, say

force = {name: load(name)["steps"][-1]["pairs"][0]["normal_force"] for name in ("refined", "second", "tetrahedra")}
say("the ball's force by three meshes: to 4 %", max(force.values()) <= 1.04 * min(force.values()), force)
PY
