# Warnings of a model that is used beyond what it can do, and none where it is not: a linear law strained or turned far,
# a contact of one facet whose force swings, a nonmortar side that is coarser than the mortar side and not softer.
contact=$AMGF_DIR/bin/contact
run() { # name
  "$contact" "$1.yaml" -quiet -summary "$1.json" 2> "$1.log" || echo "$1: exit code $?"
  echo "$1"
  sed 's/^/  /' "$1.log"
}

block() { # name, law, load
  cat > "$1.yaml" <<SCENE
problem: $1
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: $2, young: 210e3, poisson: 0.3}
$3
SCENE
  run "$1"
}
held='symmetry: [block.xmin, block.ymin, block.zmin]'
block pressed_5 linear "$held
displacements:
  - press: {face: block.zmax, value: [free, free, -0.05]}"
block pressed_30 linear "$held
load: {steps: 2}
displacements:
  - press: {face: block.zmax, value: [free, free, -0.3]}"
block pressed_30_neohookean neohookean "$held
load: {steps: 2}
displacements:
  - press: {face: block.zmax, value: [free, free, -0.3]}"
block turned linear "displacements:
  - turn: {face: block.zmin, value: [0, 0, 0], rotation: [0, 30, 0], center: [0, 0, 0]}"

cat > turned_rigid.yaml <<'SCENE'
problem: turned_rigid
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: rigid}
  - held: {lower: [3, 0, 0], upper: [4, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0.3, element: full}
displacements:
  - turn: {body: block, value: [0, 0, 0], rotation: [0, 30, 0], center: [0, 0, 0]}
  - hold: {face: held.zmin, value: [0, 0, 0]}
SCENE
run turned_rigid

# A die slides by half a facet per load step. Its contact is about one facet wide; on the finer mesh it is wider
for cells in 16 48; do
  cat > slide_$cells.yaml <<SCENE
problem: slide
bodies:
  - flat: {lower: [-1, 0, -2], upper: [5, 1, 0], cells: [$cells, 1, 4], young: 100, poisson: 0.3, element: full}
  - die: {shape: tube_arc, axis: y, center: [0.5, 0, 1], radii: [0.5, 1], angles: [90, 270], extent: [0, 1],
          cells: [2, 24, 1], young: 10e3, poisson: 0.3, element: full}
symmetry: [flat.ymin, flat.ymax, die.lmin, die.lmax]
displacements:
  - ground: {face: flat.zmin, value: [0, free, 0]}
  - down: {face: die.inner, value: [free, free, -0.04], ramp: down}
  - along: {face: die.inner, value: [3, free, free], ramp: along}
contact:
  - pair: {mortar: die.outer, nonmortar: flat.zmax}
load: {steps: 7}
ramps:
  - down: {factors: [1, 1, 1, 1, 1, 1, 1]}
  - along: {expression: (t-1)/12}
SCENE
  run slide_$cells
done

# A stiff foot of few facets on a soft block of many: its vertices carry the constraints, or those of the block
sides() { # name, mortar, nonmortar
  cat > "$1.yaml" <<SCENE
problem: $1
bodies:
  - block: {lower: [0, 0, 0], upper: [4, 4, 2], cells: [12, 12, 3], young: 1000, poisson: 0.3, element: full}
  - foot: {lower: [1, 1, 2], upper: [3, 3, 3], cells: [2, 2, 1], young: 2000, poisson: 0.3, element: full}
displacements:
  - ground: {face: block.zmin, value: [0, 0, 0]}
  - press: {face: foot.zmax, value: [0, 0, -0.01]}
contact:
  - pair: {mortar: $2, nonmortar: $3, gap: node}
SCENE
  run "$1"
}
sides coarse block.zmax foot.zmin
sides fine foot.zmin block.zmax

# Blocks with friction that ride side by side without stress: their works are rounding, and no share of them is warned
# of
cat > ride.yaml <<'SCENE'
problem: ride
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], young: 1, poisson: 0.3, element: full}
  - high: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [2, 2, 2], young: 1, poisson: 0.3, element: full}
displacements:
  - carry: {face: low.zmin, value: [0.1, 0.2, 0.3]}
  - follow: {face: high.zmax, value: [0.1, 0.2, 0.3]}
contact:
  - pair: {mortar: low.zmax, nonmortar: high.zmin, friction: 0.3}
SCENE
run ride

# A lid that is pressed through a cube: a linear law lets the cube pass through a thickness of zero. Half of that is
# warned of
for way in 0.5 1.5; do
  cat > lid.yaml <<SCENE
problem: lid
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [4, 4, 4], young: 1000, poisson: 0.3}
  - lid: {lower: [-0.5, -0.5, 1], upper: [1.5, 1.5, 1.2], cells: [4, 4, 1], material: rigid}
displacements:
  - floor: {face: cube.zmin, value: [0, 0, 0]}
  - press: {body: lid, value: [0, 0, -$way]}
contact:
  - touch: {mortar: lid.zmin, nonmortar: cube.zmax}
SCENE
  run lid
done

# Bodies whose stiffnesses differ by more than rounding errors allow
cat > ratio.yaml <<'SCENE'
problem: ratio
bodies:
  - hard: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 2e11, poisson: 0.3}
  - soft: {lower: [-0.5, -0.5, -1], upper: [1.5, 1.5, 0], cells: [4, 4, 2], young: 5e-3, poisson: 0.3}
displacements:
  - base: {face: soft.zmin, value: [0, 0, 0]}
  - press: {face: hard.zmax, value: [0, 0, -0.01]}
contact:
  - pair: {mortar: soft.zmax, nonmortar: hard.zmin}
SCENE
run ratio

# Contact alone holds the stiff body: what the load step fails for is named
for law in "" ", friction: 0.3"; do
  sed "/press:/d; s/hard.zmin}/hard.zmin$law}/" ratio.yaml > ratio_loose.yaml
  echo "tractions: [load: {face: hard.zmax, value: [0, 0, -1e-5]}]" >> ratio_loose.yaml
  [ "$law" ] || echo "symmetry: [hard.xmin, hard.ymin]" >> ratio_loose.yaml
  run ratio_loose
done
