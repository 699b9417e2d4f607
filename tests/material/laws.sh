# Scenes of Mooney-Rivlin and orthotropic bodies against stretches and compliances by hand; what is wrong with their
# constants.
contact=$AMGF_DIR/bin/contact
cat > rubber.yaml <<'YAML'
materials:
  - gum: {law: mooney_rivlin, c10: 0.3, c01: 0.1, bulk: 20}
bodies:
  - full: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [2, 1, 1], material: mooney_rivlin, c10: 0.3, c01: 0.1, bulk: 20}
  - bbar: {lower: [0, 2, 0], upper: [2, 3, 1], cells: [2, 1, 1], material: gum, element: bbar}
  - second: {lower: [0, 4, 0], upper: [2, 5, 1], cells: [1, 1, 1], material: gum, order: 2, element: bbar}
symmetry: [full.xmin, full.ymin, full.zmin, bbar.xmin, bbar.ymin, bbar.zmin, second.xmin, second.ymin, second.zmin]
displacements:
  - full: {face: full.xmax, value: [2, free, free]}
  - bbar: {face: bbar.xmax, value: [2, free, free]}
  - second: {face: second.xmax, value: [2, free, free]}
load: {steps: 4}
YAML
cat > wood.yaml <<'YAML'
bodies:
  - full: {lower: [0, 0, 0], upper: [2, 1, 1], cells: [2, 1, 1], material: orthotropic, young: [12, 1, 0.7],
      poisson: [0.35, 0.4, 0.3], shear: [0.8, 0.1, 0.6], first_axis: [0, 0, 1], second_axis: [1, 0, 0]}
  - bbar: {lower: [0, 2, 0], upper: [2, 3, 1], cells: [2, 1, 1], element: bbar, material: orthotropic,
      young: [12, 1, 0.7], poisson: [0.35, 0.4, 0.3], shear: [0.8, 0.1, 0.6], first_axis: [0, 0, 1],
      second_axis: [1, 0, 0]}
  - modes: {lower: [0, 4, 0], upper: [2, 5, 1], cells: [2, 1, 1], element: incompatible, material: orthotropic,
      young: [12, 1, 0.7], poisson: [0.35, 0.4, 0.3], shear: [0.8, 0.1, 0.6], first_axis: [0, 0, 1],
      second_axis: [1, 0, 0]}
symmetry: [full.xmin, full.ymin, full.zmin, bbar.xmin, bbar.ymin, bbar.zmin, modes.xmin, modes.ymin, modes.zmin]
pressures:
  - full: {face: full.zmax, value: -0.12}
  - bbar: {face: bbar.zmax, value: -0.12}
  - modes: {face: modes.zmax, value: -0.12}
probes:
  - full: {point: [2, 1, 1]}
  - bbar: {point: [2, 3, 1]}
  - modes: {point: [2, 5, 1]}
YAML
for name in rubber wood; do
  "$contact" $name.yaml -quiet -ksp_rtol 1e-12 -elasticity_ksp_rtol 1e-13 -summary $name.json ||
    echo "$name: exit code $?"
done
"$PYTHON" - <<'PY'
import math, sys, os

sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "tests"))
from summaries import load, say


def energy(a, b, c10=0.3, c01=0.1, bulk=20):
    """Of stretches a, b, b"""
    J, I1, I2 = a * b * b, a * a + 2 * b * b, 2 * a * a * b * b + b**4
    return c10 * (J**(-2 / 3) * I1 - 3) + c01 * (J**(-4 / 3) * I2 - 3) + bulk / 2 * (J - 1)**2


def slope(f, x, h=1e-5):
    return (8 * (f(x + h) - f(x - h)) - f(x + 2 * h) + f(x - 2 * h)) / (12 * h)


def pull(a):
    """Force on the undeformed area where the sides are free"""
    low, high = 0.3, 1.0
    for _ in range(100):
        b = (low + high) / 2
        if slope(lambda b: energy(a, b), b) > 0: high = b
        else: low = b
    return slope(lambda a: energy(a, b), a)


for number, step in enumerate(load("rubber")["steps"], 1):
    exact = pull(1 + number / 4)
    forces = [face["reaction"][0] for face in step["faces"] if face["name"].endswith("xmax")]
    say("Mooney-Rivlin, stretched by %g: the force in every element" % (number / 4),
        len(forces) == 3 and max(abs(f / exact - 1) for f in forces) < 1e-6, (forces, exact))
moves = [probe["displacement"] for probe in load("wood")["steps"][0]["probes"]]
say("orthotropic, pulled along its first axis, in every element",
    all(abs(u[2] - 0.01) < 1e-12 and abs(u[0] + 0.007) < 1e-12 and abs(u[1] + 0.003) < 1e-12 for u in moves), moves)
PY
try() {
  sed "$2" "$1.yaml" > other.yaml
  "$contact" other.yaml -quiet 2>&1 || echo "exit code $?"
}
try rubber '
  s/c01: 0.1, bulk: 20, element/c01: -0.1, bulk: 20, element/
  s/gum: {law: mooney_rivlin, c10: 0.3, c01: 0.1/gum: {law: mooney_rivlin, c10: 0.3, c01: -0.1/'
try rubber 's/bulk: 20}/bulk: 0}/'
try rubber 's/, c10: 0.3, c01: 0.1, bulk: 20}$/, young: 1, poisson: 0.3}/'
try rubber '/bbar: {/s/element: bbar/element: incompatible/'
try wood '/full: {/,/}$/s/0.35, 0.4, 0.3/0.35, 1.3, 0.3/'
try wood '/full: {/,/}$/s/young: \[12, 1/young: [12, -1/'
try wood '/full: {/,/}$/s/young: \[12, 1, 0.7\]/young: [12, 1]/'
try wood '/full: {/,/}$/s/second_axis: \[1, 0, 0\]/second_axis: [0, 0, 5]/'
