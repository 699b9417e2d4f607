"""Rows of the tables: a run's costs and errors, whichever study it belongs to."""
import csv
import math

import growth
from problems import PROBLEMS


def relative(value, reference):
    return abs(value / reference - 1) if reference else math.nan


def costs(record):
    """Time, iterations and memory of a run, whole or not"""
    summary = record["summary"]
    times = {"seconds": record["seconds"], "wall": record["wall"]}
    if not summary:
        return times
    steps = summary["steps"]
    return times | {
        "unknowns": summary["dofs"],
        "step_seconds": [step["solve_time"] for step in steps if step["converged"]],
        "newton": sum(step["ip_iterations"] for step in steps),
        "pcg": sum(sum(step["ksp_iterations"]) for step in steps),
        "applications": sum(step["amg_applications"] for step in steps),
        "amg_setups": sum(step["amg_setups"] for step in steps),
        "memory": summary["peak_memory_bytes"],
        "memory_an_unknown": summary["peak_memory_bytes"] / max(1, summary["dofs"]),
    }


def errors(record, reference, careful):
    """Of every quantity against the reference and against the careful run on the same mesh, which has the mesh's error
    too"""
    row = {}
    for quantity, value in (record["measure"] or {}).items():
        if reference and reference.get(quantity):
            row[f"error {quantity}"] = relative(value, reference[quantity])
        if careful and careful["measure"]:
            row[f"same mesh {quantity}"] = relative(value, careful["measure"][quantity])
    return row


def checks(record):
    last = record["summary"]["steps"][-1] if record["summary"] and record["summary"]["steps"] else {}
    return {key: last.get(key) for key in ("equilibrium", "kkt_error", "gap_true", "error_estimate")}


def make_row(study, panel, series, value, case, store, references):
    record, careful = store.get(case), store.get(panel.careful) if panel.careful else None
    if record is None:
        return None
    row = {
        "study": study.name, "problem": panel.problem, "mesh": case.level, "series": series.label, "value": value,
        "ranks": case.ranks, "status": record["status"]
    }
    row |= costs(record)
    row |= errors(record, PROBLEMS[panel.problem].exact(references), careful)
    row |= checks(record) | {
        "repeats": record["repeats"], "load": record["load"], "key": record["key"], "command": " ".join(
            record["command"]), "said": record["said"]
    }
    return row


def collect(studies, store, references):
    """All rows that have been run, in the order of the studies"""
    rows = [
        make_row(study, panel, series, value, case, store, references) for study in studies for panel in study.panels
        for series in panel.series for value, case in series.points
    ]
    return [row for row in rows if row]


def select(rows, **keys):
    return [row for row in rows if all(row[key] == value for key, value in keys.items())]


def of_panel(rows, study, panel):
    """One without a mesh of its own has the rows of all of them"""
    mesh = {"mesh": panel.level} if panel.level else {}
    return select(rows, study=study.name, problem=panel.problem, **mesh)


def converged(rows):
    return [row for row in rows if row["status"] == "converged"]


def growth_table(rows):
    """Exponents of every series, and the crossover with MUMPS"""
    table, times = [], {}
    for label in dict.fromkeys(row["series"] for row in select(rows, study="growth")):
        runs = converged(select(rows, study="growth", series=label))
        unknowns = [row["unknowns"] for row in runs]
        times[label] = {row["unknowns"]: row["seconds"] for row in runs}
        table.append({"series": label, "largest": max(unknowns, default=0)} | {
            cost: growth.exponent(unknowns, [row[cost] for row in runs])
            for cost in ("seconds", "applications", "memory")
        })
    for entry in table:
        entry["crossover"] = growth.crossover(times.get("defaults", {}),
                                              times[entry["series"]]) if entry["series"] != "defaults" else None
    return table


def cell(value):
    if isinstance(value, list):
        return " ".join(map(cell, value))
    return f"{value:.8g}" if isinstance(value, float) else str(value) if value is not None else ""


def write_csv(path, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows({key: cell(value) for key, value in row.items()} for row in rows)
