# -accuracy_adaptive: Hertz's ball from 1,131 unknowns, a beam, rings whose facets err where stress recovery sees
# nothing, thin cells along a curve; the same meshes on any ranks; what is asked of; what is refused, in
# one sentence; rubber that slides with friction; a block with edges. adaptive_long: more ranks, finer meshes.
# adaptive.py holds the summaries against references.
contact=$AMGF_DIR/bin/contact
long=${1-}
if [ -n "$long" ]; then slide=3e-2 edge=50000; else slide=1e-1 edge=8000; fi
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" "$AMGF_DIR/tests/run/adaptive.py" write
"$PYTHON" "$AMGF_DIR/share/scenes/meshes.py" hertz_cylinder coarse > cylinder.yaml
cp "$AMGF_DIR/share/scenes/cantilever.yaml" .

run() { # summary, scene, options
  name=$1
  scene=$2
  shift 2
  "$contact" "$scene.yaml" -quiet -summary "$name.json" -accuracy_adaptive "$@" || echo "$name: exit code $?"
}
run ball ball -accuracy 3e-3 > progress
run peak ball -accuracy 1e-2 -accuracy_of pressure
run small ball -accuracy 1e-3 -accuracy_max_dofs 5000 2> /dev/null
for ranks in 1 3 ${long:+2 5}; do
  mpiexec --oversubscribe -n $ranks "$contact" ball.yaml -quiet -accuracy_adaptive -accuracy 1e-2 \
    -tao_ipfilter_tol 1e-10 -contact_update_tol 1e-10 -summary ranks_$ranks.json
done
run cylinder cylinder -accuracy 3e-3
run slide slide -accuracy $slide
run cantilever cantilever -accuracy 1e-2
run energy cantilever -accuracy 1e-2 -accuracy_of energy
run tool tool -accuracy 5e-2
run shrink shrink -accuracy 3e-3 2> /dev/null
sed '/element: full/d; s/^refine: 1/refine: 0/; s/lower: \[-4.5, -2, /lower: [-4.5, 0, /
  s/lower: \[-3.5, -0.5, /lower: [-3.5, 0, /; s/cells: \[20, 6, 3\]/cells: [20, 3, 3]\n      element: bbar/
  s/cells: \[4, 4, 4\]/cells: [4, 2, 4]/' "$AMGF_DIR/share/scenes/two_block.yaml" > edge.yaml
echo 'symmetry: [slab.ymin, block.ymin]' >> edge.yaml
run edge edge -accuracy 1e-2 -accuracy_of energy -contact_updates 1 -accuracy_max_dofs $edge 2> /dev/null
PYTHONPATH=$AMGF_DIR/share/scenes:$AMGF_DIR/tests/lib "$PYTHON" "$AMGF_DIR/tests/run/adaptive.py" judge
"$contact" cantilever.yaml -accuracy 1e-2 -accuracy_adaptive | grep -a '^Accuracy 0.01: a mesh' |
  sed 's/has an error of .*; the next/has an error of ...; the next/'
# what is refused
sed 's/layers: 4/layers: 4, order: 2/' ball.yaml > order2.yaml
for scene in order2 rigid tied; do
  "$contact" $scene.yaml -quiet -accuracy 1e-2 -accuracy_adaptive 2>&1 || echo "exit code $?"
done
"$contact" ball.yaml -quiet -accuracy 1e-2 -accuracy_of size 2>&1 | grep -a -m 1 error
