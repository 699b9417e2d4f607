# A rigid ball is pressed into a block that yields and taken away again: its imprint stays; the same on two ranks;
# applications of the AMG beside those of an elastic block; a start at which the tangent is indefinite.
contact=$AMGF_DIR/bin/contact
cat > brinell.yaml <<'YAML'
problem: brinell
bodies:
  - block: {lower: [0, 0, -2], upper: [2, 2, 0], cells: [6, 6, 6], grading: [4, 4, 0.25], material: j2, young: 200000,
            poisson: 0.3, yield: 200, element: bbar}
  - ball: {shape: ball, center: [0, 0, 1], octant: [1, 1, -1], radius: 1, patches: [6, 6, 6], layers: 1,
           material: rigid}
symmetry: [block.xmin, block.ymin]
displacements:
  - floor: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: ball, value: [0, 0, -0.05]}
contact:
  - imprint: {mortar: ball.surface, nonmortar: block.zmax}
probes:
  - middle: {point: [0, 0, 0], body: block}
load: {factors: [0.5, 1, 0]}
YAML
for n in 1 2; do
  mpiexec --oversubscribe -n $n "$contact" brinell.yaml -quiet -summary ranks$n.json 2> /dev/null ||
    echo "$n ranks: exit code $?"
done
sed 's/material: j2,/material: j2_finite,/' brinell.yaml > finite.yaml
sed -e 's/material: j2,/material: neohookean,/' -e 's/, yield: 200//' brinell.yaml > elastic.yaml
sed 's/0.5, 1, 0/1, 2/' finite.yaml > deep.yaml
for scene in finite elastic deep; do
  "$contact" $scene.yaml -quiet -tao_ipfilter_pc_amgf_factor false -error_estimate 0 -summary $scene.json 2> /dev/null \
    || echo "$scene: exit code $?"
done
"$PYTHON" - <<'PY'
from summaries import load, say

one, two = (load("ranks%d" % n)["steps"] for n in (1, 2))
force = [step["pairs"][0]["normal_force"] for step in one]
depth = [-step["probes"][0]["displacement"][2] for step in one]
say("the ball leaves the block", force[2] == 0 and force[1] > force[0] > 0, force)
say("most of the imprint stays, and some springs back", 0.8 * depth[1] < depth[2] < depth[1], depth)
say("taken away without plastic work, to 1 %",
    abs(one[2]["plastic_work"] / one[1]["plastic_work"] - 1) < 1e-2, [step["plastic_work"] for step in one])
say("mean pressure 2 to 4 times the yield stress", 2 < force[1] / one[1]["pairs"][0]["area"] / 200 < 4,
    force[1] / one[1]["pairs"][0]["area"] / 200)
say("two ranks: the same",
    all(abs(a[key] / b[key] - 1) < 1e-5 for a, b in zip(one, two) for key in ("plastic_work", "plastic_strain")),
    [[s["plastic_work"] for s in run] for run in (one, two)])
finite, elastic = ([step["amg_applications"] for step in load(name)["steps"]] for name in ("finite", "elastic"))
say("pressed in: at most 3 times the AMG applications of an elastic block",
    max(a / b for a, b in zip(finite[:2], elastic)) < 3, (finite, elastic))
say("pressed deep in: no load step needs the interior point method, although the tangent is indefinite at its start",
    all(step["systems"] == 0 for step in load("deep")["steps"]), [step["systems"] for step in load("deep")["steps"]])
say("taken away: no more than pressed in", finite[2] <= finite[1], (finite, elastic))
PY
