"""The page: every figure with what it says in numbers, and the tables. The sentences come from the rows, so they hold for the run at hand."""
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
    """The quantity that the sentences speak of: the first there is of contact force and energy"""
    for quantity in ("contact force", "energy"):
        if row.get(f"error {quantity}") is not None:
            return row[f"error {quantity}"], quantity
    if row.get("same mesh energy") is not None:
        return row["same mesh energy"], "energy, against the same mesh"
    return None, None


def span_sentence(panel, runs):
    first, final = runs[0], runs[-1]
    name = lambda row: " ".join(part for part in (row["series"], row["value"]) if part)  # noqa: E731
    error, quantity = lead_error(first)
    text = f"{panel.title}: the first run, {name(first)}, takes {number(first['seconds'])} s, the last, {name(final)}, {number(final['seconds'])} s;"
    text += f" AMG applications: {first['applications']:,} and {final['applications']:,}"
    return text + (f"; error in {quantity}: {percent(error)} and {percent(lead_error(final)[0])}." if error is not None else ".")


def floor_sentence(runs):
    """The cheapest of those that are no worse than the best"""
    known = [(row, lead_error(row)[0]) for row in runs if lead_error(row)[0] is not None]
    if len(known) < 2:
        return ""
    least = min(error for _, error in known)
    name = lambda row: " ".join(part for part in (row["series"], row["value"]) if part)  # noqa: E731
    good = [row for row, error in known if error <= NEAR * least]
    cheap, dear = min(good, key=lambda r: r["seconds"]), max(good, key=lambda r: r["seconds"])
    text = f"The smallest error is {percent(least)}. The quickest run with an error at most 10 % larger is {name(cheap)}, {number(cheap['seconds'])} s"
    return text + (f"; the slowest such run is {name(dear)}, {number(dear['seconds'] / cheap['seconds'])} times as long." if dear is not cheap else "; there is no other such run.")


def failed_sentence(runs):
    bad = [row for row in runs if row["status"] != "converged"]
    return " ".join(f"{row['series'] or row['value']} ended with: {row['status']} ({row['said'].replace('|', '/')})." for row in bad)


def knob_words(study, rows):
    paragraphs = []
    for panel in study.panels:
        runs = of_panel(rows, study, panel)
        good = converged(runs)
        sentences = [span_sentence(panel, good), floor_sentence(good)] if len(good) > 1 else []
        paragraphs.append(" ".join(s for s in sentences + [failed_sentence(runs)] if s))
    return "\n\n".join(p for p in paragraphs if p)


def knob_table(study, rows):
    runs = select(rows, study=study.name)
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("mesh", field("mesh")), ("unknowns", field("unknowns"))]
    columns += [("", field("series"))] if any(row["series"] for row in runs) else []
    columns += [(study.knob, field("value"))] if study.knob != "mesh" else []
    columns += [("time [s]", field("seconds")), ("Newton", field("newton")), ("AMG applications", field("applications")), ("memory [MB]", lambda r: number(r["memory"] / 1e6) if r.get("memory") else "")]
    for quantity in ("energy", "contact force", "peak pressure", "contact radius"):
        if any(f"error {quantity}" in row for row in runs):
            columns.append((f"error in {quantity}", field(f"error {quantity}", 2)))
    if any("same mesh energy" in row for row in runs):
        columns.append(("energy, same mesh", field("same mesh energy", 2)))
    if study.knob == "mesh":
        columns.append(("energy, estimated", lambda r: number((r["error_estimate"] or math.nan) ** 2, 2)))
    columns += [("out of balance", field("equilibrium", 1)), ("ended", field("status"))]
    return table(columns, runs)


def place(row):
    return row["problem"], row["mesh"]


def mean_ratio(runs, ours, key):
    """Geometric mean over the problems and meshes of both; NaN without any"""
    pairs = [(row.get(key), ours.get(place(row), {}).get(key)) for row in runs]
    logs = [math.log(theirs / own) for theirs, own in pairs if theirs and own]
    return math.exp(sum(logs) / len(logs)) if logs else math.nan


