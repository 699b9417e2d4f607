# Materials by name, of a library and of the scene; the units that tables carry; what is wrong with a name, a file or
# its units.
contact=$AMGF_DIR/bin/contact
cat > bars.yaml <<YAML
library: $AMGF_DIR/share/materials/mm_N.yaml
materials:
  - own: {young: 50, poisson: 0.25}
bodies:
  - a: {material: steel, lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1]}
  - b: {material: Own, lower: [3, 0, 0], upper: [4, 1, 1], cells: [1, 1, 1], poisson: 0.4}
symmetry: [a.xmin, a.ymin, a.zmin, x: {face: b.xmin, normal: x}, b.ymin, b.zmin]
pressures:
  - onto_a: {face: a.zmax, value: 21}
  - onto_b: {face: b.zmax, value: 5}
probes:
  - a: {point: [1, 1, 1]}
  - b: {point: [4, 1, 1]}
YAML
"$contact" bars.yaml -tables_view -summary bars.json -elasticity_ksp_rtol 1e-13 > log || echo "exit code $?"
grep '^Units' log
"$PYTHON" - <<'PY'
import json, os, re

run = json.load(open("bars.json"))
a, b = (p["displacement"] for p in run["steps"][0]["probes"])
near = lambda u, v: all(abs(x - y) <= 1e-10 * abs(v[2]) for x, y in zip(u, v))
print("constants are the named ones, those beside a name win:",
      near(a, [3e-5, 3e-5, -1e-4]) and near(b, [0.04, 0.04, -0.1]))
print("units of the summary:", run["units"])


def table(name):
    text = open(os.path.join(os.environ["AMGF_DIR"], "share", "materials", name)).read()
    return {
        m[1]: (float(m[2]), float(m[3]), float(m[4]), float(m[5] or 1))
        for m in re.finditer(
            r"- (\w+): {.*young: ([^,]*), poisson: ([^,}]*).*density: ([^,}]*)(?:, yield: ([^}]*))?", text)
    }


mm, m = table("mm_N.yaml"), table("m_N.yaml")
print(
    "both libraries have the same materials:",
    len(mm) > 15 and mm.keys() == m.keys()
    and all(abs(m[k][0] / mm[k][0] - 1e6) < 1e-6 and m[k][1] == mm[k][1] for k in mm)
    and all(abs(m[k][2] / mm[k][2] - 1e12) < 1 and 900 < m[k][2] < 16000 for k in mm)
    and sum(m[k][3] == 1e6 * mm[k][3] for k in mm) == 4)
PY
try() {
  sed "$1" bars.yaml > other.yaml
  "$contact" other.yaml -quiet 2>&1 | sed "s|$AMGF_DIR/||g"
}
try 's/material: steel/material: steal/'
try '1s/^/units: m, N, Pa\n/'
try 's/^  - own/  - steel/; s/material: Own/material: steel/'
try 's|^library.*|library: nowhere.yaml|'
try 's|^library.*|library: bars.yaml|'
# Questions about units: a modulus in GPa, a density in kg/m^3, a modulus in Pa, a ratio below 0; none about the
# libraries, nor about a scene without units
ask() {
  sed "$1" bars.yaml > other.yaml
  "$contact" other.yaml -scene_check 2>&1 > /dev/null | sed 's/.*yaml: line/line/'
}
own='s/material: steel/material: linear, poisson: 0.3, young'
ask "$own: 210/"
ask "$own: 210e9/"
ask "$own: 1e-4/"
ask "$own: 210000, density: 7850/"
ask "$own: 210000/; s/poisson: 0.3/poisson: -0.3/"
ask "1s/^.*/units: m, N, s/; $own: 210, density: 7.85e-9/"
ask "1d; $own: 210, density: 7850/"
for name in mm_N m_N; do for material in $(sed \
  -n 's/^  - \([a-z_]*\): .*/\1/p' "$AMGF_DIR/share/materials/$name.yaml"); do
  sed "s/mm_N/$name/; s/material: steel/material: $material/" bars.yaml > other.yaml
  "$contact" other.yaml -scene_check > /dev/null 2> err || echo "$material of $name"
  grep 'body "a"' err || true
done; done
