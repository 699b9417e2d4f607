#!/usr/bin/env python3
"""Prints a table: scenes solved with AMG and with one factorization of the stiffness by MUMPS, user CPU time and memory
on one rank.

    share/bench/direct.py [SCENE=REFINE ...]      by default three sizes of hertz_sphere and of two_block

CPU time is the child's own, so other work on the machine shifts it by some tens of per cent; ratios of a pair shift
less.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CASES = ["hertz_sphere=0", "two_block=1", "two_block=2", "hertz_sphere=1"]


def run(scene, refine, factor, folder):
    """Unknowns, user CPU seconds, MB at the peak"""
    summary = os.path.join(folder, "run.json")
    begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [os.path.join(TOP, "bin", "contact"), os.path.join(TOP, "share", "scenes", scene + ".yaml"), "-quiet"]
    options = ["-refine", refine, "-summary", summary, "-contact_updates", "1" if scene == "two_block" else "20"]
    subprocess.run([*command, *options, "-tao_ipfilter_pc_amgf_factor", factor], check=True, stdout=subprocess.DEVNULL)
    with open(summary) as file:
        result = json.load(file)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin
    return result["dofs"], seconds, result["peak_memory_bytes"] / 1e6


def main():
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    print("| scene, refinement | unknowns | AMG [s] | MUMPS [s] | AMG [MB] | MUMPS [MB] |")
    print("| --- | --- | --- | --- | --- | --- |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for case in sys.argv[1:] or CASES:
            scene, refine = case.split("=")
            dofs, amg, amg_memory = run(scene, refine, "false", folder)
            _, mumps, mumps_memory = run(scene, refine, "true", folder)
            row = [
                f"{scene} {refine}", f"{dofs:,}", f"{amg:.1f}", f"{mumps:.1f}", f"{amg_memory:,.0f}",
                f"{mumps_memory:,.0f}"
            ]
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
