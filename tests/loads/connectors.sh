# Springs between points: a rigid lever on a hinge of two connectors and a rod to an elastic block, a body that hangs on
# springs, two bodies with a spring and a damper between them; some on three ranks; forces at points of elastic
# bodies; what is refused.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/loads/connectors.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet -summary $2.json -output $2 || echo "$2: exit code $?"
}
for scene in hung damped pulled; do run 1 $scene; done
for scene in lever middle; do run 3 $scene; done
"$PYTHON" "$AMGF_DIR/tests/loads/connectors.py" judge
"$contact" lever.yaml -scene_check | grep '^  connector '
"$contact" damped.yaml -scene_check | grep '^  connector '
"$contact" middle.yaml -scene_check | grep '^  force '
sed 's/point: .2, 0.5/point: [3, 0.5/' middle.yaml > tried.yaml
"$contact" tried.yaml -quiet 2>&1 || echo "exit code $?"
sed 's/value: .10/moment: [10/' middle.yaml > tried.yaml
"$contact" tried.yaml -quiet 2>&1 || echo "exit code $?"

try() {
  sed "$1" lever.yaml > tried.yaml
  "$contact" tried.yaml -quiet 2>&1
  echo "exit code $?"
}
try 's/point: \[10, 0.5, 0\]/point: [12, 0.5, 0]/'
try 's/to: block, to_point: \[10, 0.5, -2\], //'
try 's/, stiffness: 1000//'
try 's/stiffness: 1000/stiffness: 1000, value: [1, 1, 1]/'
try 's/to: block/to: arm/'
try 's/value: \[1e6, 1e6, 1e6\]/value: [0, 0, 0]/'
try 's/stiffness: 1000/stiffness: -1000/'
try 's/stiffness: 1000/stiffness: 1000, damping: 5/'
try '/hinge2/d'
