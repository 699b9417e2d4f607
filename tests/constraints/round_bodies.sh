# Round bodies that nothing but weak springs holds against a rotation about their axis: one sentence names body and
# axis, and the run goes on. A torque on such a body ends the run. The hub is rigid; the weight presses the bush into
# it.
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B "$AMGF_DIR/tests/constraints/round_bodies.py" ring.msh
{
  cat <<'END'
bodies:
  - hub: {shape: gmsh, mesh: ring.msh, volume: hub, material: rigid}
  - bush: {shape: gmsh, mesh: ring.msh, volume: bush, young: 2.1e5, poisson: 0.3}
displacements:
  - hub: {body: hub, value: [0, 0, 0]}
  - end: {face: bush.bush_end, value: [free, free, 0]}
body_forces: [weight: {body: bush, value: [-1, 0, 0]}]
contact: auto
END
} > facets.yaml
tube='tube_arc, axis: z, radii: [5, 8], angles: [0, 360], extent: [0, 4], cells: [1, 24, 2]'
sed -e "s/shape: gmsh.*material/shape: $tube, material/" \
  -e 's/shape: gmsh.*young/shape: cylinder, axis: z, radius: 4.99, extent: [0, 4], cells: [3, 3, 2], young/' \
  -e 's/bush_end/lmin/' facets.yaml > cylinder.yaml
sed 's/^contact/weak_springs: true\ncontact/' facets.yaml > weak.yaml
moment='forces: [turn: {face: bush.lmin, value: [0, 0, 0], moment: [0, 0, 50]}]'
sed "s/^contact/$moment\ncontact/" cylinder.yaml > turned.yaml
for scene in facets cylinder weak turned; do
  ranks=1
  [ $scene != cylinder ] || ranks=3
  mpiexec --oversubscribe -n $ranks "$contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json > said 2>&1
  code=$?
  grep '^contact:' said | grep -v 'do not converge\|penetrates'
  echo "$scene: exit code $code"
done
"$contact" weak.yaml -error_estimate 0 | grep 'can turn'
# A pin joins two plates and can turn about its axis. The linearized gap does not resist this rotation; a proximal term
# limits it.
cat > lap.yaml <<'END'
bodies:
  - plate1:
      {shape: holed_box, axis: z, lower: [-20, -10, 0], upper: [15, 10, 4], radius: 5.05, cells: [6, 4, 2],
       young: 2.1e5, poisson: 0.3}
  - plate2:
      {shape: holed_box, axis: z, lower: [-15, -10, 4], upper: [20, 10, 8], radius: 5.05, cells: [6, 4, 2],
       young: 2.1e5, poisson: 0.3}
  - pin: {shape: cylinder, axis: z, radius: 5, extent: [0, 8], cells: [5, 3, 4], young: 2.1e5, poisson: 0.3}
displacements:
  - hold: {face: plate1.xmin, value: [0, 0, 0]}
  - pull: {face: plate2.xmax, value: [0.3, 0, 0]}
contact: auto
weak_springs: true
END
for level in 0 1; do # seconds of the processor: far more than it takes
  (ulimit -t 60 && "$contact" lap.yaml -refine $level -quiet -error_estimate 0 -summary lap_$level.json 2>&1) |
    grep -v 'penetrates'
  echo "lap joint, refinement $level: exit code ${PIPESTATUS[0]}"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

for scene in ("facets", "cylinder", "weak"):
    run = load(scene)["steps"][-1]
    pair = run["pairs"][0]
    say(f"{scene}: the contact carries the weight, and the weak springs nothing",
        within(pair["force"][0], -run["reaction"][0] if pair["force"][0] < 0 else run["reaction"][0], 1e-4) and
        run["weak_spring_force"] < 1e-4 * pair["normal_force"], (pair, run["reaction"], run["weak_spring_force"]))
coarse, fine = (load(f"lap_{level}")["steps"][-1] for level in (0, 1))
for level, run in enumerate((coarse, fine)):  # on the fine mesh that method takes more than 1,100 applications
    say(f"lap joint, refinement {level}: the interior point method is not needed", run["amg_applications"] < 400,
        run["amg_applications"])
say("lap joint: the force changes little with the mesh", within(coarse["reaction"][0], fine["reaction"][0], 0.1),
    (coarse["reaction"], fine["reaction"]))
CHECK
