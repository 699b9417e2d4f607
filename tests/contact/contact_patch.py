"""Checks a written contact patch test against uniaxial stress: python contact_patch.py BASE."""
import sys

import h5py
import numpy as np

EXACT = -0.01
with h5py.File(sys.argv[1] + "_0001.h5") as file:
    stress = file["stress"][...]  # xx xy xz yy yz zz
    gap = file["contact_gap"][...]
    pressure = file["contact_pressure"][...]
rows = ~np.isnan(gap)
uniaxial = np.array([0, 0, 0, 0, 0, EXACT])
for what, error in [
    ("stress uniform", np.abs(stress - uniaxial).max()),
    ("contact pressure uniform", np.abs(pressure[rows] + EXACT).max()),
]:
    good = error <= 1e-8 * abs(EXACT)
    print("  %s to 1e-8: %s" % (what, "yes" if good else "NO, error %g" % error))
print("  vertices in contact, both sides: %d" % rows.sum())
