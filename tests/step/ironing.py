"""Holds the summaries that ironing.sh wrote against the published figures of mesh 1 and against each other."""
from summaries import each, load, say, within

ironing = load("ironing")
say("ironing: 12876 unknowns", ironing["dofs"] == 12876, ironing["dofs"])
say("ironing: at most 185 constraints, to 10 %", within(max(each(ironing, "constraints")), 185, 0.1),
    each(ironing, "constraints"))
coarse, exact = load("coarse"), load("exact")
energies = list(zip(each(coarse, "energy"), each(exact, "energy")))
say("ironing, coarse: energies of the interior point method with MUMPS at tolerance 1e-9, to 1e-6",
    all(within(a, b, 1e-6) for a, b in energies), energies)
say("ironing: complementarity below 1e-8 in every step",
    max(each(ironing, "complementarity")) < 1e-8, each(ironing, "complementarity"))
true = load("true")
say(
    "ironing as shipped: a true gap in every step, none cut, after 12 linearizations at most", true["exit_code"] == 0
    and not any(each(true, "gap_unconverged")) and not sum(each(true, "cuts"))
    and max(each(true, "contact_updates")) <= 12, (true["reason"], each(true, "contact_updates")))
