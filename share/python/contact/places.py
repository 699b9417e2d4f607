"""Where the program is, and the scripts that belong to it."""
import os
import shutil

from .files import ContactError


def program():
    """$CONTACT, else the program beside this package, in the sources or installed, else the one in the path"""
    here = os.path.dirname(os.path.realpath(__file__))
    places = [
        os.environ.get("CONTACT"), *(os.path.join(here, *[".."] * up, "bin", "contact") for up in (3, 4)),
        shutil.which("contact")
    ]
    for place in places:
        if place and os.access(place, os.X_OK):
            return os.path.normpath(place)
    raise ContactError("there is no program contact: set CONTACT to its path")


def script(name):
    """A script of share/, beside the program in the sources or installed"""
    top = os.path.dirname(os.path.dirname(os.path.realpath(program())))
    for folder in ("share/amgf", "share"):
        path = os.path.join(top, folder, name)
        if os.path.exists(path):
            return path
    raise ContactError(f"share/{name} is missing: it must be installed next to the program")
