#!/usr/bin/env python3
"""Prints a table: time of a load step with true gap over that of CG without contact, on one rank.

    share/bench/price.py [SCENE=REFINE ...]      by default the scenes below

Each linear scene runs three times. The load step as chosen is compared with CG by BoomerAMG's own cycle, which is a
run of one load step; the load step by AMG alone with CG by the default cycle of the same run. A scene of finite strain
runs twice: as it is, and as one load step of `-model quadratic`. Its last column is the time of a Newton step, with all
that the optimizer does, over that of one assembly, set-up and solve by CG to 1e-10. Times are wall times: use an idle
machine, or LD_PRELOAD=build/published/cpuclock.so, which makes them processor times.
"""
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CASES = ["two_block=1", "ironing=1", "beam_sphere_linear=1", "hertz_sphere=0", "hertz_cylinder=1", "press_fit=2"]
FINITE = ["beam_sphere_neo_hookean=1"]
HYPRE = ["-tao_ipfilter_amgf_amg_pc_type", "hypre", "-load_steps", "1", "-contact_updates", "1"]


def summary(scene, refine, folder, *options):
    path = os.path.join(folder, "run.json")
    command = [os.path.join(TOP, "bin", "contact"), os.path.join(TOP, "share", "scenes", scene + ".yaml"), "-quiet"]
    always = ["-refine", refine, "-summary", path, "-contact_updates", "20"]
    subprocess.run([*command, *always, *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(path) as file:
        return json.load(file)


def run(scene, refine, folder, *options):
    """Unknowns; mean seconds of a load step; seconds of CG without contact; contact updates of the load steps"""
    result = summary(scene, refine, folder, "-contact_free", *options)
    steps = result["steps"]
    updates = [step["contact_updates"] for step in steps]
    return result["dofs"], sum(step["step_time"]
                               for step in steps) / len(steps), result["contact_free"]["solve_time"], updates


def linear(scene, refine, folder):
    """The columns after the scene"""
    dofs, chosen, _, updates = run(scene, refine, folder)
    _, _, hypre, _ = run(scene, refine, folder, *HYPRE)
    _, amg, cg, _ = run(scene, refine, folder, "-tao_ipfilter_pc_amgf_factor", "false")
    return [
        f"{dofs:,}", f"{chosen / hypre:.2f}", f"{amg / cg:.2f}", f"{sum(updates) / len(updates):.1f}",
        max(updates), ""
    ]


def finite(scene, refine, folder):
    """The columns after the scene"""
    whole = summary(scene, refine, folder)
    updates = [step["contact_updates"] for step in whole["steps"]]
    newton = sum(step["solve_time"] for step in whole["steps"]) / sum(step["ip_iterations"] for step in whole["steps"])
    once = summary(scene, refine, folder, "-model", "quadratic", "-load_steps", "1", "-contact_updates", "1",
                   "-contact_free")
    elastic = once["time"]["assembly"] / max(once["assemblies"].values()) + once["contact_free"]["solve_time"]
    return [
        f"{whole['dofs']:,}", "", "", f"{sum(updates) / len(updates):.1f}",
        max(updates), f"{newton / elastic:.2f}"
    ]


def print_table(heads, cases, columns):
    """Prints a row for each case SCENE=REFINE. columns(scene, refine, folder): texts after the scene"""
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    print("| " + " | ".join(["scene, refinement", "unknowns", *heads]) + " |")
    print("|" + " --- |" * (2 + len(heads)), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            row = [case.replace("=", " "), *columns(*case.split("="), folder)]
            print("| " + " | ".join(map(str, row)) + " |", flush=True)


def columns(scene, refine, folder):
    return (finite if scene in [name.split("=")[0] for name in FINITE] else linear)(scene, refine, folder)


if __name__ == "__main__":
    print_table([
        "as chosen over CG by hypre", "by AMG over CG", "updates, mean", "updates, most",
        "Newton step over elastic solve"
    ], sys.argv[1:] or CASES + FINITE, columns)
