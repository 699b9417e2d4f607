"""A third set of nonlinear programs for tests/stress/nlp.py: small ones, most with solutions in closed form. They were
written after the other two sets were solved, and are chosen by what makes a program difficult, not by what a solver
does.
"""
import math

from nlp_problems import DEGENERATE, INFEASIBLE, UNBOUNDED, Problem, linear, total

TEXTBOOK = []


def add(name, objective, optimum, start, **rest):
    TEXTBOOK.append(Problem(name, objective, optimum, start, **rest))


def root(function, low, high):
    """Of a function that rises from low to high"""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return low


# ---- Equalities ----

add("nearest point of a paraboloid", "(x1-3)^2+x2^2+x3^2", 5.0, "0.5 1 1", eq=["x3-x1^2-x2^2"])
add("entropy of a die", total(f"x{i}*log(x{i})" for i in range(1, 7)), -math.log(6), "0.3 0.1 0.1 0.1 0.1 0.3",
    eq=[linear([1.0] * 6) + "-1", linear([1.0, 2, 3, 4, 5, 6]) + "-3.5"], bounds="6*0:")
add("box in an ellipsoid", "-x1*x2*x3", -2 / math.sqrt(3), "3*1", eq=["x1^2/4+x2^2+x3^2/9-1"], bounds="3*0:")
add("sum of squares at a product of 8", "x1^2+x2^2+x3^2", 12.0, "1 2 3", eq=["x1*x2*x3-8"])
TRIDIAGONAL = "+".join([f"2*x{i}^2" for i in range(1, 7)] + [f"(-2)*x{i}*x{i + 1}" for i in range(1, 6)])
SPHERE = "+".join(f"x{i}^2" for i in range(1, 7)) + "-1"
add("lowest eigenvalue", TRIDIAGONAL, 2 - 2 * math.cos(math.pi / 7), "6*1", eq=[SPHERE])
add("highest eigenvalue", f"-({TRIDIAGONAL})", -2 - 2 * math.cos(math.pi / 7), "1 0.1 0 0 0 0", eq=[SPHERE])
add("sphere in units of 1e8", "x1+2*x2", -math.sqrt(5), "1 1", eq=["1e8*(x1^2+x2^2-1)"])

# ---- Inequalities ----

add("sum in two discs", "-x1-x2", -math.sqrt(2), "0.5 0", ge=["1-x1^2-x2^2", "1-(x1-1)^2-x2^2"])
add("distance to a disc and a line", "(x1-3)^2+(x2-2)^2", 2.0, "0 0", ge=["5-x1^2-x2^2", "4-x1-2*x2"], bounds="2*0:")
add("projection on a cone", "(x1-1)^2+(x2-2)^2+x3^2", 2.5, "0 0 1", ge=["x3^2-x1^2-x2^2"], bounds=": : 0:")
add("circle around a triangle", "x3", 6.25, "0 0 0", ge=["x3-x1^2-x2^2", "x3-(x1-4)^2-x2^2", "x3-x1^2-(x2-3)^2"])
add("circle in a triangle", "-x3", -1.0, "0 0 0", ge=["x1-x3", "x2-x3", "(12-3*x1-4*x2)/5-x3"])
add("reciprocal product", "1/(x1*x2)", 1.0, "0.1 1.5", ge=["2-x1-x2"], bounds="2*0:")
add("two roots in a simplex", "-sqrt(x1)-sqrt(x2)", -math.sqrt(2), "0.9 0.05", ge=["1-x1-x2"], bounds="2*0:")

# ---- Rows with two sides ----

