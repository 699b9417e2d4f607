# The friction of nodes that are held in y acts in y, although the other body is clamped at the same y far away. A block
# on the tip of a clamped plate that is pulled sideways: if the block moves by 0.01 in y, no coordinate of its nodes is
# that of a clamped node, and the forces must remain about the same
contact=$AMGF_DIR/bin/contact
for y in 0 0.01 -0.01; do
  cat > tip.yaml <<YAML
bodies:
  - base: {lower: [0, 0, 0], upper: [4, 1, 0.2], cells: [8, 2, 1], young: 1000, poisson: 0.3}
  - top: {lower: [3, $y, 0.2], upper: [4, $("$PYTHON" -c "print(1 + $y)"), 0.4], cells: [2, 2, 1], young: 1000,
          poisson: 0.3}
displacements:
  - clamp: {face: base.xmin, value: [0, 0, 0]}
  - under: {face: base.zmin, value: [free, free, 0]}
  - tip: {face: top.xmax, value: [free, 0, free]}
  - back: {face: top.xmin, value: [0, free, free]}
  - press: {face: top.zmax, value: [free, free, -0.002]}
tractions: [pull: {face: base.xmax, value: [0, 5, 0]}]
contact: [pair: {mortar: base.zmax, nonmortar: top.zmin, friction: 0.3}]
load: {steps: 2}
YAML
  "$contact" tip.yaml -quiet -summary tip_$y.json || echo "exit $?"
done
"$PYTHON" - <<'PY'
from summaries import load

force = {y: load(f"tip_{y}")["steps"][-1]["pairs"][0]["force"][1] for y in ("0", "0.01", "-0.01")}
mean = 0.5 * (force["0.01"] + force["-0.01"])
for y, value in force.items():
    near = abs(value - mean) < 0.005 * mean
    print(f"block moved by {y}: "
          f"{'friction along y acts' if near else f'the force along y is {value}, not {mean}'}")
PY
