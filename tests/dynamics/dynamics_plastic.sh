# A bar of copper hits a rigid wall (Taylor's test) and yields: kinetic, elastic and plastic energy add up; the same bar
# without yield, and at small strain; on two ranks, and from a checkpoint within the impact
contact=$AMGF_DIR/bin/contact
bar() {
  cat <<YAML
bodies:
  - wall: {lower: [-0.01, -0.02, -0.02], upper: [0, 0.04, 0.04], cells: [1, 1, 1], material: rigid}
  - bar: {lower: [0.0001, 0, 0], upper: [0.0325, 0.0032, 0.0032], cells: [6, 1, 1], young: 117e9, poisson: 0.35, $1,
          density: 8930, element: bbar, initial_velocity: [-150, 0, 0]}
symmetry: [bar.ymin, bar.zmin]
displacements:
  - fix: {body: wall, value: [0, 0, 0]}
contact:
  - hit: {mortar: wall.xmax, nonmortar: bar.xmin}
probes:
  - end: {point: [0.0325, 0, 0], body: bar}
dynamics: {time_step: 1.5e-6, end_time: $2}
YAML
}
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
bar "material: j2_finite, yield: 400e6, hardening: 100e6" 30e-6 > metal.yaml
bar "material: j2_finite, yield: 400e12, hardening: 100e6" 15e-6 > elastic.yaml
bar "material: j2, yield: 400e6, hardening: 100e6" 24e-6 > small.yaml
for scene in metal elastic small; do run $scene.yaml -output $scene; done
mpiexec --oversubscribe -n 2 "$contact" small.yaml -quiet -error_estimate 0 -output ranks 2> /dev/null
run small.yaml -checkpoint_every 7 -checkpoint small.h5 -load_steps 16 -output part
run small.yaml -restart small.h5 -output part
"$PYTHON" - <<'PY'
from histories import history
from summaries import say, within

start = 0.5 * 8930 * 0.0324 * 0.0032**2 * 150**2
runs = {name: history(name) for name in ("metal", "elastic", "small", "ranks", "part")}
for name in "metal", "elastic", "small":
    lost = [a - b for a, b in zip(runs[name]["dynamics.numerical_dissipation"], runs[name]["contact_work"])]
    say(f"{name}: energy is kinetic, stored, plastic work or taken by contact to 1e-4 at every instant",
        max(map(abs, lost)) < 1e-4 * start, lost)
metal = runs["metal"]
say("metal: most energy becomes plastic work", 0.6 * start < metal["plastic_work"][-1] < 1.0001 * start,
    metal["plastic_work"][-1] / start)
say("metal: the plastic work never falls",
    all(b >= a for a, b in zip(metal["plastic_work"], metal["plastic_work"][1:])), metal["plastic_work"])
say("metal: it is shorter than before", 0.002 < -metal["end.displacement_x"][-1] < 0.01,
    metal["end.displacement_x"][-1])
for name in "ranks", "part":
    off = max(
        abs(a - b)
        for key in ("dynamics.total_energy", "plastic_work")
        for a, b in zip(runs["small"][key][-3:], runs[name][key][-3:]))
    say(f"{name}: the same", len(runs[name]["time"]) == len(runs["small"]["time"]) and off < 1e-6 * start, off / start)
PY
