"""Nonlinear programs whose solutions are known, for tests/stress/nlp.py; those of tests/tao_ipfilter/ipfilter_nlp.h
come beside them.

Formulas in x1, x2, ...: those that tests/tao_ipfilter/ipfilter_expression.h reads. Bounds: one "lower:upper" a
variable, either may be missing; 3*0: is 0: 0: 0:.
optimum: from the literature, or in closed form; others: values of local minima that are not the global one.
"""
import math
import random
import re

SOLVED, DEGENERATE, INFEASIBLE, UNBOUNDED, REACHED = range(5)  # as NLPEnd in tests/tao_ipfilter/ipfilter_nlp.h
PROBLEMS = []


class Problem:

    def __init__(self, name, objective, optimum, start, ge=(), eq=(), bounds="", others=(), end=SOLVED):
        self.name, self.objective, self.optimum, self.others, self.end = name, objective, optimum, tuple(others), end
        self.inequalities, self.equalities = "; ".join(ge), "; ".join(eq)
        self.bounds, self.start = repeated(bounds), repeated(start)


def repeated(text):
    """3*0: is 0: 0: 0:, and lists of numbers are joined"""
    if not isinstance(text, str):
        text = " ".join(repr(value) for value in text)
    return re.sub(r"(\d+)\*(\S+)", lambda m: " ".join([m[2]] * int(m[1])), text)


def add(name, objective, optimum, start, **rest):
    PROBLEMS.append(Problem(name, objective, optimum, start, **rest))


def total(terms):
    return "+".join(f"({term})" for term in terms)


def linear(coefficients, first=1):
    return "+".join(f"{c!r}*x{i}" for i, c in enumerate(coefficients, first) if c) or "0"


def numbers(text):
    return [float(word) for word in text.split()]


ROSENBROCK = "100*(x2-x1^2)^2+(1-x1)^2"

# ---- Hock and Schittkowski 1981, what is not in tests/tao_ipfilter/ipfilter_nlp.h ----

add(
    "HS25",
    total(f"-{0.01 * i!r}+exp(-({25 + (-50 * math.log(0.01 * i)) ** (2 / 3)!r}-x2)^x3/x1)".join(("(", ")^2"))
          for i in range(1, 100)), 0.0, "100 12.5 3", bounds="0.1:100 0:25.6 0:5", others=(32.835, ))
add("HS41", "2-x1*x2*x3", 52 / 27, "4*2", eq=["x1+2*x2+2*x3-x4"], bounds="3*0:1 0:2", others=(2.0, ))
add("HS46", "(x1-x2)^2+(x3-1)^2+(x4-1)^4+(x5-1)^6", 0.0, [math.sqrt(2) / 2, 1.75, 0.5, 2, 2],
    eq=["x1^2*x4+sin(x4-x5)-1", "x2+x3^4*x4^2-2"])
add("HS47", "(x1-x2)^2+(x2-x3)^3+(x3-x4)^4+(x4-x5)^4", 0.0, [2, math.sqrt(2), -1, 2 - math.sqrt(2), 0.5],
    eq=["x1+x2^2+x3^3-3", "x2-x3^2+x4-1", "x1*x5-1"], others=(-0.02671418, ))
add("HS55", "x1+2*x2+4*x5+exp(x1*x4)", 19 / 3, "1 2 0 0 0 2",
    eq=["x1+2*x2+5*x5-6", "x1+x2+x3-3", "x4+x5+x6-2", "x1+x4-1", "x2+x5-2",
        "x3+x6-2"], bounds="0:1 0: 0: 0:1 0: 0:", others=(20 / 3, ))
add("HS56", "-x1*x2*x3", -3.456, [1, 1, 1] + [math.asin(math.sqrt(1 / 4.2))] * 3 + [math.asin(math.sqrt(5 / 7.2))],
    eq=["x1-4.2*sin(x4)^2", "x2-4.2*sin(x5)^2", "x3-4.2*sin(x6)^2", "x1+2*x2+2*x3-7.2*sin(x7)^2"])
HS57_A = numbers(
    "8 8 10 10 10 10 12 12 12 12 14 14 14 16 16 16 18 18 20 20 20 22 22 22 24 24 24 26 26 26 28 28 30 30 30 "
    "32 32 34 36 36 38 38 40 42")
HS57_B = numbers(
    ".49 .49 .48 .47 .48 .47 .46 .46 .45 .43 .45 .43 .43 .44 .43 .43 .46 .45 .42 .42 .43 .41 .41 .40 .42 .40 "
    ".40 .41 .40 .41 .41 .40 .40 .40 .38 .41 .40 .40 .41 .38 .40 .40 .39 .39")
add("HS57", total(f"({b!r}-x1-(0.49-x1)*exp(-x2*{a - 8!r}))^2" for a, b in zip(HS57_A, HS57_B)), 0.02845966972,
    "0.42 5", ge=["0.49*x2-x1*x2-0.09"], bounds="0.4: -4:", others=(0.03064631, ))
add(
    "HS59", "-75.196+3.8112*x1-0.12694*x1^2+0.0020567*x1^3-1.0345e-5*x1^4+6.8306*x2-0.030234*x1*x2+1.28134e-3*x2*x1^2"
    "+2.266e-7*x1^4*x2-0.25645*x2^2+0.0034604*x2^3-1.3514e-5*x2^4+28.106/(x2+1)"
    "+5.2375e-6*x1^2*x2^2+6.3e-8*x1^3*x2^2-7e-10*x1^3*x2^3-3.405e-4*x1*x2^2+1.6638e-6*x1*x2^3+2.8673*exp(0.0005*x1*x2)"
    "-3.5256e-5*x1^3*x2", -7.80278947, "90 10", ge=["x1*x2-700", "x2-x1^2/125", "(x2-50)^2-5*(x1-55)"],
    bounds="0:75 0:65", others=(-6.749505, ))
add(
    "HS62", "-32.174*(255*log((x1+x2+x3+0.03)/(0.09*x1+x2+x3+0.03))"
    "+280*log((x2+x3+0.03)/(0.07*x2+x3+0.03))+290*log((x3+0.03)/(0.13*x3+0.03)))", -26272.51448, "0.7 0.2 0.1",
    eq=["x1+x2+x3-1"], bounds="3*0:1")


def normal(argument):
    """Distribution function of the normal distribution"""
    return f"(0.5+0.5*erf(({argument})/{math.sqrt(2)!r}))"


for name, a, b, d, n, optimum in (("HS68", 1e-4, 1, 1, 24, -0.920425026), ("HS69", 0.1, 1000, 1, 4, -956.71288)):
    add(name, f"({a * n!r}-({b}*(exp(x1)-1)-x3)*x4/(exp(x1)-1+x4))/x1", optimum, "4*1",
        eq=[f"x3-2*{normal('-x2')}", f"x4-{normal(f'-x2+{d * math.sqrt(n)!r}')}-{normal(f'-x2-{d * math.sqrt(n)!r}')}"],
        bounds="0.0001:100 0:100 0:2 0:2")
add("HS72", "1+x1+x2+x3+x4", 727.67937, "4*1",
    ge=["0.0401-4/x1-2.25/x2-1/x3-0.25/x4",
        "0.010085-0.16/x1-0.36/x2-0.64/x3-0.64/x4"], bounds="0.001:4e5 0.001:3e5 0.001:2e5 0.001:1e5")
add(
    "HS73", "24.55*x1+26.75*x2+39*x3+40.5*x4", 29.894378, "4*1", ge=[
        "2.3*x1+5.6*x2+11.1*x3+1.3*x4-5",
        "12*x1+11.9*x2+41.8*x3+52.1*x4-21-1.645*sqrt(0.28*x1^2+0.19*x2^2+20.5*x3^2+0.62*x4^2)"
    ], eq=["x1+x2+x3+x4-1"], bounds="4*0:")
add(
    "HS75", "3*x1+1e-6*x1^3+2*x2+2e-6/3*x2^3", 5174.4129, "4*0", ge=["x4-x3+0.48", "x3-x4+0.48"],
    bounds="2*0:1200 2*-0.48:0.48", eq=[
        "1000*sin(-x3-0.25)+1000*sin(-x4-0.25)+894.8-x1", "1000*sin(x3-0.25)+1000*sin(x3-x4-0.25)+894.8-x2",
        "1000*sin(x4-0.25)+1000*sin(x4-x3-0.25)+1294.8"
    ])
add("HS81", "exp(x1*x2*x3*x4*x5)-0.5*(x1^3+x2^3+1)^2", 0.0539498478, "-2 2 2 -1 -1",
    eq=["x1^2+x2^2+x3^2+x4^2+x5^2-10", "x2*x3-5*x4*x5",
        "x1^3+x2^3+1"], bounds="2*-2.3:2.3 3*-3.2:3.2", others=(0.43885110, 1.0))
COLVILLE_C = [[30, -20, -10, 32, -10], [-20, 39, -6, -31, 32], [-10, -6, 10, -6, -10], [32, -31, -6, 39, -20],
              [-10, 32, -10, -20, 30]]
COLVILLE_D, COLVILLE_E = [4, 8, 10, 6, 2], [-15, -27, -36, -18, -12]
COLVILLE_A = [[-16, 2, 0, 1, 0], [0, -2, 0, 0.4, 2], [-3.5, 0, 2, 0, 0], [0, -2, 0, -4, -1], [0, -9, -2, 1, -2.8],
              [2, 0, -4, 0, 0], [-1, -1, -1, -1, -1], [-1, -2, -3, -2, -1], [1, 2, 3, 4, 5], [1, 1, 1, 1, 1]]
