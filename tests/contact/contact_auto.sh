# contact: auto finds the pairs that a scene would list, on any number of ranks: faces of shapes, surfaces without
# names, thin plates in a stack, a block that slides onto the next body. Rules for pairs of bodies, exceptions, ties,
# and what is refused.
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B "$AMGF_DIR/tests/contact/contact_auto.py" write
for name in found bodies settled tied plates excepted slides tower tools bush loose_bush; do
  echo "$name"
  "$contact" "$name.yaml" -scene_check 2>&1 |
    sed -n 's/, gap auto.*//; /^Contact pairs/,/^Load steps/{/^ /p}; /^Ties/,/^Load steps/{/^ /p}; /rror/p' |
    grep -v "facets of mean" | uniq > one
  cat one
  case $name in found | tied | slides) ;; *) continue ;; esac
  mpiexec --oversubscribe -n 3 "$contact" "$name.yaml" -scene_check 2>&1 |
    sed -n 's/, gap auto.*//; /^Contact pairs/,/^Load steps/{/^ /p}; /^Ties/,/^Load steps/{/^ /p}; /rror/p' |
    grep -v "facets of mean" | uniq | cmp one
done
for name in found listed friction friction_listed tied tied_listed tower slides tools tools_listed; do
  "$contact" "$name.yaml" -quiet -summary "$name.json" || echo "$name: exit code $?"
done
"$PYTHON" -B "$AMGF_DIR/tests/contact/contact_auto.py" judge
for name in wrong_body wrong_face wrong_side wrong_key no_side far all_excepted partly_tied untied wrong_tool; do
  "$contact" "$name.yaml" -quiet 2>&1 || echo "exit code $?"
done
