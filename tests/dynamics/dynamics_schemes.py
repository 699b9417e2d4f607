"""Free vibration: order of convergence in the time step. A bar hits a rigid wall (Code_Aster, SDNV100; exact by waves):
it touches the wall for 2 L/c = 80 us, with the force A rho c v = 1.6 MN, and flies back at 100 m/s. What is refused.

python3 dynamics_schemes.py scenes writes the scenes; python3 dynamics_schemes.py judges the runs that
dynamics_schemes.sh has made.
"""
import sys

import numpy as np

from histories import history
from summaries import say, within

VIBRATION = """bodies:
  - bar: {{lower: [0, 0, 0], upper: [1, 0.1, 0.1], cells: [10, 1, 1], young: 1, poisson: 0, element: full, density: 1}}
displacements:
  - fix: {{face: bar.xmin, value: [0, free, free]}}
  - y: {{face: bar.ymin, value: [free, 0, free]}}
  - z: {{face: bar.zmin, value: [free, free, 0]}}
tractions:
  - end: {{face: bar.xmax, value: [0.01, 0, 0]}}
load: {{expression: "{load}"}}
probes:
  - tip: {{point: [1, 0, 0]}}
dynamics: {{time_step: {step}, end_time: 3.6, scheme: {scheme}, mass: {mass}}}
"""
WALL = """bodies:
  - wall: {{lower: [-0.01, -0.02, -0.02], upper: [0, 0.04, 0.04], cells: [1, 1, 1], material: rigid, density: 1}}
  - bar: {{lower: [0.002, 0, 0], upper: [0.202, 0.02, 0.02], cells: [20, 1, 1], young: 2e11, poisson: 0, element: full,
          density: 8000, initial_velocity: [-100, 0, 0]}}
displacements:
  - fix: {{body: wall, value: [0, 0, 0]}}
  - y: {{face: bar.ymin, value: [free, 0, free]}}
  - z: {{face: bar.zmin, value: [free, free, 0]}}
contact:
  - hit: {{mortar: wall.xmax, nonmortar: bar.xmin}}
dynamics: {{time_step: 2e-6, end_time: 140e-6, scheme: {scheme}, mass: {mass}}}
"""
DAMPED = VIBRATION.replace("density: 1}}", "density: 1, initial_velocity: [0.01, 0, 0]}}").replace(
    "[0.01, 0, 0]}}\nload: {{expression: \"{load}\"}}", "[0, 0, 0]}}").replace("mass: {mass}",
                                                                               "mass: {mass}, damping_stiffness: 0.1")
STEPS = {"coarse": 0.1, "middle": 0.05, "fine": 0.025}
SCHEMES = {
    "alpha_10": "generalized_alpha, spectral_radius: 1", "alpha_08": "generalized_alpha, spectral_radius: 0.8",
    "impact": "impact"
}
LOADS = {"smooth": ("sin(t)^4", "lumped"), "sudden": ("1", "consistent")}
SCENES = {
    f"vibration_{load}_{name}_{step}": VIBRATION.format(load=LOADS[load][0], mass=LOADS[load][1], step=STEPS[step],
                                                        scheme=scheme)
    for load in LOADS for name, scheme in SCHEMES.items() for step in STEPS if load == "smooth" or (step == "coarse")
}
SCENES |= {
    f"damped_{name}": DAMPED.format(mass="lumped", step=0.02, scheme=SCHEMES[name])
    for name in ("alpha_10", "impact")
}
SCENES |= {
    f"wall_{name}_{mass}": WALL.format(scheme=scheme, mass=mass)
    for name, scheme, mass in (("alpha", SCHEMES["alpha_08"], "redistributed"), ("impact", SCHEMES["impact"],
                                                                                 "redistributed"),
                               ("impact", SCHEMES["impact"], "lumped"), ("impact", SCHEMES["impact"], "consistent"))
}
BODY = ("bodies:\n  - bar: {{lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0{body}}}\n"
        "dynamics: {{{dynamics}}}\n")
REFUSED = {
    "density": ("", "time_step: 1, end_time: 2"), "density_negative": (", density: -1", "time_step: 1, end_time: 2"),
    "step_0": (", density: 1", "time_step: 0, end_time: 2"), "step_negative": (", density: 1",
                                                                               "time_step: -1, end_time: 2"),
    "end": (", density: 1", "time_step: 1, end_time: 0.5"), "scheme": (", density: 1",
                                                                       "time_step: 1, end_time: 2, scheme: newmark"),
    "radius": (", density: 1", "time_step: 1, end_time: 2, scheme: generalized_alpha, spectral_radius: 1.5"),
    "radius_impact": (", density: 1", "time_step: 1, end_time: 2, spectral_radius: 0.5"), "no_end": (", density: 1",
                                                                                                     "time_step: 1"),
    "synonym": (", density: 1", "dt: 1, end_time: 2"), "many": (", density: 1", "time_step: 1e-9, end_time: 2"),
    "damping": (", density: 1", "time_step: 1, end_time: 2, damping_mass: -1"),
    "viscosity": (", density: 1", "time_step: 1, end_time: 2, damping_stiffness: -1"),
    "viscosity_law": (", density: 1, material: neohookean", "time_step: 1, end_time: 2, damping_stiffness: 1")
}


