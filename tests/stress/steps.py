"""The state at the end of a load program must not depend on how many steps led to it."""
import os

import numpy as np

from runner import SCENES, solve

STEPS = (20, 5, 2, 1)
TOLERANCE = 1e-6


def compare(folder, wanted, done, limit):
    for name in ("two_block", "hertz_cylinder"):
        if not wanted(f"load steps, {name}"):
            continue
        base = None
        for updates in (60, 1):
            for steps in STEPS:
                options = ["-refine", 0, "-load_steps", steps, "-contact_updates", updates, "-contact_update_tol", 1e-9]
                run = solve(os.path.join(folder, "steps"), f"{name}_{steps}_{updates}", os.path.join(SCENES, name + ".yaml"), options, limit, write=True)
                base = base or run
                wrong, off = [], None
                if not run.converged:
                    wrong.append(run.status)
                elif base.converged:
                    a, b = run.fields(steps)["displacement"], base.fields(STEPS[0])["displacement"]
                    off = (np.abs(a - b).max() / np.abs(b).max(), run.energy / base.energy - 1)
                    if updates > 1 and not off[0] <= TOLERANCE:
                        wrong.append(f"displacement differs by {off[0]:.1e}")
                done(name, steps, updates, run, off, wrong)
