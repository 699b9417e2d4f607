# Two displacements of one face, of different components and ramps, act as one of both where both ramps are 1; each acts
# alone before. Loads follow their ramps, and solver options are set unless the command line has them.
contact=$AMGF_DIR/bin/contact
bodies='bodies: [bar: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], young: 10, poisson: 0.3}]'
floor='floor: {face: bar.zmin, value: [0, 0, 0]}'

energy() {
  cat > bar.yaml
  "$contact" bar.yaml -quiet -summary bar.json "$@" > /dev/null || echo "failed: $(cat bar.yaml)" >&2
  "$PYTHON" -c 'import json; print(*[step["energy"] for step in json.load(open("bar.json"))["steps"]])'
}

compare() {
  "$PYTHON" - "$@" <<'PY'
import sys

a, b = ([float(x) for x in text.split()] for text in sys.argv[2:4])
print(
    sys.argv[1] + ":",
    "same" if len(a) == len(b) and all(abs(x - y) <= 1e-8 * max(abs(y), 1e-12)
                                       for x, y in zip(a, b)) else "%s is not %s" % (a, b))
PY
}

both=$(energy <<YAML
$bodies
displacements: [$floor, press: {face: bar.zmax, value: [free, 0, -0.1], ramp: down}, slide: {face: bar.zmax,
    value: [0.2, free, free], ramp: along}]
load: {steps: 3}
ramps: [down: {factors: [1/2, 1, 1]}, along: {factors: [0, 0, 1]}]
YAML
)
one=$(energy <<YAML
$bodies
displacements: [$floor, top: {face: bar.zmax, value: [0, 0, -0.1]}]
load: {factors: [1/2, 1]}
YAML
)
all=$(energy <<YAML
$bodies
displacements: [$floor, top: {face: bar.zmax, value: [0.2, 0, -0.1]}]
YAML
)
compare "two displacements of a face" "$both" "$one $all"

counted=$(energy <<YAML
$bodies
displacements: [$floor, press: {face: bar.zmax, value: [free, 0, -0.1], ramp: down}, slide: {face: bar.zmax,
    value: [0.2, free, free], ramp: along}]
ramps: [down: {factors: [1/2, 1, 1]}, along: {factors: [0, 0, 1]}]
YAML
)
compare "without a number of load steps" "$counted" "$both"

loads=$(energy <<YAML
$bodies
displacements: [$floor]
pressures: [squeeze: {face: bar.xmax, value: 0.1, ramp: first}]
body_forces: [gravity: {value: [0, 0, -1], ramp: second}, none: {body: bar, value: [0, 9, 0], ramp: never}]
load: {steps: 2}
ramps: [first: {factors: [1, 0]}, second: {factors: [0, -2]}, never: {factors: [0, 0]}]
YAML
)
squeeze=$(energy <<YAML
$bodies
displacements: [$floor]
pressures: [squeeze: {face: bar.xmax, value: 0.1}]
YAML
)
weight=$(energy <<YAML
$bodies
displacements: [$floor]
body_forces: [gravity: {value: [0, 0, 2]}]
YAML
)
compare "pressure and weight, one after the other" "$loads" "$squeeze $weight"

# Half of an iteration limit's scene: it fails where the option holds
cat > "solver.yaml" <<YAML
$bodies
displacements: [$floor, top: {face: bar.zmax, value: [0.2, 0, -0.1]}]
solver: {elasticity: {ksp_max_it: 1, pc_amgf_factor: false}, tao_ipfilter_ksp_rtoll: 1e-8}
YAML
"$contact" solver.yaml -quiet > /dev/null 2> err
echo "option of the scene: exit $?"
grep warning err
"$contact" solver.yaml -quiet -elasticity_ksp_max_it 100 > /dev/null 2>&1
echo "command line wins: exit $?"
sed 's/ksp_rtoll/tool/' solver.yaml > misspelt.yaml
"$contact" misspelt.yaml -quiet > /dev/null 2> err
echo "misspelt option of ours: exit $?"
cat err