COLVILLE_B = [-40, -2, -0.25, -4, -4, -1, -40, -60, 5, 1]
add(
    "HS86",
    "+".join([linear(COLVILLE_E)] + [f"{COLVILLE_C[i][j]}*x{i + 1}*x{j + 1}" for i in range(5)
                                     for j in range(5)] + [f"{d}*x{j}^3" for j, d in enumerate(COLVILLE_D, 1)]),
    -32.34867897, "0 0 0 0 1", ge=[f"{linear(row)}-{b!r}" for row, b in zip(COLVILLE_A, COLVILLE_B)], bounds="5*0:")
HS95 = [
    "17.1*x1+38.2*x2+204.2*x3+212.3*x4+623.4*x5+1495.5*x6-169*x1*x3-3580*x3*x5-3810*x4*x5-18500*x4*x6-24300*x5*x6",
    "17.9*x1+36.8*x2+113.9*x3+169.7*x4+337.8*x5+1385.2*x6-139*x1*x3-2450*x4*x5-16600*x4*x6-17200*x5*x6",
    "-273*x2-70*x4-819*x5+26000*x4*x5", "159.9*x1-311*x2+587*x4+391*x5+2198*x6-14000*x1*x6"
]
for name, b, optimum, others in (("HS95", (4.97, -1.88, -29.08, -78.02), 0.015619525,
                                  ()), ("HS96", (4.97, -1.88, -69.08, -118.02), 0.015619525, ()),
                                 ("HS97", (32.97, 25.12, -29.08, -78.02), 3.1358091, (4.07124638, ))):
    add(name, "4.3*x1+31.8*x2+63.3*x3+15.8*x4+68.5*x5+4.7*x6", optimum, "6*0",
        ge=[f"{row}-{value!r}" for row, value in zip(HS95, b)],
        bounds="0:0.31 0:0.046 0:0.068 0:0.042 0:0.028 0:0.0134", others=others)


def hs99():
    """A rocket's trajectory in seven arcs: range, height and velocity at the end as sums over the arcs"""
    a, t, b = (0, 50, 50, 75, 75, 75, 100, 100), (0, 25, 50, 100, 150, 200, 290, 380), 32
    h = [t[i] - t[i - 1] for i in range(1, 8)]
    thrust = [f"({a[i]}*sin(x{i})-{b})" for i in range(1, 8)]
    r = total(f"{a[i]}*{h[i - 1]}*cos(x{i})" for i in range(1, 8))
    s = total(f"{h[i]}*{thrust[i]}" for i in range(7))
    q = total(f"{0.5 * h[i] ** 2 + h[i] * sum(h[i + 1:])!r}*{thrust[i]}" for i in range(7))
    add("HS99", f"-({r})^2", -0.831079892e9, "7*0.5", eq=[f"{q}-1e5", f"{s}-1e3"], bounds="7*0:1.58")


hs99()
HS101 = [
    "1-0.5*x1^0.5*x3^-1*x6^-2*x7-0.7*x1^3*x2*x3^-2*x6*x7^0.5-0.2*x2^-1*x3*x4^-0.5*x6^(2/3)*x7^0.25",
    "1-1.3*x1^-0.5*x2*x3^-1*x5^-1*x6-0.8*x3*x4^-1*x5^-1*x6^2-3.1*x1^-1*x2^0.5*x4^-2*x5^-1*x6^(1/3)",
    "1-2*x1*x3^-1.5*x5*x6^-1*x7^(1/3)-0.1*x2*x3^-0.5*x5*x6^-1*x7^-0.5-x1^-1*x2*x3^0.5*x5-0.65*x2^-2*x3*x5*x6^-1*x7",
    "1-0.2*x1^-2*x2*x4^-1*x5^0.5*x7^(1/3)-0.3*x1^0.5*x2^2*x3*x4^(1/3)*x5^(-2/3)*x7^0.25-0.4*x1^-3*x2^-2*x3*x5*x7^0.75"
    "-0.5*x3^-2*x4*x7^0.5"
]
for name, a, optimum in (("HS101", -0.25, 1809.76476), ("HS102", 0.125, 911.880571), ("HS103", 0.5, 543.667958)):
    f = (f"10*x1*x2^-1*x4^2*x6^-3*x7^{a}+15*x1^-1*x2^-2*x3*x4*x5^-1*x7^-0.5+20*x1^-2*x2*x4^-1*x5^-2*x6"
         f"+25*x1^2*x2^2*x3^-1*x5^0.5*x6^-2*x7")
    add(name, f, optimum, "7*6", ge=HS101 + [f"{f}-100", f"3000-({f})"], bounds="6*0.1:10 0.01:10")


def hs107():
    """Power flow in a network of three generators"""
    c, d = (48.4 / 50.176 * g(0.25) for g in (math.sin, math.cos))
    c, d, e, g = f"{c!r}", f"{d!r}", f"{2 * c!r}", f"{2 * d!r}"
    y1, y2, y3, y4, y5, y6 = "sin(x8)", "cos(x8)", "sin(x9)", "cos(x9)", "sin(x8-x9)", "cos(x8-x9)"
    add(
        "HS107", "3000*x1+1000*x1^3+2000*x2+666.667*x2^3", 5055.011803, "0.8 0.8 0.2 0.2 3*1.0454 0 0",
        bounds="2*0: 2*: 3*0.90909:1.0909 2*:", eq=[
            f"0.4-x1+{e}*x5^2-x5*x6*({d}*{y1}+{c}*{y2})-x5*x7*({d}*{y3}+{c}*{y4})",
            f"0.4-x2+{e}*x6^2+x5*x6*({d}*{y1}-{c}*{y2})+x6*x7*({d}*{y5}-{c}*{y6})",
            f"0.8+{e}*x7^2+x5*x7*({d}*{y3}-{c}*{y4})-x6*x7*({d}*{y5}+{c}*{y6})",
            f"0.2-x3+{g}*x5^2+x5*x6*({c}*{y1}-{d}*{y2})+x5*x7*({c}*{y3}-{d}*{y4})",
            f"0.2-x4+{g}*x6^2-x5*x6*({c}*{y1}+{d}*{y2})-x6*x7*({c}*{y5}+{d}*{y6})",
            f"-0.337+{g}*x7^2-x5*x7*({c}*{y3}+{d}*{y4})+x6*x7*({c}*{y5}-{d}*{y6})"
        ])


def hs109():
    """Power flow, in other units"""
    a, b, c = "50.176", f"{math.sin(0.25)!r}", f"{math.cos(0.25)!r}"
    add(
        "HS109", "3*x1+1e-6*x1^3+2*x2+0.522074e-6*x2^3", 5362.06928, "9*0",
        bounds="2*0: 2*-0.55:0.55 3*196:252 2*-400:800",
        ge=["x4-x3+0.55", "x3-x4+0.55", "2250000-x1^2-x8^2", "2250000-x2^2-x9^2"], eq=[
            f"x5*x6*sin(-x3-0.25)+x5*x7*sin(-x4-0.25)+2*{b}*x5^2-{a}*x1+400*{a}",
            f"x5*x6*sin(x3-0.25)+x6*x7*sin(x3-x4-0.25)+2*{b}*x6^2-{a}*x2+400*{a}",
            f"x5*x7*sin(x4-0.25)+x6*x7*sin(x4-x3-0.25)+2*{b}*x7^2+881.779*{a}",
            f"{a}*x8+x5*x6*cos(-x3-0.25)+x5*x7*cos(-x4-0.25)-200*{a}-2*{c}*x5^2+0.7533e-3*{a}*x5^2",
            f"{a}*x9+x5*x6*cos(x3-0.25)+x6*x7*cos(x3-x4-0.25)-2*{c}*x6^2+0.7533e-3*{a}*x6^2-200*{a}",
            f"x5*x7*cos(x4-0.25)+x6*x7*cos(x4-x3-0.25)-2*{c}*x7^2-22.938*{a}+0.7533e-3*{a}*x7^2"
        ])


hs107()
hs109()
add(
    "HS110",
    total(f"log(x{i}-2)^2+log(10-x{i})^2" for i in range(1, 11)) + "-(" + "*".join(f"x{i}" for i in range(1, 11)) +
    ")^0.2", -45.77846971, "10*9", bounds="10*2.001:9.999")
CHEMICAL = (-6.089, -17.164, -34.054, -5.914, -24.721, -14.986, -24.100, -10.708, -26.662, -22.179)
add(
    "HS111",
    total(
        f"exp(x{j})*({c!r}+x{j}-log({total(f'exp(x{k})' for k in range(1, 11))}))" for j, c in enumerate(CHEMICAL, 1)),
    -47.76109026, "10*-2.3", bounds="10*-100:100", eq=[
        "exp(x1)+2*exp(x2)+2*exp(x3)+exp(x6)+exp(x10)-2", "exp(x4)+2*exp(x5)+exp(x6)+exp(x7)-1",
        "exp(x3)+exp(x7)+exp(x8)+2*exp(x9)+exp(x10)-1"
    ])
add("HS112",
    total(f"x{j}*({c!r}+log(x{j}/({'+'.join(f'x{k}' for k in range(1, 11))})))" for j, c in enumerate(CHEMICAL, 1)),
    -47.76109026, "10*0.1", bounds="10*1e-6:", eq=["x1+2*x2+2*x3+x6+x10-2", "x4+2*x5+x6+x7-1", "x3+x7+x8+2*x9+x10-1"])


