# A rigid sphere is pressed into a metal without hardening, up to a E*/(R Y) = 250: mean pressure 2.8 to 3.1 times the
# yield stress. `area` is the sum of the whole areas of closed vertices, so that it is too large by half a cell around
# the edge.
contact=$AMGF_DIR/bin/contact
cat > sphere.yaml <<'YAML'
bodies:
  - block: {shape: tube_arc, axis: z, radii: [1e-4, 1], angles: [0, 4], extent: [-1, 0], cells: [28, 1, 28],
            grading: [40, 1, 0.025], even: [14, 1, 14], material: j2, young: 200000, poisson: 0.3, yield: 50,
            element: bbar}
  - ball: {shape: rigid_sphere, material: rigid, center: [0, 0, 1], radius: 1}
displacements:
  - floor: {face: block.lmin, value: [free, free, 0]}
  - axis: {face: block.inner, value: [0, 0, free]}
  - press: {body: ball, value: [0, 0, -0.00125]}
symmetry:
  - begin: {face: block.amin, normal: y}
  - end: {face: block.amax, normal: [-0.069756473744125, 0.997564050259824, 0]}
contact:
  - touch: {mortar: ball.surface, nonmortar: block.lmax}
load: {steps: 12}
YAML
sed 's/steps: 12/steps: 24/' sphere.yaml > more.yaml
for scene in sphere more; do
  "$contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json || echo "$scene: exit $?"
done
"$PYTHON" - <<'PY'
import math
from summaries import load, say, within

stress, modulus, cell = 50, 200000 / (1 - 0.3**2), 1 / (14 + sum(40**(k / 14) for k in range(1, 15)))


def states(name):
    """Force, radius of the area in contact, and whether this is that of the step before, of each load step"""
    last = 0
    for step in load(name)["steps"]:
        pair = step["pairs"][0]
        radius = math.sqrt(2 * pair["area"] / math.radians(4))
        yield -90 * pair["force"][2], radius, within(radius, last, 1e-3)
        last = radius


rows = [(force / (math.pi * a * a * stress), force / (math.pi * (a - cell / 2)**2 * stress), a * modulus / stress,
         still) for force, a, still in states("sphere")]
say("a E*/(R Y) above 250, fully plastic", rows[-1][2] > 250, rows)
held = [row for row in rows if row[3] and row[2] > 220]
say("where no vertex has just closed: mean pressure at least 2.75 Y by whole areas, at most 3.15 Y by half a cell less",
    len(held) > 1 and all(row[0] > 2.75 and row[1] < 3.15 for row in held), rows)
closed = [row for row in rows if not row[3] and row[2] > 220]
say("where one has just closed it is one ring of cells less: 2.3 to 2.8 Y",
    all(2.3 < row[0] < row[1] < 2.8 for row in closed), rows)
forces = [list(states(name))[-1][0] for name in ("sphere", "more")]
say("force: twice the load steps change it by less than 1 %", within(forces[0], forces[1], 1e-2), forces)
PY
