# contact_stiffness: soft contact is a layer of springs between the faces, in series with the bodies.
# contact_exponential: the pressure is 1 at the depth 0.02
blocks() { # keys of the pair, material, displacement of the lid, further lines
  cat <<SCENE
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 2], material: $2, young: 100, poisson: 0}
  - lid: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [2, 2, 2], material: $2, young: 100, poisson: 0}
displacements:
  - top: {face: lid.zmax, value: [0, 0, $3]}
  - foot: {face: cube.zmin, value: [0, 0, 0]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax, contact_stiffness: $1}
load: {steps: 2}
$4
SCENE
}
rings() { # keys of the pair
  cat <<SCENE
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [15, 25.015], angles: [0, 90], extent: [0, 2], cells: [3, 12, 1],
            young: 210000, poisson: 0.3, order: 2}
  - outer: {shape: tube_arc, axis: z, radii: [24.985, 40], angles: [0, 90], extent: [0, 2], cells: [3, 15, 1],
            young: 210000, poisson: 0.3, order: 2}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer, interference: true$1}
SCENE
}
run() { # name, ranks, options
  local name=$1 ranks=$2
  shift 2
  mpiexec --oversubscribe -n "$ranks" "$AMGF_DIR/bin/contact" "$name.yaml" -quiet -summary "$name$ranks.json" "$@" ||
    echo "$name on $ranks ranks: exit code $?"
}
refuse() { # name, options
  "$AMGF_DIR/bin/contact" "$@" -quiet 2>&1 | head -1
}

for gap in mortar dual; do
  blocks "50, gap: $gap" linear -0.04 > $gap.yaml
  blocks "50, gap: $gap, friction: 0.3" linear -0.04 > ${gap}_friction.yaml
done
blocks "50, stick: true" linear -0.04 > stick.yaml
blocks "50, friction: 0.3, shear_limit: 0.1" linear -0.04 > limit.yaml
for name in mortar dual mortar_friction dual_friction stick limit; do
  run $name 1
done
blocks 1e9 linear -0.04 > stiff.yaml
blocks 50 linear 0.01 > open.yaml
for keys in "" ", friction: 0.3"; do # a lid on half of the cube, whose edge is within cells; both almost rigid
  blocks "50$keys" linear -0.04 | sed 's/upper: \[1, 1, 2\]/upper: [0.5, 1, 2]/; s/young: 100/young: 1e8/' > half.yaml
  run half 1
  mv half1.json "covered$((++halves)).json"
done
cat > unlike.yaml <<SCENE # a pair whose pressure is a millionth of the largest one
bodies:
  - cube: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [4, 2, 2], young: 100, poisson: 0}
  - hard: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [2, 2, 2], young: 100, poisson: 0}
  - soft: {lower: [1, 0, 1], upper: [2, 1, 2], cells: [2, 2, 2], young: 100, poisson: 0}
displacements:
  - top: {face: hard.zmax, value: [0, 0, -0.04]}
  - down: {face: soft.zmax, value: [0, 0, -0.04]}
  - foot: {face: cube.zmin, value: [0, 0, 0]}
contact:
  - pressed: {mortar: hard.zmin, nonmortar: cube.zmax}
  - touched: {mortar: soft.zmin, nonmortar: cube.zmax, contact_stiffness: 1e-4}
SCENE
run unlike 1
run dual_friction 3
exponential() { sed 's/contact_stiffness: 50/contact_exponential: [0.04, 0.1]/' "$1.yaml" > "exponential_$1.yaml"; }
for name in mortar dual mortar_friction; do
  exponential $name
  run exponential_$name 1
done
# starts with a gap of 0.02
blocks 50 linear -0.06 | sed 's/, 1\]\(.*2, 2, 2\)/, 1.02]\1/; s/1, 2\]/1, 2.02]/' > apart.yaml
exponential apart
run exponential_apart 2
for law in neohookean saint_venant; do
  blocks 50 $law -0.04 > $law.yaml
  blocks "50, friction: 0.3" $law -0.04 > ${law}_friction.yaml
  run $law 2
  run ${law}_friction 2
done
run stiff 1
run open 1 2> /dev/null # warns that the pair stayed open
for keys in "" ", contact_stiffness: 1e4" ", contact_stiffness: 2e4" ", contact_stiffness: 1e4, friction: 0.2"; do
  rings "$keys" > fit.yaml
  run fit 1
  mv fit1.json "press$((++fits)).json"
done
blocks 50 linear -0.04 "dynamics: {time_step: 0.002, end_time: 0.2, scheme: generalized_alpha, spectral_radius: 1}" |
  sed '/^load/d; /- top/d; s/poisson: 0}/poisson: 0, density: 0.01}/' |
  sed '/- lid/s/}$/, initial_velocity: [0, 0, -0.5]}/' > bounce.yaml
run bounce 1 -error_estimate 0
# Vertices with mass yield at an impact, too: nothing jumps
sed 's/radius: 1}/radius: 1, mass: consistent}/; s/0, -0.5\]/0.2, -0.5]/; s/contact_stiffness: 50/&, friction: 0.3/' \
  bounce.yaml > rub.yaml
