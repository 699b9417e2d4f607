# Cells refined where a scene says so: uniform stress to rounding over hanging vertices of curved and nested cells,
# through contact and ties; the same mesh and answer on any number of ranks (refinement_long: on more); Hertz's ball
# with fewer unknowns than uniform refinement; going on from a checkpoint; what is refused, in one sentence.
contact=$AMGF_DIR/bin/contact
long=${1-}
"$PYTHON" "$AMGF_DIR/tests/run/refinement.py" write
tight="-elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-12"
for scene in ball plane; do
  "$contact" $scene.yaml -quiet -output $scene $tight || echo "$scene: exit code $?"; done
for scene in blocks tied; do
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -output $scene $tight || echo "$scene: exit code $?"; done
for ranks in 1 ${long:+2 3 5}; do
  mpiexec --oversubscribe -n $ranks "$contact" slide.yaml -quiet -summary slide_$ranks.json ||
    echo "slide, $ranks ranks: exit code $?"
done
"$contact" slide.yaml -quiet -load_steps 1 -refine 1 -summary finer.json || echo "slide, refined: exit code $?"
for scene in finite node; do "$contact" $scene.yaml -quiet -summary $scene.json || echo "$scene: exit code $?"; done
"$contact" first.yaml -quiet -checkpoint_every 1 -checkpoint first.h5
mpiexec --oversubscribe -n 3 "$contact" slide.yaml -quiet -restart first.h5 -summary again.json ||
  echo "going on: exit code $?"
cat > nested.yaml <<END
bodies:
  - low: {lower: [-1, -1, -1], upper: [1, 1, 0], cells: [3, 3, 2], young: 10, poisson: 0.3}
  - top: {lower: [-0.5, -0.5, 0], upper: [0.5, 0.5, 1], cells: [2, 2, 2], young: 100, poisson: 0.3}
displacements:
  - fix: {face: low.zmin, value: [0, 0, 0]}
  - press: {face: top.zmax, value: [0.05, 0, -0.1]}
contact:
  - c: {mortar: low.zmax, nonmortar: top.zmin, friction: 0.3}
refinements:
  - r: {near: c, levels: 2}
END
timeout -s KILL 120 "$contact" nested.yaml -quiet || echo "friction over hanging vertices: exit code $?"
"$contact" hertz.yaml -quiet -refine 1 -summary uniform.json
"$contact" hertz_by_hand.yaml -quiet -summary hand.json
"$PYTHON" "$AMGF_DIR/tests/run/refinement.py" judge
"$contact" slide.yaml -scene_check | sed -n '/^Bodies/,/  total:/p; /^Refinements/,/hang/p'
# try NAME FROM TO: the sentence where a scene has something else
try() {
  sed "s/$2/$3/" slide.yaml > other.yaml
  echo "$1: $("$contact" other.yaml -quiet 2>&1 || echo "exit code $?")"
}
try "no such pair" "near: touch" "near: touching"
try "no such face" "near: touch" "near: base.top"
try "nothing" "near: touch, " ""
try "half a box" "near: touch" "lower: [0, 0, 0]"
try "a box inside out" "near: touch" "lower: [0, 1, 0], upper: [1, 0, 0]"
try "no levels" "levels: 2" "levels: 0"
try "too many levels" "levels: 2" "levels: 50"
try "levels in words" "levels: 2" "levels: two"
try "negative" "distance: 0.2" "distance: -0.2"
try "far away" "distance: 0.2" "distance: 0.001"
try "a box that meets no cell" "near: touch" "lower: [5, 5, 5], upper: [6, 6, 6]"
try "a box that misses the body it names" "near: touch" "lower: [-2, -2, 0.4], upper: [2, 2, 4], body: base"
sed 's/near: touch, levels: 2, distance: 0.2/lower: [2, -2, -2], upper: [3, 2, 4], body: base/' slide.yaml > other.yaml
"$contact" other.yaml -scene_check | grep "hang" \
  # a box that touches the body at its border refines what it touches, as the documents say
try "misspelt" "distance: 0.2" "distanse: 0.2"
try "no such body" "near: touch" "lower: [0, 0, 0], upper: [1, 1, 1], body: bass"
try "order 2" "young: 10," "young: 10, order: 2,"
sed 's/near: top.zmin/near: top.zmin, levels: 1}\n  - spot: {lower: [0, 0, 1], upper: [0.5, 0.5, 1.1], body: top/
  s/near: top.zmin, levels: 1/near: top.zmax, levels: 1/' tied.yaml > other.yaml
echo "tied where it hangs: $("$contact" other.yaml -quiet 2>&1 || echo "exit code $?")"
mpiexec --oversubscribe -n 3 "$contact" other.yaml -quiet 2>&1 | grep -c "contact: error"
# near a rigid surface: the cells of 0.5 whose distance from it is at most 0.2, counted by hand. Each becomes eight.
surface() {
  cat > surface.yaml <<END
bodies:
  - block: {lower: [-2, -2, -4], upper: [2, 2, 0], cells: [8, 8, 8], young: 1000, poisson: 0.3}
  - tool: {$2}
displacements:
  - bottom: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: tool, value: [0, 0, -0.05]}
contact:
  - touch: {mortar: tool.surface, nonmortar: block.zmax}
refinements:
  - fine: {near: touch, levels: 1, distance: 0.2}
END
  "$contact" surface.yaml -scene_check > surface.txt 2>&1
  grep -q " $((512 + 7 * $3)) cells" surface.txt && grep -q "total: $((513 + 7 * $3)) cells" surface.txt &&
    echo "near a rigid $1: yes" ||
    { echo "near a rigid $1: NO"; cat surface.txt; }
}
surface sphere "shape: rigid_sphere, center: [0, 0, 3], radius: 3" 24
surface cone "shape: rigid_cone, tip: [0, 0, 0], direction: [0, 0, 1], half_angle: 60" 4
surface torus "shape: rigid_torus, center: [0, 0, 0.5], direction: [0, 0, 1], radius: 1, section_radius: 0.5" 36
