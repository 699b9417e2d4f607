"""Nonlinear programs of kinds that nlp_problems.py has few of, for tests/stress/nlp.py: written after the solver was
developed with those, and judged by themselves. Formulas, bounds and optima as there; an optimum that is not in closed
form is computed here by another way than by an optimizer."""
import itertools
import math
import random

import numpy

from nlp_problems import DEGENERATE, INFEASIBLE, UNBOUNDED, Problem, linear, total

KINDS = []


def add(name, objective, optimum, start, **rest):
    KINDS.append(Problem(name, objective, optimum, start, **rest))


def vertices(c, rows):
    """The least c'x subject to a'x >= b for (a, b) in rows: the best of all feasible vertices"""
    a, b = (numpy.array(list(part), dtype=float) for part in zip(*rows))
    best = math.inf
    for active in itertools.combinations(range(len(b)), len(c)):
        matrix = a[list(active)]
        if abs(numpy.linalg.det(matrix)) > 1e-10:
            x = numpy.linalg.solve(matrix, b[list(active)])
            if (a @ x >= b - 1e-9).all():
                best = min(best, float(numpy.dot(c, x)))
    return best


# ---- Linear programs with redundant rows, degenerate vertices, unbounded sets of solutions ----

add("Wyndor, rows twice and their sum", "-3*x1-5*x2", -36.0, "0 0",
    ge=["4-x1", "12-2*x2", "18-3*x1-2*x2", "4-x1", "24-4*x2", "34-4*x1-4*x2", "36-6*x1-4*x2"], bounds="2*0:")
TAHA = [[10, 2, 20, 11], [12, 7, 9, 20], [4, 14, 16, 18]]
add(
    "transportation, dependent equalities", linear(sum(TAHA, [])), 435.0, "12*1", bounds="12*0:",
    eq=["+".join(f"x{4 * i + j}" for j in range(1, 5)) + f"-{supply}" for i, supply in enumerate((15, 25, 10))] +
    ["+".join(f"x{4 * i + j}" for i in range(3)) + f"-{demand}" for j, demand in enumerate((5, 15, 15, 15), 1)])


def assignment(n):
    draw = random.Random(n)
    cost = [[draw.randint(1, 20) for _ in range(n)] for _ in range(n)]
    optimum = min(sum(cost[i][p[i]] for i in range(n)) for p in itertools.permutations(range(n)))
    sums = [[n * i + j + 1 for j in range(n)] for i in range(n)] + [[n * i + j + 1 for i in range(n)] for j in range(n)]
    add(f"assignment {n}", linear(sum(cost, [])), optimum, [1 / n] * n * n,
        eq=["+".join(f"x{k}" for k in row) + "-1" for row in sums], bounds=f"{n * n}*0:")


assignment(5)
add("Kuhn's cycling LP", "-2*x1-3*x2+x3+12*x4", -2.0, "4*0",
    ge=["2*x1+9*x2-x3-9*x4", "-x1/3-x2+x3/3+2*x4", "2-2*x1-3*x2+x3+12*x4"], bounds="4*0:")
add("LP, solutions unbounded", "x1", 1.0, "5 5 5", ge=["x1-1", "x2-x3", "x1+x2-2"], bounds="3*0:")
add("LP, a line by two inequalities", "x1+2*x2", 1.0, "0.2 0.3", ge=["x1+x2-1", "1-x1-x2"], bounds="2*0:")
TANGENT = [((1, t / 20, (t / 20)**2), math.tan(t / 20)) for t in range(21)]
add("tangent from above by a parabola, LP", "x1+0.5*x2+x3/3", vertices((1, 0.5, 1 / 3), TANGENT), "0 0 0",
    ge=[f"{linear(a)}-{b!r}" for a, b in TANGENT])

# ---- Complementarity ----


def pairs(*both):
    return [row for a, b in both for row in (a, b, f"-({a})*({b})")]


