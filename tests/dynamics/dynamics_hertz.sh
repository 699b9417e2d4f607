# A ball hits a rigid plane slowly: duration and largest force against Hertz's quasi-static theory, with the mass of the
# mesh; its rebound; energy; the same with controlled time steps
cat > ball.yaml <<'YAML'
bodies:
  - ball: {shape: ball, center: [0, 0, 1.00001], octant: [1, 1, -1], radius: 1, patches: [12, 12, 1],
           grading: [150, 150, 1], layers: 10, layer_grading: 0.007, young: 1000, poisson: 0.3, element: full,
           density: 1, initial_velocity: [0, 0, -0.003]}
  - plane: {lower: [0, 0, -0.1], upper: [1, 1, 0], cells: [1, 1, 1], material: rigid}
faces:
  - pole: {of: ball.surface, upper: [0.1, 0.1, 10]}
displacements:
  - rigid: {body: plane, value: [0, 0, 0]}
symmetry: [ball.x0, ball.y0]
contact:
  - touch: {mortar: plane.zmax, nonmortar: ball.pole, distance: 0.2}
dynamics: {time_step: 0.03, end_time: 0.84}
YAML
sed 's/time_step: 0.03, end_time: 0.84/time_step: 0.06, end_time: 0.84, tolerance: 3e-2/' ball.yaml > controlled.yaml
"$AMGF_DIR/bin/contact" ball.yaml -quiet -error_estimate 0 -output ball || echo "exit $?"
"$AMGF_DIR/bin/contact" controlled.yaml -quiet -error_estimate 0 -output controlled -summary controlled.json ||
  echo "exit $?"
"$PYTHON" - <<'PY'
import math
from histories import history
from summaries import load, say, within

run = history("ball")
speed, modulus, step = 0.003, 1000 / (1 - 0.3**2), run["time"][0]
mass = -run["dynamics.momentum_z"][0] / speed  # of a quarter
approach = (15 * 4 * mass * speed**2 / (16 * modulus))**0.4
force, duration = modulus * approach**1.5 / 3, 2.943 * approach / speed
found = run["contact_force_z"]
closed = [t for t, f in zip(run["time"], found) if f > 1e-3 * force]
total = run["dynamics.total_energy"]
say("largest force of Hertz to 4 %, at a radius of contact of 0.03 of the ball's", within(max(found), force, 0.04),
    (max(found), force))
say("duration of Hertz to 4 % and a step",
    abs(closed[-1] - closed[0] - duration) < 0.04 * duration + step, (closed, duration))
say("flies back at its speed to 0.5 %", within(run["dynamics.momentum_z"][-1] / mass, speed, 5e-3),
    run["dynamics.momentum_z"][-1] / mass)
say("impulse of the contact force", within(sum(found) * step, 2 * mass * speed, 5e-3), sum(found) * step / mass)
say("energy is that of the start to 0.5 % after the impact, and never larger", total[-1] > 0.995 * total[0]
    and max(total) <= total[0] * (1 + 1e-9), total)
say("work of the contact that comes and goes, from the normals of facets: below 2 %",
    max(run["contact_work"]) < 0.02 * total[0], run["contact_work"])
lost = [a - b for a, b in zip(run["dynamics.numerical_dissipation"], run["contact_work"])]
say("energy is accounted for", max(map(abs, lost)) < 1e-9 * total[0], lost)
say("a step takes less than half an elastic solve",
    sum(run["amg_applications"]) < 0.5 * 35 * len(found), sum(run["amg_applications"]))
run, steps = history("controlled"), load("controlled")["steps"]
found = run["contact_force_z"]
closed = [t for t, f in zip(run["time"], found) if f > 1e-3 * force]
made = sum(s["substeps"] for s in steps)
say("controlled: largest force of Hertz to 4 %", within(max(found), force, 0.04), (max(found), force))
say("controlled: duration of Hertz to 4 % and a step",
    abs(closed[-1] - closed[0] - duration) < 0.04 * duration + run["time"][0], (closed, duration))
say("controlled: flies back at its speed to 2 %", within(run["dynamics.momentum_z"][-1] / mass, speed, 0.02),
    run["dynamics.momentum_z"][-1] / mass)
say("controlled: no error above the tolerance, and fewer time steps than those of even length",
    max(s["motions"][0]["time_error"] for s in steps) <= 3e-2 and made < 28,
    ([s["motions"][0]["time_error"] for s in steps], made))
PY
