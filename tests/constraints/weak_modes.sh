# A stack of twelve bars that only weak springs hold along the contact faces, with AMG: the rigid body modes are in the
# search space, so that it takes hardly more applications than one bar. The solution is that of a factorization.
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - > stack.yaml <<'SCENE'
print("bodies:")
for i in range(12):
    x, y = 0.1 * (i % 2), 0.1 * (i % 3)
    print(f"  - b{i}: {{lower: [{x}, {y}, {2 * i}], upper: [{1 + x}, {1 + y}, {2 * i + 2}], cells: [5, 5, 10],",
          f"young: {10000 if i % 3 else 30000}, poisson: 0.3}}")
print("displacements:")
print("  - foot: {face: b0.zmin, value: [0, 0, 0]}")
print("  - top: {face: b11.zmax, value: [0, 0, -0.01]}")
print("contact: auto\nweak_springs: true\ncontact_updates: 1")
SCENE
for n in 1 3; do
  for factor in false true; do
    mpiexec --oversubscribe -n $n "$contact" stack.yaml -tao_ipfilter_pc_amgf_factor $factor -quiet -error_estimate 0 \
      -summary ${factor}_$n.json
  done
done
# A steel plate on rubber: its springs are weak beside the rubber
for young in 1 2e5 1e8; do
  cat > plate.yaml <<SCENE
bodies:
  - rubber: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], young: 1, poisson: 0.3}
  - plate: {lower: [0.1, 0.1, 1], upper: [0.9, 0.9, 2], cells: [2, 2, 2], young: $young, poisson: 0.3}
displacements: [foot: {face: rubber.zmin, value: [0, 0, 0]}]
tractions: [load: {face: plate.zmax, value: [0, 0, -0.01]}]
contact: [rest: {mortar: plate.zmin, nonmortar: rubber.zmax}]
weak_springs: true
SCENE
  "$contact" plate.yaml -quiet -error_estimate 0 -summary plate_$young.json || echo "plate, $young: exit code $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

for n in (1, 3):
    amg, factored = (load(f"{factor}_{n}")["steps"][-1] for factor in ("false", "true"))
    say(f"{n} ranks: few applications of AMG", amg["amg_applications"] < 50, amg["amg_applications"])
    say(f"{n} ranks: the force is that of a factorization",
        within(amg["reaction"][2], factored["reaction"][2], 1e-6), (amg["reaction"], factored["reaction"]))
for young in ("1", "2e5", "1e8"):
    step = load(f"plate_{young}")["steps"][-1]
    say(f"contact carries the plate of E = {young}", within(step["pairs"][0]["force"][2], -0.0064, 1e-6), step["pairs"])
CHECK
