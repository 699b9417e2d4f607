"""Nonlinear programs for tests/stress/nlp.py that are degenerate, badly scaled, or begin where they should not: fixed
and free unknowns, dependent rows, constraints without multipliers, systems of equations, feasibility problems,
infeasible and unbounded ones, regions without a value. Formulas, bounds and optima as in nlp_problems.py. All optima
are in closed form."""
import math

from nlp_problems import DEGENERATE, INFEASIBLE, UNBOUNDED, Problem, total

DEGENERATES = []


def add(name, objective, optimum, start, **rest):
    DEGENERATES.append(Problem(name, objective, optimum, start, **rest))


# ---- Dependent rows, LICQ and MFCQ fail ----

add("three rows meet in the plane", "(x1-2)^2+(x2-2)^2", 2.0, "0 0", ge=["1-x1", "1-x2", "2-x1-x2"])
add("equality three times, scaled", "x1^2+2*x2^2", 2 / 3, "5 -3", eq=["x1+x2-1", "1e3*(x1+x2-1)", "1e-3*(x1+x2-1)"])
add("sum of two equalities", "x1^2+x2^2+x3^2", 0.5 + 1.0, "3 3 3", eq=["x1+x2-1", "x3-1", "x1+x2+x3-2"])
add("equality and its square", "x1^2+x2^2", 0.5, "2 3", eq=["x1+x2-1", "(x1+x2-1)^2"], end=DEGENERATE)
add("equality between inequalities", "x1^2+x2^2", 0.5, "2 3", ge=["x1+x2-1", "1-x1-x2"], eq=["x1+x2-1"])
add("product of two rows", "x1+x2", 0.0, "2 3", ge=["x1*x2", "x1", "x2"])
add("cusp turned", "-x1", -1.0, "0.2 0.2", ge=["(1-x1)^3-x2", "x2"], end=DEGENERATE)
add("discs that touch outside", "x2", 0.0, "0.5 0.5", ge=["1-(x1-1)^2-x2^2", "1-(x1+1)^2-x2^2"], end=DEGENERATE)
add("line that touches a disc", "x1+x2", 1.0, "0 0", ge=["1-x1^2-x2^2"], eq=["x2-1"], end=DEGENERATE)
add("plane that touches a ball, linear objective", "x1+2*x2+3*x3", 3.0, "0.1 0.2 0.3", ge=["1-x1^2-x2^2-x3^2", "x3-1"],
    end=DEGENERATE)
add("sphere and its tangent plane", "(x1-1)^2+x2^2+(x3-1)^2", 1.0, "0.3 0.4 0.5", eq=["x1^2+x2^2+x3^2-1", "x3-1"],
    end=DEGENERATE)
add("vertex of six rows", "-x1-x2-x3", -1.0, "0 0 0",
    ge=["1-x1-x2-x3", "1-x1-x2", "1-x1", "1-x2", "1-x3", "2-x1-2*x2-x3", "x1", "x2", "x3"])
add("weakly active row", "(x1-1)^2+(x2-1)^2", 0.0, "5 -5", ge=["2-x1-x2"])
add("weakly active bounds", "x1^2+x2^4+(x3-1)^2", 0.0, "3 3 3", bounds="0: 0: 1:")
add("bound twice, as a row as well", "(x1+1)^2+(x2+1)^2", 2.0, "4 4", ge=["x1", "x2", "2*x1", "x1+x2"], bounds="2*0:")
add("multipliers not unique, curved", "x2+x1^2", 0.0, "1 1", ge=["x2-x1^2", "x2-2*x1^2", "x2-3*x1^2", "x2"])
add("cubic inequalities at their flat point", "x1+x2", 0.0, "1 1", ge=["x1^3", "x2^3"], end=DEGENERATE)
add("parabola from both sides", "x1", 0.0, "1 1", ge=["x2-x1^2", "x1^2-x2"], eq=["x2"], end=DEGENERATE)

# ---- Equal bounds, free rows, starts on bounds and outside ----

