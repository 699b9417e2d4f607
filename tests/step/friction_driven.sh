# A block is pulled over a rigid body by one of its faces, whose displacements along the body are prescribed: friction
# acts on the nodes of this face, too, although it moves no unknown there. The pull must be the coefficient of friction
# times the normal force, or the shear limit times the area, and the work that it puts in must be stored or dissipated
scene() {
  cat <<YAML
bodies:
  - block: {lower: [3, 0, 0], upper: [4, 1, 1], cells: [2, 2, 2], young: 1e5, poisson: 0.3}
  - floor: $1
displacements:
  - floor: {body: floor, value: [0, 0, 0]}
  - pull: {face: block.xmax, value: [0.4, $2, free], ramp: pull}
pressures: [weight: {face: block.zmax, value: 4, ramp: press}]
contact: [pair: {mortar: floor.$3, nonmortar: block.zmin, ${4:-friction: 0.5}}]
ramps: [press: {factors: [1, 1, 1]}, pull: {factors: [0, 0.5, 1]}]
YAML
}
mesh="lower: [0, -1, -1], upper: [6, 2, 0], cells: [6, 3, 1], material: rigid"
scene "{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}" 0 surface > plane.yaml
scene "{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}" 0.3 surface > oblique.yaml
scene "{$mesh}" 0 "zmax, gap: node" > node.yaml
scene "{$mesh}" 0 zmax > mortar.yaml
scene "{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}" 0 surface "shear_limit: 2" > tresca.yaml
for name in plane oblique node mortar tresca; do
  ranks=1
  [ $name != oblique ] && [ $name != node ] || ranks=3
  mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" $name.yaml -quiet -summary $name.json || echo "exit $?"
done
"$PYTHON" - <<'PY'
from math import hypot

from summaries import load, say, within

for name in ("plane", "oblique", "node", "mortar", "tresca"):
    step = load(f"{name}")["steps"][-1]
    path = 0.5 if name == "oblique" else 0.4
    pull = next(face["reaction"] for face in step["faces"] if face["name"] == "block.xmax")
    say(f"{name}: the pull is friction times normal force", within(hypot(*pull[:2]), 2, 1e-3), pull)
    say(f"{name}: work is stored or dissipated", step["imbalance"] < 1e-3, step["imbalance"])
    say(f"{name}: dissipated", within(step["dissipated"], 2 * path, 2e-3),
        step["dissipated"])
PY