add("ring", "x1+x2", -2 * math.sqrt(2), "1 0.1", ge=["x1^2+x2^2-1", "4-x1^2-x2^2"])
add("two sides that meet", "x1^2+x2^2", 2.0, "5 -1", ge=["x1+x2-2", "2-x1-x2"])
WAVE = [
    math.sin(x) + x * x / 10 - 1
    for x in (-root(lambda x: x / 5 - math.cos(x), 0, 3), root(lambda x: x / 5 + math.cos(x), 3, 5))
]
add("between two waves", "x1^2/10-x2", WAVE[0], "0 0", ge=["x2+sin(x1)+1", "1-x2-sin(x1)"], others=WAVE[1:])
add("row of 1e-6 between sides", "(x1-1)^2+(x2-1)^2", 0.5, "0 0", ge=["1e-6*(x1+x2)+1e-6", "1e-6-1e-6*(x1+x2)"])

# ---- Bounds ----

add("corners of a square", "-x1^2-x2^2+x1*x2", -7.0, "0.3 -0.1", bounds="2*-1:2", others=(-4.0, -1.0))
INTERVAL = root(lambda x: -1 / x + 1 / (1 - x) + 10, 1e-9, 0.5)
add("logarithms of an interval", "-log(x1)-log(1-x1)+10*x1",
    -math.log(INTERVAL) - math.log(1 - INTERVAL) + 10 * INTERVAL, "0.999", bounds="0:1")
add("bounds without force", "x1^2+x2^4", 0.0, "1 1", bounds="2*0:")

# ---- Multipliers that are not unique; rows that are redundant ----

add("row and its double", "x1^2+2*x2^2", 2 / 3, "0 0", eq=["x1+x2-1", "2*x1+2*x2-2"])
add("circle and its double", "x1", -1.0, "0.5 0.5", eq=["x1^2+x2^2-1", "2*x1^2+2*x2^2-2"])
add("three rows at a corner", "-x1-x2", -2.0, "0 0", ge=["1-x1", "1-x2", "2-x1-x2"])
add("three rows at a tip", "-x1", -1.0, "0 0", ge=["1-x1-x2", "1-x1+x2", "1-x1"])
add("parabolas that touch", "x2", 0.0, "1 1", eq=["x2-x1^2", "x2+x1^2"])
COSTS = (8, 6, 10, 9, 12, 13)
add("transport", linear(COSTS), 465.0, "6*1", bounds="6*0:",
    eq=["x1+x2+x3-20", "x4+x5+x6-30", "x1+x4-10", "x2+x5-25", "x3+x6-15"])
add(
    "assignment", linear((4, 1, 3, 2, 0, 5, 3, 2, 2)), 5.0, "9*0.5", bounds="9*0:",
    eq=[f"x{3 * i + 1}+x{3 * i + 2}+x{3 * i + 3}-1" for i in range(3)] +
    [f"x{i}+x{i + 3}+x{i + 6}-1" for i in (1, 2, 3)])

# ---- No interior, or no multipliers ----

add("cusp, cubic", "x1", 0.0, "1 0.5", ge=["x1^3-x2"], bounds=": 0:", end=DEGENERATE)
add("discs that touch", "x2+x1", 0.0, "0.5 0.5", ge=["1-x1^2-(x2-1)^2", "1-x1^2-(x2+1)^2"], end=DEGENERATE)
add("square below zero", "(x1-1)^2+x2", 1.0, "1 1", ge=["-x1^2"], bounds=": 0:", end=DEGENERATE)
add("point as an equality", "x1", 0.0, "1 1", eq=["x1^2+x2^2"], end=DEGENERATE)

# ---- Units ----

add("lengths of 1e-4 and 1e4", "(1e4*x1-1)^2+(1e-4*x2-1)^2", 0.0, "1 1", ge=["x1*x2-1"], bounds="2*0:")
add("weights of 1e6 and 1e-6", "1e6*(x1-1)^2+1e-6*(x2-1)^2", 1e-6 * (1 - 1e-6)**2, "0 0", ge=["1e-3*x1+1e3*x2-2000"])
add("point 1e6 away", "(x1-1e6)^2+(x2-2e6)^2", 5e11, "0 0", ge=["2e6-x1-x2"])

# ---- Infeasible ----

