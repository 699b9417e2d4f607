"""Judges the runs of friction_tetrahedra.sh, a block of tetrahedra on ground of tetrahedra or hexahedra, by statics and
by the same of hexahedra."""
import sys

from summaries import load, say, within

LONG = sys.argv[1:] == ["long"]
KINDS = ["t1_t1", "t2_h1"] + ["t2_t2", "h1_t2"] * LONG  # ground and block, kind and order
# Limits of force and dissipation. The stiffer a body, the farther it slips; 4 times as many load steps change the
# dissipation by 3e-4
MOVED = [("t1_t1", 3e-3, 1.2e-2)] + [("t2_t2", 3e-3, 8e-3)] * LONG


def last(name):
    return load(name)["steps"][-1]["pairs"][0]


for kind in KINDS:
    pair = last("sticks_" + kind)
    say(f"{kind}: pushed by 178.2 it holds",
        load("sticks_" + kind)["converged"] and within(pair["force"][0], -178.2, 1e-6), pair["force"])
    say(f"{kind}: pushed by 181.8 it slides away",
        load("slides_" + kind)["exit_code"] == 2,
        load("slides_" + kind)["reason"])
    say(f"{kind}: no friction beyond its law", pair["shear_force"] <= 0.3 * pair["normal_force"] * (1 + 1e-6),
        pair["shear_force"] / pair["normal_force"])
hexahedra = last("cycle_h1_h1")
for kind, limit, taken in MOVED:
    pair = last("cycle_" + kind)
    say(f"{kind}: moved to and fro, friction over normal force",
        within(pair["shear_force"], 0.3 * pair["normal_force"], 1e-6), pair["shear_force"] / pair["normal_force"])
    say(
        f"{kind}: force and dissipated work as of hexahedra",
        within(pair["force"][0], hexahedra["force"][0], limit)
        and within(pair["dissipated"], hexahedra["dissipated"], taken),
        (pair["force"], pair["dissipated"], hexahedra["force"], hexahedra["dissipated"]))
one, three = last("cycle_t1_t1"), last("cycle_t1_t1_3")
say("3 ranks as 1",
    within(three["force"][0], one["force"][0], 1e-7) and within(three["dissipated"], one["dissipated"], 1e-7),
    (one, three))
