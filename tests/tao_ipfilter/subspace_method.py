"""Checks the runs of subspace_method.sh. Energies and forces are those of the interior point method, on any number of
ranks. The method needs few more iterations than CG without contact. With MUMPS instead of AMG it factors once a run;
each of its steps is one solve, where Newton's method needs a factorization."""
import json
import os
import re


def steps(name):
    with open(name + ".json") as file:
        summary = json.load(file)
    return summary["steps"], summary["contact_free"]["iterations"]


def filters(name):
    """Whether a run says that it filtered systems"""
    with open(name + ".json") as file:
        return any(step["filtered_systems"] for step in json.load(file)["steps"])


def ran(name, *ranks):
    """On which of these numbers of ranks a scene ran; the expected output says on which it must"""
    return [n for n in ranks if os.path.exists(f"{name}_{n}.json")]


def forces(step):
    return [component for pair in step["pairs"] for component in pair["force"]]


def difference(a, b):
    """Largest of all load steps: of the energies, and of the pairs' forces against the largest of them"""
    energy = max(abs(x["energy"] - y["energy"]) / y["energy"] for x, y in zip(a, b))
    force = max(abs(f - g) / max(map(abs, forces(y))) for x, y in zip(a, b) for f, g in zip(forces(x), forces(y)))
    return energy, force


def verdict(what, value, limit):
    print(f"{what}: below {limit:g}" if value <= limit else f"{what}: {value:g} is above {limit:g}")


def spared(name, run):
    print("  the interior point method was",
          "not needed" if not any(step["linear"]["subspaces"] for step in run) else "NEEDED")
    print("  the AMG filter was", "not in use" if not filters(name) else "SAID TO BE IN USE")


for scene, ranks, cost in ("beam_sphere", (1, 3), (1.5, 1.2)), ("ironing", (1, 5), (1.5, 1.2)):
    interior, _ = steps(scene)
    alone, _ = steps(f"{scene}_1")
    for n in ran(scene, *ranks):
        run, free = steps(f"{scene}_{n}")
        print(f"{scene}, {n} ranks")
        energy, force = difference(run, interior)
        verdict("  energy against the interior point method's", energy, 1e-8)
        verdict("  forces", force, 1e-7)
        verdict("  energy and forces against those of one rank", max(difference(run, alone)), 1e-9)
        verdict("  AMG applications of the first load step by those without contact", run[0]["amg_applications"] / free,
                cost[0])
        verdict("  of a later one", max(step["amg_applications"] for step in run[1:]) / free, cost[1])
        print("  the AMG was set up", "once" if sum(step["amg_setups"] for step in run) == 1 else "MORE THAN ONCE")
        spared(f"{scene}_{n}", run)

for n in ran("neo_hookean", 1, 3):
    run, interior = steps(f"neo_hookean_{n}")[0], steps("neo_hookean")[0]
    print(f"beam_sphere at finite strain, {n} ranks")
    energy, force = difference(run, interior)
    verdict("  energy against the interior point method's", energy, 1e-8)
    verdict("  forces", force, 1e-7)
    verdict("  energy and forces against those of one rank", max(difference(run, steps("neo_hookean_1")[0])), 1e-9)
    verdict("  AMG applications by those of the interior point method",
            sum(step["amg_applications"] for step in run) / sum(step["amg_applications"] for step in interior), 0.5)
    spared(f"neo_hookean_{n}", run)


def judge_factored(name, scene, setups):
    """What a run with factors in place of the AMG leaves, and takes"""
    interior, _ = steps(scene)
    run, _ = steps(name)
    energy, force = difference(run, interior)
    verdict("  energy against the interior point method's", energy, 1e-8)
    verdict("  forces", force, 1e-7)
    verdict("  solves with the factors, of a load step", max(sum(step["ksp_iterations"]) for step in run), 25)
    print("  the stiffness matrix was factored", "once" if setups == 1 else f"{setups} times")
    spared(name, run)


for n in ran("beam_sphere_direct", 1, 2):
    print(f"beam_sphere with a factorization, {n} ranks")
    with open(f"beam_sphere_direct_{n}.log") as file:
        judge_factored(f"beam_sphere_direct_{n}", "beam_sphere",
                       int(re.search(r"^PCSetUp +(\d+)", file.read(), re.M)[1]))
for n in ran("ironing_chosen", 1, 3):
    print(f"ironing, which chooses a factorization, {n} ranks")
    print("  the summary says so:",
          "yes" if all(step["factored"] for step in steps(f"ironing_chosen_{n}")[0]) else "NO")
    judge_factored(f"ironing_chosen_{n}", "ironing",
                   sum(step["amg_setups"] for step in steps(f"ironing_chosen_{n}")[0]))