add("desilva", "x1^2-2*x1+x2^2-2*x2+x3^2+x4^2", -1.0, "6*0", ge=pairs(("x5", "0.25-(x3-1)^2"), ("x6", "0.25-(x4-1)^2")),
    eq=["x3-x1+x5*(x3-1)", "x4-x2+x6*(x4-1)"], end=DEGENERATE)
MURTY = [[1 if i == j else 2 if j > i else 0 for j in range(6)] for i in range(6)]
add("Murty's linear complementarity, 6", "+".join(f"x{i + 1}*({linear(row)}-1)" for i, row in enumerate(MURTY)), 0.0,
    "6*1", ge=[f"{linear(row)}-1" for row in MURTY], bounds="6*0:")
add("complementarity as equalities of products", "(x1-1)^2+(x2-2)^2+(x3-1)^2", 2.0, "1 1 1", eq=["x1*x2", "x2*x3"],
    bounds="3*0:", others=(4.0, ), end=DEGENERATE)
add("linear complementarity of a string", "(2*x1-x2-1)*x1+(2*x2-x1-x3+1)*x2+(2*x3-x2-1)*x3", 0.0, "3*1",
    ge=["2*x1-x2-1", "2*x2-x1-x3+1", "2*x3-x2-1"], bounds="3*0:")

# ---- Robust fits, minimax ----

CUBIC = [k / 10 for k in range(-10, 11)]
add("Chebyshev, a cubic by a parabola", "x4", 0.25, "4*0",
    ge=[f"x4{sign}({t ** 3!r}-x1-({t!r})*x2-{t * t!r}*x3)" for t in CUBIC for sign in "+-"])
LINE = [(t, 1 + 0.5 * t + 0.1 * math.sin(7.0 * t) + (5.0 if t in (3, 8) else 0.0)) for t in range(10)]


def least_absolute(points):
    """The best line goes through two of the points"""
    lines = [((yb - ya) / (b - a), ya - a * (yb - ya) / (b - a))
             for (a, ya), (b, yb) in itertools.combinations(points, 2)]
    return min(sum(abs(y - slope * t - offset) for t, y in points) for slope, offset in lines)


add("least absolute deviations, a line with outliers", "+".join(f"x{k}" for k in range(3, 13)), least_absolute(LINE),
    "0 0 10*1", ge=[f"x{k}{sign}({y!r}-x1-{t}*x2)" for k, (t, y) in enumerate(LINE, 3) for sign in "+-"])
add("median of an even number", "+".join(f"x{k}" for k in range(2, 8)), 20.0, "0 6*1",
    ge=[f"x{k}{sign}(x1-{a})" for k, a in enumerate((-3, -1, 0, 2, 4, 10), 2) for sign in "+-"])


def local_minima(f, low, high, n=200000):
    """Values of the local minima of a function of one unknown"""
    x = numpy.linspace(low, high, n)
    y = f(x)
    found = []
    for k in numpy.flatnonzero((y[1:-1] < y[:-2]) & (y[1:-1] < y[2:])) + 1:
        a, b = x[k - 1], x[k + 1]
        for _ in range(100):
            c, d = a + 0.382 * (b - a), a + 0.618 * (b - a)
            a, b = (a, d) if f(c) < f(d) else (c, b)
        found.append(float(f((a + b) / 2)))
    return sorted(found)


STUDENT = (-4.0, -3.8, -3.5, 0.0, 2.9, 3.0, 3.1, 3.3)
VALUES = local_minima(lambda x: sum(numpy.log(1 + 25 * (x - a)**2) for a in STUDENT), -6, 6)
add("location by Student's distribution", total(f"log(1+25*(x1-({a!r}))^2)" for a in STUDENT), VALUES[0], "1.7",
    others=VALUES[1:])
