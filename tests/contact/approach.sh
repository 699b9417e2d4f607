# Load steps that end before the faces meet: nothing presses, a body that is moved as a whole has no forces but
# rounding, and no optimizer makes anything else of it
cat > approach.yaml << 'SCENE'
bodies:
  - low: {lower: [0, 0, -1], upper: [2, 2, 0], cells: [3, 2, 1], young: 10, poisson: 0.3}
  - up: {lower: [0.5, 0.5, 0.025], upper: [1.5, 1.5, 1], cells: [2, 2, 1], young: 1000, poisson: 0.3}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - press: {face: up.zmax, value: [0.01, 0, -0.04]}
pressures:
  - side: {face: low.xmax, value: 0}
contact:
  - touch: {mortar: low.zmax, nonmortar: up.zmin}
load: {steps: 4}
SCENE
sed 's/ 1000, poisson: 0.3/&, material: neohookean/' approach.yaml > finite.yaml
sed 's/low.xmax, value: 0/low.xmax, value: 0.01/' finite.yaml > loaded.yaml
sed -e 's/young: 1000, poisson: 0.3/material: rigid/; s/press: {face: up.zmax/press: {body: up/' \
  -e 's/up.zmin}/up.zmin, friction: 0.3}/' approach.yaml > rigid.yaml
sed 's/friction: 0.3/shear_limit: 0.01/' rigid.yaml > limited.yaml
for scene in approach finite loaded rigid limited; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json || echo "$scene: exit code $?"
done
for scene in approach finite loaded; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary ${scene}_interior.json -tao_ipfilter_subspace false ||
    echo "$scene, interior point: exit code $?"
done
"$PYTHON" - << 'CHECK'
import json

for name in ("approach", "finite", "loaded", "rigid", "limited", "approach_interior", "finite_interior",
             "loaded_interior"):
    with open(name + ".json") as file:
        steps = json.load(file)["steps"]
    open_, closed = steps[0], steps[-1]
    good = all(
        step["balance"] < 1e-7 and step["equilibrium"] < 1e-7
        for step in steps) and open_["pairs"][0]["normal_force"] < 1e-7 and closed["pairs"][0]["normal_force"] > 0.01
    errors = [max(step["algebraic_error"], step["error_estimate"]**2) for step in steps]
    good = good and max(errors) < 0.5  # what is relative to the energy of a body without stress would be anything
    print(
        name + ":", "open, then closed, in balance" if good else "NO, " + str(
            ([(s["balance"], s["equilibrium"], s["pairs"][0]["normal_force"]) for s in steps], errors)))
CHECK
# With friction and nothing but rounding for forces: no warning of forces or of works
sed 's/nonmortar: up.zmin/&, friction: 0.3/; s/value: \[0.01, 0, -0.04\]/value: [0.01, 0, -0.01]/' approach.yaml \
  > apart.yaml
sed 's/ 0.025\]/ 0]/; s/-0.01\]/0]/' apart.yaml > touching.yaml
for scene in apart touching; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet 2>&1 | sed "s/^/$scene: /"
done
# A lid that is pressed through a cube, to below its foot, in one load step: the faces must not pass each other unseen
cat > through.yaml << 'SCENE'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 10, poisson: 0.3}
  - lid: {lower: [-0.5, -0.5, 1.1], upper: [1.5, 1.5, 1.4], cells: [2, 2, 1], material: rigid}
displacements:
  - foot: {face: cube.zmin, value: [0, 0, 0]}
  - press: {body: lid, value: [0, 0, -2]}
contact:
  - touch: {mortar: lid.zmin, nonmortar: cube.zmax}
SCENE
pass='pass through each other by [0-9.e+-]* within the load step'
"$AMGF_DIR/bin/contact" through.yaml -quiet 2>&1 |
  grep -o "^contact: load step 1 failed: contact pair \"touch\": lid.zmin and cube.zmax $pass" |
  sed 's, by [^ ]* within, by DEPTH within,'
echo "exit code ${PIPESTATUS[0]}"
# A smaller one, beside which the cube turns over instead
cat > over.yaml << 'SCENE'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 10, poisson: 0.3,
      element: full}
  - lid: {lower: [0.2, 0.2, 1], upper: [0.8, 0.8, 1.3], cells: [2, 2, 1], material: rigid}
displacements:
  - foot: {face: cube.zmin, value: [0, 0, 0]}
  - press: {body: lid, value: [0, 0, -2]}
contact:
  - touch: {mortar: lid.zmin, nonmortar: cube.zmax}
load: {factors: [0.2, 0.5, 1]}
SCENE
"$AMGF_DIR/bin/contact" over.yaml -quiet -load_max_cuts 0 > over.log 2>&1
echo "exit code $?, $(grep -c 'open at the end of every load step' over.log) warnings of no contact"
turns='turns by more than 90 degrees within the load step'
grep -o "^contact: load step 2 failed: contact pair \"touch\": lid.zmin or cube.zmax $turns" over.log
