"""The state at the end of a load program must not depend on how many steps led to it."""
import os

import numpy as np

from runner import SCENES, Case, solve

STEPS = (20, 5, 2, 1)
TOLERANCE = 1e-6


def compare(args, name):
    folder, base = os.path.join(args.folder, "steps"), None
    for updates in (60, 1):
        for steps in STEPS:
            options = ["-refine", 0, "-load_steps", steps, "-contact_updates", updates, "-contact_update_tol", 1e-9]
            run = solve(folder, f"{name}_{steps}_{updates}", os.path.join(SCENES, name + ".yaml"), options, args.limit,
                        write=True)
            base = base or run
            wrong, displacement, energy = [], None, None
            if not run.converged:
                wrong.append(run.status)
            elif base.converged:
                a, b = run.fields(steps)["displacement"], base.fields(STEPS[0])["displacement"]
                displacement, energy = np.abs(a - b).max() / np.abs(b).max(), run.energy / base.energy - 1
                if updates > 1 and not displacement <= TOLERANCE:
                    wrong.append(f"displacement differs by {displacement:.1e}")
            yield {
                "name": name, "steps": steps, "updates": updates, "run": run, "displacement": displacement,
                "energy": energy, "wrong": wrong
            }


def cases(args):
    for name in ("two_block", "hertz_cylinder", "press_fit"):
        yield Case("Number of load steps", name, lambda name=name: compare(args, name))
