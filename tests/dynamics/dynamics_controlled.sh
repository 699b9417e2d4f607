# Controlled time steps (tolerance of dynamics): a bar that hits a wall, its flight, error, restart and ranks; a
# pendulum; what is refused
contact=$AMGF_DIR/bin/contact
bar() {
  cat > $1.yaml <<YAML
bodies:
  - wall: {lower: [-0.01, -0.02, -0.02], upper: [0, 0.04, 0.04], cells: [1, 1, 1], material: rigid}
  - bar: {lower: [0.002, 0, 0], upper: [0.202, 0.02, 0.02], cells: [10, 1, 1], young: 2e11, poisson: 0, element: full,
          density: 8000, initial_velocity: [-100, 0, 0]}
displacements:
  - hold: {body: wall, value: [0, 0, 0]}
symmetry: [bar.ymin, bar.zmin]
contact:
  - hit: {mortar: wall.xmax, nonmortar: bar.xmin}
dynamics: {end_time: 130e-6, $2}
YAML
}
pendulum() {
  cat > $1.yaml <<YAML
bodies:
  - cube: {lower: [0, 0, -1], upper: [0.2, 0.2, 0], cells: [1, 1, 1], material: rigid, density: 1}
  - other: {lower: [5, 0, 0], upper: [6, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0, density: 1}
displacements:
  - free: {body: cube, value: [0, 0, 0], rotation: [0, free, 0], center: [0.1, 0.1, 0]}
  - fix: {face: other.xmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: cube, value: [5, 0, -9.81]}
load: {expression: "1"}
dynamics: {end_time: 1.5, $2}
YAML
}
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "$1: exit $?"; cat err; }; }
bar loose 'time_step: 20e-6, tolerance: 2e-2'
bar tight 'time_step: 20e-6, tolerance: 5e-3'
bar alpha 'time_step: 20e-6, tolerance: 2e-2, scheme: generalized_alpha'
bar fine 'time_step: 1e-6'
pendulum swing 'time_step: 0.25, tolerance: 1e-2'
pendulum swing_tight 'time_step: 0.25, tolerance: 2e-3'
pendulum swing_fine 'time_step: 0.01'
for scene in loose tight alpha fine swing swing_tight swing_fine; do run $scene.yaml -summary $scene.json; done
run loose.yaml -checkpoint loose.h5 -checkpoint_every 4
run loose.yaml -restart loose.h5 -summary restart.json
mpiexec --oversubscribe -n 2 "$contact" loose.yaml -quiet -error_estimate 0 -summary ranks.json
"$contact" loose.yaml -error_estimate 0 -tables_view | grep -c '^time steps: .* were repeated$'
"$PYTHON" - <<'PY'
from summaries import load, say, within


def runs(name):
    steps = load(name)["steps"]
    return steps, [step["motions"][0] for step in steps]


def error(name, fine, key):
    at = {round(step["time"], 12): key(step) for step in load(fine)["steps"]}
    steps = load(name)["steps"]
    times = [min(at, key=lambda t: abs(t - step["time"])) for step in steps]
    return max(abs(key(step) - at[t]) for step, t in zip(steps, times)) / max(map(abs, at.values()))


momentum = lambda step: step["motions"][0]["momentum"][0]
for name, tolerance in ("loose", 2e-2), ("tight", 5e-3):
    steps, motions = runs(name)
    say("%s: load steps are equal and end at the end time" % name,
        len(steps) == 7 and all(within(step["time"], 130e-6 * (k + 1) / 7, 1e-12) for k, step in enumerate(steps)),
        [step["time"] for step in steps])
    say("flies to the wall in one time step", steps[0]["substeps"] == 1 and motions[0]["rejected_steps"] == 0,
        steps[0]["substeps"])
    say("time steps are taken back where it hits, and none at the end is above the tolerance",
        motions[1]["rejected_steps"] > 0 and 0 < max(m["time_error"] for m in motions) <= tolerance,
        [(m["rejected_steps"], m["time_error"]) for m in motions])
    total = [m["total_energy"] for m in motions]
    say("energy never grows, and what the impact takes is below half of the tolerance",
        all(b <= a * (1 + 1e-12) for a, b in zip(total, total[1:])) and total[-1] > (1 - tolerance / 2) * total[0],
        total)
    n = sum(step["substeps"] for step in steps)
    say("at most two thirds of the steps of even length", n < 2 / 3 * 130e-6 / min(m["shortest_step"] for m in motions),
        n)
late = [load(name)["steps"][-1]["motions"][0]["momentum"][0] for name in ("loose", "tight", "fine")]
say("momentum of the rebound: that of fine time steps to the tolerance",
    within(late[0], late[2], 2e-2) and within(late[1], late[2], 5e-3), late)
say("generalized-alpha, too", within(load("alpha")["steps"][-1]["motions"][0]["momentum"][0], late[2], 0.02),
    load("alpha")["steps"][-1]["motions"][0]["momentum"])
for name in "restart", "ranks":
    steps, whole = load(name)["steps"], {step["step"]: step for step in load("loose")["steps"]}
    same = all(
        within(momentum(step), momentum(whole[step["step"]]), 1e-6)
        and step["substeps"] == whole[step["step"]]["substeps"] for step in steps)
    say("%s: the same time steps and momentum" % name, same and len(steps) == {"restart": 3, "ranks": 7}[name],
        [(step["substeps"], momentum(step)) for step in steps])
kinetic = lambda step: step["motions"][0]["kinetic_energy"]
loose, tight = error("swing", "swing_fine", kinetic), error("swing_tight", "swing_fine", kinetic)
say("pendulum: error of the kinetic energy below 5 %, and in proportion to the tolerance", loose < 0.05
    and tight < loose / 2, (loose, tight))
PY
for tolerance in -1 2; do
  bar bad "time_step: 20e-6, tolerance: $tolerance"; "$contact" bad.yaml -quiet 2>&1; echo "exit $?"
done
