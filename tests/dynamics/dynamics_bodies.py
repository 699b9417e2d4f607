"""Two equal bars that meet: the first stops, the second flies on (exact by waves); a block that slides over v^2/(2 mu
g); a block that falls and bounces; a rod of finite strain that spins freely; a rigid body that falls.

python3 dynamics_bodies.py scenes writes the scenes; python3 dynamics_bodies.py judges the runs that dynamics_bodies.sh
has made.
"""
import math
import sys

import h5py

from histories import history
from summaries import say, within

BARS = """bodies:
  - a: {lower: [0, 0, 0], upper: [0.1, 0.02, 0.02], cells: [10, 1, 1], young: 2e11, poisson: 0, element: full,
        density: 8000, initial_velocity: [10, 0, 0]}
  - b: {lower: [0.1001, 0, 0], upper: [0.2001, 0.02, 0.02], cells: [10, 1, 1], young: 2e11, poisson: 0, element: full,
        density: 8000}
symmetry: [a.ymin, a.zmin, b.ymin, b.zmin]
contact:
  - hit: {mortar: a.xmax, nonmortar: b.xmin}
probes:
  - a: {point: [0.05, 0, 0], body: a}
  - b: {point: [0.15, 0, 0], body: b}
dynamics: {time_step: 2e-6, end_time: 80e-6}
"""
SLIDE = """bodies:
  - floor: {lower: [-1, -1, -0.2], upper: [4, 2, 0], cells: [10, 3, 1], material: rigid}
  - block: {lower: [0, 0, 0], upper: [1, 1, 0.5], cells: [2, 2, 1], young: 1e4, poisson: 0.2, element: full, density: 1,
            initial_velocity: [2, 0, 0]}
displacements:
  - fix: {body: floor, value: [0, 0, 0]}
body_forces:
  - weight: {body: block, value: [0, 0, -10]}
contact:
  - foot: {mortar: floor.zmax, nonmortar: block.zmin, friction: 0.2}
probes:
  - middle: {point: [0.5, 0.5, 0.25], body: block}
dynamics: {time_step: 0.04, end_time: 1.2}
"""
BOUNCE = SLIDE.replace(", friction: 0.2", "").replace("[2, 0, 0]", "[0, 0, 0]").replace(
    "lower: [0, 0, 0], upper: [1, 1, 0.5]", "lower: [0, 0, 0.05], upper: [1, 1, 0.55]").replace(
        "0.25]", "0.3]").replace("time_step: 0.04, end_time: 1.2",
                                 "time_step: 0.01, end_time: 0.4").replace("1e4", "1e3")
SPIN = """bodies:
  - rod: {lower: [-1, -0.1, -0.1], upper: [1, 0.1, 0.1], cells: [6, 1, 1], material: neohookean, young: 1e3,
          poisson: 0.3, density: 1, initial_spin: [0, 0, 2]}
dynamics: {time_step: 0.05, end_time: 5, scheme: generalized_alpha, spectral_radius: 0.9, mass: consistent}
"""
SPIN_IMPACT = SPIN.replace(", scheme: generalized_alpha, spectral_radius: 0.9", "")
RIGID = """bodies:
  - ball: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: rigid, density: 2,
           initial_velocity: [3, 0, 1]}
  - other: {lower: [5, 0, 0], upper: [6, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0, density: 1}
displacements:
  - free: {body: ball, value: [free, free, free], rotation: [free, free, free], center: [0.5, 0.5, 0.5]}
  - fix: {face: other.xmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: ball, value: [0, 0, -20]}
probes:
  - middle: {point: [0.5, 0.5, 0.5], body: ball}
dynamics: {time_step: 0.05, end_time: 1, mass: lumped}
"""
TURN = """bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], material: rigid, density: 1, initial_spin: [0, 0, 1]}
  - other: {lower: [5, 0, 0], upper: [6, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0, density: 1}
displacements:
  - free: {body: cube, value: [free, free, free], rotation: [free, free, free], center: [0.5, 0.5, 0.5]}
  - fix: {face: other.xmin, value: [0, 0, 0]}
dynamics: {time_step: 0.02, end_time: 1.6}
"""
TUMBLE = TURN.replace(
    "upper: [1, 1, 1], cells: [1, 1, 1], material: rigid, density: 1, initial_spin: [0, 0, 1]",
    "upper: [1, 2, 3], cells: [1, 1, 1], material: rigid, density: 1, initial_spin: [0.1, 1, 0.02]").replace(
        "center: [0.5, 0.5, 0.5]", "center: [0.5, 1, 1.5]").replace("time_step: 0.02, end_time: 1.6",
                                                                    "time_step: 0.2, end_time: 8")
