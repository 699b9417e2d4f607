# A coil spring of rubber, three turns, is pressed until its coils touch: constant stiffness before, more force after,
# and the energy is the work
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B - <<'MESH'
import math

R, W, H = 4.0, 1.0, 0.8  # radius of the coil; width and height of the wire
PITCH, TURNS, PER = 1.2, 3.0, 32  # pitch; turns; cells a turn
n, nodes, cells = int(TURNS * PER), [], []
cr, cz = 2, 2
for k in range(n + 1):
    a = 2 * math.pi * k / PER
    for j in range(cz + 1):
        for i in range(cr + 1):
            r = R - W / 2 + W * i / cr
            nodes.append((r * math.cos(a), r * math.sin(a), PITCH * k / PER + H * j / cz))
m = (cr + 1) * (cz + 1)
at = lambda k, i, j: m * k + (cr + 1) * j + i + 1
for k in range(n):
    for j in range(cz):
        for i in range(cr):
            section = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            cells.append([at(layer, *corner) for layer in (k, k + 1) for corner in section])
with open("coil.inp", "w") as f:
    f.write("*NODE\n" + "".join("%d, %.12g, %.12g, %.12g\n" % (q + 1, *x) for q, x in enumerate(nodes)))
    f.write("*ELEMENT, TYPE=C3D8, ELSET=coil\n")
    f.write("".join(f"{q + 1}, " + ", ".join(map(str, c)) + "\n" for q, c in enumerate(cells)))
    f.write("*NSET, NSET=low\n" + ", ".join(str(at(0, i, j)) for j in range(cz + 1) for i in range(cr + 1)) + "\n")
MESH
cat > coil.yaml <<'SCENE'
bodies:
  - coil: {mesh: coil.inp, volume: coil, material: neohookean, young: 1000, poisson: 0.3}
faces:
  - top: {of: coil.surface_6, lower: [2, -0.01, 3.5], upper: [6, 0.01, 4.5]}
displacements:
  - foot: {face: coil.low, value: [0, 0, 0]}
  - head: {face: coil.top, value: [0, 0, -1.2]}
contact: [touch: {self: coil}]
load: {steps: 12}
SCENE
"$contact" coil.yaml -quiet -error_estimate 0 -summary coil.json || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

steps = load("coil")["steps"]
force = [-step["reaction"][2] for step in steps]
energy = [step["energy"] for step in steps]
say("constant stiffness until the coils touch",
    all(within(f, force[0] * (k + 1), 0.01) for k, f in enumerate(force[:11])), force)
say("energy is half of force times way",
    all(within(e, 0.05 * f * (k + 1), 0.005) for k, (e, f) in enumerate(zip(energy[:11], force))), energy)
touch = steps[-1]["pairs"][0]
say("more force when they touch",
    touch["normal_force"] > 0 and force[-1] > 1.3 * 12 * force[0] and touch["penetration"] < 1e-3, (force[-1], touch))
say("work between those of the force before and of the mean force",
    0.1 * force[-2] < energy[-1] - energy[-2] < 0.05 * (force[-2] + force[-1]), energy[-2:])
CHECK
