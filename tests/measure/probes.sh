# Points and lines: displacement, stress and contact of a stack under uniform pressure against the exact answer, on one
# rank and on three; the fields of the files against each other; points on curved surfaces; points in no body.
contact=$AMGF_DIR/bin/contact
cat > stack.yaml <<'YAML'
problem: stack
bodies:
  - lower: {lower: [0, 0, 0], upper: [2, 2, 1], cells: [4, 4, 2], young: 1e5, poisson: 0.3}
  - upper: {lower: [0, 0, 1], upper: [2, 2, 2], cells: [3, 3, 2], young: 5e4, poisson: 0.15}
symmetry: [lower.xmin, lower.ymin, lower.zmin, upper.xmin, upper.ymin]
pressures:
  - weight: {face: upper.zmax, value: 2}
contact:
  - joint: {mortar: lower.zmax, nonmortar: upper.zmin}
probes:
  - inside: {point: [0.3, 0.7, 0.4]}
  - corner: {point: [2, 2, 2]}
  - below: {point: [1.1, 0.2, 1], body: lower}
  - above: {point: [1.1, 0.2, 1], body: upper}
  - height: {from: [1, 1, 0], to: [1, 1, 1], points: 5, body: lower}
  - seam: {from: [0, 1, 1], to: [2, 1, 1], points: 3, body: upper}
load: {steps: 2}
YAML
for ranks in 1 3; do
  mpiexec --oversubscribe -n $ranks "$contact" stack.yaml -quiet -output stack -output_gauss -summary stack.json \
    -tao_ipfilter_tol 1e-12 || echo "exit code $?"
  echo "ranks: $ranks"
  "$PYTHON" "$AMGF_DIR/tests/measure/probes.py"
done
"$PYTHON" "$AMGF_DIR/share/plot/curves.py" stack_height.csv line.png --steps all && head -c 4 line.png | tail -c 3 &&
  echo
"$contact" stack.yaml -scene_check | sed -n '/^Probes/,/^Load steps/p'

# Where bodies touch a point is the first one's, on any ranks
cat > touch.yaml <<'YAML'
bodies:
  - low: {lower: [0, 0, 0], upper: [3, 2, 1], cells: [3, 2, 1], young: 10, poisson: 0.3}
  - top: {lower: [0.5, 0.5, 1], upper: [2.5, 1.5, 2], cells: [2, 2, 1], young: 10, poisson: 0.3}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - guide: {face: top.zmax, value: [0, 0, -0.05]}
contact:
  - touch: {mortar: low.zmax, nonmortar: top.zmin}
probes:
  - between: {point: [1.5, 1, 1]}
  - below: {point: [1.5, 1, 1], body: low}
  - above: {point: [1.5, 1, 1], body: top}
YAML
for ranks in 1 4; do
  mpiexec --oversubscribe -n $ranks "$contact" touch.yaml -quiet -summary touch.json && "$PYTHON" -c '
import json
between, below, above = (probe["displacement"][2] for probe in json.load(open("touch.json"))["steps"][0]["probes"])
print("between two bodies: the first one'"'"'s", between == below, ", not the other", abs(above - below) > 1e-3)'
done

cat > ball.yaml <<'YAML'
bodies:
  - ball: {shape: ball, radius: 1, patches: [2, 2, 2], layers: 2, young: 1, poisson: 0.3}
symmetry: [ball.x0, ball.y0, ball.z0]
pressures:
  - deep: {face: ball.surface, value: 1}
probes:
  - pole: {point: [0.5773502691896258, 0.5773502691896258, 0.5773502691896258]}
YAML
"$contact" ball.yaml -quiet -summary ball.json && "$PYTHON" -c '
import json
pole = json.load(open("ball.json"))["steps"][0]["probes"][0]
moved, pressure = pole["displacement"][0], pole["contact_pressure"]
print("on the facets of a ball:", abs(pole["stress_xx"] + 1) < 0.1, abs(moved + 0.4 / 3**0.5) < 0.03, pressure)'
sed 's/point: .*/point: [0.7, 0.7, 0.7]}/' ball.yaml > outside.yaml
sed 's/point: .*/point: [7, 7, 7]}/' ball.yaml > far.yaml
for scene in outside far; do
  for check in '' -scene_check; do
    mpiexec --oversubscribe -n 2 "$contact" $scene.yaml $check > out 2> err
    echo "$scene $check: exit $?, $(sed 's/it is 0.[0-9]* /it is ... /;q' err)"
  done
done