def hs114():
    """The alkylation process"""
    a, b = 0.99, 0.9
    g = [
        f"35.82-0.222*x10-{b}*x9", f"-133+3*x7-{a}*x10", f"1.12*x1+0.13167*x1*x8-0.00667*x1*x8^2-{a}*x4",
        f"57.425+1.098*x8-0.038*x8^2+0.325*x6-{a}*x7"
    ]
    back = [
        f"-({g[0]})+{1 / b - b!r}*x9", f"-({g[1]})+{1 / a - a!r}*x10", f"-({g[2]})+{1 / a - a!r}*x4",
        f"-({g[3]})+{1 / a - a!r}*x7"
    ]
    add("HS114", "5.04*x1+0.035*x2+10*x3+3.36*x5-0.063*x4*x7", -1768.80696,
        "1745 12000 110 3048 1974 89.2 92.8 8 3.6 145", ge=g + back,
        eq=["1.22*x4-x1-x5", "98000*x3/(x4*x9+1000*x3)-x6",
            "(x2+x5)/x1-x8"], bounds="1e-5:2000 1e-5:16000 1e-5:120 1e-5:5000 1e-5:2000 85:93 90:95 3:12 1.2:4 145:162")


hs114()
add(
    "HS116", "x11+x12+x13", 97.58750956, "0.5 0.8 0.9 0.1 0.14 0.5 489 80 650 450 150 150 150",
    bounds="3*0.1:1 0.0001:0.1 2*0.1:0.9 2*0.1:1000 500:1000 0.1:500 1:150 2*0.0001:150", ge=[
        "x3-x2", "x2-x1", "1-0.002*x7+0.002*x8", "x11+x12+x13-50", "250-x11-x12-x13",
        "x13-1.262626*x10+1.231059*x3*x10", "x5-0.03475*x2-0.975*x2*x5+0.00975*x2^2",
        "x6-0.03475*x3-0.975*x3*x6+0.00975*x3^2", "x5*x7-x1*x8-x4*x7+x4*x8", "1-0.002*(x2*x9+x5*x8-x1*x8-x6*x9)-x5-x6",
        "x2*x9-x3*x10-x6*x9-500*x2+500*x6+x2*x10", "x2-0.9-0.002*(x2*x10-x3*x10)",
        "x4-0.03475*x1-0.975*x1*x4+0.00975*x1^2", "x11-1.262626*x8+1.231059*x1*x8", "x12-1.262626*x9+1.231059*x2*x9"
    ])
add(
    "HS117", "+".join([f"{-b!r}*x{j}" for j, b in enumerate(COLVILLE_B, 1)] +
                      [f"{COLVILLE_C[k][j]}*x{11 + k}*x{11 + j}" for k in range(5)
                       for j in range(5)] + [f"{2 * d}*x{11 + j}^3" for j, d in enumerate(COLVILLE_D)]), 32.348679,
    "6*0.001 60 8*0.001", bounds="15*0:", ge=[
        "+".join([f"{2 * COLVILLE_C[k][j]}*x{11 + k}"
                  for k in range(5)] + [f"{3 * COLVILLE_D[j]}*x{11 + j}^2+{COLVILLE_E[j]}"] +
                 [f"{-COLVILLE_A[k][j]!r}*x{k + 1}"
                  for k in range(10)])
        for j in range(5)
    ])
add(
    "HS118",
    total(f"2.3*x{i + 1}+0.0001*x{i + 1}^2+1.7*x{i + 2}+0.0001*x{i + 2}^2+2.2*x{i + 3}+0.00015*x{i + 3}^2"
          for i in range(0, 15, 3)), 664.82045, "20 55 15" + 4 * " 20 60 20", ge=[
              row for j in range(1, 5) for k, high in ((1, 13), (2, 14), (3, 13))
              for row in (f"x{3 * j + k}-x{3 * j + k - 3}+7", f"{high - 7}-x{3 * j + k}+x{3 * j + k - 3}")
          ] + [f"x{i}+x{i + 1}+x{i + 2}-{low}" for i, low in ((1, 60), (4, 50), (7, 70), (10, 85), (13, 100))],
    bounds="8:21 43:57 3:16" + 4 * " 0:90 0:120 0:60")
HS119_A = {
    1: (4, 7, 8, 16), 2: (3, 7, 10), 3: (7, 9, 10, 14), 4: (7, 11, 15), 5: (6, 10, 12, 16), 6: (8, 15), 7: (11, 13),
    8: (10, 15), 9: (12, 16), 10: (14, ), 11: (13, ), 12: (14, ), 13: (14, )
}
HS119_B = [(0.22, 0.2, 0.19, 0.25, 0.15, 0.11, 0.12, 0.13), (-1.46, 0, -1.3, 1.82, -1.15, 0, 0.8, 0),
           (1.29, -0.89, 0, 0, -1.16, -0.96, 0, -0.49), (-1.1, -1.06, 0.95, -0.54, 0, -1.78, -0.41, 0),
           (0, 0, 0, -1.43, 1.51, 0.59, -0.33, -0.43), (0, -1.72, -0.33, 0, 1.62, 1.24, 0.21, -0.26),
           (1.12, 0, 0, 0.31, 0, 0, 1.12, 0, -0.36), (0, 0.45, 0.26, -1.1, 0.58, 0, -1.03, 0.1)]
add(
    "HS119", total(f"(x{i}^2+x{i}+1)*(x{j}^2+x{j}+1)" for i in range(1, 17) for j in (i, ) + HS119_A.get(i, ())),
    244.899698, "16*10", bounds="16*0:5", eq=[
        f"{linear(row)}+x{9 + k}-{c!r}"
        for k, (row, c) in enumerate(zip(HS119_B, (2.5, 1.1, -3.1, -3.5, 1.3, 2.1, 2.3, -1.5)))
    ])

# ---- Schittkowski 1987, "More test examples for nonlinear programming codes" ----

add("S201", "4*(x1-5)^2+(x2-6)^2", 0.0, "8 9")
add("S202", "(-13+x1-2*x2+5*x2^2-x2^3)^2+(-29+x1-14*x2+x2^2+x2^3)^2", 0.0, "15 -2", bounds="1:20 -5:5",
    others=(48.98425368, ))
add("S203", "(1.5-x1*(1-x2))^2+(2.25-x1*(1-x2^2))^2+(2.625-x1*(1-x2^3))^2", 0.0, "2 0.2")
add("S206", "(x2-x1^2)^2+100*(1-x1)^2", 0.0, "-1.2 1")
add("S207", "(x2-x1^2)^2+(1-x1)^2", 0.0, "-1.2 1")
add("S208", ROSENBROCK, 0.0, "-1.2 1")
add("S209", "1e4*(x2-x1^2)^2+(1-x1)^2", 0.0, "-1.2 1")
add("S210", "1e6*(x2-x1^2)^2+(1-x1)^2", 0.0, "-1.2 1")
add("S211", "100*(x2-x1^3)^2+(1-x1)^2", 0.0, "-1.2 1")
add("S212", "(4*(x1+x2))^2+(4*(x1+x2)+(x1-x2)*((x1-2)^2+x2^2-1))^2", 0.0, "2 0")
add("S213", "(10*(x1-x2)^2+(x1-1)^2)^4", 0.0, "-1.2 1", end=DEGENERATE)
add("S215", "x2", 0.0, "1 1", ge=["x2-x1^2"], bounds="0: :")
add("S216", "100*(x1^2-x2)^2+(x1-1)^2", 0.999375293, "-1.2 1", eq=["x1*(x1-4)-2*x2+12"], bounds="-3:10 -3:10")
add("S217", "-x2", -0.8, "10 10", ge=["1+x1-2*x2"], eq=["x1^2+x2^2-1"], bounds="0: :")
add("S218", "x2", 0.0, "9 100", ge=["x2-x1^2"], bounds="-100:100 0:100")
add("S219", "-x1", -1.0, "4*10", eq=["x2-x1^3-x3^2", "x1^2-x2-x4^2"])
add("S220", "x1", 1.0, "25000 25000", eq=["(x1-1)^3-x2"], bounds="1: 0:", end=DEGENERATE)
add("S221", "-x1", -1.0, "0.25 0.25", ge=["-(x1-1)^3-x2"], bounds="0: 0:", end=DEGENERATE)
add("S222", "-x1", -1.5, "1.3 0.2", ge=["0.125-(x1-1)^3-x2"], bounds="0: 0:")
add("S223", "-x1", -math.log(math.log(10)), "0.1 3.3", ge=["x2-exp(exp(x1))"], bounds="0:10 0:10")
add("S224", "2*x1^2+x2^2-48*x1-40*x2", -304.0, "0.1 0.1", ge=["x1+3*x2", "18-x1-3*x2", "x1+x2", "8-x1-x2"],
    bounds="0:6 0:6")
add("S225", "x1^2+x2^2", 2.0, "3 1", ge=["x1+x2-1", "x1^2+x2^2-1", "9*x1^2+x2^2-9", "x1^2-x2", "x2^2-x1"],
    others=(9.4721359550, ))