add("all fixed but a product", "x1*x2*x3", -6.0, "9 9 9", bounds="1:1 2:2 -3:4")
add("all fixed", "x1^2+x2", 3.0, "0 0", bounds="1:1 2:2")
add("all fixed, row met", "x1^2+x2", 3.0, "7 7", ge=["3-x1-x2"], bounds="1:1 2:2")
add("fixed at zero", "(x1-1)^2+(x2-1)^2", 1.0, "0 0", eq=["x1*x2"], bounds="0:0 :")
add("fixed at 1e8", "(x1*1e-8-x2)^2+x2", 0.75, "0 0", bounds="1e8:1e8 :")
add("bounds 1e-12 apart", "x1^2+(x2-3)^2", 1.0, "4 4", bounds="1:1.000000000001 :3")
add("start on lower bounds", "(x1-2)^2+(x2-3)^2", 0.0, "0 0", bounds="2*0:5")
add("start on upper bounds", "x1^2+x2^2+x1*x2", 0.0, "5 5", bounds="2*-5:5")
add("start outside of all bounds", "(x1-0.5)^2+(x2-2)^2", 1.0, "100 -100", bounds="2*0:1")
add("start on a corner, saddle", "x1*x2", -1.0, "-1 -1", bounds="2*-1:1")
add("start on the row", "(x1-1)^2+(x2-1)^2", 0.5, "0.5 0.5", ge=["1-x1-x2"])
add("start where a gradient vanishes", "x1", -1.0, "0 0", eq=["x1^2+x2^2-1"], others=(1.0, ))
add("rows that are constant", "(x1-1)^2+x2^2", 0.0, "3 3", ge=["1+0*x1", "2+0*x2"])
add("row without an unknown, not met", "(x1-1)^2", 0.0, "3", ge=["0*x1-1"], end=INFEASIBLE)
add("no objective, no rows", "0*x1", 0.0, "3", bounds="0:")

# ---- Units from 1e-8 to 1e8 ----

add("quadratic, curvatures 1e-8 and 1e8", "1e-8*(x1-1)^2+1e8*(x2-1)^2", 0.0, "5 5")
add("row in 1e8", "x1^2+x2^2", 0.5, "3 4", eq=["1e8*(x1+x2-1)"])
add("row in 1e-8", "x1^2+x2^2", 0.5, "3 4", eq=["1e-8*(x1+x2-1)"])
add("rows in 1e-8 and 1e8", "x1^2+x2^2+x3^2", 1.5, "3 4 5", ge=["1e-8*(x1+x2-1)"], eq=["1e8*(x3-1)"])
add("unknowns in 1e-8 and 1e8", "(1e8*x1-1)^2+(1e-8*x2-1)^2+1e8*x1*1e-8*x2", 2.0 / 3.0, "0 0")
add("sum of unknowns in 1e-6 and 1e6", "1e6*x1+1e-6*x2", 2e-0, "1e-6 1e6", ge=["x1*x2-1"], bounds="2*0:")
add("objective in 1e8, disc", "1e8*(x1+x2)", -1e8 * math.sqrt(2), "0 0", ge=["1-x1^2-x2^2"])
add("objective in 1e-8, disc", "1e-8*(x1+x2)", -1e-8 * math.sqrt(2), "0 0", ge=["1-x1^2-x2^2"])
add("disc of radius 1e-4", "x1+x2", -1e-4 * math.sqrt(2), "0 0", ge=["1e-8-x1^2-x2^2"])
add("disc of radius 1e4", "x1+x2", -1e4 * math.sqrt(2), "0 0", ge=["1e8-x1^2-x2^2"])
add("disc of radius 1e4, from 1e6", "x1+x2", -1e4 * math.sqrt(2), "1e6 -1e6", ge=["1e8-x1^2-x2^2"])
add("rosenbrock in 1e4", "100*(1e-4*x2-1e-8*x1^2)^2+(1-1e-4*x1)^2", 0.0, "-12000 10000")

# ---- Systems of equations, feasibility ----

add("circle and line", "0", 0.0, "10 -3", eq=["x1^2+x2^2-25", "x1-x2-1"])
add("circle and line that touch", "0", 0.0, "3 3", eq=["x1^2+x2^2-2", "x1+x2-2"], end=DEGENERATE)
add("circle and line apart", "0", 0.0, "3 3", eq=["x1^2+x2^2-1", "x1+x2-3"], end=INFEASIBLE)
add("exponential system", "0", 0.0, "2 2", eq=["exp(x1)-x2-1", "x1+x2"])
add("trigonometric system", "0", 0.0, "0.5 0.5", eq=["sin(x1)-0.5*x2", "cos(x2)-x1-0.2"])
add("more equations than unknowns, consistent", "0", 0.0, "3 3", eq=["x1-1", "x2-2", "x1+x2-3", "x1*x2-2"])
add("more equations than unknowns, not consistent", "0", 0.0, "3 3", eq=["x1-1", "x2-2", "x1+x2-4"], end=INFEASIBLE)
add("double root", "0", 0.0, "5", eq=["(x1-2)^2"], end=DEGENERATE)
add("cubic with one real root", "0", 0.0, "-3", eq=["x1^3-2*x1-5"])
add("point of a box in a shell", "0", 0.0, "0 0 0", ge=["x1^2+x2^2+x3^2-2", "3-x1^2-x2^2-x3^2"], bounds="3*-1:1.5")
add("point of a ring from its centre", "0", 0.0, "0 0", ge=["x1^2+x2^2-1", "4-x1^2-x2^2"])
add("quadratic system in ten unknowns", "0", 0.0, "10*2", eq=[f"x{i}^2+0.1*x{i % 10 + 1}-1.1" for i in range(1, 11)])
add(
    "Broyden's tridiagonal equations", "0", 0.0, "8*-1", eq=[
        f"(3-2*x{i})*x{i}" + (f"-x{i - 1}" if i > 1 else "") + (f"-2*x{i + 1}" if i < 8 else "") + "+1"
        for i in range(1, 9)
    ])