add("Polak 1", "x3", math.e, "50 0.05 0", ge=["x3-exp(x1^2/1000+(x2-1)^2)", "x3-exp(x1^2/1000+(x2+1)^2)"])
add("minimax of three parabolas, one point in all", "x2", 1.0, "5 0",
    ge=["x2-x1^2", "x2-(x1-2)^2", "x2-0.5*(x1-1)^2-1"])

# ---- Systems of polynomials as equalities ----

add("Powell's singular system", "0", 0.0, "3 -1 0 1",
    eq=["x1+10*x2", "sqrt(5)*(x3-x4)", "(x2-2*x3)^2", "sqrt(10)*(x1-x4)^2"], end=DEGENERATE)
add("Freudenstein and Roth, equations", "0", 0.0, "15 -2", eq=["x1-13+((5-x2)*x2-2)*x2", "x1-29+((x2+1)*x2-14)*x2"])
add("Brown's almost linear equations", "0", 0.0, "6*0.5",
    eq=[f"x{i}+{'+'.join(f'x{j}' for j in range(1, 7))}-7" for i in range(1, 6)] + ["x1*x2*x3*x4*x5*x6-1"])
KATSURA = [
    f"{'+'.join(f'x{abs(l) + 1}*x{abs(m - l) + 1}' for l in range(-3, 4) if abs(m - l) <= 3)}-x{m + 1}"
    for m in range(3)
]
add("Katsura 3", "0", 0.0, "0.8 0.1 0.1 0.1", eq=[*KATSURA, "x1+2*x2+2*x3+2*x4-1"])
add("cyclic 3 has no real root", "0", 0.0, "1 0.5 -1", eq=["x1+x2+x3", "x1*x2+x2*x3+x3*x1", "x1*x2*x3-1"],
    end=INFEASIBLE)


def chandrasekhar(n, c):
    """The H-equation at the middle of n intervals"""
    t = [(i + 0.5) / n for i in range(n)]
    add(
        f"Chandrasekhar's H-equation {n}", "0", 0.0, [1.0] * n, eq=[
            f"x{i + 1}*(1-{total(f'{c / 2 / n * t[i] / (t[i] + t[j])!r}*x{j + 1}' for j in range(n))})-1"
            for i in range(n)
        ])


chandrasekhar(8, 0.9)

# ---- Discretized control of ordinary differential equations, paths ----


def time_optimal(n):
    """From rest at 0 to rest at 1 with a force between -1 and 1, constant in each of n (even) steps of the same length,
    unknown x1: in time 2"""
    p, v, u = (["0"] + [f"x{1 + k * n + i}" for i in range(1, n + 1)] for k in range(3))
    rows = [
        row for i in range(1, n + 1)
        for row in (f"{p[i]}-{p[i - 1]}-x1*{v[i - 1]}-0.5*x1^2*{u[i]}", f"{v[i]}-{v[i - 1]}-x1*{u[i]}")
    ]
    add(f"time optimal {n}", f"{n}*x1", 2.0, [1 / n] + [i / n for i in range(1, n + 1)] + [0.5] * n + [0.0] * n,
        eq=[*rows, f"{p[n]}-1", v[n]], bounds=f"0.001: {2 * n}*: {n}*-1:1")


time_optimal(6)
time_optimal(12)


def quadratic_control(n):
    """x' = x + u from 1, by Euler's rule, least sum of squares: by the normal equations of the reduced problem"""
    h = 1 / n
    state = numpy.array([[h * (1 + h)**(i - j) if j <= i else 0.0 for j in range(n)] for i in range(n)])
    free = numpy.array([(1 + h)**(i + 1) for i in range(n)])
    u = numpy.linalg.solve(h * state.T @ state + h * numpy.eye(n), -h * state.T @ free)
    x = state @ u + free
    add(f"linear quadratic control {n}", total(f"{h!r}*(x{i}^2+x{n + i}^2)" for i in range(1, n + 1)),
        float(h * (x @ x + u @ u)), [0.0] * (2 * n),
        eq=[f"x{i}-{1 + h!r}*{f'x{i - 1}' if i > 1 else '1'}-{h!r}*x{n + i}" for i in range(1, n + 1)])


