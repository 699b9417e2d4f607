# -accuracy TARGET: Hertz's cylinder from a coarse mesh, its force against the exact one, his sphere, and a cantilever;
# what the estimates are worth, order 2 in place of refinement, displacements of probes, and what cannot be reached is
# said. accuracy.py holds the summaries against the exact solution.
contact=$AMGF_DIR/bin/contact

for body in sphere cylinder; do
  "$PYTHON" "$AMGF_DIR/share/scenes/meshes.py" hertz_$body coarse > $body.yaml
done
cp "$AMGF_DIR/share/scenes/cantilever.yaml" .

# Two thick rings that overlap by 0.03 on radius 25: facets of unequal number interfere by as much as a third of it,
# which stress recovery does not see
cat > shrink.yaml <<'YAML'
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [20, 25.015], angles: [0, 90], extent: [0, 1], cells: [2, 24, 1],
            young: 1000, poisson: 0.3, element: full}
  - outer: {shape: tube_arc, axis: z, radii: [24.985, 30], angles: [0, 90], extent: [0, 1], cells: [2, 30, 1],
            young: 1000, poisson: 0.3, element: full}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer}
YAML

# The same rings from Gmsh files, with the shape of the circles and on the facets of the first mesh, which refinement
# sharpens
"$PYTHON" "$AMGF_DIR/tests/mesh/gmsh_rings.py" write
sed 's/curved: true/curved: false/' rings_8_2.2.yaml > rings_facets.yaml

# A pin in a hole, half of both, moved by a hundredth of its radius
cat > pin.yaml <<'YAML'
bodies:
  - pin: {shape: tube_arc, axis: z, center: [0.004, 0, 0], radii: [1, 9.996], angles: [0, 180], extent: [0, 0.5],
          cells: [5, 24, 1], grading: [1/4, 1, 1], young: 210000, poisson: 0.3, element: full}
  - plate: {shape: tube_arc, axis: z, radii: [10, 60], angles: [0, 180], extent: [0, 0.5], cells: [7, 20, 1],
            grading: [16, 1, 1], young: 210000, poisson: 0.3, element: full}
symmetry: [pin.amin, pin.amax, pin.lmin, pin.lmax, plate.amin, plate.amax, plate.lmin, plate.lmax]
contact:
  - joint: {mortar: plate.inner, nonmortar: pin.outer, distance: 1, interference: true}
displacements:
  - rim: {face: plate.outer, value: [0, 0, 0]}
  - bore: {face: pin.inner, value: [0.02, 0, free]}
YAML

run() { # summary, scene, options
  name=$1
  scene=$2
  shift 2
  "$contact" "$scene.yaml" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}
cp cantilever.yaml tip.yaml
printf 'probes:\n  - tip: {point: [10, 0, 0]}\n  - middle: {point: [5, 0, 0.5]}\n' >> tip.yaml
sed 's/poisson: 0.3/&\n      order: 2/' tip.yaml > tip_2.yaml
sed 's/element: full/element: incompatible/' tip.yaml > tip_incompatible.yaml

run exact cylinder -refine 1
run cylinder_1 cylinder -accuracy 1e-2
mpiexec --oversubscribe -n 3 "$contact" cylinder.yaml -quiet -accuracy 3e-3 -summary cylinder_2.json
run cylinder_tight cylinder -accuracy 1e-2 -accuracy_share 1e-4
# True gaps would need a smaller tolerance than the given one, and the subspace method would reach a smaller error. Both
# are off here.
run cylinder_given cylinder -accuracy 1e-2 -accuracy_share 1e-4 -tao_ipfilter_tol 1e-2 -contact_smooth false \
  -contact_updates 1 -tao_ipfilter_subspace false
run cylinder_gatol cylinder -accuracy 1e-2 -accuracy_share 1e-4 -tao_gatol 1e-2 -contact_smooth false \
  -contact_updates 1 -tao_ipfilter_subspace false
run once "$AMGF_DIR/share/scenes/two_block" -refine 0 -accuracy 0.2 -accuracy_of energy -contact_updates 1 \
  -accuracy_max_dofs 2e4 # a gap that is not true, as asked for, is no tolerance's doing
run cylinder_small cylinder -accuracy 1e-4 -accuracy_max_dofs 20000
run sphere sphere -accuracy 3e-3 -accuracy_max_dofs 45000
run raised cylinder -accuracy 1e-3 -accuracy_order 2
run cylinder_single cylinder -accuracy 1e-1 -accuracy_max_dofs 10000
run cantilever cantilever -accuracy 1e-2
"$contact" shrink.yaml -quiet -summary shrink.json -accuracy 3e-3 -accuracy_max_dofs 1e4 2> /dev/null
run tip tip -accuracy 2e-2 -accuracy_of displacement
run tip_raised tip -accuracy 3e-3 -accuracy_of displacement -accuracy_order 2
for rings in rings_8_2.2 rings_20_2.2; do run $rings $rings -accuracy 3e-3; done
run rings_facets rings_facets -accuracy 3e-3 -accuracy_max_dofs 5e3
run pin pin -accuracy 2e-2
run pin_refused pin -accuracy 3e-3 -accuracy_max_dofs 2e4
PYTHONPATH=$AMGF_DIR/share/scenes:$AMGF_DIR/tests/lib "$PYTHON" "$AMGF_DIR/tests/run/accuracy.py"

"$contact" cantilever.yaml -accuracy 1e-2 -accuracy_order 2 | grep -a '^Accuracy 0.01: error of the mesh' |
  sed 's/mesh .*; next/mesh ...; next/'
(cat cantilever.yaml && printf 'refinements:\n  - wall: {near: beam.xmin}\n') > refined.yaml
for scene in tip_2 tip_incompatible refined; do
  "$contact" $scene.yaml -quiet -accuracy 1e-2 -accuracy_order 2 2>&1 || echo "exit code $?"
done
for wrong in '-accuracy nan' '-accuracy -0.1' '-accuracy 0.1 -accuracy_order 3' \
  '-accuracy 0.1 -accuracy_order 2 -accuracy_adaptive' '-accuracy 0.1 -accuracy_of displacement' \
  '-accuracy 0.1 -accuracy_of pressure' '-accuracy 0.1 -accuracy_of forces' '-accuracy 0' '-accuracy 2' \
  '-accuracy little' '-accuracy 0.1 -accuracy_share 1' '-accuracy 0.1 -error_estimate 0'; do
  # shellcheck disable=SC2086
  "$contact" cantilever.yaml -quiet $wrong 2>&1 | grep -a '^contact: error' | head -n 1
done
