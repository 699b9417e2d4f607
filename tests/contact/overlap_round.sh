# Rollers that touch a third one along lines do not overlap, although the mean gap of coarse facets counts the far
# sides; a roller inside another one does
contact=$AMGF_DIR/bin/contact
rollers() {
  cat > rollers.yaml <<YAML
bodies:
  - sun: {shape: cylinder, axis: z, radius: 3, extent: [0, 2], cells: [4, 3, 2], young: 1000, poisson: 0.3}
  - planet: {shape: cylinder, axis: z, center: [-2.5, -4.330127018922193, 0], radius: 2, extent: [0, 2],
             cells: [4, 2, 2], young: 1000, poisson: 0.3}
  - other: {shape: cylinder, axis: z, center: [$1, 0, 0], radius: 2, extent: [0, 2], cells: [4, 2, 2], young: 1000,
            poisson: 0.3}
displacements:
  - hold: {face: sun.lmin, value: [0, 0, 0]}
  - push: {face: planet.lmin, value: [0.05, 0.0866025, 0]}
  - pull: {face: other.lmin, value: [-0.1, 0, 0]}
contact:
  - one: {mortar: sun.surface, nonmortar: planet.surface}
  - two: {mortar: sun.surface, nonmortar: other.surface}
load: {steps: 1}
YAML
  "$contact" rollers.yaml -scene_check > out 2>&1 ||
    { echo "exit $?"; grep -o 'contact pair "two".*overlap at the start' out; }
}
echo "rollers that touch:"; rollers 5
echo "a roller 2.5 deep in another one:"; rollers 2.5
# A post whose top is inside a block, between the vertices of the block's facets
post() {
  cat > post.yaml <<YAML
bodies:
  - post: {lower: [0.4, 0.4, -1], upper: [0.6, 0.6, $1], cells: [1, 1, 3], young: 1000, poisson: 0.3}
  - block: {lower: [0, 0, 0], upper: [1, 1, 2], cells: [1, 1, 2], young: 1000, poisson: 0.3}
displacements: [foot: {face: post.zmin, value: [0, 0, 0]}, head: {face: block.zmax, value: [0, 0, -0.001]}]
contact: [pair: {mortar: post.zmax, nonmortar: block.zmin}]
YAML
  mpiexec --oversubscribe -n $2 "$contact" post.yaml -scene_check > out 2>&1 ||
    { echo "exit $?"; grep -o 'contact pair "pair".*overlap at the start' out; }
}
for ranks in 1 3; do
  echo "a post under a block, $ranks ranks:"; post 0 $ranks
  echo "1.2 deep in it:"; post 1.2 $ranks
done