add("S226", "-x1*x2", -0.5, "0.8 0.05", ge=["x1^2+x2^2", "1-x1^2-x2^2"], bounds="0: 0:")
add("S227", "(x1-2)^2+(x2-1)^2", 1.0, "0.5 0.5", ge=["-x1^2+x2", "x1-x2^2"])
add("S228", "x1^2+x2", -3.0, "0 0", ge=["-x1-x2+1", "-x1^2-x2^2+9"])
add("S229", ROSENBROCK, 0.0, "-1.2 1", bounds="-2:2 -2:2")
add("S230", "x2", 0.375, "0 0", ge=["-2*x1^2+x1^3+x2", "-2*(1-x1)^2+(1-x1)^3+x2"], others=(1.0, ))
add("S231", ROSENBROCK, 0.0, "-1.2 1", ge=["x1/3+x2+0.1", "-x1/3+x2+0.1"])
add("S233", ROSENBROCK, 0.0, "1.2 1", ge=["x1^2+x2^2-0.25"])
add("S234", "(x2-x1)^4-(1-x1)", -0.8, "1 1", ge=["-x1^2-x2^2+1"], bounds="0.2:2 0.2:2")
add("S235", "(x2-x1^2)^2+0.01*(x1-1)^2", 0.04, "-2 3 1", eq=["x1+x3^2+1"])
add("S240", "(x1-x2+x3)^2+(-x1+x2+x3)^2+(x1+x2-x3)^2", 0.0, "100 -1 2.5")
add("S241",
    "(x1^2+x2^2+x3^2-1)^2+(x1^2+x2^2+(x3-2)^2-1)^2+(x1+x2+x3-1)^2+(x1+x2-x3+1)^2+(x1^3+3*x2^2+(5*x3-x1+1)^2-36)^2", 0.0,
    "1 2 0")
add("S242",
    total(f"(exp({-t / 10!r}*x1)-exp({-t / 10!r}*x2)-x3*{math.exp(-t / 10) - math.exp(-t)!r})^2" for t in range(1, 11)),
    0.0, "2.5 10 10", bounds="3*0:10")
add("S246", "100*(x3-((x1+x2)/2)^2)^2+(1-x1)^2+(1-x2)^2", 0.0, "-1.2 2 0")
add("S249", "x1^2+x2^2+x3^2", 1.0, "1 1 1", ge=["x1^2+x2^2-1"], bounds="1: : :")
add("S250", "-x1*x2*x3", -3300.0, "3*10", ge=["x1+2*x2+2*x3", "72-x1-2*x2-2*x3"], bounds="0:20 0:11 0:42")
add("S252", "0.01*(x1-1)^2+(x2-x1^2)^2", 0.04, "-1 2 2", eq=["x1+x3^2+1"], bounds=":-1 : :")
add("S254", "log(x3)/log(10)-x2", -math.sqrt(3), "1 1 1", eq=["x2^2+x3^2-4", "x3-1-x1^2"], bounds=": : 1:")
add("S256", "(x1+10*x2)^2+5*(x3-x4)^2+(x2-2*x3)^4+10*(x1-x4)^4", 0.0, "3 -1 0 1")
WOOD = "100*(x2-x1^2)^2+(1-x1)^2+90*(x4-x3^2)^2+(1-x3)^2+10.1*((x2-1)^2+(x4-1)^2)+19.8*(x2-1)*(x4-1)"
add("S257", WOOD, 0.0, "-3 -1 -3 -1", bounds="0: : 0: :")
add("S260", WOOD, 0.0, "-3 -1 -3 -1")
add("S261", "(exp(x1)-x2)^4+100*(x2-x3)^6+(sin(x3-x4)/cos(x3-x4))^4+x1^8+(x4-1)^2", 0.0, "4*0")
add("S262", "-0.5*x1-x2-0.5*x3-x4", -10.0, "4*1", bounds="4*0:",
    ge=["10-x1-x2-x3-x4", "10-0.2*x1-0.5*x2-x3-2*x4", "10-2*x1-x2-0.5*x3-0.2*x4"], eq=["x1+x2+x3-2*x4-6"])
add("S263", "-x1", -1.0, "4*10", ge=["x2-x1^3", "x1^2-x2"], eq=["x2-x1^3-x3^2", "x1^2-x2-x4^2"], end=DEGENERATE)
add("S269", "(x1-x2)^2+(x2+x3-2)^2+(x4-1)^2+(x5-1)^2", 4.09302326, "5*2", eq=["x1+3*x2", "x3+x4-2*x5", "x2-x5"])
add("S271", total(f"10*{16 - i}*(x{i}-1)^2" for i in range(1, 7)), 0.0, "6*0")


def hilbert(n):
    return [[1 / (i + j + 1) for j in range(n)] for i in range(n)]


for name, n in (("S274", 2), ("S275", 4), ("S276", 6)):
    add(name, total(f"x{i + 1}*x{j + 1}/{i + j + 1}" for i in range(n) for j in range(n)), 0.0,
        [-4 / i for i in range(1, n + 1)])
for name, n in (("S277", 4), ("S278", 6), ("S279", 8), ("S280", 10)):
    sums = [sum(row) for row in hilbert(n)]
    add(name, linear(sums), sum(sums), [0] * n, ge=[f"{linear(row)}-{total!r}" for row, total in zip(hilbert(n), sums)],
        bounds=f"{n}*0:")
add("S282", "(x1-1)^2+(x10-1)^2+10*(" + total(f"{10 - i}*(x{i}^2-x{i + 1})^2" for i in range(1, 10)) + ")", 0.0,
    "-1.2 9*0")
add("S283", "(" + total(f"{i ** 3}*(x{i}-1)^2" for i in range(1, 11)) + ")^3", 0.0, "10*0", end=DEGENERATE)
add("S286", total(f"100*(x{i}^2-x{i + 10})^2+(x{i}-1)^2" for i in range(1, 11)), 0.0, "10*-1.2 10*1")
add(
    "S288",
    total(f"(x{i}+10*x{i + 5})^2+5*(x{i + 10}-x{i + 15})^2+(x{i + 5}-2*x{i + 10})^4+10*(x{i}-x{i + 15})^4"
          for i in range(1, 6)), 0.0, "5*3 5*-1 5*0 5*1")
add("S289", "1-exp(-(" + total(f"x{i}^2" for i in range(1, 31)) + ")/60)", 0.0,
    [(-1)**i * (1 + i / 30) for i in range(1, 31)])
for name, n in (("S290", 2), ("S291", 10), ("S292", 30)):
    add(name, "(" + total(f"{i}*x{i}^2" for i in range(1, n + 1)) + ")^2", 0.0, [1] * n)
for name, n in (("S294", 6), ("S295", 10), ("S297", 30), ("S298", 50)):
    add(name, total(f"100*(x{i + 1}-x{i}^2)^2+(1-x{i})^2" for i in range(1, n)), 0.0,
        [-1.2 if i % 2 == 0 else 1 for i in range(n)], others=(3.97394, 3.98657911, 3.98662))
for name, n in (("S300", 20), ("S301", 50)):
    add(name, "x1^2-2*x1+" + total(f"2*x{i}^2-2*x{i - 1}*x{i}" for i in range(2, n + 1)), -n, [0] * n)
for name, n in (("S303", 20), ("S304", 50)):
    half = total(f"{i / 2!r}*x{i}" for i in range(1, n + 1))
    add(name, total(f"x{i}^2" for i in range(1, n + 1)) + f"+({half})^2+({half})^4", 0.0, [0.1] * n)
add("S307", total(f"({2 + 2 * i}-exp({i}*x1)-exp({i}*x2))^2" for i in range(1, 11)), 124.362182, "0.3 0.4",
    others=(2020.0, ))
add("S308", "(x1^2+x1*x2+x2^2)^2+sin(x1)^2+cos(x2)^2", 0.77319906, "3 0.1")
add("S309", "1.41*x1^4-12.76*x1^3+39.91*x1^2-51.93*x1+24.37+(x2-3.9)^2", -3.98717, "0 0", others=(0.2891491748, ))
add("S311", "(x1^2+x2-11)^2+(x1+x2^2-7)^2", 0.0, "1 1")
add("S315", "-x2", -0.8, "-0.1 -0.9", ge=["1-2*x2+x1", "x1^2+x2^2", "1-x1^2-x2^2"])
for name, axis, optimum in (("S316", 100, (20 * math.sqrt(2) - 10)**2), ("S317", 64, 372.466606),
                            ("S318", 36, 412.750053), ("S319", 16, 452.404444), ("S320", 4, 485.531463),
                            ("S321", 1, 496.112368), ("S322", 0.01, 499.960001)):
    add(name, "(x1-20)^2+(x2+20)^2", optimum, "0 0", eq=[f"x1^2/100+x2^2/{axis}-1"],
        others=((20 * math.sqrt(2) + 10)**2, ) if axis == 100 else ())
add("S323", "x1^2+x2^2-4*x1+4", 3.79894, "0 1", ge=["x1-x2+2", "-x1^2+x2-1"], bounds="0: 0:")
add("S324", "0.01*x1^2+x2^2", 5.0, "2 2", ge=["x1*x2-25", "x1^2+x2^2-25"], bounds="2: :")
add("S325", "x1^2+x2", 3.79134, "-3 0", ge=["-x1-x2+1", "-x1-x2^2+1"], eq=["x1^2+x2^2-9"])
add("S326", "x1^2+x2^2-16*x1-10*x2", -79.807821, "4 3", ge=["11-x1^2+6*x1-4*x2", "x1*x2-3*x2-exp(x1-3)+1"],
    bounds="0:10 0:10")
