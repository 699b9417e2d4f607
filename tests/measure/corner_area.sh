# A tilted block touches a slab with one corner, within the facets around one vertex of the slab: its area in contact is
# that of the row there, and not zero beside a force.
contact=$AMGF_DIR/bin/contact
cat > corner.yaml <<'YAML'
bodies:
  - slab: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [8, 8, 2], young: 200000, poisson: 0.3}
  - block: {lower: [1, 1, 1], upper: [2, 2, 2], cells: [4, 4, 2], young: 200000, poisson: 0.3}
displacements:
  - floor: {face: slab.zmin, value: [0, 0, 0]}
  - tilt: {face: block.zmax, value: [0, 0, 0.022], rotation: [1, 1, 0], center: [1, 2, 2]}
contact:
  - touch: {mortar: block.zmin, nonmortar: slab.zmax}
YAML
"$contact" corner.yaml -quiet -summary corner.json 2> /dev/null || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say

pair = load("corner")["steps"][-1]["pairs"][0]
# The row covers a part of the block's face, and its pressure is the largest one.
mean = pair["normal_force"] / max(pair["area"], 1e-9)
say("area of one row", 0 < pair["area"] < 0.5**2 and 0.9 < mean / pair["pressure"] < 2.25,
    (pair["area"], pair["normal_force"], pair["pressure"]))
CHECK
