"""The figures: error against cost, a study a figure; baselines; growth."""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

from problems import PROBLEMS  # noqa: E402
from results import converged, of_panel, select  # noqa: E402

COSTS = {
    "time": ("seconds", "user time [s]", 1), "wall": ("wall", "elapsed time [s]", 1),
    "applications": ("applications", "AMG applications", 1), "memory": ("memory", "peak memory [MB]", 1e-6)
}
STYLES = ("-", "--", ":", "-.", (0, (4, 1, 1, 1, 1, 1)), (0, (6, 3)))
MARKERS = "osD^vP*X<>hd"
COLORS = plt.get_cmap("tab10").colors
SAME = "same mesh "
FLOOR = 1e-13  # errors below are rounding, and zero has no logarithm
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "legend.fontsize": 8})


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, f"{name}.png"), dpi=80, bbox_inches="tight")
    plt.close(figure)


def measures(problem, rows):
    """Columns of errors to draw, and how to name them: against the reference, and energy against the careful run on the
    same mesh"""
    columns = [(f"error {quantity}", quantity) for quantity in PROBLEMS[problem].quantities]
    if any(SAME + "energy" in row for row in rows):
        columns.append((SAME + "energy", "energy, against the same mesh solved to the end"))
    return [(column, name) for column, name in columns if any(
        row.get(column, math.nan) == row.get(column, math.nan) for row in rows if column in row)]


class Look:
    """Marker by value of the knob; color by series, or by value where there is one series; line style by quantity"""

    def __init__(self, study):
        self.values = list(
            dict.fromkeys(value for panel in study.panels for series in panel.series for value, _ in series.points))
        self.series = list(dict.fromkeys(series.label for panel in study.panels for series in panel.series))
        self.quantities = []

    def marker(self, value):
        return MARKERS[self.values.index(value) % len(MARKERS)]

    def color(self, value, series):
        index = self.values.index(value) if len(self.series) == 1 else self.series.index(series)
        return COLORS[index % len(COLORS)]

    def line(self, series):
        return "0.6" if len(self.series) == 1 else COLORS[self.series.index(series) % len(COLORS)]

    def style(self, quantity):
        if quantity not in self.quantities:
            self.quantities.append(quantity)
        return STYLES[self.quantities.index(quantity) % len(STYLES)]

    def legend(self, knob):
        """Handles: quantities, series, values, each under its heading"""
        heading = lambda text: Line2D([], [], linestyle="none", label=text)  # noqa: E731
        handles = [heading("error in")
                   ] + [Line2D([], [], color="0.3", linestyle=self.style(q), label=q) for q in list(self.quantities)]
        if len(self.series) > 1:
            handles += [heading("")] + [Line2D([], [], color=self.line(s), label=s) for s in self.series]
        color = (lambda v: self.color(v, "")) if len(self.series) == 1 else (lambda v: "0.3")
        return handles + [heading(""), heading(knob)] + [
            Line2D([], [], linestyle="none", marker=self.marker(v), color=color(v), label=v) for v in self.values
        ]


def draw_line(axes, rows, column, cost, look, quantity):
    """One series, one quantity"""
    key, _, unit = COSTS[cost]
    points = [(row[key] * unit, max(row[column], FLOOR), row)
              for row in rows
              if row.get(column) is not None and math.isfinite(row[column])]
    if not points:
        return
    x, y, _ = zip(*points)
    axes.plot(x, y, color=look.line(rows[0]["series"]), linestyle=look.style(quantity), linewidth=1, zorder=1)
    for a, b, row in points:
        axes.plot(a, b, linestyle="none", marker=look.marker(row["value"]),
                  color=look.color(row["value"], row["series"]), markersize=5.5, zorder=2)