def default_rows(studies, rows):
    """What every other value of a knob costs, in units of what is built in"""
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
    better = [e for e in entries if e["time"] < 0.95]
    text = "For parameters that do not change the result, the default should be the quickest value on average over the problems. "
    text += "It is, to within 5 % of the time." if not better else "Exceptions: " + ", ".join(f"{e['value']} takes {e['time']:.2f} times the time of {e['default']} ({e['study']})" for e in better) + "."
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
    columns = [("problem", lambda r: PROBLEMS[r["problem"]].title), ("begun with mesh", field("mesh")), ("unknowns", field("unknowns")), ("target", field("value")), ("attained", lambda r: number(lead_error(r)[0], 2)), ("energy, estimated", lambda r: number((r["error_estimate"] or math.nan) ** 2, 2))]
    columns += [("time [s]", field("seconds")), ("best of the sweeps at that error, same element [s]", lambda r: number(best_at(rows, r, ("full",)))), ("any element [s]", lambda r: number(best_at(rows, r, ("full", "bbar"))))]
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


def baseline_table(study, rows):
    text = []
    for panel in study.panels:
        runs = of_panel(rows, study, panel)
        ours = next((row for row in runs if row["series"] == "defaults" and row["status"] == "converged"), None)
        columns = [(panel.title, field("series")), ("time [s]", field("seconds")), ("of the defaults'", lambda r: time_ratio(r, ours)), ("in load steps", lambda r: step_ratio(r, ours))]
        columns += [("Newton", field("newton")), ("PCG", field("pcg")), ("AMG applications", field("applications")), ("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3) if r.get("memory_an_unknown") else "")]
        columns += [("energy, same mesh", field("same mesh energy", 2)), ("ended", lambda r: r["status"] + (f": {r['said']}".replace("|", "/") if r["status"] != "converged" else ""))]
        text.append(table(columns, runs))
    return "\n".join(text)


def baseline_words(study, rows):
    sentences = []
    for panel in study.panels:
        runs = converged(of_panel(rows, study, panel))
        ours = next((row for row in runs if row["series"] == "defaults"), None)
        others = [f"{row['series']} {number(row['seconds'] / ours['seconds'], 2)}" for row in runs if ours and row is not ours]
        if others:
            sentences.append(f"{panel.title}: time divided by that of the default settings, which is {number(ours['seconds'])} s: " + ", ".join(others) + ".")
    return " ".join(sentences)


def growth_words(entries):
    if not entries:
        return ""
    sentences = [f"{e['series']}: time grows like n^{e['seconds']:.2f}, applications like n^{e['applications']:.2f}." for e in entries if math.isfinite(e["seconds"]) and "MUMPS" not in e["series"]]
    for e in (e for e in entries if "MUMPS" in e["series"]):
        where = {0.0: "the defaults are the quicker on every mesh that both were run on", math.inf: "the defaults are the slower on every mesh that both were run on"}
        sentences.append(f"{e['series']}: time grows like n^{e['seconds']:.2f}; " + where.get(e["crossover"], f"the defaults are the quicker from {e['crossover']:,.0f} unknowns on") + ".")
    return " ".join(sentences)


def growth_rows(rows):
    columns = [("", field("series")), ("unknowns", field("unknowns")), ("time [s]", field("seconds")), ("time per unknown [ms]", lambda r: number(1e3 * r["seconds"] / r["unknowns"]) if r.get("unknowns") else ""), ("AMG applications", field("applications"))]
    columns += [("memory per unknown [kB]", lambda r: number(r["memory_an_unknown"] / 1e3) if r.get("memory_an_unknown") else ""), ("AMG set-up and apply", lambda r: percent(r["amg_share"]) if r.get("amg_share") is not None else ""), ("neither AMG nor filter", lambda r: percent(r["own_share"]) if r.get("own_share") is not None else ""), ("ended", field("status"))]
    return table(columns, select(rows, study="growth"))


def roofline_words(entries):
    if not entries:
        return ""
    last = max((e for e in entries if e["cycle"] == "fbf"), key=lambda e: e["unknowns"])
    text = f"At {last['unknowns']:,.0f} unknowns a product with the condensed matrix moves {number(last['product_rate'] / 1e9)} GB/s, {percent(last['product_share'])} of the triad's {number(last['triad'] / 1e9)} GB/s in a working set of that size. "
    text += f"A V-cycle, of operator complexity {last['operator_complexity']:.2f}, is counted as {number(last['cycle_rate'] / 1e9)} GB/s, {percent(last['cycle_share'])}; it costs as much as {number(last['cycle_products'])} products. "
    return text + f"An application of AMGF (fbf) costs {number(last['application_products'])} products; V-cycle and filter solves, counted as documented, make {number(last['model_products'])}."


def roofline_rows(entries):
    rate = lambda key: lambda r: number(r[key] / 1e9)  # noqa: E731
    columns = [("unknowns", lambda r: f"{r['unknowns']:,.0f}"), ("cycle", field("cycle")), ("triad [GB/s]", rate("triad")), ("product [GB/s]", rate("product_rate")), ("share", lambda r: percent(r["product_share"])), ("V-cycle [GB/s]", rate("cycle_rate")), ("share", lambda r: percent(r["cycle_share"]))]
    columns += [("operator complexity", field("operator_complexity")), ("V-cycle [products]", field("cycle_products")), ("filter solve [products]", field("filter_products")), ("application [products]", field("application_products")), ("as documented", field("model_products"))]
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
    small = "" if results["size"] == "full" else "\nThese are the figures of a small run; `make bench-full` makes those of the problems at full size.\n"
    return f"""# One page per setting
{small}
`{command}` made this page on {results["date"]}: {m["processor"]}, {m["cores"]} cores, {memory}; {versions}; sources {results["version"]}.
Runs are on one rank unless stated otherwise. Times are of the whole run, including mesh and assembly; runs below {results["short"]:g} s are
repeated three times, and the shortest time is given. Errors are relative to Hertz's solution, or to values extrapolated from
fine meshes (last section). Force and energy of Hertz's solution, for a half-space, differ from those of this ball by about 0.2 %.
Data of all runs: `bench.csv`, `bench.json`.

    make bench             # at most an hour on two cores: the accuracy page, and these pages of small problems
    make bench-full        # these pages at full size, three hours; an interrupted bench continues where it stopped
    make bench-page        # copies the pages and their figures to share/bench
    make bench-full BENCH="--only tolerance forcing"     # some studies; BENCH=--plan lists the runs, BENCH=--no-run only makes the pages of completed runs
"""


def section(study, results, drawn):
    rows, text = results["rows"], [f"# {study.title}\n", f"Made on {results['date']}, sources {results['version']}. Back to [the accuracy page](../README.md) and [all pages](README.md).\n"]
    if not select(rows, study=study.name):
        return ""
    if study.name in drawn:
        text.append(f"![{study.title}]({study.name}.png)\n")
    if study.kind == "knob":
        text += [knob_words(study, rows) + "\n", accuracy_table(rows) if study.name == "accuracy" else knob_table(study, rows)]
    elif study.kind == "baselines":
        text += [baseline_words(study, rows) + "\n", baseline_table(study, rows)]
    elif study.kind == "growth":
        text += [growth_words(results["growth"]) + "\n", growth_rows(rows)]
    else:
        text += [roofline_words(results["roofline"]) + "\n", roofline_rows(results["roofline"])]
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
        parts.append("## All together\n\n![front](pareto.png)\n")
    parts += [text] if (text := default_section(studies, results["rows"])) else []
    parts.append('## References\n\nExtrapolated from three meshes or more; `make bench-full BENCH="--only references"` computes them again.\n\n' + reference_table(results["references"]))
    parts += ["## Not run\n\n" + "".join(f"- {line}\n" for line in skipped)] if skipped else []
    with open(path, "w") as file:
        file.write("\n".join(parts))
