"""TAOIPFILTER and IPOPT on the nonlinear programs of nlp.py written in other forms: tests/stress/nlp_forms.md. `make
stress STRESS=nlp` runs this after nlp.py.
"""
import math
import os

from nlp import HERE, KINDS, PROBLEMS, counts, differences, judge, parse, run, shipped, solvers
from nlp_problems import UNBOUNDED, Problem
from nlp_textbook import TEXTBOOK

# Minima of these problems beside the known ones, to which other forms lead: the gradient of the Lagrangian vanishes
# there to 1e-5, and its Hessian is positive definite on the tangent space (HS23, S325: two rows active, both
# multipliers positive)
MINIMA = {
    "HS23": 9.472135955, "HS46": 0.0210889286, "S261": 1.6295575861, "S282": 3.9843950179, "bard": 1.0038205868,
    "BT5": 952.1424944555, "HS47": 10.0699102841, "S325": 7.4640959077
}

FUNCTIONS = {name: getattr(math, name) for name in ("exp", "sin", "cos", "cosh", "atan", "sqrt", "log", "tanh", "erf")}
MOST_UNKNOWNS, MOST_ROWS = 50, 100  # tests/stress/nlp_read.h


def rows(text):
    return [row for row in text.split(";") if row.strip()]


def value(formula, start):
    """At the start; 0 where there is none"""
    try:
        return float(
            eval(formula.replace("^", "**"),
                 {**FUNCTIONS, **{f"x{i}": float(x)
                                  for i, x in enumerate(start.split(), 1)}}))
    except (ArithmeticError, ValueError, TypeError):
        return 0.0


def rewritten(p, start=(), bounds=(), **parts):
    """The problem with some parts replaced, and unknowns more"""
    n = len(p.start.split())
    old = (p.bounds.split() + [":"] * n)[:n]
    parts = {"objective": p.objective, "ge": rows(p.inequalities), "eq": rows(p.equalities), **parts}
    return Problem(p.name, parts.pop("objective"), p.optimum, " ".join([*p.start.split(), *map(repr, start)]),
                   bounds=" ".join([*old, *bounds]),
                   others=[*p.others, *([MINIMA[p.name]] if p.name in MINIMA else [])], end=p.end, **parts)


def slacks(p, zero=False):
    n, ge = len(p.start.split()), rows(p.inequalities)
    if not ge:
        return None
    return rewritten(p, [0.0 if zero else max(value(row, p.start), 0.0) for row in ge], ["0:"] * len(ge), ge=[],
                     eq=rows(p.equalities) + [f"{row}-x{n + k}" for k, row in enumerate(ge, 1)])


def epigraph(p, zero=False):
    n = len(p.start.split())
    return rewritten(p, [0.0 if zero else value(p.objective, p.start)], [":"], objective=f"x{n + 1}",
                     ge=[*rows(p.inequalities), f"x{n + 1}-({p.objective})"])


def twice(p):
    if not p.inequalities and not p.equalities:
        return None
    return rewritten(p, ge=2 * rows(p.inequalities), eq=2 * rows(p.equalities))


def far(p):
    if p.end == UNBOUNDED:
        return None  # the rows would bound it
    return rewritten(p, ge=[*rows(p.inequalities), "1e8+x1", f"1e10-x{len(p.start.split())}"])


FORMS = {
    "slacks": slacks, "slacks from zero": lambda p: slacks(p, True), "epigraph": epigraph,
    "epigraph from zero": lambda p: epigraph(p, True), "twice": twice, "far rows": far
}


def fits(p):
    return p is not None and len(
        p.start.split()) <= MOST_UNKNOWNS and len(rows(p.inequalities)) + len(rows(p.equalities)) <= MOST_ROWS


HEADER = """# Nonlinear programs in other forms: TAOIPFILTER compared with IPOPT

`make stress STRESS=nlp` makes this page (tests/stress/nlp_forms.py). The problems are those of
[nlp.md](nlp.md), which also says which results are right. build/nlp/nlp_forms_all.md lists the problems that one of
both solvers has right.

| form | how it is written |
| --- | --- |
| slacks | each inequality c >= 0 becomes c - s = 0, s >= 0 |
| slacks from zero | the same, with s = 0 at the start |
| epigraph | the objective f becomes t with the constraint t - f >= 0; t = f at the start |
| epigraph from zero | the same, with t = 0 at the start |
| twice | each constraint is given twice |
| far rows | two constraints of magnitude 1e8 and 1e10, which are never active, are added |
"""


def main():
    args = parse()
    lines, others = [HEADER], ["# Problems that one of ipfilter and IPOPT has right", ""]
    asked = [s for s in solvers(args.folder) if s.name in ("ipfilter", "IPOPT")]
    for form, rewrite in FORMS.items():
        problems = [p for p in map(rewrite, [*shipped(args.folder), *PROBLEMS, *KINDS, *TEXTBOOK]) if fits(p)]
        results = {s.name: run(s, problems, args.folder, args.limit) for s in asked}
        for found in results.values():
            for p in problems:
                found[p.name].verdict = judge(p, found[p.name])
        title = "| problem | | f | optimum | violation | its | said |\n|" + " --- |" * 7
        lines += [f"## {form}", "", *counts(problems, results), ""]
        for left, right in (("ipfilter", "IPOPT"), ("IPOPT", "ipfilter")):
            others += [f"## {form}: {right} has right, {left} not", "", title,
                       *differences(problems, results, left, right), ""]
        print(form, *counts(problems, results), sep="\n", flush=True)
    with open(os.path.join(args.out, "nlp_forms.md"), "w") as out:
        out.write("\n".join(lines))
    with open(os.path.join(args.folder, "nlp_forms_all.md"), "w") as out:
        out.write("\n".join(others))


if __name__ == "__main__":
    main()