quadratic_control(20)


def refraction(speeds, width):
    """The quickest way through layers of height 1: sines of the angles in proportion to the speeds (Snell)"""
    low, high = 0.0, 1 / max(speeds)
    for _ in range(200):
        k = (low + high) / 2
        low, high = (k, high) if sum(k * s / math.sqrt(1 - (k * s)**2) for s in speeds) < width else (low, k)
    n, optimum = len(speeds), sum(1 / s / math.sqrt(1 - (k * s)**2) for s in speeds)
    add(f"refraction in {n} layers", total(f"sqrt(x{i}^2+1)/{s!r}" for i, s in enumerate(speeds, 1)), optimum,
        [0.0] * n, eq=["+".join(f"x{i}" for i in range(1, n + 1)) + f"-{width}"])


refraction([1 + 0.5 * k for k in range(10)], 12)

# ---- Eigenvalues, trust regions, frames ----

LAPLACE = "+".join(f"2*x{i}^2" + (f"-2*x{i}*x{i + 1}" if i < 8 else "") for i in range(1, 9))
SPHERE = "+".join(f"x{i}^2" for i in range(1, 9)) + "-1"
add("least eigenvalue", LAPLACE, 2 - 2 * math.cos(math.pi / 9), [0.9, -0.3, 0.5, 0.1, -0.4, 0.2, 0.3, -0.2],
    eq=[SPHERE])
add("largest eigenvalue in the ball", f"-({LAPLACE})", -(2 + 2 * math.cos(math.pi / 9)),
    "0.1 0.1 0.1 0.1 -0.1 0.2 0.1 0.05", ge=[f"-({SPHERE})"])
add("eigenvalue twice", "x1^2+x2^2+3*x3^2", 1.0, "1 2 3", eq=["x1^2+x2^2+x3^2-1"])
add("trust region, the hard case", "-x1^2-0.5*x2^2+0.5*x3^2+0.3*x2+0.3*x3", -1.06, "0.1 0 0", ge=["1-x1^2-x2^2-x3^2"])
add("frame of two least eigenvectors", total(f"{i}*x{i}^2+{i}*x{4 + i}^2" for i in range(1, 5)), 3.0,
    "1 0.5 0.2 0.3 -0.2 1 0.3 0.4", eq=["x1^2+x2^2+x3^2+x4^2-1", "x5^2+x6^2+x7^2+x8^2-1", "x1*x5+x2*x6+x3*x7+x4*x8"])

# ---- Domains: logarithms and roots that are no number beyond them ----

add("logarithm, start outside of the bounds", "x1-log(x1)", 1.0, "-5", bounds="0:")
add("row that ends at a logarithm", "x1^2", math.exp(-2), "5", ge=["log(x1)+1"])
add("start without a value", "x1-log(x1)", 1.0, "-5", end=DEGENERATE)
add("entropy from a corner", total(f"x{i}*log(x{i})" for i in range(1, 6)), -math.log(5), "1 4*0",
    eq=["x1+x2+x3+x4+x5-1"], bounds="5*0:")
add("analytic centre of a triangle from its edge", "-log(x1)-log(x2)-log(1-x1-x2)", 3 * math.log(3), "1e-9 0.5")
add("root at its branch point", "x2-sqrt(x1)", -0.25, "0 0", ge=["x2-x1"], bounds="0: :")
add("posynomial, Duffin", "40/(x1*x2*x3)+40*x2*x3", 60.0, "1 1 1", ge=["1-0.5*x1*x3-0.25*x1*x2"], bounds="3*0:")

# ---- Fixed unknowns, far bounds, units ----

