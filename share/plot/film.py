#!/usr/bin/env python3
"""Makes a film of a run, a GIF, from the pictures that draw.py draws of its load steps. No display is needed.

    share/plot/film.py BASE FILM.gif [--every N] [--rate PICTURES_A_SECOND] [options of draw.py]

All pictures have the same colours for the same values, the same scale of displacements and the same view.
"""
import argparse
import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "python")]
from interpreter import need

need("numpy", "h5py", "vtkmodules", "PIL")
from PIL import Image
from contact.files import ContactError, Files
import draw


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("base", help="BASE of contact -output BASE")
    parser.add_argument("film", help="a GIF file")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="draw every Nth load step; default: 1")
    parser.add_argument("--rate", type=float, default=10, help="pictures per second; default: 10")
    args, options = parser.parse_known_args()
    if args.every < 1 or args.rate <= 0:
        sys.exit("film.py: --every and --rate must be above 0")
    try:
        numbers = sorted(Files(args.base).files)[::args.every]
    except ContactError as error:
        sys.exit("film.py: %s" % error)
    with tempfile.TemporaryDirectory() as folder:
        names = [os.path.join(folder, f"{number:06d}.png") for number in numbers]
        draw.draw_steps(draw.arguments([args.base, names[0], *options]), numbers, names)
        pictures = [Image.open(name).convert("P", palette=Image.Palette.ADAPTIVE) for name in names]
        pictures[0].save(args.film, save_all=True, append_images=pictures[1:], duration=1000 / args.rate, loop=0)
    print("%s: %d pictures" % (args.film, len(pictures)))


if __name__ == "__main__":
    main()
