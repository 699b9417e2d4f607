#!/usr/bin/env python3
"""Makes a film of a run, a GIF, from the pictures that draw.py draws of its load steps. No display is needed.

    share/plot/film.py BASE FILM.gif [--every N] [--rate PICTURES_A_SECOND] [options of draw.py]

Give --limit, the upper end of the colours, so that colours mean the same in all pictures.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

try:
    from PIL import Image
except ImportError:
    sys.exit("film.py: Python has no Pillow: install python3-pil (Debian), or pillow from PyPI")

DRAW = os.path.join(os.path.dirname(os.path.abspath(__file__)), "draw.py")


def steps(base):
    """Numbers of the load steps with files"""
    folder, name = os.path.split(base)
    found = (re.fullmatch(re.escape(name) + r"_(\d+)\.h5", file) for file in os.listdir(folder or "."))
    return sorted(int(match.group(1)) for match in found if match)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("base", help="BASE of contact -output BASE")
    parser.add_argument("film", help="a GIF file")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="draw every Nth load step; default: 1")
    parser.add_argument("--rate", type=float, default=10, help="pictures per second; default: 10")
    args, options = parser.parse_known_args()
    if args.every < 1 or args.rate <= 0:
        sys.exit("film.py: --every and --rate must be above 0")
    numbers = steps(args.base)[::args.every]
    if not numbers:
        sys.exit("film.py: there are no files %s_0001.h5 and so on: run contact with -output %s" %
                 (args.base, args.base))
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for number in numbers:
            picture = os.path.join(folder, "%06d.png" % number)
            if subprocess.run([sys.executable, "-B", DRAW, args.base, picture, "--step",
                               str(number)] + options).returncode:
                sys.exit("film.py: load step %d could not be drawn" % number)
            pictures.append(Image.open(picture).convert("P", palette=Image.Palette.ADAPTIVE))
        pictures[0].save(args.film, save_all=True, append_images=pictures[1:], duration=1000 / args.rate, loop=0)
    print("%s: %d pictures" % (args.film, len(pictures)))


if __name__ == "__main__":
    main()