add("disc and a far half plane", "x1", 0.0, "0 0", ge=["1-x1^2-x2^2", "x1+x2-3"], end=INFEASIBLE)
add("cosh of one half", "x1^2+x2", 0.0, "1 0", eq=["exp(x1)+exp(-x1)-1", "x2-x1"], end=INFEASIBLE)
add("sum beyond a box", "x1", 0.0, "2*0", eq=["x1+x2-5"], bounds="2*0:1", end=INFEASIBLE)
add("two products", "x1^2+x2^2", 0.0, "1 1", eq=["x1*x2-1", "x1*x2-2"], end=INFEASIBLE)
add("square of minus one", "0", 0.0, "1", eq=["x1^2+1"], end=INFEASIBLE)

# ---- Unbounded ----

add("saddle above a half plane", "-x1^2+x2", 0.0, "1 1", bounds=": 0:", end=UNBOUNDED)
add("below a parabola", "x1-x2", 0.0, "0 0", ge=["x1^2-x2"], end=UNBOUNDED)
add("strip", "-x1-x2", 0.0, "0 0", ge=["1-x1+x2", "1-x2+x1"], end=UNBOUNDED)

# ---- No constraints ----

add("Booth", "(x1+2*x2-7)^2+(2*x1+x2-5)^2", 0.0, "10 -10")
add("Matyas", "0.26*(x1^2+x2^2)-0.48*x1*x2", 0.0, "10 -7")
add("McCormick", "sin(x1+x2)+(x1-x2)^2-1.5*x1+2.5*x2+1", -math.sqrt(3) / 2 - math.pi / 3, "0 0", bounds="-1.5:4 -3:4")
LOW, HIGH = ((x**4 - 16 * x**2 + 5 * x) / 2
             for x in (root(lambda x: 4 * x**3 - 32 * x + 5, *sides) for sides in ((-4, -2), (2, 4))))
add("Styblinski and Tang", total(f"(x{i}^4-16*x{i}^2+5*x{i})/2" for i in range(1, 4)), 3 * LOW, "3*-1",
    others=(2 * LOW + HIGH, LOW + 2 * HIGH, 3 * HIGH))
ONE_LOG = (1 + math.sqrt(3)) / 2
add("logarithm without a bound", "x1^2-log(x1-1)", ONE_LOG**2 - math.log(ONE_LOG - 1), "10")

# ---- Fixed unknowns ----

add("product with a fixed unknown", "x2^2+x3^2", 5.0, "0 0 0", eq=["x1*x2+x3-5"], bounds="2:2 : :")
add("all fixed", "x1^2+x2^2", 5.0, "0 0", ge=["4-x1-x2"], bounds="1:1 2:2")
add("all fixed, row not met", "x1^2+x2^2", 0.0, "0 0", ge=["2-x1-x2"], bounds="1:1 2:2", end=INFEASIBLE)

# ---- Not convex; complementarity ----

add("product in a disc", "x1*x2", -0.5, "0.1 0.2", ge=["1-x1^2-x2^2"])
add("product at most zero", "(x1-1)^2+(x2-1)^2", 1.0, "0.5 0.2", ge=["-x1*x2"], bounds="2*0:")
add("product zero", "x1^2+x2^2-4*x1*x2", 0.0, "1 1", eq=["x1*x2"], bounds="2*0:")
add("two levels", "(x1+1)^2+(x2-1)^2", 1.0, "0.5 0.5 0.1", eq=["x2-x1-x3"], ge=["-x3*x2"], bounds=": 0: 0:",
    others=(2.0, ))

# ---- Objective zero ----

add("circle and hyperbola", "0", 0.0, "1 2", eq=["x1^2+x2^2-25", "x1*x2-12"])
add("lens", "0", 0.0, "-3 4", ge=["1-x1^2-x2^2", "1-(x1-1.9)^2-x2^2"])
add("double root", "0", 0.0, "1 5", eq=["x1-x2", "(x1-2)^2"])
