"""Checks the colours in the pictures that draw.py made of two boxes.

An argument is PICTURE=NAME,-NAME: the picture must have the first colour, and must not have the second one.
"""
import os
import sys

import matplotlib.image
import numpy as np

sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "share", "plot"))
from draw import BODY_COLOURS, GREY, STATUS_COLOURS, VIRIDIS

COLOURS = {
    "high": VIRIDIS[-1],
    "grey": GREY,
    "base": BODY_COLOURS[0],
    "punch": BODY_COLOURS[1],
    "open": STATUS_COLOURS[0],
    "closed": STATUS_COLOURS[1],
}


def share(picture, colour):
    """Fraction of the bodies' part of the picture whose pixels have this hue, however dark the light makes them"""
    pixels = picture[:-50, :int(0.8 * picture.shape[1]), :3].reshape(-1, 3)
    lightness = pixels.max(axis=1, keepdims=True)
    hue = pixels / np.maximum(lightness, 1e-3)
    white = pixels.min(axis=1) > 0.97
    near = np.abs(hue - np.array(colour) / max(colour)).max(axis=1) < 0.08
    return np.mean(near & (lightness[:, 0] > 0.15) & ~white)


for argument in sys.argv[1:]:
    name, _, wanted = argument.partition("=")
    picture = matplotlib.image.imread(name)
    for word in wanted.split(","):
        part = share(picture, COLOURS[word.lstrip("-")])
        absent = word.startswith("-")
        if (part > 1e-3) == absent:
            print(f"{name}: {word.lstrip('-')} is on {100 * part:.2f} % of it")
print("pictures judged:", len(sys.argv) - 1)
