"""TAOIPFILTER and IPOPT on nonlinear programs drawn at random: tests/stress/nlp_random.md. `make stress STRESS=nlp`
runs this after nlp.py.

No one has chosen these: ten families, the seed of a problem is its number. Constraints hold at a point that is drawn
too, but for those that cannot be met, so that a solution exists where the objective is bounded; which one of several a
solver ends in is not judged.
"""
import math
import os
import random
from collections import namedtuple

from nlp import FAR, FAR_VIOLATION, HERE, parse, run, solvers
from nlp_problems import INFEASIBLE, Problem, total

# of an objective whose coefficients are at most 3: a feasible point below minus this shows that there is no minimum
BOTTOMLESS = 1e10
Draw = namedtuple("Draw", "random n point start")
FUNCTIONS = {name: getattr(math, name) for name in ("exp", "sin", "atan", "sqrt")}


def value(formula, point):
    return eval(formula.replace("^", "**"), {**FUNCTIONS, **{f"x{i}": x for i, x in enumerate(point, 1)}})


def each(n, term):
    """The term for every unknown, summed: x stands for the unknown, # for its number"""
    return total(term.replace("x#", f"x{i}") for i in range(1, n + 1))


def polynomial(d, terms, degree):
    return "+".join(f"({d.random.uniform(-3, 3):.2f})*" + "*".join(f"x{d.random.randint(1, d.n)}"
                                                                   for _ in range(d.random.randint(1, degree)))
                    for _ in range(terms))


def through(d, formula, room=0.0):
    """The formula less its value at the point, and some room"""
    return f"{formula}-({value(formula, d.point) - room!r})"


def plane(d):
    return "+".join(f"({d.random.uniform(-1, 1)!r})*x{i}" for i in range(1, d.n + 1))