run rub 1 -error_estimate 0
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

for name in ("mortar", "dual", "mortar_friction", "dual_friction", "stick", "limit"):
    steps = [load(f"{name}{ranks}")["steps"][-1] for ranks in ((1, 3) if name == "dual_friction" else (1, ))]
    forces = [step["pairs"][0]["normal_force"] for step in steps]
    say(f"{name}: force 0.04/(1/100 + 1/100 + 1/50)", all(within(f, 1, 1e-8) for f in forces),
        forces)
    energies = [(step["energy"], step["contact_energy"]) for step in steps]
    say(f"{name}: bodies and layer store the same energy",
        all(within(e, 0.01, 1e-8) for both in energies for e in both), energies)
    say(f"{name}: the depth is the gap", within(steps[0]["gap_min"], -0.02, 1e-8), steps[0]["gap_min"])
    say(f"{name}: work", within(steps[0]["work"], 0.02, 1e-8), steps[0]["work"])
for name, ranks in ("mortar", 1), ("dual", 1), ("mortar_friction", 1), ("apart", 2):
    step = load(f"exponential_{name}{ranks}")["steps"][-1]
    force = step["pairs"][0]["normal_force"]
    say(f"exponential, {name}: force on {ranks} ranks", within(force, 1, 1e-6), force)
    say(f"exponential, {name}: energy of the layer",
        within(step["contact_energy"], (1 - 0.0005) * 0.04 / 4.60517019, 1e-6), step["contact_energy"])
step = load("stiff1")["steps"][-1]
say("a stiffness of 1e9 is hard contact", within(step["pairs"][0]["normal_force"], 2, 1e-6), step["pairs"][0])
step = load("unlike1")["steps"][-1]
say("a pair with little pressure", 1e-6 < step["pairs"][1]["normal_force"] < 4e-6, step["pairs"][1])
step = load("open1")["steps"][-1]
say("no tension", step["pairs"][0]["normal_force"] == 0 and step["contact_energy"] == 0, step["pairs"][0])
for name in ("covered1", "covered2"):
    step = load(name)["steps"][-1]
    say(f"{name}: only the covered half yields",
        within(step["pairs"][0]["normal_force"], 50 * 0.5 * 0.04, 1e-4) and within(step["contact_energy"], 0.02, 1e-4),
        (step["pairs"][0]["normal_force"], step["contact_energy"]))
for law in ("neohookean", "saint_venant"):
    for name in (law, law + "_friction"):
        step = load(name + "2")["steps"][-1]
        force = step["pairs"][0]["normal_force"]
        say(f"{name}: pressure = stiffness x depth", within(force, -50 * step["gap_min"], 1e-3),
            (force, step["gap_min"]))
        say(f"{name}: work is stored", within(step["work"], step["energy"] + step["contact_energy"], 2e-2),
            (step["work"], step["energy"], step["contact_energy"]))
motion = [step["motions"][0] for step in load("bounce1")["steps"]]
start = 0.5 * 0.01 * 0.5**2
say("a lid that falls on the layer bounces without loss",
    all(within(step["total_energy"], start, 2e-2) for step in motion) and motion[-1]["momentum"][2] > 0,
    (start, [step["total_energy"] for step in motion], motion[-1]["momentum"]))
steps = load("rub1")["steps"]
kept = [step["motions"][0]["total_energy"] + step["dissipated"] for step in steps]
start = 0.5 * 0.01 * (0.5**2 + 0.2**2)
say("a lid that falls and slides on the layer loses what friction takes",
    all(within(energy, start, 2e-3) for energy in kept) and steps[-1]["dissipated"] > 0.01 * start,
    (start, kept, steps[-1]["dissipated"]))
hard, soft, twice, rubs = (load(f"press{k}")["steps"][-1]["pairs"][0]["normal_force"] for k in (1, 2, 3, 4))
area = 0.5 * 3.14159265 * 25 * 2
say("press fit: interference/force of rings and layer add", within(1 / soft - 1 / hard, 1 / (1e4 * 0.03 * area), 5e-3),
    (hard, soft))
say("and with twice the stiffness", within(2 * (1 / twice - 1 / hard), 1 / soft - 1 / hard, 5e-3), (hard, soft, twice))
say("and with friction", within(rubs, soft, 1e-3), (soft, rubs))
PY
blocks 50 linear -0.04 "displacement_bounds: 2" > bounds.yaml
refuse bounds.yaml
blocks 50 linear -0.04 > refused.yaml
refuse refused.yaml -tao_type almm
sed 's/load: .*/dynamics: {time_step: 0.01, end_time: 1}/; s/poisson: 0}/poisson: 0, density: 1}/' refused.yaml \
  > impact.yaml
refuse impact.yaml
blocks -1 linear -0.04 > negative.yaml
refuse negative.yaml
sed 's/contact_stiffness: 50/&, contact_exponential: [0.04, 0.1]/' refused.yaml > both.yaml
refuse both.yaml
exponential impact
refuse exponential_impact.yaml
exponential refused
echo "contact_updates: 1" >> exponential_refused.yaml
refuse exponential_refused.yaml