PENDULUM = TURN.replace("lower: [0, 0, 0], upper: [1, 1, 1]", "lower: [0, 0, -1], upper: [0.2, 0.2, 0]").replace(
    ", initial_spin: [0, 0, 1]",
    "").replace("[free, free, free], rotation: [free, free, free], center: [0.5, 0.5, 0.5]",
                "[0, 0, 0], rotation: [0, free, 0], center: [0.1, 0.1, 0]").replace(
                    "dynamics: {time_step: 0.02, end_time: 1.6}",
                    ("body_forces:\n  - weight: {body: cube, value: [5, 0, -9.81]}\nload: {expression: \"1\"}\n"
                     "dynamics: {time_step: 0.05, end_time: 3}"))
SCENES = {
    "tumble": TUMBLE, "pendulum": PENDULUM, "turn": TURN, "massless": TURN.replace("material: rigid, density: 1",
                                                                                   "material: rigid"), "bars": BARS,
    "bars_alpha": BARS.replace("80e-6", "80e-6, scheme: generalized_alpha"), "slide": SLIDE, "bounce": BOUNCE,
    "bounce_damped": BOUNCE.replace("end_time: 0.4", "end_time: 0.4, damping_mass: 2"), "spin": SPIN,
    "spin_impact": SPIN_IMPACT, "rigid": RIGID
}


