"""Scenes without elastic bodies, and a rigid mass that strikes an elastic bar, against closed forms.

dynamics_rigid.py scenes writes the scenes; dynamics_rigid.py judges the runs; dynamics_rigid.py long judges those of
dynamics_rigid_long.
"""
import math
import sys

from histories import history
from summaries import say

MASS = """bodies:
  - m: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], material: rigid, density: 2, initial_velocity: [1, 0, 0]}
displacements:
  - guide: {body: m, value: [free, 0, 0]}
connectors:
  - spring: {body: m, point: [0, 0.5, 0.5], to_point: [-1, 0.5, 0.5], stiffness: 200, damping: DAMPING}
dynamics: {time_step: 0.005, end_time: 0.7}
"""
BALL = """bodies:
  - ground: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - ball: {shape: ball, center: [0, 0, 1.45], octant: [2, 2, 2], radius: 1, patches: [1, 1, 1], layers: 1,
           material: rigid, density: 1}
displacements:
  - fix: {body: ground, value: [0, 0, 0]}
  - fly: {body: ball, value: [free, free, free], rotation: [free, free, free], center: [0, 0, 1.45]}
body_forces:
  - weight: {body: ball, value: [0, 0, -10]}
contact: auto
dynamics: {time_step: 0.01, end_time: 0.65}
"""
STRUCK = """bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 0.1, 0.1], cells: [40, 1, 1], young: 1, poisson: 0, element: full, density: 1}
  - ram: {shape: rigid_plane, point: [1.001, 0, 0], normal: [-1, 0, 0], mass: 0.01, initial_velocity: [-0.01, 0, 0],
          size: 0.1}
displacements:
  - fix: {face: bar.xmin, value: [0, free, free]}
  - guide: {body: ram, value: [free, 0, 0]}
symmetry: [bar.ymin, bar.zmin]
contact:
  - hit: {mortar: ram.surface, nonmortar: bar.xmax}
dynamics: {time_step: 0.02, end_time: 3.5}
"""
STILL = MASS.replace("[free, 0, 0]", "[0, 0, 0]")
SCENES = {
    "mass": MASS.replace(", damping: DAMPING", ""), "damped": MASS.replace("DAMPING", "4"), "ball": BALL,
    "struck": STRUCK,
    "fine": STRUCK.replace("time_step: 0.02", "time_step: 0.01"), "still": STILL.replace(", damping: DAMPING", "")
}


def saint_venant(tau):
    """Force of a mass equal to that of the bar, divided by E A v/c, at the time tau L/c after it struck the bar
    (Saint-Venant 1883; Timoshenko and Goodier, section 171)"""
    first = math.exp(-tau)
    return first if tau < 2 else first + math.exp(2 - tau) * (1 - 2 * (tau - 2)) + math.exp(2 - tau)


def judge_ranks(run):
    other = history("ball_3")
    say("ball on 3 ranks: the same",
        all(abs(a - b) < 1e-6 for a, b in zip(run["ball.position_z"], other["ball.position_z"])),
        other["ball.position_z"])


def judge_struck(name, limit):
    run = history(name)
    seen = [(-f / 1e-4, saint_venant(t - 0.1))
            for t, f in zip(run["time"], run["hit.force_x"])
            if 0.4 < t < 2.05 or 2.4 < t < 3.1]
    say(f"{name}: mean error of the force below {limit} E A v/c",
        sum(abs(force - exact) for force, exact in seen) < limit * len(seen),
        sum(abs(force - exact) for force, exact in seen) / len(seen))
    say(f"{name}: the mass leaves the bar at 3.07 L/c",
        all(abs(f) < 1e-7 for t, f in zip(run["time"], run["hit.force_x"]) if t > 3.3), run["hit.force_x"][-30:])


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
elif sys.argv[1:] == ["long"]:
    judge_ranks(history("ball"))
    judge_struck("fine", 0.05)
else:
    for name, ratio in ("mass", 0), ("damped", 0.1):
        run, frequency = history(name), 10
        own = frequency * math.sqrt(1 - ratio**2)
        seen = [(x - 0.5, math.exp(-ratio * frequency * t) * math.sin(own * t) / own)
                for t, x in zip(run["time"], run["m.position_x"])]
        say(f"{name}: oscillates with sqrt(k/m), to 0.2 % of the amplitude",
            all(abs(x - exact) < 2e-3 / own for x, exact in seen), seen)
    run = history("ball")
    fall = [(z, 1.45 - 5 * t * t) for t, z in zip(run["time"], run["ball.position_z"]) if t < 0.295]
    say("ball: falls along the parabola", all(abs(z - exact) < 1e-8 for z, exact in fall), fall)
    say("ball: rises again, not higher than before",
        min(run["ball.position_z"]) < 1.2 < max(run["ball.position_z"][35:]) < 1.45, run["ball.position_z"])
    say("ball: never deeper than the fall of a step", min(run["ball.position_z"]) > 0.97, min(run["ball.position_z"]))
    energy = [0] + [total - work for total, work in zip(run["dynamics.total_energy"], run["work"])]
    say("ball: energy never grows", all(b < a + 1e-6 for a, b in zip(energy, energy[1:])), energy)
    judge_struck("struck", 0.07)
