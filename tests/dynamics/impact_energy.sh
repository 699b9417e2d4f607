# A block falls on a plane: nodes with mass lose energy when they hit it. The numerical dissipation has it, and the run
# warns. Without friction these nodes have no mass, and no energy is lost.
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
CHECK
