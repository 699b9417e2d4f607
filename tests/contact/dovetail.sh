# A dovetail between two inclined rigid planes, pulled down with and without friction, and a sprung pin under a plane:
# contact: auto, closed forms
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - <<'SCENES'
import math

WIDE, HIGH, LONG, SLOPE, N = 3.0, 4.0, 4.0, math.tan(math.radians(30)), 4
nodes = [((WIDE + SLOPE * HIGH * k / N) * (2 * i / N - 1), LONG * j / 2, HIGH * k / N)
         for k in range(N + 1) for j in range(3) for i in range(N + 1)]
at = lambda i, j, k: i + (N + 1) * (j + 3 * k) + 1
ring = lambda i, j, k: [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)]
cells = [ring(i, j, k) + ring(i, j, k + 1) for k in range(N) for j in range(2) for i in range(N)]
with open("tail.inp", "w") as out:
    out.write("*NODE\n" + "".join("%d, %.12g, %.12g, %.12g\n" % (n + 1, *x) for n, x in enumerate(nodes)))
    out.write("*ELEMENT, TYPE=C3D8, ELSET=tail\n")
    out.write("".join(f"{n + 1}, " + ", ".join(map(str, c)) + "\n" for n, c in enumerate(cells)))
    out.write("*NSET, NSET=low\n" + ", ".join(str(at(i, j, 0)) for j in range(3) for i in range(N + 1)) + "\n")
for name, friction in (("smooth", 0), ("rough", 0.1)):
    open(name + ".yaml", "w").write(f"""bodies:
  - tail: {{mesh: tail.inp, volume: tail, young: 2.1e5, poisson: 0.3}}
  - left: {{shape: rigid_plane, point: [-{WIDE}, 0, 0], normal: [{math.cos(math.pi / 6)}, 0, 0.5]}}
  - right: {{shape: rigid_plane, point: [{WIDE}, 0, 0], normal: [-{math.cos(math.pi / 6)}, 0, 0.5]}}
displacements: [left: {{body: left, value: [0, 0, 0]}}, right: {{body: right, value: [0, 0, 0]}}]
weak_springs: true
forces: [pull: {{face: tail.low, value: [0, 0, -1000]}}]
contact: [auto: {{friction: {friction}}}]
load: {{steps: 2}}
""")
open("pin.yaml", "w").write("""bodies:
  - pin: {shape: cylinder, axis: z, radius: 2, extent: [0, 6], cells: [3, 3, 4], young: 2.1e5, poisson: 0.3}
  - guide: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - press: {shape: rigid_plane, point: [0, 0, 6.1], normal: [0, 0, -1]}
displacements: [guide: {body: guide, value: [0, 0, -5]}, press: {body: press, value: [0, 0, -1.1]}]
connectors: [spring: {body: pin, point: [0, 0, 0], to_point: [0, 0, -10], stiffness: 20}]
weak_springs: true
contact: auto
load: {steps: 2}
""")
SCENES
for name in smooth rough pin; do
  "$contact" $name.yaml -quiet -error_estimate 0 -summary $name.json || echo "$name: exit code $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
import math

from summaries import load, say, within

for name, friction in (("smooth", 0), ("rough", 0.1)):
    # the lower face of the tail faces the planes, too, so that the nodes on its edges are in two pairs of each plane
    pairs = load(name)["steps"][-1]["pairs"]
    force = [sum(pair["normal_force"] for pair in pairs if side in pair["name"]) for side in ("left", "right")]
    exact = 1000 / 2 / (math.sin(math.pi / 6) + friction * math.cos(math.pi / 6))
    say(f"dovetail, friction {friction}: the force on each flank within 0.5 %",
        all(within(f, exact, 0.005) for f in force), (force, exact))
step = load("pin")["steps"][-1]
force = max(pair["normal_force"] for pair in step["pairs"])
say("pin: stiffness times way within 0.5 %", within(force, 20, 0.005), step["pairs"])
CHECK
