# A rigid block that rests on a rigid floor without a gap, from the start or after a fall; nothing in the scene is
# elastic
for gap in 0 0.01; do
  for rotation in ", rotation: [0, 0, 0]" ""; do
    cat > block.yaml <<YAML
bodies:
  - floor: {lower: [-1, -1, -1], upper: [2, 2, 0], cells: [3, 3, 1], material: rigid}
  - block: {lower: [0, 0, $gap], upper: [1, 1, 1], cells: [2, 2, 2], material: rigid}
displacements: [stay: {body: floor, value: [0, 0, 0]}, guide: {body: block, value: [0, 0, free]$rotation}]
forces: [weight: {body: block, value: [0, 0, -10]}]
contact: [foot: {mortar: floor.zmax, nonmortar: block.zmin}]
YAML
    for ranks in 1 2; do
      mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" block.yaml -quiet -summary block.json > out 2>&1
      echo "gap $gap$rotation, $ranks ranks: exit code $?"
      "$PYTHON" - <<PYTHON
from summaries import load, say, within
step = load("block")["steps"][-1]
say("the floor bears the weight", within(step["pairs"][0]["normal_force"], 10, 1e-6), step["pairs"])
PYTHON
    done
  done
done