add("all but one fixed", "x3^2", 9.0, "0 0 0", eq=["x1+x2+x3-6"], bounds="1:1 2:2 :")
add("row of fixed unknowns, met", "(x3-1)^2", 0.0, "0 0 5", eq=["x1+x2-3"], bounds="1:1 2:2 :")
add("row of fixed unknowns, not met", "(x3-1)^2", 0.0, "0 0 5", eq=["x1+x2-4"], bounds="1:1 2:2 :", end=INFEASIBLE)
add("box of 1e-9", "(x1-3)^2+x2", 4.0, "1 1", ge=["x2-x1+1"], bounds="0.999999999:1.000000001 0:")
add("bounds of 1e12 and 1e15", "(x1-3)^2+(x2+2)^2+x1*x2", -37 / 3, "0 0", bounds="-1e12:1e12 -1e15:")
add("product of 1e6 and 1e-6", "1e-6*x1+1e6*x2", 2.0, "1 1", ge=["x1*x2-1"], bounds="2*0:")
add(
    "spring", "(x3+2)*x2*x1^2", 0.012665233, "0.1 0.5 10", bounds="0.05:2 0.25:1.3 2:15", ge=[
        "x2^3*x3/(71785*x1^4)-1", "1-(4*x2^2-x1*x2)/(12566*(x2*x1^3-x1^4))-1/(5108*x1^2)", "140.45*x1/(x2^2*x3)-1",
        "1.5-x1-x2"
    ])
add("three-bar truss", "100*(2*sqrt(2)*x1+x2)", 263.8958434, "0.5 0.5", bounds="2*1e-6:1",
    ge=["2-2*(sqrt(2)*x1+x2)/(sqrt(2)*x1^2+2*x1*x2)", "2-2*x2/(sqrt(2)*x1^2+2*x1*x2)", "2-2/(x1+sqrt(2)*x2)"])
add(
    "speed reducer",
    "0.7854*x1*x2^2*(3.3333*x3^2+14.9334*x3-43.0934)-1.508*x1*(x6^2+x7^2)+7.4777*(x6^3+x7^3)+0.7854*(x4*x6^2+x5*x7^2)",
    2994.471066, "3 0.75 20 8 8 3.5 5.2", bounds="2.6:3.6 0.7:0.8 17:28 7.3:8.3 7.3:8.3 2.9:3.9 5:5.5", ge=[
        "1-27/(x1*x2^2*x3)", "1-397.5/(x1*x2^2*x3^2)", "1-1.93*x4^3/(x2*x3*x6^4)", "1-1.93*x5^3/(x2*x3*x7^4)",
        "1-sqrt((745*x4/(x2*x3))^2+1.69e7)/(110*x6^3)", "1-sqrt((745*x5/(x2*x3))^2+1.575e8)/(85*x7^3)", "1-x2*x3/40",
        "1-5*x2/x1", "1-x1/(12*x2)", "1-(1.5*x6+1.9)/x4", "1-(1.1*x7+1.9)/x5"
    ])

# ---- Nonconvex with equalities; cones ----

add("Haverly's pooling", "6*x1+16*x2+10*x5+10*x6-9*(x3+x5)-15*(x4+x6)", -400.0, "50 50 50 50 50 50 2",
    bounds="6*0: 1:3", others=(-100.0, 0.0),
    ge=["100-x3-x5", "200-x4-x6", "2.5*(x3+x5)-x7*x3-2*x5",
        "1.5*(x4+x6)-x7*x4-2*x6"], eq=["x1+x2-x3-x4", "3*x1+x2-x7*(x3+x4)"])
add("three points apart in a square", "-x7", -(math.sqrt(6) - math.sqrt(2)), "0.1 0.2 0.8 0.1 0.4 0.9 0.3",
    ge=[f"({'+'.join(f'(x{2 * i + k}-x{2 * j + k})^2' for k in (1, 2))})-x7^2" for i in range(3) for j in range(i)],
    bounds="6*0:1 0:")
