# Metals at finite strain: bars stretched to up to twice their length and pushed back on every element, a tube widened
# by a following pressure, order of Newton's method; ranks, restart, cuts.
contact=$AMGF_DIR/bin/contact
options="-quiet -tao_ipfilter_tol 1e-11"
law="material: j2_finite, young: 200, poisson: 0.3, yield: 0.2"
cat > bars.yaml <<YAML
problem: bars
bodies:
  - full: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [3, 2, 2], element: full, $law, hardening: 4}
  - bbar: {lower: [0, 2, 0], upper: [2, 3, 1], cells: [2, 1, 1], element: bbar, $law, hardening: 2, kinematic: 1.5}
  - second: {lower: [0, 4, 0], upper: [2, 5, 1], cells: [1, 1, 1], order: 2, element: full, $law, saturation: 0.6,
             saturation_rate: 1, hardening: 4}
  - both: {lower: [0, 6, 0], upper: [2, 7, 1], cells: [1, 1, 1], order: 2, element: bbar, material: j2_finite,
           young: 200, poisson: 0.3, plastic_strains: [0, 0.2, 3], yield_stresses: [0.2, 1.2, 12.4]}
symmetry: [full.xmin, full.ymin, full.zmin, bbar.xmin, bbar.ymin, bbar.zmin, second.xmin, second.ymin, second.zmin,
    both.xmin, both.ymin, both.zmin]
displacements:
  - full: {face: full.xmax, value: [2, free, free]}
  - bbar: {face: bbar.xmax, value: [2, free, free]}
  - second: {face: second.xmax, value: [2, free, free]}
  - both: {face: both.xmax, value: [0.5, free, free]}
load: {factors: [0.5, 1, 0.6, 0.2, -0.2]}
YAML
cat > tube.yaml <<YAML
problem: tube
bodies:
  - tube: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [1, 2], angles: [0, 15], extent: [0, 0.1],
           cells: [12, 2, 1], grading: [2, 1, 1], material: j2_finite, young: 10000, poisson: 0.3,
           yield: 1.7320508075688772, hardening: 6, element: bbar}
displacements:
  - bottom: {face: tube.lmin, value: [free, free, 0]}
  - top: {face: tube.lmax, value: [free, free, 0]}
symmetry:
  - begin: {face: tube.amin, normal: y}
  - end: {face: tube.amax, normal: [-0.25881904510252074, 0.96592582628906831, 0]}
pressures:
  - bore: {face: tube.inner, value: 1, follows: true}
probes:
  - outside: {point: [2, 0, 0]}
load: {factors: [1.35, 1.5092646879, 1.6346579]}
YAML
for n in 1 3; do
  mpiexec --oversubscribe -n $n "$contact" bars.yaml $options -summary bars$n.json || echo "$n ranks: exit code $?"
done
"$contact" bars.yaml $options -checkpoint bars.h5 -checkpoint_every 3 -load_steps 5 -summary whole.json
"$contact" bars.yaml $options -load_steps 5 -restart bars.h5 -summary part1.json
mpiexec --oversubscribe -n 2 "$contact" bars.yaml $options -load_steps 5 -restart bars.h5 -summary part2.json
"$contact" tube.yaml -tao_ipfilter_tol 1e-13 -output tube -summary bbar.json > newton.txt || echo "tube: exit code $?"
sed 's/element: bbar/element: full/' tube.yaml > full.yaml; "$contact" full.yaml $options -summary full.json
sed 's/cells: .12, 2, 1./order: 2, cells: [6, 1, 1]/' tube.yaml > order2.yaml;
  "$contact" order2.yaml $options -summary order2.json
"$PYTHON" "$AMGF_DIR/tests/material/plasticity_finite.py"
sed 's/kinematic: 1.5/expansion: 1e-5/' bars.yaml > other.yaml; "$contact" other.yaml -quiet 2>&1 || echo "exit code $?"
sed 's/element: bbar/element: incompatible/' bars.yaml > other.yaml; "$contact" other.yaml -quiet 2>&1 ||
  echo "exit code $?"
sed '1s/^/model: quadratic\n/' bars.yaml > other.yaml; "$contact" other.yaml -quiet 2>&1 || echo "exit code $?"