def differ(one, other, keys):
    return max(abs(a - b) for key in keys for a, b in zip(one[key][-10:], other[key][-10:]))


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        open(name + ".yaml", "w").write(text)
else:
    momentum, energy, step = 8000 * 4e-5 * 10, 0.5 * 8000 * 4e-5 * 100, 2e-6
    for name in "bars", "bars_alpha":
        run = history(name)
        speeds = [(run[f"{body}.displacement_x"][-1] - run[f"{body}.displacement_x"][-6]) / (5 * step) for body in "ab"]
        say(f"{name}: momentum stays", all(within(p, momentum, 1e-10) for p in run["dynamics.momentum_x"]),
            run["dynamics.momentum_x"])
        say(f"{name}: the first stops, the second has its speed within 8 %",
            abs(speeds[0]) < 0.8 and within(speeds[1], 10, 0.08), speeds)
        say(f"{name}: energy within 1 %", within(run["dynamics.total_energy"][-1], energy, 0.01),
            run["dynamics.total_energy"][-1] / energy)
    run = history("bars")
    say("bars: energy to rounding", within(run["dynamics.total_energy"][-1], energy, 1e-8),
        run["dynamics.total_energy"][-1] / energy - 1)
    say("bars: time of the history", within(run["time"][-1], 80e-6, 1e-12), run["time"])
    with h5py.File(f"bars_{len(run['time']):04d}.h5", "r") as file:
        say("bars: fields have the velocity", file["velocity"].shape == file["displacement"].shape, list(file))
    say("bars on 3 ranks: same energies",
        differ(run, history("bars_3"), ["dynamics.total_energy", "dynamics.kinetic_energy"]) < 1e-8 * energy, "")
    for name in "bars", "bars_alpha", "bounce_damped":
        whole, part = history(name), history("part_" + name)
        say(
            f"{name}: goes on from a checkpoint to the same end",
            differ(whole, part, ["dynamics.total_energy", "dynamics.damping_work", "contact_work", "work", "time"]) <
            1e-7 * max(whole["dynamics.total_energy"]),
            (whole["dynamics.total_energy"][-3:], part["dynamics.total_energy"][-3:]))
    run = history("slide")
    way = run["middle.displacement_x"][-1]
    say("slide: v^2/(2 mu g) within 0.2 %", within(way, 1, 2e-3), way)
    say("slide: nothing is lost to the time integration",
        abs(run["dynamics.numerical_dissipation"][-1]) < 1e-6, run["dynamics.numerical_dissipation"])
    free, damped = history("bounce"), history("bounce_damped")
    say("bounce: back to at least 60 % of the height",
        max(free["middle.displacement_z"][20:]) > -0.02, max(free["middle.displacement_z"][20:]))
    say("bounce: with damping not as high",
        max(damped["middle.displacement_z"][20:]) < max(free["middle.displacement_z"][20:]) - 0.005,
        max(damped["middle.displacement_z"][20:]))
    for name, run in ("bounce", free), ("bounce_damped", damped):
        lost = [a - b for a, b in zip(run["dynamics.numerical_dissipation"], run["contact_work"])]
        say(f"{name}: energy is accounted for",
            max(abs(value) for value in lost) < 1e-8 * max(run["dynamics.total_energy"]), lost)
    run = history("spin")
    spin, total = run["dynamics.angular_momentum_z"], run["dynamics.total_energy"]
    say("spin: angular momentum within 1 %", all(within(value, spin[0], 0.01) for value in spin), spin)
    say("spin: energy within 2 %, and it does not grow", all(within(value, total[0], 0.02) for value in total), total)
    run = history("spin_impact")
    spin, total = run["dynamics.angular_momentum_z"], run["dynamics.total_energy"]
    say("spin, impact scheme: angular momentum and energy to 1e-5",
        max(abs(value / values[0] - 1) for values in (spin, total) for value in values) < 1e-5, (spin, total))
    run = history("rigid")
    say(
        "rigid: x = 3 t, z = t - 5 t^2",
        all(
            abs(x - 3 * t) < 1e-8 and abs(z - (t - 5 * t * t)) < 1e-6
            for t, x, z in zip(run["time"], run["middle.displacement_x"], run["middle.displacement_z"])),
        (run["middle.displacement_x"][-1], run["middle.displacement_z"][-1]))
    run = history("turn")
    spin, total = run["dynamics.angular_momentum_z"], run["dynamics.total_energy"]
    say("turn: moment of inertia of a cube, m/6, within 0.1 %",
        within(spin[0], 1 / 6, 1e-3) and within(total[0], 1 / 12, 1e-3), (spin[0], total[0]))
    say("turn: 1.6 radians within 0.1 %, energy stays to 1e-6",
        within(run["cube.rotation_z"][-1], 91.67, 0.001) and abs(total[-1] / total[0] - 1) < 1e-6,
        (run["cube.rotation_z"][-1], total))
    run = history("tumble")
    total = run["dynamics.total_energy"]
    off = max(
        abs(value - run[f"dynamics.angular_momentum_{k}"][0])
        for k in "xyz"
        for value in run[f"dynamics.angular_momentum_{k}"]) / 7.9
    say("tumble about the middle axis: energy and angular momentum to 1e-5 in steps of 0.2 radians",
        max(abs(value / total[0] - 1) for value in total) < 1e-5 and off < 1e-5, (off, total))
    run = history("pendulum")
    turned, lost, total = run["cube.rotation_y"], run["dynamics.numerical_dissipation"], max(
        run["dynamics.total_energy"])
    say(
        "pendulum: swings to twice the angle of rest and back, and loses nothing",
        within(max(map(abs, turned)), 2 * math.degrees(math.atan2(5, 9.81)), 0.01) and min(map(abs, turned[10:])) < 5
        and max(map(abs, lost)) < 1e-3 * total, (max(map(abs, turned)), min(map(abs, turned[10:])), lost))
