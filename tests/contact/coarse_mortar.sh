# What is shown of a contact whose nonmortar side is finer and stiffer than the facets of the mortar side under it, and
# how deep vertices are in the other body where the nonmortar side is the coarser one, on one rank and on three.
# coarse_mortar.py has the scenes, and holds their summaries and fields against each other.
contact=$AMGF_DIR/bin/contact
rm -f ball.yaml pin.yaml # of an earlier run in this folder
"$PYTHON" "$AMGF_DIR/tests/contact/coarse_mortar.py" write
for scene in *.yaml; do
  name=${scene%.yaml}
  "$contact" "$scene" -quiet -output "$name" -summary "$name.json" 2> "$name.log" || echo "$name: exit code $?"
done
mpiexec --oversubscribe -n 3 "$contact" rubs.yaml -quiet -output rubs_3 -summary rubs_3.json 2> rubs_3.log ||
  echo "three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/coarse_mortar.py" judge
# A ball pressed into facets larger than its contact, which carry no force
cat > ball.yaml <<'END'
bodies:
  - base: {lower: [0, 0, 0], upper: [10, 10, 8], cells: [4, 4, 3], young: 210000, poisson: 0.3}
  - ball: {shape: ball, center: [10, 10, 18], octant: [-1, -1, -1], radius: 10, patches: [3, 3, 3], layers: 3,
           young: 210000, poisson: 0.3}
symmetry: [ball.x0, ball.y0, base.xmax, base.ymax, base.zmin]
displacements:
  - push: {face: ball.z0, value: [free, free, -0.05]}
contact:
  - touch: {mortar: base.zmax, nonmortar: ball.surface}
END
# A pin of eight facets, whose edges are too sharp for a smooth surface, pushed into the wall of its hole
cat > pin.yaml <<'END'
bodies:
  - hub: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 180], extent: [0, 0.2], cells: [3, 24, 1], young: 1000,
          poisson: 0.3}
  - pin: {shape: tube_arc, axis: z, radii: [0.5, 1], angles: [0, 180], extent: [0, 0.2], cells: [2, 4, 1], young: 1000,
          poisson: 0.3}
symmetry: [hub.lmin, hub.lmax, pin.lmin, pin.lmax]
displacements:
  - outer: {face: hub.outer, value: [0, 0, 0]}
  - push: {face: pin.inner, value: [0, 0.02, 0]}
contact:
  - touch: {mortar: hub.inner, nonmortar: pin.outer}
END
for name in ball pin; do
  "$contact" $name.yaml -quiet -summary $name.json 2> $name.log
  code=$?
  inside=$(grep -c 'carries no force, although a point of .* penetrates the other body' $name.log)
  echo "$name: exit code $code, $inside sentence"
done
