# A bar with kinematic hardening in pull and push, by every element: stresses of the closed form at every load step
contact=$AMGF_DIR/bin/contact
for element in auto full bbar; do
  cat > $element.yaml <<YAML
bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], material: j2, young: 1000, poisson: 0.3, yield: 1,
          kinematic: 100, element: $element}
symmetry: [bar.xmin, bar.ymin, bar.zmin]
displacements:
  - pull: {face: bar.xmax, value: [0.004, free, free]}
load: {factors: [0.5, 1, 0.5, 0, -0.5, -1, -0.5, 0, 0.5, 1, 0, -1]}
YAML
  "$contact" $element.yaml -quiet -error_estimate 0 -summary $element.json 2>&1 || echo "exit $?"
done
"$PYTHON" - <<'PY'
import math
from summaries import load, say

for name in "auto", "full", "bbar":
    plastic, off = 0.0, []
    for step, factor in zip(load(name)["steps"], [0.5, 1, 0.5, 0, -0.5, -1, -0.5, 0, 0.5, 1, 0, -1]):
        trial = 1000 * (0.004 * factor - plastic) - 100 * plastic
        plastic += math.copysign(max(abs(trial) - 1, 0) / 1100, trial)
        off.append([face for face in step["faces"] if face["name"] == "bar.xmax"][0]["reaction"][0] - 1000 *
                   (0.004 * factor - plastic))
    say(f"{name}: stresses of twelve load steps", len(off) == 12 and max(map(abs, off)) < 1e-8, off)
PY
