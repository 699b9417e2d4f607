# A rigid cone is pressed into a metal and lifted a little: Code_Aster's case SSNA111 (V6.01.111, modelling A) on its
# mesh of 49 by 35 cells and with its load steps.
# Its values are the displacement of the node at the tip and the force on it per radian; the law there is Simo and
# Miehe's, with the same yield stress of Kirchhoff stresses
contact=$AMGF_DIR/bin/contact
"$PYTHON" - <<'PY'
pressed = ", ".join("%g" % (step / 40) for step in range(1, 41))
# 49 cells whose sizes grow by 1.02; hardening from the tangent modulus of 5000; flanks that rise by 1 over 2.7
open("cone.yaml", "w").write("""bodies:
  - block: {shape: tube_arc, axis: z, radii: [1e-4, 10], angles: [0, 4], extent: [-5, 0], cells: [49, 1, 35],
            grading: [%.9f, 1, 1], material: j2_finite, young: 2e5, poisson: 0.3, yield: 300, hardening: %.9f,
            element: full}
  - cone: {shape: rigid_cone, material: rigid, tip: [0, 0, 0], direction: [0, 0, 1], half_angle: 69.676863}
displacements:
  - floor: {face: block.lmin, value: [0, 0, 0]}
  - press: {body: cone, value: [0, 0, -0.4]}
symmetry:
  - begin: {face: block.amin, normal: y}
  - end: {face: block.amax, normal: [-0.069756473744125, 0.997564050259824, 0]}
contact:
  - touch: {mortar: cone.surface, nonmortar: block.lmax, gap: node}
load: {factors: [%s, 0.996, 0.992, 0.988, 0.984, 0.98]}
""" % (1.02**48, 2e5 * 5000 / (2e5 - 5000), pressed))
PY
"$contact" cone.yaml -quiet -error_estimate 0 -output cone || echo "exit $?"
"$PYTHON" - <<'PY'
import math
import h5py
from summaries import say, within

with h5py.File("cone.h5") as mesh:
    points = mesh["vertices"][:]
tip = [node for node, (x, y, z) in enumerate(points) if z == 0 and math.hypot(x, y) < 2e-4]
say("two nodes at the tip, one on each plane of symmetry", len(tip) == 2, len(tip))
for text, step, depth, force in (("half of the time", 25, 0.24798, 8.7703), ("lifted", 45, 0.38944, 4.8966)):
    with h5py.File("cone_%04d.h5" % step) as state:
        moved = -state["displacement"][tip[0], 2]
        push = -sum(state["contact_force"][node, 2] for node in tip) / math.radians(4)
    say(text + ": displacement of the tip to 0.1 %", within(moved, depth, 1e-3), (moved, depth))
    say(text + ": force on the tip to 4 %", within(push, force, 4e-2), (push, force))
PY