add("S328", "0.1*(12+x1^2+(1+x2^2)/x1^2+(x1^2*x2^2+100)/(x1*x2)^4)", 1.744152, "0.5 0.5", bounds="1:3 1:3")
add("S335", "-0.001*x1-x2", -0.00447214, "1 1 1", eq=["-1000*x1^2-100*x2^2+x3", "100*x1^2+400*x2^2+x3-0.01"])
add("S336", "7*x1-6*x2+4*x3", -0.337896, "0 0 0", eq=["x1^2+2*x2^2+3*x3^2-1", "5*x1+5*x2-3*x3-6"])
add("S337", "9*x1^2+x2^2+9*x3^2", 6.0, "1 1 1", ge=["x1*x2-1"], bounds=": 1: :1")
add("S338", "-x1^2-x2^2-x3^2", -10.9928, "0 0 0", eq=["0.5*x1+x2+x3-1", "x1^2+2/3*x2^2+0.25*x3^2-4"],
    others=(-7.205705, ))
add("S339", "0.2/(x1*x2*x3)+4/x1+3/x3", 3.36168, "1 1 1", ge=["10-2*x1*x3-x1*x2"], bounds="3*0:")
add("S340", "-x1*x2*x3", -0.054, "1 1 1", ge=["1.8-x1-2*x2-2*x3"], bounds="0:1 0: 0:")
add("S341", "-x1*x2*x3", -22.6274, "1 1 1", ge=["48-x1^2-2*x2^2-4*x3^2"], bounds="3*0:")
add("S343", "-0.0201e-7*x1^4*x2*x3^2", -5.68478, "22.3 0.5 125", ge=["675-x1^2*x2", "0.419-1e-7*x1^2*x3^2"],
    bounds="0:36 0:5 0:125")
add("S344", "(x1-1)^2+(x1-x2)^2+(x2-x3)^4", 0.0325682, "2 2 2", eq=["x1*(1+x2^2)+x3^4-4-3*sqrt(2)"])
add("S345", "(x1-1)^2+(x1-x2)^2+(x2-x3)^4", 0.0325682, "0 0 0", eq=["x1*(1+x2^2)+x3^4-4-3*sqrt(2)"])

# ---- More, Garbow and Hillstrom 1981: least squares ----

add("powell badly scaled", "(1e4*x1*x2-1)^2+(exp(-x1)+exp(-x2)-1.0001)^2", 0.0, "0 1")
add("brown badly scaled", "(x1-1e6)^2+(x2-2e-6)^2+(x1*x2-2)^2", 0.0, "1 1")
add(
    "brown dennis",
    total(f"((x1+{t}/5*x2-{math.exp(t / 5)!r})^2+(x3+x4*{math.sin(t / 5)!r}-{math.cos(t / 5)!r})^2)^2"
          for t in range(1, 21)), 85822.2016, "25 5 -5 -1")
BARD = numbers("0.14 0.18 0.22 0.25 0.29 0.32 0.35 0.39 0.37 0.58 0.73 0.96 1.34 2.10 4.39")
add("bard", total(f"({y!r}-x1-{u}/({16 - u}*x2+{min(u, 16 - u)}*x3))^2" for u, y in enumerate(BARD, 1)), 8.21487e-3,
    "1 1 1", others=(17.4286, ))
GAUSSIAN = numbers(
    "0.0009 0.0044 0.0175 0.0540 0.1295 0.2420 0.3521 0.3989 0.3521 0.2420 0.1295 0.0540 0.0175 0.0044 0.0009")
add("gaussian", total(f"(x1*exp(-x2*({(8 - i) / 2!r}-x3)^2/2)-{y!r})^2" for i, y in enumerate(GAUSSIAN, 1)), 1.12793e-8,
    "0.4 1 0")
MEYER = numbers("34780 28610 23650 19630 16370 13720 11540 9744 8261 7030 6005 5147 4427 3820 3307 2872")
add("meyer", total(f"(x1*exp(x2/({45 + 5 * i}+x3))-{y!r})^2" for i, y in enumerate(MEYER, 1)), 87.9458, "0.02 4000 250")
add("box3d",
    total(f"(exp({-t / 10!r}*x1)-exp({-t / 10!r}*x2)-x3*{math.exp(-t / 10) - math.exp(-t)!r})^2" for t in range(1, 11)),
    0.0, "0 10 20")
KOWALIK = list(
    zip(numbers("0.1957 0.1947 0.1735 0.1600 0.0844 0.0627 0.0456 0.0342 0.0323 0.0235 0.0246"),
        numbers("4 2 1 0.5 0.25 0.167 0.125 0.1 0.0833 0.0714 0.0625")))
add("kowalik osborne", total(f"({y!r}-x1*({u * u!r}+{u!r}*x2)/({u * u!r}+{u!r}*x3+x4))^2" for y, u in KOWALIK),
    3.07505e-4, "0.25 0.39 0.415 0.39", others=(1.02734e-3, ))
add(
    "biggs exp6",
    total(f"(x3*exp({-t / 10!r}*x1)-x4*exp({-t / 10!r}*x2)+x6*exp({-t / 10!r}*x5)"
          f"-{math.exp(-t / 10) - 5 * math.exp(-t) + 3 * math.exp(-0.4 * t)!r})^2"
          for t in range(1, 14)), 0.0, "1 2 1 1 1 1", others=(5.65565e-3, 0.30636677))
OSBORNE1 = numbers(
    "0.844 0.908 0.932 0.936 0.925 0.908 0.881 0.850 0.818 0.784 0.751 0.718 0.685 0.658 0.628 0.603 0.580 "
    "0.558 0.538 0.522 0.506 0.490 0.478 0.467 0.457 0.448 0.438 0.431 0.424 0.420 0.414 0.411 0.406")
add("osborne1", total(f"({y!r}-x1-x2*exp({-10 * i}*x4)-x3*exp({-10 * i}*x5))^2" for i, y in enumerate(OSBORNE1)),
    5.46489e-5, "0.5 1.5 -1 0.01 0.02")
for n, optimum in ((6, 2.28767e-3), (9, 1.39976e-6)):
    slope = lambda t: "+".join(f"{(j - 1) * t ** (j - 2)!r}*x{j}" for j in range(2, n + 1))
    value = lambda t: "+".join(f"{t ** (j - 1)!r}*x{j}" for j in range(1, n + 1))
    rows = [f"({slope(i / 29)}-({value(i / 29)})^2-1)^2" for i in range(1, 30)]
    add(f"watson{n}", total(rows + ["x1^2", "(x2-x1^2-1)^2"]), optimum, [0] * n)
for n, optimum in ((4, 2.24997e-5), (10, 7.08765e-5)):
    add(
        f"penalty1 {n}",
        total([f"1e-5*(x{i}-1)^2" for i in range(1, n + 1)] +
              [f"({total(f'x{i}^2' for i in range(1, n + 1))}-0.25)^2"]), optimum, list(range(1, n + 1)))
add(
    "variably dimensioned",
    total([f"(x{i}-1)^2" for i in range(1, 11)] +
          [f"({total(f'{i}*(x{i}-1)' for i in range(1, 11))})^{k}" for k in (2, 4)]), 0.0,
    [1 - i / 10 for i in range(1, 11)])
add("trigonometric",
    total(f"(10-({total(f'cos(x{j})' for j in range(1, 11))})+{i}*(1-cos(x{i}))-sin(x{i}))^2" for i in range(1, 11)),
    0.0, [0.1] * 10, others=(2.79506e-5, 4.47357e-6))
add(
    "brown almost linear",
    total([f"(x{i}+{total(f'x{j}' for j in range(1, 11))}-11)^2" for i in range(1, 10)] +
          [f"({'*'.join(f'x{j}' for j in range(1, 11))}-1)^2"]), 0.0, [0.5] * 10, others=(1.0, ))
add(
    "broyden tridiagonal",
    total(f"((3-2*x{i})*x{i}{f'-x{i - 1}' if i > 1 else ''}{f'-2*x{i + 1}' if i < 20 else ''}+1)^2"
          for i in range(1, 21)), 0.0, [-1] * 20)
add(
    "discrete boundary value",
    total(f"(2*x{i}{f'-x{i - 1}' if i > 1 else ''}{f'-x{i + 1}' if i < 20 else ''}+{0.5 / 441!r}*(x{i}"
          f"+{i / 21 + 1!r})^3)^2" for i in range(1, 21)), 0.0, [i / 21 * (i / 21 - 1) for i in range(1, 21)])


def chebyquad(n):

    def polynomial(i, x):
        t = {0: [1.0], 1: [-1.0, 2.0]}
        for k in range(2, i + 1):
            new = [0.0] * (k + 1)
            for power, c in enumerate(t[k - 1]):
                new[power] -= 2 * c
                new[power + 1] += 4 * c
            for power, c in enumerate(t[k - 2]):
                new[power] -= c
            t[k] = new
        value = f"{t[i][-1]!r}"
        for c in reversed(t[i][:-1]):
            value = f"(({value})*{x}+{c!r})"
        return value

    mean = lambda i: f"({total(polynomial(i, f'x{j}') for j in range(1, n + 1))})/{n}"
    return total(f"({mean(i)}{f'+{1 / (i * i - 1)!r}' if i % 2 == 0 else ''})^2" for i in range(1, n + 1))


add("chebyquad6", chebyquad(6), 0.0, [i / 7 for i in range(1, 7)])
add("chebyquad8", chebyquad(8), 3.51687e-3, [i / 9 for i in range(1, 9)])

# ---- Boggs and Tolle 1989: equality constraints ----

