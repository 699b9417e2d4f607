"""Runs contact from Python, and reads what it wrote.

    import contact

    run = contact.run("press.yaml", refine=1)        # contact press.yaml -refine 1
    run.history["force"]                             # a numpy array, one vector a load step
    run.plot("pressure", "press.png")
    old = contact.load("results/press")              # the files that contact -output results/press wrote

Quantities have the units of the scene.
"""
from .files import ContactError
from .results import Run, load
from .runs import run

__all__ = ["ContactError", "Run", "load", "run"]
