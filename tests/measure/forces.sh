# Forces by pair, face and body against statics, one on three ranks: a peg that three faces guide, a stack of
# three blocks, a ball in a box, a flat punch whose edge lies anywhere in the facets under it. Then what an older run
# leaves. forces.py has the scenes, and holds their summaries and fields against the weights.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/measure/forces.py" write

# One linearization of the gap: the statics are those of the undeformed faces, whose normals do not tilt
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -output $2 -tao_ipfilter_tol 1e-12 -contact_updates 1 || echo "$2: exit code $?"
}
for scene in stack ball; do run 1 $scene; done
for scene in peg; do run 3 $scene; done
for punch in punch_*.yaml; do
  name=${punch%.yaml}
  "$contact" "$punch" -quiet -output "$name" -summary "$name.json" -tao_ipfilter_tol 1e-9 || echo "$name: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/measure/forces.py" judge

"$contact" peg.yaml -quiet -output again -load_steps 3
"$contact" peg.yaml -quiet -output again -load_steps 1
echo "a run of one step after one of three:" again*
cp again_0001.h5 again_0002.h5 # as an older run leaves it that was killed
PYTHONPATH=$AMGF_DIR/share/python "$PYTHON" -B \
  -c 'from contact.files import Files; print("load steps to draw:", Files("again").files)'

# A rubber block between two plates to which it is tied, and a block with opposite pressures between two springs: the
# forces on a body cancel, but they are no rounding errors, to which its residual would be compared
cat > between.yaml <<YAML
bodies:
  - pad: {lower: [0, 0, 0], upper: [2, 1, 0.5], cells: [6, 3, 3], young: 10, poisson: 0.45, material: neohookean}
  - below: {lower: [-1, -0.5, -0.3], upper: [3, 1.5, 0], cells: [3, 2, 1], material: rigid}
  - above: {lower: [-1, -0.5, 0.5], upper: [3, 1.5, 0.8], cells: [4, 2, 1], material: rigid}
  - block: {lower: [9, 0, 0], upper: [10, 1, 1], cells: [2, 2, 2], young: 10, poisson: 0.3}
ties: [lower: {mortar: below.zmax, nonmortar: pad.zmin}, upper: {mortar: above.zmin, nonmortar: pad.zmax}]
displacements:
  - stand: {body: below, value: [0, 0, 0]}
  - press: {body: above, value: [0.1, 0, -0.05]}
springs: [left: {face: block.xmin, value: [1, 1, 1]}, right: {face: block.xmax, value: [1, 1, 1]}]
pressures: [left: {face: block.xmin, value: 1}, right: {face: block.xmax, value: 1}]
YAML
"$contact" between.yaml -quiet -summary between.json
"$PYTHON" - <<'PY'
from summaries import load, say

for body in load("between")["steps"][0]["bodies"]:
    say(f"between: forces on {body['name']} are in equilibrium to 1e-9", body["balance"] < 1e-9, body["balance"])
PY
