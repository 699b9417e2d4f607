"""The pages: a figure and tables for each study. All text that depends on the results is made from the rows of the runs."""
import math
import os

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
    return {"panel": panel.title, "quantity": known[0][2], "least": percent(least), "quickest": label(quickest), "seconds": quickest["seconds"], "slowest": label(slowest), "ratio": slowest["seconds"] / quickest["seconds"]}


def failed_sentence(runs):
    bad = [row for row in runs if row["status"] != "converged"]
    return " ".join(f"{row['series'] or row['value']} ended with: {row['status']} ({row['said'].replace('|', '/')})." for row in bad)


def knob_words(study, rows):
    """A table of the best runs of each panel, and the runs that did not converge"""
    runs = [of_panel(rows, study, panel) for panel in study.panels]
    best = [row for row in (best_row(panel, converged(r)) for panel, r in zip(study.panels, runs)) if row]
    columns = [("problem", field("panel")), ("error in", field("quantity")), ("smallest error", field("least")), ("quickest run", field("quickest")), ("its time [s]", field("seconds")), ("slowest run", field("slowest")), ("its time relative to the quickest", field("ratio"))]
    parts = ["Runs with an error at most 10 % above the smallest error of the problem:\n\n" + table(columns, best) + "\nAll runs:"] if best else []
    return "\n\n".join([p for p in map(failed_sentence, runs) if p] + parts)


def knob_table(study, rows):
    runs = select(rows, study=study.name)
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("mesh", field("mesh")), ("unknowns", field("unknowns"))]
    columns += [("", field("series"))] if any(row["series"] for row in runs) else []
    columns += [(study.knob, field("value"))] if study.knob != "mesh" else []
    columns += [("time [s]", field("seconds")), ("Newton steps", field("newton")), ("AMG applications", field("applications")), ("memory [MB]", lambda r: number(r["memory"] / 1e6) if r.get("memory") else "")]
    for quantity in ("energy", "contact force", "peak pressure", "contact radius"):
        if any(f"error {quantity}" in row for row in runs):
            columns.append((f"error in {quantity}", field(f"error {quantity}", 2)))
    if any("same mesh energy" in row for row in runs):
        columns.append(("error in energy, same mesh", field("same mesh energy", 2)))
    if study.knob == "mesh":
        columns.append(("estimated error in energy", lambda r: number((r["error_estimate"] or math.nan) ** 2, 2)))
    columns += [("equilibrium residual", field("equilibrium", 1)), ("status", field("status"))]
    return table(columns, runs)


def place(row):
    return row["problem"], row["mesh"]


def mean_ratio(runs, ours, key):
    """Geometric mean over the problems and meshes of both; NaN without any"""
    pairs = [(row.get(key), ours.get(place(row), {}).get(key)) for row in runs]
    logs = [math.log(theirs / own) for theirs, own in pairs if theirs and own]
    return math.exp(sum(logs) / len(logs)) if logs else math.nan


def default_rows(studies, rows):
    """Time of every other value of a parameter, relative to the default"""
    entries = []
    for study in (s for s in studies if s.default):
        runs = select(rows, study=study.name)
        ours = {place(row): row for row in converged(runs) if row["value"] == study.default}
        for value in dict.fromkeys(row["value"] for row in runs if row["value"] != study.default):
            same = [row for row in runs if row["value"] == value]
            good = converged(same)
            entries.append({"study": study.title, "default": study.default, "value": value, "time": mean_ratio(good, ours, "seconds"), "applications": mean_ratio(good, ours, "applications"), "converged": f"{len(good)} of {len(same)}"})
    return entries


def default_section(studies, rows):
    entries = default_rows(studies, rows)
    if not entries:
        return ""
    text = "A time below 1 means that the other value is quicker than the default."
    columns = [("parameter", field("study")), ("default", field("default")), ("other value", field("value")), ("time relative to the default, geometric mean", field("time")), ("AMG applications relative to the default", field("applications")), ("converged", field("converged"))]
    return "## The defaults\n\n" + text + "\n\n" + table(columns, entries)


