# bin/contact -scene_check on every shipped scene: exit 0, the same words on one rank and on three, and no solve. Then
# one scene in full, and a scene that is wrong.
contact=$AMGF_DIR/bin/contact
for scene in "$AMGF_DIR"/share/scenes/*.yaml; do
  timeout 600 "$contact" "$scene" -scene_check > one 2>&1
  echo "$(basename "$scene"): exit $?, solved: $(grep -c 'Load step 1' one),$(grep '  total:' one)"
done
for name in gmsh_blocks ironing lug; do
  "$contact" "$AMGF_DIR/share/scenes/$name.yaml" -scene_check > one 2>&1
  timeout 600 mpiexec --oversubscribe -n 3 "$contact" "$AMGF_DIR/share/scenes/$name.yaml" -scene_check 2>&1 |
    cmp - one && echo "$name: the same on three ranks"
done
"$contact" "$AMGF_DIR/share/scenes/ironing.yaml" -scene_check -refine 0 -load_steps 20
sed 's/nonmortar: die.outer/nonmortar: die.bottom/' "$AMGF_DIR/share/scenes/ironing.yaml" > wrong.yaml
"$contact" wrong.yaml -scene_check 2>&1
echo "wrong: exit $?"
sed '/wall/d' "$AMGF_DIR/share/scenes/cantilever.yaml" > loose.yaml
"$contact" loose.yaml -scene_check > out 2>&1
echo "loose: exit $?"; cat out
# An assembly of 300 bodies: more keys than PETSc's options database holds
{
  echo "bodies:"
  for i in $(seq 0 2 598); do
    echo "  - block$i: {lower: [$i, 0, 0], upper: [$((i + 1)), 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3}"
  done
  echo "displacements:"
  for i in $(seq 0 2 598); do echo "  - foot$i: {face: block$i.zmin, value: [0, 0, 0]}"; done
} > assembly.yaml
"$AMGF_DIR/bin/contact" assembly.yaml -scene_check | grep -c '^  displacement foot'
# What a scene may have besides: a named material, velocities, friction, a tie, time integration, a long load program
cat > full.yaml <<END
problem: full
units: mm, N, MPa
library: $AMGF_DIR/share/materials/mm_N.yaml
bodies:
  - base: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 1], material: steel, density: 7.85e-9}
  - cover: {lower: [0, 0, 1], upper: [4, 4, 2], cells: [4, 4, 1], material: aluminium, density: 2.7e-9}
  - stone: {lower: [1, 1, 2.1], upper: [2, 2, 3], cells: [2, 2, 2], young: 1000, poisson: 0.2, density: 2e-9,
            initial_velocity: [0, 0, -100], initial_spin: [0, 0, 5]}
displacements:
  - foot: {face: base.zmin, value: [0, 0, 0]}
ties:
  - glue: {mortar: base.zmax, nonmortar: cover.zmin}
contact:
  - hit: {mortar: cover.zmax, nonmortar: stone.zmin, friction: 0.25, friction_ramp: rub, shear_limit: 40}
ramps:
  - rub: {expression: "sin(t * 1e4)"}
dynamics: {time_step: 1e-6, end_time: 100e-6, damping_mass: 3}
END
"$contact" full.yaml -scene_check | sed '/^Contact at/,$d; s/expansion = [^;]*, rho/rho/'
# What the run refuses is refused here, in the same words: a tie whose faces do not cover one another, and all bodies
# that are not held
sed '/^ramps/,$d; /^contact/,/hit/d; s/density: 2e-9,/density: 2e-9}/; /velocity/d' full.yaml > static.yaml
sed 's/upper: \[4, 4, 1\]/upper: [4, 2.5, 1]/; /^ties/i\  - hold: {face: stone.zmin, value: [0, 0, 0]}' static.yaml \
  > short.yaml
sed '/^ties/,/glue/d' static.yaml > free.yaml
cat >> free.yaml <<'END'
symmetry: [stone.xmin, stone.ymin]
END
for name in short free; do
  "$contact" $name.yaml -scene_check > out 2> one; echo "$name: exit $?, $(cat one)"
  "$contact" $name.yaml -quiet > out 2> two; echo "$name: exit $?, $(cmp -s one two && echo same || cat two)"
done
# A rigid tool is described by its surface, not by the cell that stands for it. A displacement that is larger than the
# body that it presses is named where the run fails
cat > tool.yaml <<'YAML'
bodies:
  - slab: {lower: [0, 0, 0], upper: [4, 4, 1], cells: [4, 4, 2], young: 1000, poisson: 0.3}
  - roll: {shape: rigid_cylinder, center: [2, 2, 4], direction: [0, 1, 0], radius: 3}
displacements:
  - foot: {face: slab.zmin, value: [0, 0, 0]}
  - down: {body: roll, value: [0, 0, -6]}
contact:
  - touch: {mortar: roll.surface, nonmortar: slab.zmax}
YAML
"$contact" tool.yaml -scene_check | grep -A1 -E '^  roll|friction$'
"$contact" tool.yaml -quiet > out 2> err; echo "tool: exit $?"
grep -o 'displacement .*' err
