# Pretension of bolts: bars in closed form (shortening, then a load shared by stiffness), with a restart; several bolts
# of unlike elements that close clearances, on one rank and on three; finite strain; a washer on weak springs; what is
# refused.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/loads/bolts.py" write
for scene in bars four; do
  "$contact" $scene.yaml -quiet -summary $scene.json -output $scene -checkpoint $scene.state -checkpoint_every 2 ||
    echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json ||
    echo "$scene, three ranks: exit code $?"
done
"$contact" rubber.yaml -quiet -summary rubber.json || echo "rubber: exit code $?"
"$contact" washer.yaml -quiet -summary washer.json || echo "washer: exit code $?"
"$contact" short.yaml -quiet -summary short.json || echo "short: exit code $?"
"$contact" bars.yaml -quiet -restart bars.state -summary again.json || echo "again: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/loads/bolts.py" judge
"$contact" bars.yaml -scene_check | grep '^  bolt '
"$contact" bars.yaml -load_steps 6 -scene_check | grep '^  bolt '

try() {
  sed "$1" bars.yaml > tried.yaml
  "$contact" tried.yaml -quiet -load_max_cuts 0 2>&1
  echo "exit code $?"
}
try 's/body: bolt/body: head/'
try 's/body: bolt, point/body: screw, point/'
try 's/body: bolt, point/point/'
try 's/point: \[0, 0, 4.5\]/point: [0, 0, 14.5]/'
try 's/axis: \[0, 0, 1\], //'
try 's/axis: \[0, 0, 1\]/axis: [0, 0, 0]/'
try 's/force: 1000, /force: 1000, shortening: 1, /'
try 's/force: 1000, //'
try 's/lock: 1/lock: -1/'
try 's/force: 1000/shortening: 0.1/'
try 's/^bolts:.*/&\n  - twin: {body: bolt, point: [0, 0, 4.6], axis: [0, 0, 1], force: 1}/'
try 's/^  - b: {mortar.*//'
