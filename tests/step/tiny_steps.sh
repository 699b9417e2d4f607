# Load steps so small that rounding decides in them: strains of 1e-6 and residuals of equilibrium at rounding from the
# start.
# None is cut, and 2500 of them end where three do.
cat > cube.yaml <<'YAML'
bodies:
  - cube: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 1,
           poisson: 0.3}
displacements:
  - bottom: {face: cube.zmin, value: [0, 0, 0]}
  - top: {face: cube.zmax, value: [0, 0, -0.0075]}
YAML
for steps in 3 2500; do
  "$AMGF_DIR/bin/contact" cube.yaml -quiet -load_steps $steps -summary $steps.json -error_estimate 0 \
    -tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type cholesky
  echo "$steps: exit $?"
done
"$PYTHON" - <<'PY'
import json

few, many = (json.load(open("%d.json" % n))["steps"] for n in (3, 2500))
print("cuts:", sum(step["cuts"] for step in many))
print(
    "energy and force within 1e-9:",
    all(
        abs(a / b - 1) < 1e-9
        for a, b in ((many[-1]["energy"], few[-1]["energy"]), (many[-1]["reaction"][2], few[-1]["reaction"][2]))))
PY