add("BT1", "100*x1^2+100*x2^2-x1-100", -1.0, "0.08 0.06", eq=["x1^2+x2^2-1"])
add("BT2", "(x1-1)^2+(x1-x2)^2+(x2-x3)^4", 0.032568200, "3*10", eq=["x1*(1+x2^2)+x3^4-4-3*sqrt(2)"])
add("BT3", "(x1-x2)^2+(x2+x3-2)^2+(x4-1)^2+(x5-1)^2", 4.09302326, "20 4*2", eq=["x1+3*x2", "x3+x4-2*x5", "x2-x5"])
add("BT5", "1000-x1^2-2*x2^2-x3^2-x1*x2-x1*x3", 961.715172, "3*2", eq=["x1^2+x2^2+x3^2-25", "8*x1+14*x2+7*x3-56"])
add("BT7", ROSENBROCK, 306.5, "-2 1 1 1 1", eq=["x1*x2-1-x3^2", "x2^2+x1-x4^2", "x1+x5^2-0.5"], others=(360.379767, ))
add("BT8", "x1^2+x2^2+x3^2", 1.0, "1 1 1 0 0", eq=["x1-1-x4^2+x2^2", "x1^2+x2^2-1-x5^2"], end=DEGENERATE)
add("BT10", "-x1", -1.0, "2 2", eq=["x2-x1^3", "x1^2-x2"])
add("BT12", "0.01*x1^2+x2^2", 6.188119, "15.811 1.5811 0 15.083 3.7164",
    eq=["x1+x2-x3^2-25", "x1^2+x2^2-x4^2-25", "x1-x5^2-2"])
add("maratos", "-x1+10*(x1^2+x2^2-1)", -1.0, "1.1 0.1", eq=["x1^2+x2^2-1"])
add("maratos on the circle", "2*(x1^2+x2^2-1)-x1", -1.0, [math.cos(1), math.sin(1)], eq=["x1^2+x2^2-1"])

# ---- Minimax problems as programs in one unknown more: Charalambous and Conn, Demyanov and Malozemov, Madsen, Polak
# ----


def minimax(name, functions, optimum, start, **rest):
    n = len(start) + 1
    add(name, f"x{n}", optimum, [*start, 0.0], ge=[f"x{n}-({f})" for f in functions], **rest)


minimax("CB2", ["x1^2+x2^4", "(2-x1)^2+(2-x2)^2", "2*exp(x2-x1)"], 1.9522245, [2, 2])
minimax("CB3", ["x1^4+x2^2", "(2-x1)^2+(2-x2)^2", "2*exp(x2-x1)"], 2.0, [2, 2])
minimax("demyanov malozemov", ["5*x1+x2", "-5*x1+x2", "x1^2+x2^2+4*x2"], -3.0, [1, 1])
minimax("madsen", [s + f for f in ("(x1^2+x2^2+x1*x2)", "sin(x1)", "cos(x2)") for s in ("", "-")], 0.616432436, [3, 1])
minimax("mifflin", ["-x1-x2", "-x1-x2+x1^2+x2^2-1"], -math.sqrt(2), [1, 1])
ROSEN_SUZUKI = "x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4"
ROSEN_SUZUKI_ROWS = [
    "0", "10*(x1^2+x2^2+x3^2+x4^2+x1-x2+x3-x4-8)", "10*(x1^2+2*x2^2+x3^2+2*x4^2-x1-x4-10)",
    "10*(2*x1^2+x2^2+x3^2+2*x1-x2-x4-5)"
]
minimax("rosen suzuki", [f"{ROSEN_SUZUKI}+{row}" for row in ROSEN_SUZUKI_ROWS], -44.0, [0, 0, 0, 0])
WONG1 = "(x1-10)^2+5*(x2-12)^2+x3^4+3*(x4-11)^2+10*x5^6+7*x6^2+x7^4-4*x6*x7-10*x6-8*x7"
WONG1_ROWS = [
    "0", "10*(2*x1^2+3*x2^4+x3+4*x4^2+5*x5-127)", "10*(7*x1+3*x2+10*x3^2+x4-x5-282)", "10*(23*x1+x2^2+6*x6^2-8*x7-196)",
    "10*(4*x1^2+x2^2-3*x1*x2+2*x3^2+5*x6-11*x7)"
]
minimax("wong1", [f"{WONG1}+{row}" for row in WONG1_ROWS], 680.630057, [1, 2, 0, 4, 0, 1, 1])
add("makela1", "x3", -math.sqrt(2), "0 0 0", ge=["x3+x1+x2", "x3+x1+x2-x1^2-x2^2+1"])
add("makela2", "x3", 7.2, "-1 5 0", ge=["x3-x1^2-x2^2", "x3+40*x1+10*x2-x1^2-x2^2-40", "x3+10*x1+20*x2-x1^2-x2^2-60"])
add("makela3", "x21", 0.0, [*range(1, 11), *range(-11, -21, -1), 0], ge=[f"x21-x{i}^2" for i in range(1, 21)])
add("makela4", "x21", 0.0, [*range(1, 11), *range(-11, -21, -1), 0],
    ge=[row for i in range(1, 21) for row in (f"x21-x{i}", f"x21+x{i}")])

# ---- Complementarity constraints (MacMPEC, Leyffer): a >= 0, b >= 0, a b <= 0 has no interior ----


def complementary(name, objective, optimum, start, pairs, ge=(), **rest):
    rows = [row for a, b in pairs for row in (a, b, f"-({a})*({b})")]
    add(name, objective, optimum, start, ge=[*ge, *rows], end=DEGENERATE, **rest)


complementary("ralph2", "x1^2+x2^2-4*x1*x2", 0.0, "1 1", [("x1", "x2")])
complementary("scale1", "(100*x1-1)^2+(x2-1)^2", 1.0, "0.01 1", [("x1", "x2")])
complementary("scale2", "(x1-1)^2+(100*x2-1)^2", 1.0, "1 0.01", [("x1", "x2")])
complementary("scale4", "(100*x1-1)^2+(100*x2-1)^2", 1.0, "0.01 0.01", [("x1", "x2")])
complementary("kth1", "x1+x2", 0.0, "1 1", [("x1", "x2")])
complementary("kth2", "x1+(x2-1)^2", 0.0, "0 0", [("x1", "x2")], others=(1.0, ))
complementary("kth3", "0.5*(x1-1)^2+(x2-1)^2", 0.5, "0 0", [("x1", "x2")], others=(1.0, ))
complementary("gauvin", "x1^2+(x2-10)^2", 20.0, "7 7 7", [("20-x1-x2", "x3")], eq=["4*(x1+2*x2-30)+x3"],
              bounds="0:15 0: :")
complementary("df1", "(x1-1-x2)^2", 0.0, "1 1", [("x2", "x2-x1^2+1")], ge=["2-x1^2", "3-(x1-1)^2-(x2-1)^2"],
              bounds="-1:2 :")
complementary("scholtes1", "(x1-1)^2+(x2-1)^2+x3^2-x3", 0.75, "1 1 1", [("x1", "x2")], bounds=": : 0:")
complementary("scholtes3", "0.5*((x1-1)^2+(x2-1)^2)", 0.5, "1.1 1.1", [("x1", "x2")])
complementary("scholtes4", "x1+x2-x3", 0.0, "0 1 0.5", [("x1", "x2")], ge=["4*x1-x3", "4*x2-x3"])
complementary("stackelberg", "0.5*x1^2+0.5*x1*x2-95*x1", -3266.66666667, "0 0 0", [("x2", "x3")],
              eq=["2*x2+0.5*x1-100-x3"], bounds="0:200 : :")

# ---- Degenerate ----

add("x^2<=0", "x1+x2^2", 0.0, "1 1", ge=["-x1^2"], end=DEGENERATE)
add("tangent circles", "x1", 0.0, "0.5 0.5", ge=["1-(x1-1)^2-x2^2", "1-(x1+1)^2-x2^2"], end=DEGENERATE)
add("point by two squares", "x1+x2", 2.0, "0 0", eq=["(x1-1)^2+(x2-1)^2"], end=DEGENERATE)
add("circle by two inequalities", "x1+x2", -math.sqrt(2), "1 0.5", ge=["x1^2+x2^2-1", "1-x1^2-x2^2"])
add("row stated four times", "(x1-2)^2+x2^2", 1.0, "0 1", ge=["1-x1", "2-2*x1", "1-x1", "10-10*x1"])
add("more active rows than unknowns", "-x1-x2", -2.0, "0 0", ge=["1-x1", "1-x2", "2-x1-x2", "3-2*x1-x2", "3-x1-2*x2"])
add("equality stated three times", "x1^2+x2^2+x3^2", 1 / 3, "3 -1 2",
    eq=["x1+x2+x3-1", "2*x1+2*x2+2*x3-2", "-x1-x2-x3+1"])
