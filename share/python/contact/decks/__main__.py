"""contact-ccx -i JOB runs the deck JOB.inp by contact, and writes JOB.frd and JOB.dat as CalculiX does."""
import argparse
import shutil
import subprocess
import sys

from .. import ContactError, load
from ..meshes.model import MeshError
from ..places import program
from . import results
from .translate import translate

FAILED = 201  # exit code of ccx after an error


def main():
    parser = argparse.ArgumentParser(prog="contact-ccx", description=__doc__, allow_abbrev=False,
                                     epilog="Further options are those of contact, for example -progress_every 5.")
    parser.add_argument("-i", metavar="JOB", dest="job", help="name of the deck, without .inp")
    parser.add_argument("-v", action="store_true", dest="version", help="prints the version of CalculiX' file formats")
    parser.add_argument("-deck_ignore", action="append", default=[], metavar="KEYWORD",
                        help="keywords of the deck, separated by commas, that are left out")
    parser.add_argument("-output", metavar="BASE", help="begin of the names of the results of contact")
    parser.add_argument("-summary", metavar="FILE", help="a copy of the summary of contact")
    given, options = parser.parse_known_args()
    if given.version:
        print("\nThis is Version 2.20\n(contact-ccx of amgf; the version is that of CalculiX' file formats)")
        return 0
    if given.job is None and options and not options[0].startswith("-"):
        given.job = options.pop(0)  # ccx JOB
    if given.job is None:
        parser.error("give a deck: -i JOB")
    stem = given.job[:-4] if given.job.lower().endswith(".inp") else given.job
    try:
        deck, bodies = translate(stem + ".inp", stem + "_deck.yaml", given.deck_ignore)
        print("\n".join(deck.notes.lines()), flush=True)
        base = given.output or stem + "_deck"
        done = subprocess.run([program(), stem + "_deck.yaml", "-output", base, "-summary", base + ".json", *options])
        if given.summary and done.returncode in (0, 2, 3, 4):
            shutil.copyfile(base + ".json", given.summary)
        if done.returncode in (0, 2, 3, 4) and any(step["converged"] for step in load(base).summary["steps"]):
            results.write(deck, bodies, load(base), stem)
    except (MeshError, ContactError, OSError) as error:
        print(f"*ERROR in contact-ccx: {error}", file=sys.stderr)
        return FAILED
    return 0 if done.returncode == 0 else FAILED


sys.exit(main())
