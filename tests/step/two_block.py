"""Holds the summaries that two_block.sh and two_block_long.sh wrote against each other, and with the argument `long`
against the published figures of mesh 1."""
import sys

from summaries import load, mean, say, within

published, coarse = load("published"), load("coarse")  # on the same mesh
steps, bound = published["steps"], published["contact_free"]["bound"]


def balanced(name, run):
    for s in run["steps"]:
        force = s["contact_force"][2] + s["reaction"][2]
        say("%s, step %d: action = reaction to 1e-6" % (name, s["step"]),
            abs(force) <= 1e-6 * abs(s["reaction"][2]), force)


if sys.argv[1:] == ["long"]:
    say("13380 unknowns", published["dofs"] == 13380, published["dofs"])
    say("81 constraints in both steps", all(s["constraints"] == 81 for s in steps), [s["constraints"] for s in steps])
    say("filter of 111 and 348 unknowns", all(within(s["filter_dofs"], n, 0.05) for s, n in zip(steps, (111, 348))),
        [s["filter_dofs"] for s in steps])
    say("interior-point iterations within 30 % of 16", all(within(s["ip_iterations"], 16, 0.3) for s in steps),
        [s["ip_iterations"] for s in steps])
    counts = [mean([k for k in s["ksp_iterations"] if k]) for s in steps]
    say("mean PCG iterations within 25 % of 72", all(within(c, 72, 0.25) for c in counts), counts)
most = max(max(s["ksp_iterations"]) for s in steps)
say("PCG iterations never above the bound", most <= bound, (most, bound))
balanced("published", published)
forces = [(s["contact_force"][2], e["contact_force"][2]) for s, e in zip(coarse["steps"], steps)]
say("defaults: contact force of the published configuration, to 1e-5", all(within(a, b, 1e-5) for a, b in forces),
    forces)
if sys.argv[1:] == ["long"]:
    sys.exit()
exact, amg = load("exact"), load("amg")
default = {ranks: load("default_%d" % ranks) for ranks in (1, 3)}
say("AMG alone above the bound", max(amg["steps"][0]["ksp_iterations"]) > bound, amg["steps"][0]["ksp_iterations"])
balanced("defaults", default[1])
energies = [(s["energy"], e["energy"]) for s, e in zip(default[1]["steps"], exact["steps"])]
say("defaults: energy of the interior point method with MUMPS at tolerance 1e-9, to 1e-9",
    all(within(a, b, 1e-9) for a, b in energies), energies)
applications = [s["amg_applications"] for s in default[1]["steps"]]
say("defaults: at most 250 AMG applications a load step", max(applications) <= 250, applications)
pairs = [(s["energy"], t["energy"]) for s, t in zip(default[3]["steps"], default[1]["steps"])]
say("3 ranks: energy of one rank to 1e-9", all(within(a, b, 1e-9) for a, b in pairs), pairs)
