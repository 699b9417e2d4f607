# Pressures that follow the deformed face: homogeneous states and a sphere that is blown up, on one rank and on three;
# with contact, ties and hanging vertices; what is refused.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/loads/follower.py" write
for scene in cube free bar sphere press glued fine; do
  "$contact" $scene.yaml -quiet -tao_ipfilter_tol 1e-8 -summary $scene.json || echo "$scene: exit code $?"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -tao_ipfilter_tol 1e-8 -summary ${scene}_3.json ||
    echo "$scene, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/loads/follower.py" judge
# Where the gap is linearized again the load goes on from the last solve, by secants of its own: a third of the solves
# that it takes with those of another gap
"$contact" ride.yaml > ride.log || echo "ride: exit code $?"
solves=$(grep -c '^iter' ride.log)
echo "solves of four linearizations of the gap, 55 at most: $([ "$solves" -le 55 ] && echo yes || echo "no, $solves")"
"$contact" cube.yaml -scene_check | grep '^  pressure px'

try() {
  sed "$1" cube.yaml > tried.yaml
  "$contact" tried.yaml -quiet -load_max_cuts 0 -tao_max_it 40 2>&1 # no equilibrium: 500 iterations end alike
  echo "exit code $?"
}
try 's/material: neohookean, //'
try 's/load:/model: quadratic\n&/'
try 's/follows: true/follows: maybe/'
try 's/follows: true/follow: true/'
try 's/load:/contact:\n  - touch: {mortar: cube.zmax, nonmortar: cube.zmin, friction: 0.1}\n&/'
try 's/value: 0.3/value: 3/; s/steps: 2/steps: 1/' | sed 's/failed: .*/failed: .../'
