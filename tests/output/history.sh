# BASE.csv: a line a load step, its numbers those of the summary; the work of the forces from outside is the energy of
# linear bodies; times of the fields are those of the load program, also where the load goes back. Curves of it, and a
# disk that is full.
contact=$AMGF_DIR/bin/contact
rm -f bar.csv # a link, of the last time
cat > bar.yaml <<'YAML'
problem: bar
bodies:
  - bar: {shape: box, lower: [0, 0, 0], upper: [1, 2, 3], cells: [2, 3, 4], young: 10, poisson: 0.3}
symmetry: [bar.xmin, bar.ymin, bar.zmin]
displacements:
  - pull: {face: bar.zmax, value: [free, free, 0.03], ramp: drive}
pressures:
  - press: {face: bar.xmax, value: 0.2}
load: {factors: [1/2, 1, 1/4]}
ramps:
  - drive: {factors: [1, -1/2, 1/3]}
YAML
for ranks in 1 3; do
  mpiexec --oversubscribe -n $ranks "$contact" bar.yaml -quiet -output bar -summary bar.json \
    -elasticity_ksp_rtol 1e-13 || echo "exit code $?"
  "$PYTHON" - <<'PY'
import csv, json, xml.etree.ElementTree as tree
with open("bar.csv", newline="") as file:
    rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
steps = json.load(open("bar.json"))["steps"]
same = lambda a, b: abs(a - b) <= 1e-13 * abs(b)
print("lines %d, times %s" % (len(rows), [row["time"] for row in rows]))
print("times of the fields", [float(time.get("Value")) for time in tree.parse("bar.xmf").getroot().iter("Time")])
print("factors", ["%.6g %.6g" % (row["load.factor"], row["drive.factor"]) for row in rows])
print(
    "as the summary has them:",
    all(
        same(row["energy"], step["energy"]) and same(row["work"], step["work"])
        and same(row["bar.balance"], step["bodies"][0]["balance"]) and all(
            same(row["%s.%s_%s" % (face["name"], what, axis)], face[what][d])
            for face in step["faces"]
            for what in ("reaction", "moment")
            for d, axis in enumerate("xyz")) and row["ksp_iterations"] == sum(step["ksp_iterations"])
        and row["converged"] == 1
        for row, step in zip(rows, steps)))


# 10/(2 (1 - 0.3^2)) (...): plane stress in y: e_z is given, s_x = -p, s_y = 0; e_x = (s_x - 0.3 s_z)/10, e_z = (s_z -
# 0.3 s_x)/10
def exact(p, d):
    sx, ez = -0.2 * p, 0.01 * d
    sz = 10 * ez + 0.3 * sx
    return 6 * 0.5 * ((sx * sx + sz * sz - 0.6 * sx * sz) / 10), sz * 2


for row in rows:
    energy, force = exact(row["load.factor"], row["drive.factor"])
    print("energy %s, force %s, work is the energy %s" %
          (abs(row["energy"] / energy - 1) < 1e-8, abs(row["bar.zmax.reaction_z"] / force - 1) < 1e-8,
           abs(row["work"] / energy - 1) < 1e-8))
PY
done
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -output blocks
curves=$AMGF_DIR/share/plot/curves.py
"$PYTHON" "$curves" blocks.csv | grep -E '^(step|time|energy|work|press\.|.*normal_force|.*zmax\.reaction_z|step_time)'
"$PYTHON" "$curves" blocks.csv blocks.png && head -c 4 blocks.png | tail -c 3 && echo
"$PYTHON" "$curves" blocks.csv forces.png '*.reaction_z' -x load.factor && head -c 4 forces.png | tail -c 3 && echo
"$PYTHON" "$curves" blocks.csv none.png no_such_column 2>&1
rm -f bar.csv && ln -s /dev/full bar.csv
"$contact" bar.yaml -quiet -output bar 2>&1 | sed "s|$PWD/||"