def log_axes(axes, x, y):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    low, high = axes.get_ylim()
    if high < 10 * low:
        axes.set_ylim(low / 2, high * 2)
    low, high = axes.get_xlim()
    if high < 1.5 * low:  # a per cent is not to look like a decade
        axes.set_xlim(low / 1.3, high * 1.3)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        if high < 100 * low:  # too narrow for powers of ten alone
            axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 3 * low else (1, 1.5, 2, 3, 4, 5, 6, 8)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def knob_figure(study, rows, folder):
    """Rows of axes: problems; columns: costs"""
    panels = [(panel, runs)
              for panel in study.panels
              if (runs := converged(of_panel(rows, study, panel))) and measures(panel.problem, runs)]
    if not panels:
        return False
    look = Look(study)
    figure, grid = plt.subplots(len(panels), len(study.costs),
                                figsize=(3.4 * len(study.costs) + 0.4, 2.9 * len(panels)), squeeze=False, sharey="row")
    for (panel, runs), line in zip(panels, grid):
        for axes, cost in zip(line, study.costs):
            for series in panel.series:
                for column, quantity in measures(panel.problem, runs):
                    draw_line(axes, select(runs, series=series.label), column, cost, look, quantity)
            log_axes(axes, COSTS[cost][1], "relative error" if cost == study.costs[0] else "")
        line[0].set_title(panel.title, loc="left", fontsize=9)
    figure.suptitle(study.title, x=0.02, ha="left", fontsize=11)
    figure.tight_layout()
    figure.legend(handles=look.legend(study.knob), loc="upper left", bbox_to_anchor=(1.0, 0.97), frameon=False)
    save(figure, folder, study.name)
    return True


def front(points):
    """Those that no other beats in both time and error, by time"""
    best, kept = math.inf, []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


def baseline_figure(study, rows, folder):
    """Bars of time; what did not end with an answer is hatched"""
    panels = [(panel, runs) for panel in study.panels if (runs := of_panel(rows, study, panel))]
    if not panels:
        return False
    figure, grid = plt.subplots(1, len(panels), figsize=(3.9 * len(panels) + 1, 3), squeeze=False, sharey=True)
    for (panel, runs), axes in zip(panels, grid[0]):
        runs = [row for row in runs if row["status"] in ("converged", "time limit")]
        for row in runs:
            good = row["status"] == "converged"
            axes.barh(row["series"], row["seconds"], color=COLORS[0] if good else "white", edgecolor=COLORS[0],
                      hatch=None if good else "////")
        axes.set_xscale("log")
        axes.set_xlim(left=0.3 * min(row["seconds"] for row in runs))
        axes.set_xlabel("user time [s]")
        axes.set_title(panel.title, fontsize=9, loc="left")
        axes.grid(axis="y", visible=False)
    grid[0][0].invert_yaxis()
    figure.suptitle(study.title + " (hatched: ended by the time limit)", x=0.02, ha="left", fontsize=11)
    figure.tight_layout()
    save(figure, folder, study.name)
    return True


def growth_figure(study, rows, table, folder):
    """Time, applications and memory an unknown against unknowns"""
    runs = converged(select(rows, study=study.name))
    if not runs:
        return False
    kinds = (("seconds", "user time [s]", lambda row: row["seconds"]), ("applications", "AMG applications",
                                                                        lambda row: row["applications"]),
             ("memory", "peak memory an unknown [kB]", lambda row: row["memory_an_unknown"] / 1e3))
    figure, grid = plt.subplots(1, 3, figsize=(12, 3.6))
    for axes, (cost, label, value) in zip(grid, kinds):
        for index, entry in enumerate(table):
            line = select(runs, series=entry["series"])
            points = [(row["unknowns"], value(row)) for row in line if value(row) > 0]
            if not points or (cost == "applications" and "MUMPS" in entry["series"]):
                continue
            slope = entry[cost]
            text = entry["series"] + (f", n^{slope:.2f}" if math.isfinite(slope) and cost != "memory" else "")
            axes.plot(*zip(*points), marker=MARKERS[index], color=COLORS[index], label=text, markersize=4.5,
                      linewidth=1)
        log_axes(axes, "unknowns", label)
        axes.legend(frameon=True, fontsize=7)
    figure.suptitle("Two-block: " + study.title.lower(), x=0.02, ha="left", fontsize=11)
    figure.tight_layout()
    save(figure, folder, study.name)
    return True


def draw(studies, rows, growths, folder):
    """All figures; names of those that there was something to draw for"""
    kinds = {
        "knob": lambda study: knob_figure(study, rows, folder),
        "baselines": lambda study: baseline_figure(study, rows, folder),
        "growth": lambda study: growth_figure(study, rows, growths, folder)
    }
    return [study.name for study in studies if kinds[study.kind](study)]
