# A beam bent by a roller that is driven by a force, up to a plastic hinge: a force above the collapse load ends with a
# sentence that says so.
cat > hinge.yaml <<'YAML'
problem: hinge
bodies:
  - beam: {lower: [0, 0, 0], upper: [50, 5, 10], cells: [12, 1, 2], material: j2, young: 200000, poisson: 0.3,
           yield: 250, element: bbar}
  - roller: {shape: rigid_cylinder, center: [0, 0, 15], direction: [0, 1, 0], radius: 5}
  - support: {shape: rigid_cylinder, center: [45, 0, -5], direction: [0, 1, 0], radius: 5}
symmetry: [beam.xmin, beam.ymin]
displacements:
  - roller: {body: roller, value: [0, 0, free]}
  - support: {body: support, value: [0, 0, 0]}
forces:
  - press: {body: roller, value: [0, 0, -800]}
contact:
  - roller: {mortar: roller.surface, nonmortar: beam.zmax}
  - support: {mortar: support.surface, nonmortar: beam.zmin}
load: {factors: [0.9, 1.5]}
YAML
"$AMGF_DIR/bin/contact" hinge.yaml -quiet -error_estimate 0 > said 2>&1
echo "exit code $?"
sed "s/time [0-9.]*[0-9]/time .../g" said
awk '/last equilibrium/ {print "the last equilibrium is near collapse: " ($NF > 1.5 ? "yes" : "NO, " $NF)}' said
