# bin/contact -scene_check on every shipped scene: exit 0, the same words on one rank and on three, and no solve. Then
# one scene in full, and a scene that is wrong.
contact=$AMGF_DIR/bin/contact
for scene in "$AMGF_DIR"/share/scenes/*.yaml; do
  timeout 600 "$contact" "$scene" -scene_check > one 2>&1
  codes=$?
  timeout 600 mpiexec --oversubscribe -n 3 "$contact" "$scene" -scene_check > three 2>&1
  codes="$codes $?"
  echo "$(basename "$scene"): exit $codes, $(cmp -s one three && echo same || echo different)," \
    "solved: $(grep -c 'Load step 1' one),$(grep '  total:' one)"
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