add("product system from afar", "0", 0.0, "1e3 1e3", eq=["x1*x2-1", "x1-4*x2"])

# ---- Infeasible ----

add("bounds and row apart", "x1^2", 0.0, "0 0", ge=["x1+x2-5"], bounds="2*0:2", end=INFEASIBLE)
add("ball outside of a half space", "x1", 0.0, "0 0 0", ge=["1-x1^2-x2^2-x3^2", "x1+x2+x3-3"], end=INFEASIBLE)
add("parabolas apart", "x1^2+x2^2", 0.0, "2 0", ge=["x2-x1^2-1", "-x1^2-x2"], end=INFEASIBLE)
add("equalities apart by 1e-3", "x1^2", 0.0, "0 0", eq=["x1+x2-1", "x1+x2-1.001"], end=INFEASIBLE)
add("logarithm too small", "x1", 0.0, "1", ge=["log(x1)-5", "100-x1"], bounds=":", end=INFEASIBLE)

# ---- Unbounded, values that are not attained ----

add("linear along a ray", "-x1-x2", 0.0, "0 0", ge=["1-x1+x2", "1+x1-x2"], end=UNBOUNDED)
add("concave in a cone", "-x1^2", 0.0, "1 0", ge=["x1-x2", "x1+x2"], end=UNBOUNDED)
add("cubic in a half plane", "x1^3+x2^2", 0.0, "-1 1", ge=["-x1"], end=UNBOUNDED)
add("below a cubic", "-x1-x2", 0.0, "1 0", ge=["x1^3-x2"], end=UNBOUNDED)

# ---- Regions without a value ----

add("logarithm of a product", "-log(x1*x2)", 0.0, "0.5 0.5", ge=["2-x1-x2"], bounds="2*1e-9:")
add("root of a difference", "x1+x2", 0.0, "3 1", ge=["sqrt(x1-x2)"], bounds="2*0:")
add("logarithmic barrier of a disc", "x1-0.01*log(1-x1^2-x2^2)",
    -(math.sqrt(1.0001) - 0.01) - 0.01 * math.log(1 - (math.sqrt(1.0001) - 0.01)**2), "0.1 0.1")
add("quotient with a pole between start and solution", "(x1-3)^2", 1.002001, "0.5", ge=["1/(2-x1)-1"], bounds=":1.999")
add("x log x from a bound", total(f"x{i}*log(x{i})" for i in (1, 2, 3)), -math.log(3), "1e-9 1e-9 1", bounds="3*1e-12:",
    eq=["x1+x2+x3-1"])
add("power with a fraction", "x1^1.5-3*x1", -4.0, "1", bounds="0:")

# ---- Nonconvex ----

add("concave in a box", "-(x1-0.1)^2-(x2-0.2)^2", -1.21 - 1.44, "0.1 0.2", bounds="2*-1:1",
    others=(-1.21 - 0.64, -0.81 - 1.44, -0.81 - 0.64))
add("monkey saddle in a disc", "x1^3-3*x1*x2^2", -1.0, "0.1 0.05", ge=["1-x1^2-x2^2"])
add("sphere, product", "x1*x2*x3", -1 / math.sqrt(27), "0.5 0.6 -0.6", eq=["x1^2+x2^2+x3^2-1"], others=(0.0, ))
add("farthest point of an ellipse", "-(x1-1)^2-x2^2", -9.0, "0 1", ge=["1-x1^2/4-x2^2"])
add("quartic in two wells, tilted", "(x1^2-1)^2+x2^2", 0.0, "0 0.5")
add("hyperbola, nearest point", "x1^2+x2^2", 2.0, "3 -1", eq=["x1*x2-1"])
