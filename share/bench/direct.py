#!/usr/bin/env python3
"""Prints a table: scenes solved with AMG and with one factorization of the stiffness by MUMPS, user CPU time and memory
on one rank.

    share/bench/direct.py [SCENE=REFINE ...]      by default three sizes of hertz_sphere and of two_block

CPU time is the child's own, so other work on the machine shifts it by some tens of per cent; ratios of a pair shift
less.
"""
import resource
import sys

from price import print_table, summary

CASES = ["hertz_sphere=0", "two_block=1", "two_block=2", "hertz_sphere=1"]


def run(scene, refine, factor, folder):
    """Unknowns, user CPU seconds, MB at the peak"""
    begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = summary(scene, refine, folder, "-contact_updates", "1" if scene == "two_block" else "20",
                     "-tao_ipfilter_pc_amgf_factor", factor)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin
    return result["dofs"], seconds, result["peak_memory_bytes"] / 1e6


def columns(scene, refine, folder):
    dofs, amg, amg_memory = run(scene, refine, "false", folder)
    _, mumps, mumps_memory = run(scene, refine, "true", folder)
    return f"{dofs:,}", f"{amg:.1f}", f"{mumps:.1f}", f"{amg_memory:,.0f}", f"{mumps_memory:,.0f}"


if __name__ == "__main__":
    print_table(["AMG [s]", "MUMPS [s]", "AMG [MB]", "MUMPS [MB]"], sys.argv[1:] or CASES, columns)
