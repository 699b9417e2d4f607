# A block falls on a plane: nodes with mass lose energy when they hit it. The numerical dissipation has it, and the run
# warns. Without friction these nodes have no mass, and no energy is lost. A ball slides and rolls on a soft floor:
# after the first contact its normal forces give and take less than 1 % of the energy. A body that flies costs one
# iteration a time step, although it may meet another with friction.
contact=$AMGF_DIR/bin/contact
cat > drop.yaml <<'YAML'
bodies:
  - block: {lower: [0, 0, 0.01], upper: [0.1, 0.1, 0.11], cells: [4, 4, 4], young: 1e7, poisson: 0.3, density: 1000,
            initial_velocity: [0, 0, -0.5]}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1], material: rigid}
displacements:
  - floor: {body: floor, value: [0, 0, 0]}
contact:
  - hit: {mortar: floor.surface, nonmortar: block.zmin, friction: 0.3}
dynamics: {time_step: 5e-4, end_time: 0.03}
YAML
sed 's/, friction: 0.3//' drop.yaml > smooth.yaml
for scene in drop smooth; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2>&1 | grep -o "normal forces of contact have taken"
done
cat > ball.yaml <<'YAML'
bodies:
  - floor: {lower: [-0.15, 0, -0.1], upper: [0.35, 0.1, 0], cells: [20, 4, 2], material: neohookean, young: 4e4,
            poisson: 0.3, density: 100}
  - ball: {shape: rigid_sphere, center: [0, 0, 0.085], radius: 0.1, mass: 4, material: rigid,
           initial_velocity: [2, 0, 0]}
symmetry: [floor.ymin]
displacements:
  - base: {face: floor.zmin, value: [0, 0, 0]}
  - ball: {body: ball, value: [free, 0, free], rotation: [0, free, 0], center: [0, 0, 0.085]}
forces:
  - weight: {body: ball, value: [0, 0, -20]}
contact:
  - roll: {mortar: ball.surface, nonmortar: floor.zmax, friction: 0.5, interference: true}
dynamics: {time_step: 0.01, end_time: 0.09, mass: lumped}
YAML
"$contact" ball.yaml -quiet -error_estimate 0 -summary ball.json 2> /dev/null || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say

energy = 0.5 * 1000 * 0.1**3 * 0.5**2
for name, least, most in ("drop", 1e-2, 1e-1), ("smooth", -1e-9, 1e-9):
    last = load(name)["steps"][-1]
    motion = last["motions"][0]
    lost = energy - motion["total_energy"] - last["dissipated"]
    say(name + ": what is lost", least < lost / energy < most, lost / energy)
    say(name + ": is the numerical dissipation", abs(motion["numerical_dissipation"] - lost) < 1e-9 * energy,
        (motion["numerical_dissipation"], lost))
flying = [step["ip_iterations"] for step in load("drop")["steps"][:30]]
say("drop: one iteration a time step before contact", max(flying) == 1, flying)
steps = load("ball")["steps"]
given = [step["normal_work"] - steps[1]["normal_work"] for step in steps[1:]]
say("ball: normal forces do no work", max(map(abs, given)) < 0.01 * 0.5 * 4 * 2**2, given)
spare = [step["motions"][0]["numerical_dissipation"] for step in steps]
say("ball: the rest of the balance", max(map(abs, spare)) < 1e-4 * 0.5 * 4 * 2**2, spare)
CHECK
