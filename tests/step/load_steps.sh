# A scene without contact takes no optimizer and gives the exact energy; a step that fails says so, exits with another
# code than 0, and leaves what was written before it.
contact=$AMGF_DIR/bin/contact
cat > bar.yaml <<'YAML'
problem: bar
bodies:
  - bar: {shape: box, lower: [0, 0, 0], upper: [1, 2, 3], cells: [2, 3, 4], young: 10, poisson: 0.3}
displacements:
  - x: {face: bar.xmin, value: [0, free, free]}
  - y: {face: bar.ymin, value: [free, 0, free]}
  - z: {face: bar.zmin, value: [free, free, 0]}
  - pull: {face: bar.zmax, value: [free, free, 0.03]}
load: {steps: 2}
YAML
for ranks in 1 3; do
  launch=()
  [ "$ranks" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$ranks")
  "${launch[@]}" "$contact" bar.yaml -quiet -summary bar.json -log_view :bar.log
  echo "$ranks: exit $?, optimizer used: $(grep -c TaoIPFltSolve bar.log)," \
    "contact searched: $(grep -c ContactSearch bar.log)"
  # E e^2/2 per volume, e = 0.005 and 0.01, volume 6; force 10 e x area 2
  "$PYTHON" - <<'PY'
import json
for step, e in zip(json.load(open("bar.json"))["steps"], (0.005, 0.01)):
    print("  energy %s, force %s" %
          tuple(abs(a / b - 1) < 1e-8 for a, b in ((step["energy"], 30 * e * e), (step["reaction"][2], 20 * e))))
PY
done
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -output good -load_steps 1 &&
  cp good_0001.h5 before.h5
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -output good -load_steps 1 \
  -tao_ipfilter_subspace false -tao_max_it 2 -load_max_cuts 0 2> err # directions of the subspace are no steps
code=$?
said=$(grep -c 'contact: load step 1 failed: iteration limit 2 reached' err)
echo "failed step: exit $code, $said sentence," \
  "old file intact: $(cmp -s good_0001.h5 before.h5 && echo yes || echo no)"
# -summary through a link: what it leads to stays until there is a new one
echo kept > target.json && ln -sf target.json link.json
"$contact" bar.yaml -quiet -summary link.json -accuracy 2 2> err
echo "failed run, summary through a link: exit $?, old file $(cat target.json)"