def polynomials(d):
    eq = [through(d, polynomial(d, 4, 3)) for _ in range(d.random.randint(1, max(1, (d.n - 1) // 2)))]
    ge = [through(d, polynomial(d, 4, 2), d.random.choice([0.0, 0.5])) for _ in range(d.random.randint(0, 4))]
    return dict(objective=polynomial(d, 8, 4) + "+" + each(d.n, "0.1*x#^4"), eq=eq, ge=ge)


def decays(d):
    pairs = min(3, d.n // 2)
    model = "+".join(f"x{2 * j + 1}*exp(-x{2 * j + 2}^2*T)" for j in range(pairs))
    terms = []
    for k in range(10):
        formula = model.replace("T", repr(k / 3))
        terms.append(f"({formula}-({value(formula, d.point) + d.random.gauss(0, 0.05)!r}))^2")
    return dict(objective="+".join(terms), start=d.start[:2 * pairs], ge=["4-" + each(2 * pairs, f"x#^2/{2 * pairs}")],
                bounds=f"{2 * pairs}*-5:5")


def posynomials(d):

    def posynomial():
        return "+".join(f"{d.random.uniform(0.1, 3)!r}*exp(" +
                        "+".join(f"({d.random.choice([-2, -1, 1, 2])})*x{i}"
                                 for i in d.random.sample(range(1, d.n + 1), 2)) + ")"
                        for _ in range(4))

    rows = [posynomial() for _ in range(d.random.randint(1, d.n))]
    return dict(objective=posynomial() + "+" + each(d.n, "0.01*x#^2"),
                ge=[f"{value(row, d.point) * d.random.uniform(1, 1.2)!r}-({row})" for row in rows])


def quadratics(d):
    ge = [through(d, plane(d), d.random.choice([0.0, 0.0, 1.0])) for _ in range(d.random.randint(1, d.n))]
    return dict(objective=polynomial(d, 3 * d.n, 2), ge=ge, eq=[through(d, plane(d))] if d.n > 3 else [],
                bounds=f"{d.n}*-2:2")


def controls(d):
    steps, rate = d.random.randint(4, 16), d.random.uniform(1.5, 9)
    before = ["1.0", *(f"x{k}" for k in range(1, steps))]
    eq = [f"x{k}-({x})-{1 / steps!r}*({rate!r}*sin({x})+x{steps + k}*(1+({x})^2))" for k, x in enumerate(before, 1)]
    return dict(objective="+".join(f"x{k}^2+0.01*x{steps + k}^2" for k in range(1, steps + 1)), eq=eq,
                start=[d.random.uniform(-1, 1) for _ in range(2 * steps)],
                bounds=f"{steps}*-5:5 {steps}*{-d.random.uniform(1, 6)!r}:{d.random.uniform(1, 6)!r}")


def kinks(d):
    rows = [through(d, polynomial(d, 3, 2), -0.2) for _ in range(3)]
    return dict(objective="+".join(f"sqrt((x{i}-({x!r}))^2+1e-6)" for i, x in enumerate(d.point, 1)) + "+0.01*x1^2",
                ge=[row for row in rows for _ in range(2)], bounds=f"{d.n}*-4:4")


def infeasible(d):
    return dict(
        objective=polynomial(d, 5, 2) + "+" + each(d.n, "0.1*x#^4"), end=INFEASIBLE, ge=[
            "-0.5-(" + "+".join(f"(x{i}-({x!r}))^2" for i, x in enumerate(d.point, 1)) + ")",
            polynomial(d, 3, 2) + "-1"
        ])


def waves(d):
    objective = "+".join(f"sin({d.random.uniform(0.5, 2)!r}*x{i}+x{i % d.n + 1})+0.1*x{i}^2" for i in range(1, d.n + 1))
    row = "+".join(f"atan({d.random.uniform(-2, 2)!r}*x{i})" for i in range(1, d.n + 1))
    return dict(objective=objective, eq=[through(d, row)],
                bounds=" ".join(d.random.choice([":", "-1:", "-1.5:1.5", ":1"]) for _ in range(d.n)))


def complementarities(d):
    pairs = d.n // 2
    objective = "+".join(f"(x{i}-({d.random.uniform(-1, 2)!r}))^2"
                         for i in range(1, 2 * pairs + 1)) + f"+({d.random.uniform(-1, 1)!r})*x1*x{2 * pairs}"
    return dict(objective=objective, ge=[f"-x{i}*x{pairs + i}" for i in range(1, pairs + 1)],
                start=[abs(x) for x in d.start[:2 * pairs]], bounds=f"{2 * pairs}*0:")


def units(d):
    sizes = [10**d.random.uniform(-4, 4) for _ in range(d.n)]

    def scaled(formula):
        for i in range(d.n, 0, -1):
            formula = formula.replace(f"x{i}", f"(y{i}*{sizes[i - 1]!r})")
        return formula.replace("y", "x")

    row, side = (f"{10 ** d.random.uniform(-3, 3)!r}*({through(d, polynomial(d, 3, 2))})" for _ in range(2))
    return dict(objective=scaled(polynomial(d, 8, 3) + "+" + each(d.n, "0.1*x#^4")), eq=[scaled(row)],
                ge=[scaled(side)], start=[x / size for x, size in zip(d.start, sizes)])


FAMILIES = [polynomials, decays, posynomials, quadratics, controls, kinks, infeasible, waves, complementarities, units]


def problem(number):
    """Of the family that the last digit of its number says"""
    generator, family = random.Random(number), FAMILIES[number % len(FAMILIES)]
    n = generator.randint(2, 10)
    d = Draw(generator, n, [generator.uniform(-2, 2) for _ in range(n)],
             [round(generator.uniform(-3, 3), 4) for _ in range(n)])
    parts = {"start": d.start, **family(d)}
    return Problem(f"{family.__name__} {number}", parts.pop("objective"), 0.0, parts.pop("start"), **parts)


def solved(p, result):
    if p.end == INFEASIBLE:
        return result.status == "infeasible"
    if result.status == "unbounded":
        return result.objective < -BOTTOMLESS and result.violation < FAR_VIOLATION
    return result.status in ("converged", "acceptable") and result.violation < FAR_VIOLATION


def rows(problems, ours, theirs):
    for family in FAMILIES:
        members = [p for p in problems if p.name.startswith(family.__name__)]
        both = [
            p.name for p in members if solved(p, ours[p.name]) and solved(p, theirs[p.name]) and (
                p.end == INFEASIBLE or abs(ours[p.name].objective -
                                           theirs[p.name].objective) <= FAR * max(1.0, abs(theirs[p.name].objective)))
        ]
        sums = [
            str(sum(getattr(results[name], what)
                    for name in both))
            for results in (ours, theirs)
            for what in ("iterations", "points")
        ]
        yield [
            family.__name__,
            str(len(members)), *(str(sum(solved(p, results[p.name]) for p in members)) for results in (ours, theirs)),
            str(len(both)), *sums
        ]


HEADER = f"""# Nonlinear programs drawn at random: TAOIPFILTER compared with IPOPT

`make stress STRESS=nlp` makes this page (tests/stress/nlp_random.py). Both solvers use their default
options. The time limit is %g s per problem.

| family | a problem is solved if the solver reports |
| --- | --- |
| infeasible | that it is infeasible |
| polynomials, which may be unbounded below | convergence as below, or an unbounded problem at a point that meets \
the constraints and has an objective below -{BOTTOMLESS:g} |
| all others | convergence, and constraints are violated by less than {FAR_VIOLATION:g} |

Iterations and points are sums over the problems that both solve with the same objective. A point is
one at which the objective or its gradient was computed.

| family | problems | ipfilter solves | IPOPT solves | both, alike | iterations | points | IPOPT's iterations \
| IPOPT's points |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
"""


def main():
    args = parse()
    problems = [problem(number) for number in range(500)]
    results = {
        s.name: run(s, problems, args.folder, args.limit)
        for s in solvers(args.folder)
        if s.name in ("ipfilter", "IPOPT")
    }
    table = list(rows(problems, results["ipfilter"], results["IPOPT"]))
    table.append(["all", *(str(sum(int(row[k]) for row in table)) for k in range(1, len(table[0])))])
    lines = "".join("| " + " | ".join(row) + " |\n" for row in table)
    with open(os.path.join(args.out, "nlp_random.md"), "w") as out:
        out.write(HEADER % args.limit + lines)
    print(lines)


if __name__ == "__main__":
    main()