def damped(time, n=10, damping=0.1):
    """Tip of the bar of n elements with lumped mass that starts with the velocity 0.01, by its modes"""
    stiffness, mass = np.zeros((n + 1, n + 1)), np.zeros(n + 1)
    for e in range(n):
        stiffness[e:e + 2, e:e + 2] += n * np.array([[1, -1], [-1, 1]])
        mass[e:e + 2] += 0.5 / n
    root = np.sqrt(mass[1:])
    squares, modes = np.linalg.eigh(stiffness[1:, 1:] / np.outer(root, root))
    decay = 0.5 * damping * squares
    frequency = np.sqrt((squares - decay**2).astype(complex))
    return float((modes[-1] * (modes.T @ (0.01 * root)) * np.exp(-decay * time) *
                  (np.sin(frequency * time) / frequency).real).sum() / root[-1])


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        open(name + ".yaml", "w").write(text)
    for name, (body, dynamics) in REFUSED.items():
        open(f"refused_{name}.yaml", "w").write(BODY.format(body=body, dynamics=dynamics))
    open("refused_static.yaml",
         "w").write(BODY.format(body=", initial_velocity: [1, 0, 0]", dynamics="").replace("dynamics: {}\n", ""))
    open("refused_mass.yaml", "w").write(WALL.format(scheme="generalized_alpha", mass="lumped"))
    open("refused_steps.yaml",
         "w").write(BODY.format(body=", density: 1", dynamics="time_step: 1, end_time: 2") + "load: {steps: 3}\n")
else:
    for name in SCHEMES:
        tips = [history(f"vibration_smooth_{name}_{step}")["tip.displacement_x"][-1] for step in STEPS]
        ratio = (tips[0] - tips[1]) / (tips[1] - tips[2])
        say(f"free vibration, {name}: order 2 in the time step", within(ratio, 4, 0.1), ratio)
        run = history(f"vibration_sudden_{name}_coarse")
        lost = run["dynamics.numerical_dissipation"]
        say(f"free vibration, {name}: no energy comes from nowhere", min(lost) > -1e-9 * max(run["work"]), lost)
        say(f"free vibration, {name}: forces are in balance with inertia",
            max(run["equilibrium"]) < 1e-8, max(run["equilibrium"]))
        if name != "alpha_08":
            say(f"free vibration, {name}: nothing is dissipated", max(lost) < 1e-9 * max(run["work"]), lost)
    for name in "alpha_10", "impact":
        run = history("damped_" + name)
        errors = [abs(tip - damped(time)) for time, tip in zip(run["time"], run["tip.displacement_x"])]
        say(f"damping by stiffness, {name}: tip by the modes to 0.1 % at every instant",
            max(errors) < 1e-3 * max(run["tip.displacement_x"]), max(errors))
        say(f"damping by stiffness, {name}: energy is accounted for",
            max(map(abs, run["dynamics.numerical_dissipation"])) < 1e-10 * run["dynamics.damping_work"][-1],
            run["dynamics.numerical_dissipation"])
    mass, energy = 8000 * 0.2 * 4e-4, 0.5 * 8000 * 0.2 * 4e-4 * 1e4
    for name in (name for name in SCENES if name.startswith("wall")):
        run = history(name)
        closed = [t for t, f in zip(run["time"], run["contact_force_x"]) if f > 1e3]
        force = [f for t, f in zip(run["time"], run["contact_force_x"]) if 30e-6 < t < 95e-6]
        speed = run["dynamics.momentum_x"][-1] / mass
        say(f"{name}: rebound speed within 6 % of 100 m/s", within(speed, 100, 0.06), speed)
        say(f"{name}: mean force within 4 % of 1.6 MN", within(sum(force) / len(force), 1.6e6, 0.04),
            sum(force) / len(force))
        say(f"{name}: contact from 20 us to 100 us",
            len(closed) > 0 and 18e-6 < closed[0] < 24.1e-6 and 96e-6 < closed[-1] < 104.1e-6, closed)
        waves = [-100 + 200 * min(max((t - 20e-6) / 80e-6, 0), 1) for t in run["time"]]
        off = max(abs(p / mass - v) for p, v in zip(run["dynamics.momentum_x"], waves))
        say(f"{name}: mean velocity by waves at every instant, to 8 m/s of 200", off < 8, off)
        if "impact" in name:
            say(
                f"{name}: energy never grows",
                max(b - a for a, b in zip([energy] + run["dynamics.total_energy"], run["dynamics.total_energy"])) <
                1e-9 * energy, run["dynamics.total_energy"])
        if name == "wall_impact_redistributed":
            say(f"{name}: energy stays", within(run["dynamics.total_energy"][-1], energy, 1e-4),
                run["dynamics.total_energy"][-1] / energy)
            say(f"{name}: force within 25 % of 1.6 MN after the first microseconds",
                all(within(f, 1.6e6, 0.25) for f in force), force)
            say(f"{name}: a step takes less than half an elastic solve",
                sum(run["amg_applications"]) < 0.5 * 35 * len(run["time"]), sum(run["amg_applications"]))
