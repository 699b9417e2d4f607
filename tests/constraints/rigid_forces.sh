# Rigid bodies that forces drive, against runs that displacements drive, statics and beams, on one rank and, some, on
# three (rigid_forces_long: all); what is refused.
long=${1-}
contact=$AMGF_DIR/bin/contact
options="-quiet -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-10 -contact_update_tol 1e-10"
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid_forces.py" drive
for scene in punch rubber roller rolled; do
  "$contact" driven_$scene.yaml $options -summary driven_$scene.json || echo "$scene: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid_forces.py" write
for scene in punch rubber roller rolled beam tilt rubs sprung; do
  "$contact" $scene.yaml $options -summary $scene.json || echo "$scene: exit code $?"
done
for scene in tilt ${long:+roller} ${long:+punch rubber rolled beam rubs sprung}; do
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml $options -summary ${scene}_3.json ||
    echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/constraints/rigid_forces.py" judge
"$contact" tilt.yaml -scene_check | grep '^  \(displacement guide\|force load\)'

try() {
  sed "$1" tilt.yaml > tried.yaml
  "$contact" tried.yaml -quiet 2>&1 | cut -c1-200
  echo "exit code ${PIPESTATUS[0]}"
}
try 's/-0.002\]/0.002]/'
try 's/\[0.1, -0.2, 7\]/[0.1, -2, 7]/'
try 's/free, free, 0\]/free, free, free]/'
try 's/free, free, 0\]/free, 1, 0]/'
try 's/, center: \[0, 0, 1\]//'
try 's/foot: .*/foot: {face: block.zmin, value: [0, 0, 0], rotation: [free, 0, 0], center: [0, 0, 0]}/'
try 's/load: {body: plate/load: {body: block/'
try 's/load: {body: plate/load: {body: plates/'
try 's/load: {body: plate/load: {body: plate, face: plate.zmax/'
try 's/  - foot.*/&\n  - more: {body: plate, value: [0, 0, 0]}/'
try 's/moment: \[0.0001, 0, 0\]/moment: [0.0001, nan, 0]/'
try 's/point: \[0.1, -0.2, 7\]/point: [0.1, -0.2]/'
try 's/point: /points: /'
sed 's/moment: \[0.01, 0, 0\]/moment: [1, 0, 0]/' beam.yaml > turned.yaml
"$contact" turned.yaml -quiet 2>&1 | sed 's/by [0-9.]* degrees/by too much/'
# A tolerance that rounding does not admit: the best solution is taken, and no other
"$contact" rubber.yaml -quiet -tao_ipfilter_tol 1e-13 -contact_updates 2 -summary best.json
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -c '
from summaries import load, say
steps = load("best")["steps"]
say("in equilibrium where a solution is acceptable only",
    all(step["equilibrium"] < 1e-8 and step["balance"] < 1e-8 for step in steps),
    [(step["reason"], step["equilibrium"]) for step in steps])'
