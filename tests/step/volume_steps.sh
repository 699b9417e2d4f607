# A nearly incompressible rod is twisted by 45 degrees a load step. Newton's steps change volumes in the second order;
# the false pressures of that must not enter the tangent, with which it would take twice as many steps. The energy is
# that of short load steps
contact=$AMGF_DIR/bin/contact
cat > rod.yaml <<'YAML'
bodies:
  - rod: {shape: cylinder, axis: z, radius: 1, extent: [0, 6], cells: [3, 2, 12], young: 1, poisson: 0.49,
      material: neohookean}
displacements:
  - hold: {face: rod.lmin, value: [0, 0, 0]}
  - twist: {face: rod.lmax, value: [0, 0, 0], rotation: [0, 0, 180], center: [0, 0, 6]}
YAML
for steps in 4 12; do
  "$contact" rod.yaml -load_steps $steps -quiet -error_estimate 0 -summary rod_$steps.json || echo "exit code $?"
done
"$PYTHON" -B - <<'PYTHON'
from summaries import each, load, say, within

few, many = load("rod_4"), load("rod_12")
say("few steps of Newton's method", sum(each(few, "ip_iterations")) < 40, each(few, "ip_iterations"))
say("the energy of short load steps", within(each(few, "energy")[-1], each(many, "energy")[-1], 1e-8),
    (each(few, "energy"), each(many, "energy")))
PYTHON
