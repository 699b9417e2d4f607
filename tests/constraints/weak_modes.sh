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
run() { # ranks, factorization
  mpiexec --oversubscribe -n $1 "$contact" stack.yaml -tao_ipfilter_pc_amgf_factor $2 -quiet -error_estimate 0 \
    -summary $2_$1.json
}
run 1 true && run 1 false && run 2 false
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
# Half a ball on weak springs between inclined planes. The solver has to reduce its search directions. The forces are
# those of Hertz
cat > ball.yaml <<'SCENE'
bodies:
  - shaft: {shape: rigid_plane, point: [1.4142135623730951, 0, -1.4142135623730951], normal: [1, 0, -1]}
  - ball: {shape: ball, center: [2.121320343559643, 0, -2.121320343559643], octant: [2, 1, 2], radius: 1,
           patches: [3, 3, 3], layers: 3, young: 1, poisson: 0.3}
  - pad: {shape: rigid_plane, point: [2.8284271247461903, 0, -2.8284271247461903], normal: [-1, 0, 1]}
displacements:
  - hold: {body: pad, value: [0, 0, 0]}
  - load: {body: shaft, value: [0.004, 0, -0.004]}
symmetry: [ball.y0]
weak_springs: true
equations:
  - centre: {body: ball, point: [2.121320343559643, 0, -2.121320343559643], direction: [1, 0, 1]}
  - radius: {body: ball, point: [1.4142135623730951, 0, -1.4142135623730951], direction: [1, 0, 1]}
contact:
  - in: {mortar: shaft.surface, nonmortar: ball.surface}
  - out: {mortar: pad.surface, nonmortar: ball.surface}
refinements:
  - iw: {near: in, levels: 2, distance: 0.04}
  - ic: {near: in, levels: 4, distance: 0.008}
  - ow: {near: out, levels: 2, distance: 0.04}
  - oc: {near: out, levels: 4, distance: 0.008}
SCENE
"$contact" ball.yaml -quiet -error_estimate 0 -summary ball.json || echo "ball: exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

for n in (1, 2):
    amg, factored = (load(name)["steps"][-1] for name in (f"false_{n}", "true_1"))
    say(f"{n} ranks: few applications of AMG", amg["amg_applications"] < 50, amg["amg_applications"])
    say(f"{n} ranks: the force is that of a factorization",
        within(amg["reaction"][2], factored["reaction"][2], 1e-6), (amg["reaction"], factored["reaction"]))
for young in ("1", "2e5", "1e8"):
    step = load(f"plate_{young}")["steps"][-1]
    say(f"contact carries the plate of E = {young}", within(step["pairs"][0]["force"][2], -0.0064, 1e-6), step["pairs"])
forces = [pair["normal_force"] for pair in load("ball")["steps"][-1]["pairs"]]
hertz = 0.5 * 4 / 3 / (1 - 0.3**2) * (0.004 / 2**0.5)**1.5
say("ball: Hertz's force on both sides", within(forces[0], forces[1], 1e-6) and within(forces[0], hertz, 0.05), forces)
CHECK