add("plane through the start", "(x1-1)^2+(x2-1)^2+(x3-1)^2", 0.09 / 0.59, "0 0 0", eq=["0.1*x1+0.3*x2-0.7*x3"])
add("plane through the start, no curvature", "x1^2+x2^2+x3^2", 0.0, "0 0 0", eq=["0.1*x1+0.3*x2-0.7*x3"])
add("constant objective, box", "0", 0.0, "3 -4", ge=["1-x1", "1+x1", "1-x2", "1+x2"])
add("constant objective, disc and line", "7", 7.0, "3 4", ge=["1-x1^2-x2^2"], eq=["x1-x2"])
add("constant objective, feasible start", "1", 1.0, "0.5 0.5", ge=["x1", "x2", "2-x1-x2"])
add("nothing to do", "x1^2+x2^2", 0.0, "0 0")
add("linear on a point", "x1-x2", -1.0, "1 1", eq=["x1+x2-1", "x1-x2+1"])
add("quartic", "x1^4", 0.0, "1")
add("sixth power", "(x1-1)^6+(x2+1)^4", 0.0, "3 3")
add("flat valley", "(x1-x2)^4", 0.0, "2 -1")
add("singular Hessian on a face", "(x1+x2-1)^2", 0.0, "2 2", bounds="0: 0:")
add("zero multiplier", "x1^2+(x2-1)^2", 0.0, "2 2", ge=["x1", "x2-1"])
add("bound active with zero multiplier", "x1^2+x2^2", 0.0, "1 1", bounds="0: 0:")
add("LP with a face of solutions", "-x1-x2", -1.0, "0.1 0.2", ge=["1-x1-x2"], bounds="2*0:")
add("LP, degenerate vertex", "-x1", -1.0, "0.1 0.1", ge=["1-x1-x2", "1-x1+x2", "1-x1"], bounds="2*0:")
add("Beale's cycling LP", "-0.75*x1+150*x2-0.02*x3+6*x4", -0.05, "4*0",
    ge=["-0.25*x1+60*x2+0.04*x3-9*x4", "-0.5*x1+90*x2+0.02*x3-3*x4", "1-x3"], bounds="4*0:")
add("Klee Minty 3", "-100*x1-10*x2-x3", -10000.0, "3*0", ge=["1-x1", "100-20*x1-x2", "10000-200*x1-20*x2-x3"],
    bounds="3*0:")
add("cusp", "-x1", -1.0, "0 0", ge=["(1-x1)^3-x2"], bounds="0: 0:", end=DEGENERATE)
add("Robinson, no multiplier set bounded", "x1", 0.0, "1 1", ge=["x1-x2^2", "x1+x2^2"])
add("fully fixed", "x1^2+x2", 5.0, "2 1", bounds="2:2 1:1")
add("one free unknown of three", "(x1-3)^2+x2*x3", 4.0, "1 2 2", bounds="0:10 2:2 2:2")
add("Gould saddle", "x1^3-3*x1+x2^2", -2.0, "0.5 1", bounds="-1.5:3 :")
add("log barrier of its own", "-log(x1)-log(1-x1)+x1", -math.log((3 - math.sqrt(5)) / 2) - math.log(
    (math.sqrt(5) - 1) / 2) + (3 - math.sqrt(5)) / 2, "0.9", bounds="0:1")

# ---- Badly scaled ----

add("bounds of 1e9 that mean none", "x1^2+x2^2+x1*x2-x1", -1 / 3, "10 -20", bounds="2*-1e9:1e9")
add("bounds of 1e7 that mean none", "x1^2+x1", -0.25, "18", bounds="-1e7:1e7")
add("bounds of 1e9 that mean none, one unknown", "x1^2+x1", -0.25, "18", bounds="-1e9:1e9")
add("far rows", "(x1-1)^2+(x2+1)^2", 0.0, "5 5", ge=["1e9-x1-x2", "1e9+x1-x2"])
add("rosenbrock from afar", ROSENBROCK, 0.0, "-1e3 1e3")
add("rosenbrock from afar, bounded", ROSENBROCK, 0.0, "-1e3 1e3", bounds="2*-1e4:1e4")
add("rosenbrock in millions", "100*(1e-6*x2-1e-12*x1^2)^2+(1-1e-6*x1)^2", 0.0, "-1.2e6 1e6")
add("rosenbrock in millionths", "100*(1e6*x2-1e12*x1^2)^2+(1-1e6*x1)^2", 0.0, "-1.2e-6 1e-6")
add("mixed units, HS71", "1e6*x1*x4*(1e6*x1+x2+1e-6*x3)+1e-6*x3", 17.0140173, "1e-6 5 5e6 1", ge=["x1*x2*x3*x4-25"],
    eq=["1e12*x1^2+x2^2+1e-12*x3^2+x4^2-40"], bounds="1e-6:5e-6 1:5 1e6:5e6 1:5")
add(
    "rows in mixed units, HS43", "x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4", -44.0, "4*0", ge=[
        "1e6*(8-x1^2-x2^2-x3^2-x4^2-x1+x2-x3+x4)", "10-x1^2-2*x2^2-x3^2-2*x4^2+x1+x4",
        "1e-6*(5-2*x1^2-x2^2-x3^2-2*x1+x2+x4)"
    ])
add("objective in 1e10, HS43", "1e10*(x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4)", -44e10, "4*0",
    ge=["8-x1^2-x2^2-x3^2-x4^2-x1+x2-x3+x4", "10-x1^2-2*x2^2-x3^2-2*x4^2+x1+x4", "5-2*x1^2-x2^2-x3^2-2*x1+x2+x4"])
add("objective in 1e-10, HS43", "1e-10*(x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4)", -44e-10, "4*0",
    ge=["8-x1^2-x2^2-x3^2-x4^2-x1+x2-x3+x4", "10-x1^2-2*x2^2-x3^2-2*x4^2+x1+x4", "5-2*x1^2-x2^2-x3^2-2*x1+x2+x4"])
add("large offset", "1e8+(x1-1)^2+(x2-2)^2", 1e8, "10 10", ge=["x1+x2-1"])
add("start of 1e6, QP", "(x1-1)^2+(x2-2)^2", 0.0, "1e6 -1e6", ge=["10-x1-x2"])
add("start of 1e6, quartic", "(x1-1)^4+(x2-2)^2", 0.0, "1e6 -1e6")
add("stiff and soft", "1e8*(x1-1)^2+1e-4*(x2-1)^2", 0.0, "5 5")
add("stiff and soft, bounds", "1e8*(x1-1)^2+1e-4*(x2-1)^2", 0.25e8, "0.2 5", bounds="0:0.5 0:10")
add("tiny box far from zero", "(x1-1e4)^2+x2^2", 1.0, "1e4 0", bounds=":9999 -1e-6:1e-6")
add("multiplier of 1e8", "1e8*x1", 1e8, "3", ge=["x1-1"])
add("multiplier of 1e-8", "1e-8*x1+(x2-1)^2", 1e-8, "3 3", ge=["x1-1"])
add("equality in 1e8", "x1^2+x2^2", 0.5, "3 -1", eq=["1e8*(x1+x2-1)"])
add("equality in 1e-8", "x1^2+x2^2", 0.5, "3 -1", eq=["1e-8*(x1+x2-1)"])
add("nonlinear equality in 1e6", "x1+x2", -math.sqrt(2), "-2 -0.5", eq=["1e6*(x1^2+x2^2-1)"])

# ---- Infeasible ----

add("parallel lines", "x1^2+x2^2", 0.0, "0 0", eq=["x1+x2-1", "x1+x2-2"], end=INFEASIBLE)
add("disc beside the half plane", "x1", 0.0, "0 0", ge=["1-x1^2-x2^2", "x1-2"], end=INFEASIBLE)
add("discs apart", "x1+x2", 0.0, "1.5 1", ge=["1-x1^2-x2^2", "1-(x1-3)^2-x2^2"], end=INFEASIBLE)
add("sum below bounds", "x1^2+x2^2+x3^2", 0.0, "3*2", ge=["2-x1-x2-x3"], bounds="3*1:", end=INFEASIBLE)
add("exponential below zero", "x1+x2", 0.0, "0 0", ge=["-exp(x1)-1-x2^2"], end=INFEASIBLE)
add("three half planes", "0", 0.0, "5 5", ge=["-x1", "-x2", "x1+x2-1"], end=INFEASIBLE)
add("equality beyond bounds", "(x1-1)^2", 0.0, "0.5 0.5", eq=["x1+x2-3"], bounds="0:1 0:1", end=INFEASIBLE)
add("infeasible by 1e-2", "x1^2+x2^2", 0.0, "0 0", ge=["x1+x2-1", "0.99-x1-x2"], end=INFEASIBLE)
add("infeasible in 1e6", "x1", 0.0, "1", ge=["1e6*(x1-1)", "-1e6*x1"], end=INFEASIBLE)
add("product and sum", "x1", 0.0, "1 1", eq=["x1*x2-5", "x1+x2-2"], end=INFEASIBLE)

# ---- Unbounded ----

add("LP, unbounded", "-x1-2*x2", 0.0, "1 1", ge=["x1-x2+1"], bounds="2*0:", end=UNBOUNDED)
add("saddle, unbounded", "x1^2-x2^2", 0.0, "1 1", end=UNBOUNDED)
add("concave on a ray", "-x1^2", 0.0, "1", bounds="0:", end=UNBOUNDED)
add("free along an equality", "x1+x2+x3", 0.0, "0 0 0", eq=["x1-x2"], end=UNBOUNDED)
add("exponential, unbounded", "-exp(x1)", 0.0, "0", end=UNBOUNDED)
add("cubic with a row", "x1^3+x2^2", 0.0, "1 1", ge=["5-x1"], end=UNBOUNDED)

# ---- Linear and quadratic programs with a solution by construction: x*, active rows and multipliers are drawn, the
# linear term follows ----


