# Bodies and faces that are moved, against closed forms: a rigid mass, the base of an elastic cell with consistent mass,
# the base of a damper, also after a restart; a body whose initial velocity is that of its prescribed motion
contact=$AMGF_DIR/bin/contact
ALPHA="scheme: generalized_alpha, spectral_radius"
rigid() {
  cat > $1.yaml <<YAML
bodies:
  - mass: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], material: rigid, density: 1000, initial_velocity: $4}
  - other: {lower: [5, 0, 0], upper: [6, 1, 1], cells: [1, 1, 1], young: 1000, poisson: 0.3, density: 1}
displacements:
  - drive: {body: mass, value: [1, 0, 0], ramp: drive}
ramps:
  - drive: {expression: "$3"}
dynamics: {time_step: 0.02, end_time: 0.4, $2}
YAML
}
rigid rigid_impact "scheme: impact" "t^2" "[0, 0, 0]"
rigid rigid_alpha "$ALPHA: 0.8" "t^2" "[0, 0, 0]"
rigid moving_impact "scheme: impact" t "[1, 0, 0]"
rigid moving_alpha "$ALPHA: 0.8" t "[1, 0, 0]"
for scheme in impact alpha; do
  [ $scheme = impact ] && choice="scheme: impact" || choice="$ALPHA: 1"
  cat > base_$scheme.yaml <<YAML
bodies:
  - cell: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], element: full, young: 1e5, poisson: 0, density: 1000}
symmetry: [cell.xmin, cell.ymin]
displacements:
  - drive: {face: cell.zmin, value: [free, free, 1], ramp: drive}
ramps:
  - drive: {expression: "t^2"}
probes:
  - top: {point: [1, 1, 1]}
dynamics: {time_step: 0.002, end_time: 0.4, $choice, mass: consistent}
YAML
  for step in 0.02 0.01; do
    cat > damper_${scheme}_$step.yaml <<YAML
bodies:
  - base: {lower: [-1, 0, 0], upper: [0, 1, 1], cells: [1, 1, 1], material: rigid}
  - mass: {shape: rigid_sphere, center: [3, 0.5, 0.5], radius: 0.5, mass: 2}
displacements:
  - guide: {body: mass, value: [free, 0, 0], rotation: [0, 0, 0], center: [3, 0.5, 0.5]}
  - drive: {body: base, value: [0.1, 0, 0], ramp: drive}
connectors:
  - spring: {body: mass, point: [3, 0.5, 0.5], to: base, to_point: [0, 0.5, 0.5], stiffness: 50, damping: 2}
ramps:
  - drive: {expression: "1-cos(3*t)"}
dynamics: {time_step: $step, end_time: 1, $choice}
YAML
  done
done
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
for scene in rigid_* moving_* base_* damper_*; do run $scene -summary ${scene%.yaml}.json -checkpoint_every 35 \
  -checkpoint ${scene%.yaml}.h5; done
run damper_alpha_0.02.yaml -restart damper_alpha_0.02.h5 -summary again.json
"$PYTHON" - <<'CHECK'
import cmath
import math
from summaries import load, say

lost = lambda step: abs(step["motions"][0]["numerical_dissipation"])
for scheme in "impact", "alpha":
    steps = load("rigid_" + scheme)["steps"]
    say(f"{scheme}: a mass of 1000 with the acceleration 2 needs the force 2000 in each step",
        all(abs(step["reaction"][0] - 2000) < 1e-6 for step in steps), [step["reaction"] for step in steps])
    say(f"{scheme}: energy is accounted for to 1 %", lost(steps[-1]) < 0.01 * steps[-1]["work"], lost(steps[-1]))
    steps = load("moving_" + scheme)["steps"]
    say(f"{scheme}: a body that already has the prescribed velocity needs no force",
        all(abs(step["reaction"][0]) < 1e-6 for step in steps), [step["reaction"] for step in steps])
    mass, stiffness, off, pull = 1000, 1e5, [], []
    frequency = math.sqrt(3 * stiffness / mass)
    for step in load("base_" + scheme)["steps"]:
        phase = frequency * step["time"]
        off.append(step["probes"][0]["displacement"][2] - step["time"]**2 + mass / stiffness * (1 - math.cos(phase)))
        # momentum: force on the base = mass (2 + half the acceleration of the top relative to the base)
        pull.append(step["reaction"][2] - mass * (2 - 1.5 * math.cos(phase)))
    say(f"{scheme}: the top of a cell on a driven base, to 0.1 % of its largest displacement",
        max(map(abs, off)) < 2e-5, max(map(abs, off)))
    say(f"{scheme}: force on that base, to 2 %", max(map(abs, pull)) < 70, max(map(abs, pull)))
    m, c, k, a, w, t = 2, 2, 50, 0.1, 3, 1
    decay, ratio = c / (2 * m), (k + 1j * c * w) / (k - m * w * w + 1j * c * w)
    own, x0, v0 = math.sqrt(k / m - decay**2), -a + (ratio * a).real, (1j * w * ratio * a).real
    free = x0 * math.cos(own * t) + (v0 + decay * x0) / own * math.sin(own * t)
    exact = a - (ratio * a * cmath.exp(1j * w * t)).real + math.exp(-decay * t) * free
    errors = [
        load(f"damper_{scheme}_{step}")["steps"][-1]["rigid_bodies"][1]["position"][0] - 3 - exact
        for step in ("0.02", "0.01")
    ]
    say(f"{scheme}: error of a mass on a driven spring and damper below 0.1 %, order 2 in the time step",
        abs(errors[1]) < 1e-3 * exact and 3.5 < errors[0] / errors[1] < 4.5, (errors, exact))
places = [load(name)["steps"][-1]["rigid_bodies"][1]["position"][0] for name in ("damper_alpha_0.02", "again")]
say("the same after a restart", abs(places[0] - places[1]) < 1e-12, places)
CHECK