def best_at(rows, row, series):
    """The quickest run of the sweeps that is at least as accurate as this one; series: which of the elements' lines count"""
    error = lead_error(row)[0] or 0
    others = (r for r in converged(select(rows, problem=row["problem"], ranks=1)) if r["study"] != "accuracy" and (r["study"] != "element" or r["series"] in series))
    return min((r["seconds"] for r in others if (lead_error(r)[0] or math.inf) <= NEAR * error), default=math.nan)


def accuracy_table(rows):
    """What was asked for, what came of it, and what the sweeps needed for the same"""
    runs = select(rows, study="accuracy")
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("first mesh", field("mesh")), ("unknowns", field("unknowns")), ("requested error", field("value")), ("true error", lambda r: number(lead_error(r)[0], 2)), ("estimated error in energy", lambda r: number((r["error_estimate"] or math.nan) ** 2, 2))]
    columns += [("time [s]", field("seconds")), ("best time in the other studies at that error, same element [s]", lambda r: number(best_at(rows, r, ("full",)))), ("the same, any element [s]", lambda r: number(best_at(rows, r, ("full", "bbar"))))]
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


BASELINES = """"Time for load steps" compares the solve times of the load steps that both runs completed; their
number is in parentheses. After a `time limit`, the time of the whole run is a lower bound.
"""


