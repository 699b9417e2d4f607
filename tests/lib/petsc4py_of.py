"""Whether petsc4py loads the PETSc whose libraries are in a folder, and no other: exit code 0 or 1.

    python3 petsc4py_of.py FOLDER
"""
import os
import sys

import petsc4py.PETSc  # an error: there is none, exit code 1

with open("/proc/self/maps") as maps:
    loaded = {line.split()[-1] for line in maps if "/libpetsc" in line}
there = {os.path.realpath(os.path.join(sys.argv[1], name)) for name in os.listdir(sys.argv[1])}
sys.exit(not loaded & there)