CENTRES = ((0, 0), (1, 0.1), (-1, 0.1))
add("Fermat's point at a corner, cones", "x3+x4+x5", 2 * math.sqrt(1.01), "0.3 0.3 2 2 2",
    ge=[f"x{k}^2-(x1-{a})^2-(x2-{b})^2".replace("--1", "+1") for k, (a, b) in enumerate(CENTRES, 3)], bounds=": : 3*0:",
    end=DEGENERATE)
add("sum at a product of one", "x1+x2+x3+x4", 4.0, "4*3", eq=["x1*x2*x3*x4-1"], bounds="4*0:")
add("two spheres and a plane", "x3", -math.sqrt(1 - 0.25 - 0.0625), "0.4 0.1 0.5",
    eq=["x1^2+x2^2+x3^2-1", "(x1-1)^2+x2^2+x3^2-1", "x2-0.25"], others=(math.sqrt(0.6875), ))
add(
    "dixmaan", "1+" +
    total([f"x{i}^2" for i in range(1, 13)] + [f"0.125*x{i}^2*x{i + 4}^4"
                                               for i in range(1, 9)] + [f"0.125*x{i}*x{i + 8}" for i in range(1, 5)]),
    1.0, "12*2")

# ---- Infeasible ----

add("square of 1 more", "x1+x2", 0.0, "1 1", eq=["x1^2+x2^2+1"], end=INFEASIBLE)
add("exponential below a half", "x1", 0.0, "1", ge=["0.5-exp(x1)"], bounds="0:", end=INFEASIBLE)
add("cycle of differences", "x1^2+x2^2+x3^2", 0.0, "0 0 0", ge=["x1-x2-1", "x2-x3-1", "x3-x1-1"], end=INFEASIBLE)
add("hyperbola beyond a box", "x1+x2", 0.0, "0.5 0.5", ge=["x1*x2-2"], bounds="2*0:1", end=INFEASIBLE)
add("ten sums", linear([1.0] * 10), 0.0, "10*0",
    ge=[f"x{i}+x{i % 10 + 1}-1" for i in range(1, 11)] + ["4-" + "-".join(f"x{i}" for i in range(1, 11))],
    end=INFEASIBLE)

# ---- Unbounded, or a value that is not attained ----

add("quadratic, free along a line", "(x1-x2)^2-x1", 0.0, "1 0", ge=["x1+x2"], end=UNBOUNDED)
add("product over a quadrant", "-x1*x2", 0.0, "1 1", ge=["x1-x2+1", "x2-x1+1"], bounds="2*0:", end=UNBOUNDED)
add("value not attained, exponential", "exp(-x1)", 0.0, "0")
add("value not attained, hyperbola", "1/x1", 0.0, "1", bounds="1:")

# ---- Homogeneous equalities from zero, and starts beside which any violation is small ----

add("currents at two nodes, from zero", "(x1-1)^2+x2^4+2*x2^2+x3^2+(x4-0.3)^4+x4^2", 0.5035887906424, "4*0",
    eq=["x1-x2-x3", "x3-x4"])
add("currents in a loop, cubic, from zero", "x1^2*sqrt(x1^2+1e-4)+2*x2^2*sqrt(x2^2+1e-4)+x3^2-4*x3", -2.711952908477,
    "3*0", eq=["x1+x2-x3", "3*x1-3*x2+x2^3-x1^3"])
add("linear dynamics, from zero", "exp(x1)-3*x1+0.01*x2^2+(x3-1)^2+0.01*x4^2", -0.2837654916053, "4*0",
    eq=["x1-x2", "x3-x1-x4"], bounds=": -2:2 : -2:2")
add("circle and hyperbola, from afar", "0", 0.0, "1e4 1e-2", eq=["x1^2+x2^2-1e4", "x1*x2-3e3"])
add("cubic equation, from afar", "0", 0.0, "1e6 -1e6", eq=["x1+x2^3*1e-3-48", "x1-x2"])
