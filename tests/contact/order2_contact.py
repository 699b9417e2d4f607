"""Holds the runs of order2_contact.sh against exact solutions."""
import glob
import sys

import h5py
import numpy as np

sys.path[1:1] = [sys.path[0] + folder for folder in ("/../../share/scenes", "/../constraints")]
from hertz_solution import SOLUTIONS, measure  # noqa: E402
from shrink_fit import lame, pressures  # noqa: E402
from summaries import load, say, within  # noqa: E402
from ties import STRESS, stress  # noqa: E402


def patch(name):
    """Largest errors of stress and pressure over the exact ones"""
    stress = -0.01 / (1 + 0.5 / float(name.split("_")[3]))
    with h5py.File(name + "_0001.h5") as file:
        rows = ~np.isnan(file["contact_gap"][...])
        pressure, cells = file["contact_pressure"][...][rows], file["stress"][...]
    return np.abs(cells / stress - [0, 0, 0, 0, 0, 1]).max(), np.abs(pressure / stress + 1).max()


def last(name):
    return load(name)["steps"][-1]


def main():
    for name in sorted(file[:-len("_0001.h5")] for file in glob.glob("patch_*_0001.h5")):
        errors = patch(name)
        say(name + ": stress and pressure uniform",
            max(errors) <= 1e-12 * max(1e4,
                                       float(name.split("_")[3]) * 1e2), errors)
    exact = 0.5 * lame() * 0.03 * 2 * np.pi / 2
    for name, tolerance in (("rings_22", 0.002), ("rings_12", 0.015), ("rings_21", 0.015)):
        p = pressures(name)
        say(name + ": pressure, Lame's", np.abs(p - 1).max() <= tolerance, (p.min(), p.max()))
        say(name + ": energy, Lame's", within(last(name)["energy"], exact, tolerance), (last(name)["energy"], exact))
    say("rings_node: mean pressure, Lame's", within(pressures("rings_node").mean(), 1, 0.02),
        pressures("rings_node").mean())
    one = last("rings_22")
    say("a probe on the seam", within(one["probes"][0]["contact_pressure"], lame() / 25.015, 0.003), one["probes"][0])
    for ranks in ("three", ):
        say("energy on %s ranks" % ranks, within(last(ranks)["energy"], one["energy"], 1e-9),
            (last(ranks)["energy"], one["energy"]))
    hertz = measure(SOLUTIONS["cylinder"](), "cylinder")
    for what, tolerance in (("peak pressure", 0.003), ("approach", 0.003)):
        say("cylinder: %s, Hertz's" % what, abs(hertz["errors"][what]) <= tolerance, hertz["errors"][what])
    say("cylinder: largest nodal pressure, Hertz's", abs(hertz["nodal error"]) <= 0.004, hertz["nodal error"])
    s = STRESS
    for name in sorted(file[:-len(".json")] for file in glob.glob("tie_*.json")):
        errors = [
            np.abs(np.subtract(stress(p), [s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]])).max()
            for p in last(name)["probes"]
        ]
        say(name + ": any uniform stress passes", max(errors) < 1e-8, errors)
    say("a run goes on", within(last("again")["energy"],
                                last("press")["energy"], 1e-9), (last("again")["energy"], last("press")["energy"]))


if __name__ == "__main__":
    main()
