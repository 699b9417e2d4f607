"""Holds runs of the Hertz scenes against Hertz's solution at the computed force.

python hertz.py sphere|cylinder COARSE MEDIUM FINE   judges three runs, written with -output NAME -summary NAME.json
python hertz.py ssnv104 NAME                         judges SSNV104
"""
import sys

from hertz_solution import SOLUTIONS, measure
from summaries import say


def judge_convergence(title, runs):
    for what in runs[0]["errors"]:
        errors = [abs(run["errors"][what]) for run in runs]
        say("%s: %s within 1.5 %% of Hertz on the finest mesh" % (title, what), errors[2] <= 0.015, errors)
        # an error that is small on every mesh has nothing left to lose: its sign may change
        say("%s: %s converges from mesh to mesh" % (title, what),
            all(fine < coarse or fine < 6e-3 for coarse, fine in zip(errors, errors[1:])), errors)
    say("%s: largest nodal pressure within 1.5 %% of Hertz on the finest mesh" % title,
        abs(runs[2]["nodal error"]) <= 0.015, runs[2]["nodal error"])
    say("%s: the gap was updated until it was true" % title, all(1 < run["updates"] < 10 for run in runs),
        [run["updates"] for run in runs])


def judge_ssnv104(run):
    """At a/R = 0.2 the middle is so near that the ball is stiffer than Hertz's half-spaces; the contact itself is still
    his"""
    for what in ("peak pressure", "contact radius"):
        say("ssnv104: %s within 1 %% of Hertz at the computed force" % what,
            abs(run["errors"][what]) <= 0.01, run["errors"][what])
    say("ssnv104: approach 7 to 8 % below Hertz at the computed force", -0.08 <= run["errors"]["approach"] <= -0.07,
        run["errors"]["approach"])
    for what, reference in (("peak pressure", 2798.3), ("contact radius", 10)):
        say("ssnv104: %s within 5 %% of the published reference" % what,
            abs(run[what] / reference - 1) <= 0.05, run[what])


def main():
    body, *names = sys.argv[1:]
    runs = [measure(SOLUTIONS[body](), name) for name in names]
    if body == "ssnv104":
        judge_ssnv104(runs[0])
    else:
        judge_convergence(body, runs)


main()
