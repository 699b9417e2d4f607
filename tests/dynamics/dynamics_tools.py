"""Rigid surfaces with mass: a ball that a force and a moment drive; a ball that falls on an elastic block and rises
again.

python3 dynamics_tools.py scenes writes the scenes; python3 dynamics_tools.py judges the runs.
"""
import math
import sys

from histories import history
from summaries import say, within

DRIVEN = """bodies:
  - ball: {shape: rigid_sphere, center: [0, 0, 2], radius: 0.5, mass: 2}
  - other: {lower: [5, 0, 0], upper: [6, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0, density: 1}
displacements:
  - free: {body: ball, value: [free, free, free], rotation: [free, free, free], center: [0, 0, 2]}
  - fix: {face: other.xmin, value: [0, 0, 0]}
forces:
  - drive: {body: ball, value: [4, 0, 0], moment: [0, 0, 0.1], point: [0, 0, 2]}
load: {expression: "1"}
dynamics: {time_step: 0.02, end_time: 1}
"""
FALL = """bodies:
  - block: {lower: [0, 0, -2], upper: [2, 2, 0], cells: [8, 8, 8], grading: [4, 4, 0.25], young: 1e5, poisson: 0.3,
            density: 1e-3}
  - ball: {shape: rigid_sphere, center: [0, 0, 2.0005], radius: 2, mass: 10, initial_velocity: [0, 0, -2]}
displacements:
  - bottom: {face: block.zmin, value: [0, 0, 0]}
  - guide: {body: ball, value: [0, 0, free]}
symmetry: [block.xmin, block.ymin]
contact:
  - touch: {mortar: ball.surface, nonmortar: block.zmax}
dynamics: {time_step: 0.0025, end_time: 0.1}
"""
MASSLESS = FALL.replace(", mass: 10", "")

if sys.argv[1:] == ["scenes"]:
    for name, text in ("driven", DRIVEN), ("fall", FALL), ("massless", MASSLESS):
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    run = history("driven")
    seen = [(x, t * t) for t, x in zip(run["time"], run["ball.position_x"])]
    say("driven: x = F t^2/(2 m)", all(abs(x - exact) < 1e-8 for x, exact in seen), seen)
    turned = math.degrees(0.5 * 0.1 / (0.4 * 2 * 0.25))
    say("driven: turns by M t^2/(2 I), I = 2/5 m r^2, within 0.2 %", within(run["ball.rotation_z"][-1], turned, 2e-3),
        (run["ball.rotation_z"][-1], turned))
    run = history("fall")
    last = run["dynamics.momentum_z"]
    # a quarter of the block, so that the ball has a mass of 40 and four times the force
    stiffness, mass, speed = 4 / 3 * 1e5 / (1 - 0.09) * math.sqrt(2), 40, 2
    deepest = (5 / 4 * mass * speed**2 / stiffness)**0.4
    largest = stiffness * deepest**1.5 / 4
    force = max(run["touch.force_z"], key=abs)
    say("fall: the ball rises with 0.99 of its speed or more", last[-1] > 0.99 * 20, last)
    say("fall: largest force within 10 % of Hertz's quasi-static one, on 8 x 8 x 8 cells", within(-force, largest, 0.1),
        (force, largest))
    lost = [a - b for a, b in zip(run["dynamics.numerical_dissipation"], run["contact_work"])]
    say("fall: energy is accounted for to 1e-6", max(map(abs, lost)) < 1e-6 * max(run["dynamics.total_energy"]), lost)
