"""Scenes for tetrahedra_contact.sh, and what its runs came to

    tetrahedra_contact.py mesh SCENE.yaml BODY=FILE.msh:ORDER...   the scene with these bodies from files of
    tests/lib/tetrahedra.py
    tetrahedra_contact.py check
"""
import glob
import re
import sys

import h5py
import numpy as np

sys.path[1:1] = [sys.path[0] + folder for folder in ("/../../share/scenes", "/../constraints")]
from order2_contact import last, patch  # noqa: E402
from summaries import say, within  # noqa: E402
from shrink_fit import lame  # noqa: E402
from ties import STRESS, stress  # noqa: E402


def mesh(scene, bodies):
    """What a body keeps from its young on; faces that tell no normal are those of a box or of a quarter of a pipe"""
    text = open(scene).read()
    for body in bodies:
        name, file, order = re.fullmatch(r"(\w+)=(.*):(\d)", body).groups()
        text = re.sub(r"(- %s:)\s*\{?[^}]*?young" % name,
                      r"\1 {mesh: %s, volume: block, order: %s, young" % (file, order), text, count=1)
        text = re.sub(r"(\{mesh: %s[^\n}]*)\n\s*poisson: ([0-9.]+)" % file, r"\1, poisson: \2}", text)
    print(text, end="")


def pressures(name):
    """At the vertices of both sides more than three facets away from the ends of the arc, over Lame's"""
    with h5py.File(name + ".h5") as file, h5py.File(name + "_0001.h5") as state:
        x, pressure, gap = file["vertices"][...], state["contact_pressure"][...], state["contact_gap"][...]
    angle = np.degrees(np.arctan2(x[:, 1], x[:, 0]))
    inside = ~np.isnan(gap) & (angle > 25) & (angle < 65)
    return pressure[inside] * np.hypot(x[inside, 0], x[inside, 1]) / lame()


def check():
    for name in sorted(file[:-len("_0001.h5")] for file in glob.glob("patch_*_0001.h5")):
        errors, young = patch(name), float(name.split("_")[3])
        say(name + ": stress and pressure uniform", max(errors) <= 1e-12 * max(1e4, young * 1e2), errors)
    s = STRESS
    for name in sorted(file[:-len(".json")] for file in glob.glob("tie_*.json")):
        errors = [
            np.abs(np.subtract(stress(p), [s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]])).max()
            for p in last(name)["probes"]
        ]
        say(name + ": any uniform stress passes", max(errors) < 1e-8, errors)
    one = last("ring_1")
    three = last("ring_3")["energy"]
    say("ring: energy on 3 ranks", within(three, one["energy"], 1e-9), (three, one["energy"]))
    exact = 0.5 * lame() * 0.03 * 2 * np.pi / 2
    for name, tolerance in (("ring_1", 0.01), ("ring_node", 0.01)):
        energy = last(name)["energy"]
        say(name + ": energy near Lame's", within(energy, exact, tolerance), (energy, exact))
    p = pressures("ring_node")
    say("ring_node: mean pressure near Lame's", within(p.mean(), 1, 0.02), (p.min(), p.mean(), p.max()))
    say("a run goes on", within(last("again")["energy"],
                                last("press")["energy"], 1e-9), (last("again")["energy"], last("press")["energy"]))
    say("force of the press, of tetrahedra and of hexahedra",
        within(last("press")["pairs"][0]["force"][2],
               last("hexahedra")["pairs"][0]["force"][2], 0.01),
        (last("press")["pairs"][0]["force"], last("hexahedra")["pairs"][0]["force"]))


if __name__ == "__main__":
    if sys.argv[1] == "mesh":
        mesh(sys.argv[2], sys.argv[3:])
    else:
        check()
