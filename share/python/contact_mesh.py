"""Starts contact-mesh from this folder, wherever that is. --modules only loads what the files of VTK need"""
import os
import runpy
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
if sys.argv[1:] == ["--modules"]:
    import contact.vtu  # noqa: F401
else:
    runpy.run_module("contact.meshes", run_name="__main__")