def baseline_table(study, rows):
    text = []
    for panel in study.panels:
        runs = of_panel(rows, study, panel)
        ours = next((row for row in runs if row["series"] == "defaults" and row["status"] == "converged"), None)
        columns = [(panel.title, field("series")), ("time [s]", field("seconds")), ("time relative to the defaults", lambda r: time_ratio(r, ours)), ("time for load steps relative to the defaults", lambda r: step_ratio(r, ours))]
        columns += [("Newton steps", field("newton")), ("PCG iterations", field("pcg")), ("AMG applications", field("applications")), ("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3) if r.get("memory_an_unknown") else "")]
        columns += [("error in energy, same mesh", field("same mesh energy", 2)), ("status", lambda r: r["status"] + (f": {r['said']}".replace("|", "/") if r["status"] != "converged" else ""))]
        text.append(table(columns, runs))
    return "\n".join(text)


def growth_words(entries):
    """Exponents of a power law of the unknowns n, and the size from which the defaults are quicker than another method"""
    crossing = {None: "", 0.0: "on all meshes", math.inf: "on no mesh"}
    columns = [("method", field("series")), ("time grows like n to the power", field("seconds")), ("AMG applications grow like n to the power", field("applications")), ("the defaults are quicker from [unknowns]", lambda e: crossing.get(e["crossover"]) or number(round(e["crossover"] or 0) or ""))]
    return table(columns, [e for e in entries if math.isfinite(e["seconds"])]) if entries else ""


def growth_rows(rows):
    columns = [("", field("series")), ("unknowns", field("unknowns")), ("time [s]", field("seconds")), ("time per unknown [ms]", lambda r: number(1e3 * r["seconds"] / r["unknowns"]) if r.get("unknowns") else ""), ("AMG applications", field("applications"))]
    columns += [("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3) if r.get("memory_an_unknown") else ""), ("time in AMG", lambda r: percent(r["amg_share"]) if r.get("amg_share") is not None else ""), ("time outside AMG and filter", lambda r: percent(r["own_share"]) if r.get("own_share") is not None else ""), ("status", field("status"))]
    return table(columns, select(rows, study="growth"))


ROOFLINE = """| column | meaning |
| --- | --- |
| triad | bandwidth of the triad a = b + c d in a working set of that size |
| product | bandwidth of a product with the condensed matrix; share: of the triad |
| V-cycle | bandwidth of a V-cycle, with its memory traffic counted from the operator complexity; share: of the triad |
| V-cycle, filter solve, application [products] | time, in units of a product with the matrix; application: of the whole preconditioner |
| documented count | application as the documentation counts it: V-cycles and filter solves |
"""


def roofline_rows(entries):
    rate = lambda key: lambda r: number(r[key] / 1e9)  # noqa: E731
    columns = [("unknowns", lambda r: f"{r['unknowns']:,.0f}"), ("cycle", field("cycle")), ("triad [GB/s]", rate("triad")), ("product [GB/s]", rate("product_rate")), ("share", lambda r: percent(r["product_share"])), ("V-cycle [GB/s]", rate("cycle_rate")), ("share", lambda r: percent(r["cycle_share"]))]
    columns += [("operator complexity", field("operator_complexity")), ("V-cycle [products]", field("cycle_products")), ("filter solve [products]", field("filter_products")), ("application [products]", field("application_products")), ("documented count [products]", field("model_products"))]
    return table(columns, entries)


def reference_table(entries):
    rows = [{"problem": PROBLEMS[name].title, "quantity": q, "unknowns": max(entry["unknowns"])} | data for name, entry in entries.items() for q, data in entry["quantities"].items()]
    columns = [("problem", field("problem")), ("quantity", field("quantity")), ("extrapolated", field("value", 8)), ("order", field("order", 2)), ("uncertain by", lambda r: percent(r["uncertainty"])), ("finest mesh, unknowns", field("unknowns"))]
    return table(columns, rows)


def head(results):
    m = results["machine"]
    versions = ", ".join(f"{name} {version}" for name, version in m["versions"].items())
    memory = f"{m['memory_bytes'] / 2**30:.0f} GiB" if m["memory_bytes"] else "unknown memory"
    command = {"full": "make bench-full", "quick": "make bench"}.get(results["size"], f"share/bench/run.py --size {results['size']}")
    small = "" if results["size"] == "full" else "\nThese pages are of small meshes. `make bench-full` makes those of the meshes at full size.\n"
    return f"""# One page per setting
{small}
`{command}` made this page on {results["date"]} from commit {results["version"]}.

| | |
| --- | --- |
| machine | {m["processor"]}, {m["cores"]} cores, {memory} |
| libraries | {versions} |
| ranks | one, unless stated otherwise |
| times | of the whole run, including mesh and assembly; the shortest of three runs if it is below {results["short"]:g} s |
| errors | relative to Hertz's solution, or to values extrapolated from fine meshes (last section) |
| Hertz's ball | force and energy of Hertz's half-space differ from those of the ball by about 0.2 % |
| data of all runs | `bench.csv`, `bench.json` |

    make bench             # at most an hour on two cores: the accuracy page, and these pages of small problems
    make bench-full        # these pages at full size, three hours; an interrupted bench continues where it stopped
    make bench-page        # copies the pages and their figures to share/bench
    make bench-full BENCH="--only tolerance forcing"     # some studies; BENCH=--plan lists the runs, BENCH=--no-run only makes the pages of completed runs
"""


def section(study, results, drawn):
    rows, text = results["rows"], [f"# {study.title}\n", f"Runs of {results['date']}, commit {results['version']}. Back to [the accuracy page](../README.md) and [all pages](README.md).\n"]
    if not select(rows, study=study.name):
        return ""
    if study.name in drawn:
        text.append(f"![{study.title}]({study.name}.png)\n")
    if study.kind == "knob":
        text += [knob_words(study, rows) + "\n", accuracy_table(rows) if study.name == "accuracy" else knob_table(study, rows)]
    elif study.kind == "baselines":
        text += [BASELINES, baseline_table(study, rows)]
    elif study.kind == "growth":
        text += [growth_words(results["growth"]) + "\n", growth_rows(rows)]
    else:
        text += [ROOFLINE, roofline_rows(results["roofline"])]
    return "\n".join(text)


def write(path, studies, results, drawn, skipped):
    """A page for every study beside the index at `path`"""
    folder, parts = os.path.dirname(path), [head(results), "| page | |\n| --- | --- |"]
    for study in studies:
        text = section(study, results, drawn)
        if text:
            with open(os.path.join(folder, study.name + ".md"), "w") as file:
                file.write(text)
            parts[-1] += f"\n| [{study.name}]({study.name}.md) | {study.title} |"
    parts[-1] += "\n"
    if "pareto" in drawn:
        parts.append("## All studies\n\n![front](pareto.png)\n")
    parts += [text] if (text := default_section(studies, results["rows"])) else []
    parts.append('## References\n\nExtrapolated from at least three meshes. `make bench-full BENCH="--only references"` computes them again.\n\n' + reference_table(results["references"]))
    parts += ["## Not run\n\n" + "".join(f"- {line}\n" for line in skipped)] if skipped else []
    with open(path, "w") as file:
        file.write("\n".join(parts))