def quadratic(name, seed, n, m, n_active, n_equal, rank, spread=0.0, bounded=0):
    """1/2 x'Hx + q'x, H = G'G of the rank given; m rows of which n_active hold with equality; spread: powers of ten
    between the units of rows and unknowns"""
    draw = random.Random(seed)
    unit = [10**draw.uniform(-spread / 2, spread / 2) for _ in range(n)]
    g = [[draw.gauss(0, 1) / unit[j] for j in range(n)] for _ in range(rank)]
    x = [draw.uniform(0.5, 2) * unit[j] for j in range(n)]
    h = [[sum(row[i] * row[j] for row in g) for j in range(n)] for i in range(n)]
    gradient = [0.0] * n  # J'lambda, less what the equalities push
    rows, equal, bounds = [], [], [["", ""] for _ in range(n)]
    for k in range(m + n_equal):
        scale = 10**draw.uniform(-spread / 2, spread / 2)
        a = [scale * draw.gauss(0, 1) / unit[j] for j in range(n)]
        force = draw.uniform(0.5, 2) / scale
        value = sum(aj * xj for aj, xj in zip(a, x))
        if k < n_active or k >= m:
            gradient = [gj + force * aj for gj, aj in zip(gradient, a)]
        else:
            value -= scale * draw.uniform(0.5, 2)
        (rows if k < m else equal).append(f"{linear(a)}-({value!r})")
    for j in range(bounded):
        gradient[j] += draw.uniform(0.5, 2) / unit[j]
        bounds[j][0] = repr(x[j])
    q = [gj - sum(hij * xi for hij, xi in zip(row, x)) for gj, row in zip(gradient, h)]
    f = "+".join([linear(q)] + [f"{0.5 * h[i][j]!r}*x{i + 1}*x{j + 1}" for i in range(n) for j in range(n) if h[i][j]])
    optimum = sum(qj * xj
                  for qj, xj in zip(q, x)) + 0.5 * sum(x[i] * h[i][j] * x[j] for i in range(n) for j in range(n))
    add(name, f, optimum, [0.0] * n, ge=rows, eq=equal, bounds=" ".join(":".join(b) for b in bounds) if bounded else "")


for k in range(6):
    n = 4 + 2 * k
    quadratic(f"LP {n}", 100 + k, n, 2 * n, n - k // 2, 0, 0, bounded=k // 2)
for k in range(4):
    n = 6 + 2 * k
    quadratic(f"LP {n}, equalities", 200 + k, n, 2 * n, n - 2 - k, 2, 0, bounded=k)
for k in range(3):
    quadratic(f"LP 8, units of 1e{2 + 2 * k}", 300 + k, 8, 16, 6, 0, 0, spread=2 + 2 * k, bounded=2)
for k in range(6):
    n = 5 + 3 * k
    quadratic(f"QP {n}", 400 + k, n, n, n // 2, 0, n)
for k in range(4):
    n = 8 + 2 * k
    quadratic(f"QP {n}, half the rank", 500 + k, n, n, n // 2, 0, n // 2, bounded=n - n // 2 - n // 2 + 1)
for k in range(4):
    n = 6 + 4 * k
    quadratic(f"QP {n}, equalities", 600 + k, n, n, n // 4, n // 3, n, bounded=k)
for k in range(4):
    quadratic(f"QP 10, units of 1e{2 + 2 * k}", 700 + k, 10, 10, 4, 0, 10, spread=2 + 2 * k, bounded=1)

# ---- After COPS (Dolan, More, Munson 2004), small ----


def thomson(n, optimum):
    """Charges on a sphere"""
    draw = random.Random(n)
    x, y, z = ([f"x{3 * i + k}" for i in range(n)] for k in (1, 2, 3))
    add(f"electrons {n}",
        "+".join(f"(({x[i]}-{x[j]})^2+({y[i]}-{y[j]})^2+({z[i]}-{z[j]})^2)^-0.5" for i in range(n) for j in range(i)),
        optimum, [draw.gauss(0, 1) for _ in range(3 * n)], eq=[f"{x[i]}^2+{y[i]}^2+{z[i]}^2-1" for i in range(n)])


for n, optimum in ((2, 0.5), (3, math.sqrt(3)), (4, 3.674234614), (5, 6.474691495), (6, 9.985281374), (7, 14.452977414),
                   (8, 19.675287861), (10, 32.716949460), (12, 49.165253058)):
    thomson(n, optimum)


def isoperimetric(n):
    """The largest area of a polygon of perimeter 1, the first corner at the origin"""
    draw = random.Random(n)
    x, y = [f"x{2 * i + 1}" for i in range(n)], [f"x{2 * i + 2}" for i in range(n)]
    start = [
        value for i in range(n) for value in ((1 + 0.2 * draw.random()) / 6 * math.cos(2 * math.pi * i / n),
                                              (1 + 0.2 * draw.random()) / 6 * math.sin(2 * math.pi * i / n))
    ]
    add(f"isoperimetric {n}",
        "-0.5*(" + total(f"{x[i]}*{y[(i + 1) % n]}-{x[(i + 1) % n]}*{y[i]}" for i in range(n)) + ")",
        -1 / (4 * n * math.tan(math.pi / n)), start,
        ge=["1-(" + "+".join(f"sqrt(({x[i]}-{x[(i + 1) % n]})^2+({y[i]}-{y[(i + 1) % n]})^2)" for i in range(n)) + ")"],
        eq=["x1", "x2"])


for n in (3, 5, 8):
    isoperimetric(n)


def chain(n, length):
    """A hanging chain of n links of equal length between (0, 0) and (2, 0), by its corners"""
    link = (length / n)**2
    x, y = ["0"] + [f"x{i}" for i in range(1, n)] + ["2"], ["0"] + [f"x{n - 1 + i}" for i in range(1, n)] + ["0"]
    optimum = chain_energy(n, length)
    start = [2 * i / n for i in range(1, n)] + [-math.sin(math.pi * i / n) for i in range(1, n)]
    add(f"chain {n}", "+".join(f"({y[i]}+{y[i + 1]})/2*{length / n!r}" for i in range(n)), optimum, start,
        eq=[f"({x[i + 1]}-{x[i]})^2+({y[i + 1]}-{y[i]})^2-{link!r}" for i in range(n)])


def chain_energy(n, length):
    """Link i has the slope (i - (n - 1) / 2) / h: the horizontal force h is found by bisection"""
    low, high = 1e-6, 1e6
    for _ in range(200):
        h = math.sqrt(low * high)
        span = sum(length / n / math.hypot(1, (i - (n - 1) / 2) / h) for i in range(n))
        low, high = (h, high) if span < 2 else (low, h)
    slopes = [(i - (n - 1) / 2) / h for i in range(n)]
    drops = [length / n * t / math.hypot(1, t) for t in slopes]
    heights = [sum(drops[:i]) for i in range(n + 1)]
    return sum((heights[i] + heights[i + 1]) / 2 * length / n for i in range(n))


for n in (4, 8, 16):
    chain(n, 3.0)


def obstacle(n):
    """A string of n - 1 points over an obstacle: the membrane problem in one dimension, load 1, obstacle -0.05; its
    solution by the contact zone"""
    f = "+".join(f"{n / 2}*({'x%d' % i if i < n else '0'}-{'x%d' % (i - 1) if i > 1 else '0'})^2"
                 for i in range(1, n + 1)) + "+" + "+".join(f"{1 / n!r}*x{i}" for i in range(1, n))
    add(f"string {n}", f, string_energy(n, -0.05), [0.0] * (n - 1), bounds=f"{n - 1}*-0.05:")


def string_energy(n, low):
    """By projected Gauss and Seidel"""
    x = [0.0] * (n + 1)
    for _ in range(20000):
        for i in range(1, n):
            x[i] = max(low, (x[i - 1] + x[i + 1] - 1 / n**2) / 2)
    return sum(n / 2 * (x[i] - x[i - 1])**2 for i in range(1, n + 1)) + sum(x) / n


for n in (10, 20):
    obstacle(n)


def steering(n):
    """A mass from rest at 0 to rest at 1 in unit time with the least sum of squares of n piecewise constant forces: 12
    n^2 / (n^2 - 1)"""
    h = 1 / n
    p, v, u = (["0"] + [f"x{k * n + i}" for i in range(1, n + 1)] for k in range(3))
    add(
        f"steering {n}", "+".join(f"{h!r}*{u[i]}^2" for i in range(1, n + 1)), 12 * n * n / (n * n - 1),
        [0.0] * (3 * n), eq=[
            row for i in range(1, n + 1)
            for row in (f"{p[i]}-{p[i - 1]}-{h!r}*{v[i - 1]}-{h * h / 2!r}*{u[i]}", f"{v[i]}-{v[i - 1]}-{h!r}*{u[i]}")
        ] + [f"{p[n]}-1", v[n]])


for n in (4, 10, 16):
    steering(n)
for n, optimum, others in ((2, -1.0, ()), (3, -3.0, ()), (4, -6.0, ()), (5, -9.103852, ()), (6, -12.712062,
                                                                                             (-12.302928, ))):
    draw = random.Random(40 + n)
    r = {(i, j): f"((x{3 * i + 1}-x{3 * j + 1})^2+(x{3 * i + 2}-x{3 * j + 2})^2+(x{3 * i + 3}-x{3 * j + 3})^2)"
         for i in range(n) for j in range(i)}
    add(f"Lennard Jones {n}", "+".join(f"{d}^-6-2*{d}^-3" for d in r.values()), optimum,
        [draw.uniform(-0.8, 0.8) for _ in range(3 * n)], others=others)
