# Metals against published figures: deal.II's step-42, a sphere pressed into a cube, on its first mesh; a press fit of a
# hub that yields, by Hill and Lamé
contact=$AMGF_DIR/bin/contact
# its law: norm of the deviator 400, slope gamma = H/(3 mu + H) = 0.01 of the trial stress
"$PYTHON" -B "$AMGF_DIR/share/published/cases.py" --scene cube > cube.yaml
cat > fit.yaml <<'YAML'
bodies:
  - hub: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [1, 2], angles: [0, 15], extent: [0, 0.1],
          cells: [16, 2, 1], grading: [4, 1, 1], material: j2, young: 1000, poisson: 0.4999, yield: 1.7320508075688772,
          element: bbar}
  - shaft: {shape: tube_arc, axis: z, center: [0, 0, 0], radii: [0.5, 1.0061881], angles: [0, 15], extent: [0, 0.1],
            cells: [8, 2, 1], young: 500, poisson: 0.3}
displacements:
  - bottom: {face: hub.lmin, value: [free, free, 0]}
  - top: {face: hub.lmax, value: [free, free, 0]}
  - below: {face: shaft.lmin, value: [free, free, 0]}
  - above: {face: shaft.lmax, value: [free, free, 0]}
symmetry:
  - begin: {face: hub.amin, normal: y}
  - end: {face: hub.amax, normal: [-0.25881904510252074, 0.96592582628906831, 0]}
  - from: {face: shaft.amin, normal: y}
  - to: {face: shaft.amax, normal: [-0.25881904510252074, 0.96592582628906831, 0]}
contact:
  - fit: {mortar: shaft.outer, nonmortar: hub.inner, interference: true}
probes:
  - outside: {point: [2, 0, 0]}
YAML
for scene in cube fit; do "$contact" $scene.yaml -quiet -error_estimate 0 -summary $scene.json || echo "exit $?"; done
"$PYTHON" - <<'PY'
import math
from summaries import load, say, within

force = 4 * load("cube")["steps"][-1]["pairs"][0]["normal_force"]
say("step-42: force of the first mesh, 37.3058, to 1e-5", within(force, 37.3058, 1e-5), force)

# plastic up to c = 1.5: hub k c^2/(2 G a), shaft by Lame, together the interference
k, a, b, c, G = 1.0, 1.0, 2.0, 1.5, 1000 / 2 / 1.4999
exact = 2 * k * math.log(c / a) + k * (1 - c * c / b / b)
inner, E, nu = 0.5, 500.0, 0.3
shaft = exact / E * (1 + nu) * ((1 - 2 * nu) * a * a + inner * inner) / (a * a - inner * inner) * a
say("press fit: the interference is that of a plastic zone up to 1.5",
    within(k * c * c / (2 * G * a) + shaft, 0.0061881, 1e-4), k * c * c / (2 * G * a) + shaft)
step = load("fit")["steps"][-1]
pressure, wide = step["pairs"][0]["normal_force"] / step["pairs"][0]["area"], step["probes"][0]["displacement"][0]
say("press fit: pressure to 0.5 %", within(pressure, exact, 5e-3), (pressure, exact))
say("press fit: widening outside to 1 %", within(wide, k * c * c / (2 * G * b), 1e-2), (wide, k * c * c / (2 * G * b)))
PY
