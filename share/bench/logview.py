"""What PETSc's log and hypre's statistics say of a run: times, counts and flops of events, complexities of the AMG."""
import csv
import re

EVENTS = ("MatMult", "PCApply", "KSPSolve", "PCAMGFAMGApply", "PCAMGFAMGSetUp", "PCAMGFFltApply", "PCAMGFFltSetUp")
STATISTICS = "-tao_ipfilter_amgf_amg_pc_hypre_boomeramg_print_statistics"


def arguments(base):
    return ["-log_view", f":{base}.csv:ascii_csv", STATISTICS, "3"]


def read_events(path):
    """event: count, seconds, flops of the first rank"""
    events = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            name = row["Event Name"].strip()
            if name in EVENTS and row["Rank"] == "0" and name not in events:
                events[name] = {"count": float(row["Count"]), "seconds": float(row["Time"]), "flops": float(row["FLOP"])}
    return events


def read_levels(said):
    """Rows and nonzeros of the operators of hypre's first hierarchy, fine to coarse: lines of "level rows entries sparsity ..." """
    levels = []
    table = re.search(r"Operator Matrix Information:.*?\n\s*=+\n(.*?)\n\s*\n", said, re.S)
    for line in table.group(1).splitlines() if table else ():
        words = line.split()
        if len(words) > 3 and words[0].isdigit():
            levels.append({"rows": float(words[1]), "entries": float(words[2])})
    return levels


def read(base, said):
    complexity = {name: float(m.group(1)) for name in ("grid", "operator", "memory") if (m := re.search(rf"\b{name} = +([0-9.]+)", said))}
    return {"events": read_events(base + ".csv"), "complexity": complexity, "levels": read_levels(said)}
