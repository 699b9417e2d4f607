"""Scenes for dynamics_reactions.sh, and their reactions: python dynamics_reactions.py scenes|judge."""
import math
import sys

import numpy as np

from summaries import load, say

SCENES = {
    "block": """bodies:
  - b: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 2], young: 1e6, poisson: 0, element: full, density: 1000}
displacements: [f: {face: b.zmin, value: [0, 0, 0]}]
body_forces: [g: {body: b, value: [100, 200, -9810]}]
dynamics: {time_step: 0.02, end_time: 1.2, damping_mass: 40, scheme: SCHEME}
""", "sector": """bodies:
  - b: {shape: tube_arc, axis: z, radii: [1, 2], angles: [20, 60], extent: [0, 1], cells: [1, 2, 1], young: 1e6,
        poisson: 0.3, density: 1000}
symmetry: [b.amin, b.amax, b.lmin, b.lmax]
pressures: [p: {face: b.inner, value: 1000}]
dynamics: {time_step: 0.03, end_time: 2.4, damping_mass: 40, scheme: SCHEME}
""", "pendulum": """bodies:
  - b: {lower: [0, -0.1, -0.1], upper: [2, 0.1, 0.1], cells: [1, 1, 1], material: rigid, density: 1000}
displacements: [f: {body: b, value: [0, 0, 0], rotation: [0, free, 0], center: [0, 0, 0]}]
body_forces: [g: {body: b, value: [0, 0, -9810]}]
dynamics: {time_step: 0.0025, end_time: 0.5, scheme: SCHEME}
"""
}


def near(value, exact, tolerance):
    return np.linalg.norm(np.subtract(value, exact)) <= tolerance * np.linalg.norm(exact)


def pendulum(angle):
    """The force on the axis of the bar that has turned by an angle below the horizontal, in which it was at rest"""
    mass, inertia, g = 80, 4 / 3 + 0.1**2 / 3, 9.81
    rate, gain = 2 * g * math.sin(angle) / inertia, g * math.cos(angle) / inertia
    along, across = np.array([math.cos(angle), 0, -math.sin(angle)]), np.array([-math.sin(angle), 0, -math.cos(angle)])
    return mass * (gain * across - rate * along + [0, 0, g])


def judge(scheme):
    last = {name: load(name + "_" + scheme)["steps"][-1] for name in SCENES}
    faces = {name: {face["name"]: face["reaction"] for face in step["faces"]} for name, step in last.items()}
    say(f"{scheme}, block at rest: reaction of its face", near(faces["block"]["b.zmin"], [-100, -200, 9810], 1e-6),
        faces["block"])
    for face, angle, sign in ("b.amin", 20, 1), ("b.amax", 60, -1):
        normal = [math.sin(math.radians(angle)), -math.cos(math.radians(angle)), 0]
        say(f"{scheme}, sector at rest: reaction of {face}",
            near(faces["sector"][face], 1000 * sign * np.array(normal), 1e-6), faces["sector"])
    exact = pendulum(math.radians(last["pendulum"]["rigid_bodies"][0]["rotation"][1]))
    say(f"{scheme}, pendulum: reaction of its axis to 1 %", near(faces["pendulum"]["b.*"], exact, 1e-2),
        (faces["pendulum"], exact))
    for name, step in last.items():
        body, total = step["bodies"][0], np.sum(list(faces[name].values()), axis=0)
        say(f"{scheme}, {name}: reaction of the body is that of its faces, and balances its load",
            near(body["reaction"], total, 1e-9) and near(body["load"], -total, 1e-7), (body, total))


if sys.argv[1] == "scenes":
    for name, text in SCENES.items():
        for scheme in "impact", "generalized_alpha":
            with open(f"{name}_{scheme}.yaml", "w") as file:
                file.write(text.replace("SCHEME", scheme))
else:
    judge("impact")
    judge("generalized_alpha")
