# What is shown of a contact whose nonmortar side is finer and stiffer than the facets of the mortar side under it, and how
# deep vertices are in the other body where the nonmortar side is the coarser one, on one rank and on three.
# coarse_mortar.py has the scenes, and holds their summaries and fields against each other.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/coarse_mortar.py" write
for scene in *.yaml; do
  name=${scene%.yaml}
  "$contact" "$scene" -quiet -output "$name" -summary "$name.json" 2> "$name.log" || echo "$name: exit code $?"
done
for name in stiff rubs mean; do
  mpiexec --oversubscribe -n 3 "$contact" $name.yaml -quiet -output ${name}_3 -summary ${name}_3.json 2> "${name}_3.log" || echo "$name, three ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/contact/coarse_mortar.py" judge
# A ball pressed into facets larger than its contact, which carry no force
cat > ball.yaml <<'END'
bodies:
  - base: {lower: [0, 0, 0], upper: [10, 10, 8], cells: [4, 4, 3], young: 210000, poisson: 0.3}
  - ball: {shape: ball, center: [10, 10, 18], octant: [-1, -1, -1], radius: 10, patches: [3, 3, 3], layers: 3, young: 210000, poisson: 0.3}
symmetry: [ball.x0, ball.y0, base.xmax, base.ymax, base.zmin]
displacements:
  - push: {face: ball.z0, value: [free, free, -0.05]}
contact:
  - touch: {mortar: base.zmax, nonmortar: ball.surface}
END
"$contact" ball.yaml -quiet 2>&1 | grep -o 'though the gap is .*'
