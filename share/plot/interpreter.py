"""Finds a Python that has the modules of a program: that which runs it, or the one that the build found."""
import importlib.util
import os
import re
import subprocess
import sys

PACKAGES = {"vtkmodules": "vtk9", "PIL": "pil"}  # of Debian, where they are not called after the module: python3-...


def of_the_build():
    """The Python in the program bin/contact-mesh, of the tree or of an installation"""
    here = os.path.dirname(os.path.abspath(__file__))
    for top in ("../..", "../../.."):
        try:
            with open(os.path.join(here, top, "bin", "contact-mesh"), encoding="utf-8") as file:
                return re.search(r"exec (\S+) -B", file.read())[1]
        except (OSError, TypeError):
            continue
    return "/usr/bin/python3"


def need(*modules):
    """Goes on if this Python has the modules; else runs the program by the other Python, or ends with one sentence"""
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if not missing:
        return
    other, program = of_the_build(), os.path.basename(sys.argv[0])
    test = subprocess.run([other, "-c", "import " + ", ".join(modules)], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) if os.path.exists(other) else None
    if test and test.returncode == 0:
        os.execv(other, [other, "-B", *sys.argv])
    packages = ", ".join("python3-" + PACKAGES.get(module, module) for module in missing)
    sys.exit(f"{program}: Python at {sys.executable} has no module {', '.join(missing)} (Debian: {packages})")
