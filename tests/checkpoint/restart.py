"""Holds the load steps of a run that went on against those of one that was not stopped: TITLE TOLERANCE WHOLE PART
[energy]."""
import sys

import numpy as np

from summaries import load, say


def difference(a, b, alone):
    """Largest relative difference of energy, and of each pair's and face's force"""
    worst = abs(a["energy"] - b["energy"]) / abs(a["energy"])
    for kind, key in () if alone else (("pairs", "force"), ("faces", "reaction")):
        size = max(np.linalg.norm(item[key]) for item in a[kind])
        worst = max([worst, *(np.linalg.norm(np.subtract(x[key], y[key])) / size for x, y in zip(a[kind], b[kind]))])
    return worst if alone else max(worst, abs(a["work"] - b["work"]) / abs(a["work"]))


def main(title, tolerance, whole, part, *rest):
    before, after = ({step["step"]: step for step in load(name)["steps"]} for name in (whole[:-5], part[:-5]))
    worst = max(difference(before[step], after[step], bool(rest)) for step in after)
    done = max(after) == max(before) and len(after) > 0
    say("%s: energy%s as without a stop to %s" % (title, "" if rest else ", work and forces", tolerance), done
        and worst <= float(tolerance), worst)


main(*sys.argv[1:])
