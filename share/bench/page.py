"""The pages of settings: a figure and tables for each study. All text that depends on the results is made from the rows
of the runs."""
import math
import os

import machine
from problems import PROBLEMS
from results import converged, of_panel, select

NEAR = 1.1  # an error within this factor of the smallest counts as no worse


def number(value, digits=3):
    if value is None or value == "" or (isinstance(value, float) and math.isnan(value)):
        return ""
    return f"{value:.{digits}g}" if isinstance(value, float) else f"{value:,}" if isinstance(value, int) else str(value)


def percent(value):
    return f"{100 * value:.0f} %" if value >= 0.1 else f"{100 * value:.2g} %"


def table(columns, rows):
    """Markdown; columns: (heading, row -> text)"""
    lines = ["| " + " | ".join(heading for heading, _ in columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(text(row) for _, text in columns) + " |" for row in rows]) + "\n"


def field(key, digits=3):
    return lambda row: number(row.get(key), digits)


def lead_error(row):
    """Error and name of the quantity that runs are compared by: contact force if it is known, else energy"""
    for quantity in ("contact force", "energy"):
        if row.get(f"error {quantity}") is not None:
            return row[f"error {quantity}"], quantity
    if row.get("same mesh energy") is not None:
        return row["same mesh energy"], "energy, same mesh"
    return None, None


def label(row):
    return " ".join(part for part in (row["series"], row["value"]) if part)


def best_row(panel, runs):
    """Compares the runs whose error is at most NEAR times the smallest one; None if fewer than two errors are known"""
    known = [(row, *lead_error(row)) for row in runs if lead_error(row)[0] is not None]
    if len(known) < 2:
        return None
    least = min(error for _, error, _ in known)
    good = [row for row, error, _ in known if error <= NEAR * least]
    quickest, slowest = min(good, key=lambda r: r["seconds"]), max(good, key=lambda r: r["seconds"])
    return {
        "panel": panel.title, "quantity": known[0][2], "least": percent(least), "quickest": label(quickest),
        "seconds": quickest["seconds"], "slowest": label(slowest), "ratio": slowest["seconds"] / quickest["seconds"]
    }


def megabytes(row):
    return number(row["memory"] / 1e6) if row.get("memory") else ""


def status(row):
    """How it ended; what was said by one that has no answer"""
    return row["status"] + ("" if row["status"] == "converged" or not row["said"] else ": " +
                            row["said"].replace("|", "/"))


def knob_words(study, rows):
    """A table of the best runs of each panel"""
    runs = [of_panel(rows, study, panel) for panel in study.panels]
    best = [row for row in (best_row(panel, converged(r)) for panel, r in zip(study.panels, runs)) if row]
    columns = [("problem", field("panel")), ("error in", field("quantity")), ("smallest error", field("least")),
               ("quickest run", field("quickest")), ("its time [s]", field("seconds")),
               ("slowest run", field("slowest")), ("its time relative to the quickest", field("ratio"))]
    return "Runs with an error at most 10 % above the smallest error of the problem:\n\n" + table(
        columns, best) + "\nAll runs:\n" if best else ""


def knob_table(study, rows):
    runs = select(rows, study=study.name)
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("mesh", field("mesh")),
               ("unknowns", field("unknowns"))]
    columns += [("", field("series"))] if any(row["series"] for row in runs) else []
    columns += [(study.knob, field("value"))] if study.knob != "mesh" else []
    columns += [("time [s]", field("seconds")),
                *([("elapsed time [s]", field("wall"))] if "wall" in study.costs else []),
                ("Newton steps", field("newton")), ("AMG applications", field("applications")),
                ("memory [MB]", megabytes)]
    for quantity in ("energy", "contact force", "peak pressure", "contact radius"):
        if any(f"error {quantity}" in row for row in runs):
            columns.append((f"error in {quantity}", field(f"error {quantity}", 2)))
    if any("same mesh energy" in row for row in runs):
        columns.append(("error in energy, same mesh", field("same mesh energy", 2)))
    if study.knob == "mesh":
        columns.append(("estimated error in energy", lambda r: number((r["error_estimate"] or math.nan)**2, 2)))
    columns += [("equilibrium residual", field("equilibrium", 1)), ("status", status)]
    return table(columns, runs)


def accuracy_table(rows):
    """What was asked for, and what came of it"""
    runs = select(rows, study="accuracy")
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("first mesh", field("mesh")),
               ("refinement", field("series")), ("requested error", field("value")),
               ("true error", lambda r: number(lead_error(r)[0], 2)), ("error in", lambda r: lead_error(r)[1] or ""),
               ("estimated error in energy", lambda r: number((r["error_estimate"] or math.nan)**2, 2))]
    columns += [("unknowns", field("unknowns")), ("time [s]", field("seconds")), ("memory [MB]", megabytes),
                ("status", status)]
    return table(columns, runs)


