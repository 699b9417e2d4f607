#!/usr/bin/env python3
"""Draws columns of a table that contact -output BASE wrote: of the history BASE.csv or of a line BASE_<line>.csv.

    share/plot/curves.py BASE.csv PICTURE.png [COLUMN ...] [-x COLUMN] [--steps all|N,...]
    share/plot/curves.py BASE.csv                            # prints the names of the columns

A COLUMN may have wildcards: '*.normal_force', 'slab.zmin.reaction_?'. Each COLUMN has axes of its own. By default a
history is drawn with energy, work and the normal force of each pair over time, and a line with displacement and von
Mises stress, one curve per load step.
"""
import argparse
import csv
import fnmatch
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from interpreter import need

need("numpy", "matplotlib")
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HISTORY = [["energy", "work"], ["*.normal_force"]]
LINE = [["displacement_?"], ["von_mises"]]


def read(name):
    """column: its values"""
    with open(name, newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    return {column: np.array([float(row[i]) for row in rows]) for i, column in enumerate(heading)}


def matching(table, patterns, name):
    """Columns of each pattern in turn; one that has none is an error"""
    found = []
    for pattern in patterns:
        columns = [column for column in table if fnmatch.fnmatchcase(column, pattern)]
        if not columns:
            sys.exit("curves.py: %s has no column %s; without columns curves.py says what there is" % (name, pattern))
        found += columns
    return found


def chosen(table, steps):
    """Rows of each load step of a line that is asked for, and its label"""
    every = np.unique(table["step"])
    wanted = every if steps == "all" else [float(step) for step in steps.split(",")] if steps else every[-1:]
    return [(table["step"] == step, "step %g" % step) for step in wanted]


def panels(table, args):
    if args.columns:
        return [matching(table, [pattern], args.table) for pattern in args.columns]
    groups = [[column
               for pattern in group
               for column in table
               if fnmatch.fnmatchcase(column, pattern)]
              for group in (LINE if "arc" in table else HISTORY)]
    return [group for group in groups if group]


def draw(axis, table, along, group, curves):
    """Load steps from dark to light, of which ten at most are named"""
    for column in group:
        for k, (rows, label) in enumerate(curves):
            style = ".-" if len(table[along][rows]) <= 60 else "-"
            named = not label or (len(curves) - 1 - k) % (1 + (len(curves) - 1) // 10) == 0
            color = plt.cm.viridis(0.9 * k / max(1, len(curves) - 1)) if len(group) == 1 and len(curves) > 1 else None
            axis.plot(table[along][rows], table[column][rows], style, color=color,
                      label=(column + " " + label).strip() if named else None)
    axis.legend(fontsize="small")
    axis.grid(alpha=0.3)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("table", help="BASE.csv or BASE_<line>.csv")
    parser.add_argument("picture", nargs="?", help="a PNG file; without it the columns of the table are printed")
    parser.add_argument("columns", nargs="*", metavar="COLUMN",
                        help="columns to draw; '*.normal_force' is all columns with this ending")
    parser.add_argument("-x", help="column of the horizontal axis; default: time, for a line its arc")
    parser.add_argument("--steps", help="for a line: all, or numbers of load steps; default: the last one")
    args = parser.parse_args()
    table = read(args.table)
    if not args.picture:
        print("\n".join(table))
        return
    line = "arc" in table
    along = args.x or ("arc" if line else "time")
    matching(table, [along], args.table)
    groups = panels(table, args)
    curves = chosen(table, args.steps) if line else [(slice(None), "")]
    figure, axes = plt.subplots(len(groups), squeeze=False, sharex=True, figsize=(8, 3.2 * len(groups) + 0.8))
    for axis, group in zip(axes.ravel(), groups):
        draw(axis, table, along, group, curves)
    axes[-1, 0].set_xlabel(along)
    figure.tight_layout()
    figure.savefig(args.picture, dpi=110)


if __name__ == "__main__":
    main()
