#!/usr/bin/env python3
"""Prints a table: time of a load step with true gap over that of CG without contact, on one rank.

    share/bench/price.py [SCENE=REFINE ...]      by default the six scenes below

Each scene runs three times. The load step as chosen is compared with CG by BoomerAMG's own cycle, which is a run of
one load step; the load step by AMG alone with CG by the default cycle of the same run. Times are wall times: use an
idle machine, or LD_PRELOAD=build/published/cpuclock.so, which makes them processor times.
"""
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CASES = ["two_block=1", "ironing=1", "beam_sphere_linear=1", "hertz_sphere=0", "hertz_cylinder=1", "press_fit=2"]
HYPRE = ["-tao_ipfilter_amgf_amg_pc_type", "hypre", "-load_steps", "1", "-contact_updates", "1"]


def run(scene, refine, folder, *options):
    """Unknowns; mean seconds of a load step; seconds of CG without contact; contact updates of the load steps"""
    summary = os.path.join(folder, "run.json")
    command = [os.path.join(TOP, "bin", "contact"), os.path.join(TOP, "share", "scenes", scene + ".yaml"), "-quiet"]
    always = ["-refine", refine, "-summary", summary, "-contact_updates", "20", "-contact_free"]
    subprocess.run([*command, *always, *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(summary) as file:
        result = json.load(file)
    steps = result["steps"]
    updates = [step["contact_updates"] for step in steps]
    return result["dofs"], sum(step["step_time"]
                               for step in steps) / len(steps), result["contact_free"]["solve_time"], updates


def main():
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    print(
        "| scene, refinement | unknowns | as chosen over CG by hypre | by AMG over CG | updates, mean | updates, most |"
    )
    print("| --- | --- | --- | --- | --- | --- |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in sys.argv[1:] or CASES:
            scene, refine = case.split("=")
            dofs, chosen, _, updates = run(scene, refine, folder)
            _, _, hypre, _ = run(scene, refine, folder, *HYPRE)
            _, amg, cg, _ = run(scene, refine, folder, "-tao_ipfilter_pc_amgf_factor", "false")
            row = [
                f"{scene} {refine}", f"{dofs:,}", f"{chosen / hypre:.2f}", f"{amg / cg:.2f}",
                f"{sum(updates) / len(updates):.1f}",
                max(updates)
            ]
            print("| " + " | ".join(map(str, row)) + " |", flush=True)


if __name__ == "__main__":
    main()