def time_ratio(row, ours):
    """Of the whole run; at least that where the limit ended it"""
    if not ours or row["status"] not in ("converged", "time limit"):
        return ""
    return ("> " if row["status"] == "time limit" else "") + number(row["seconds"] / ours["seconds"], 2)


def step_ratio(row, ours):
    """Of the optimizer's time in the load steps that both have done"""
    done = len(row.get("step_seconds") or ())
    return f"{sum(row['step_seconds']) / sum(ours['step_seconds'][:done]):.2g} (of {done})" if ours and done else ""


BASELINES = """"Time for load steps" compares the elapsed solve times of the load steps that both runs completed;
their number is in parentheses. After a `time limit`, the time of the whole run is a lower bound.
"""


def baseline_table(study, rows):
    text = []
    for panel in study.panels:
        runs = of_panel(rows, study, panel)
        ours = next((row for row in runs if row["series"] == "defaults" and row["status"] == "converged"), None)
        columns = [(panel.title, field("series")), ("time [s]", field("seconds")),
                   ("time relative to the defaults", lambda r: time_ratio(r, ours)),
                   ("time for load steps relative to the defaults", lambda r: step_ratio(r, ours))]
        columns += [("Newton steps", field("newton")), ("PCG iterations", field("pcg")),
                    ("AMG applications", field("applications")),
                    ("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3)
                     if r.get("memory_an_unknown") else "")]
        columns += [("error in energy, same mesh", field("same mesh energy", 2)), ("status", status)]
        text.append(table(columns, runs))
    return "\n".join(text)


def growth_words(entries):
    """Exponents of a power law of the unknowns n, and the size from which the defaults are quicker than another
    method"""
    crossing = {None: "", 0.0: "on all meshes", math.inf: "on no mesh"}
    columns = [("method", field("series")), ("time grows like n to the power", field("seconds")),
               ("AMG applications grow like n to the power", field("applications")),
               ("the defaults are quicker from [unknowns]",
                lambda e: crossing.get(e["crossover"]) or number(round(e["crossover"] or 0) or ""))]
    return table(columns, [e for e in entries if math.isfinite(e["seconds"])]) if entries else ""


def growth_rows(rows):
    columns = [("", field("series")), ("unknowns", field("unknowns")), ("time [s]", field("seconds")),
               ("time per unknown [ms]", lambda r: number(1e3 * r["seconds"] / r["unknowns"])
                if r.get("unknowns") else ""), ("AMG applications", field("applications"))]
    columns += [("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3)
                 if r.get("memory_an_unknown") else ""), ("status", status)]
    return table(columns, select(rows, study="growth"))


def head(title, data, rows):
    """What holds for all studies of a page"""
    repeats = "the shortest of three for short runs" if any(row["repeats"] > 1 for row in rows) else "one run each"
    lines = [
        f"# {title}\n",
        f"`make bench` made this page. Back to [the front page](../README.md).\n[Data of all runs]({data}).\n", "| | |",
        "| --- | --- |"
    ]
    lines += machine.header([row["load"] for row in rows])
    lines += [
        f"| times | user CPU seconds of whole runs, {repeats} |", "| ranks | one, unless stated otherwise |",
        "| errors | relative to Hertz's formula, or to the references of the front page |"
    ]
    lines += [
        "| Newton steps | of the optimizer; with the subspace method its directions |",
        "| AMG applications | with MUMPS the solves with its factors |"
    ]
    return "\n".join(lines) + "\n"


def section(study, rows, growths, drawn):
    text = [f"## {study.title}\n"] + ([study.text + "\n"] if study.text else [])
    if study.name in drawn:
        text.append(f"![{study.title}]({study.name}.png)\n")
    if study.kind == "baselines":
        text += [BASELINES, baseline_table(study, rows)]
    elif study.kind == "growth":
        text += [growth_words(growths), growth_rows(rows)]
    elif study.name == "accuracy":
        text.append(accuracy_table(rows))
    else:
        text += [part for part in (knob_words(study, rows), knob_table(study, rows)) if part]
    return "\n".join(text)


def write(path, title, studies, rows, growths, drawn):
    """A page of several studies"""
    made = [section(study, rows, growths, drawn) for study in studies if select(rows, study=study.name)]
    with open(path, "w") as file:
        file.write("\n".join([head(title, os.path.basename(path).replace(".md", ".csv"), rows), *made]))
