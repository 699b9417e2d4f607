# Pressures that follow the deformed face: homogeneous states and a sphere that is blown up, some on three ranks;
# with contact, ties and hanging vertices; what is refused.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/loads/follower.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -tao_ipfilter_tol 1e-8 || echo "$2: exit code $?"
}
for scene in cube bar sphere glued fine; do run 1 $scene; done
for scene in free press; do run 3 $scene; done
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
