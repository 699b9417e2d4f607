/* Small problems whose solutions are known, as text. HS: the collection of Hock and Schittkowski, its numbers and
   starting points. */
#ifndef IPFILTER_NLP_H
#define IPFILTER_NLP_H

typedef enum {
  NLP_SOLVED,
  NLP_DEGENERATE, /* no multipliers exist: a failure is admitted, a wrong result is not */
  NLP_INFEASIBLE,
  NLP_UNBOUNDED,
  NLP_REACHED /* no multipliers exist, and the optimum is to be found in spite of that */
} NLPEnd;

/* Formulas in x1, x2, ...; several constraints are separated by semicolons. Bounds: one "lower:upper" a variable,
   either may be missing. others: values of local minima that are not the global one. */
typedef struct {
  const char *name, *objective, *inequalities, *equalities, *bounds, *start;
  double      optimum;
  NLPEnd      end;
  const char *others;
} NLP;

#define ROSENBROCK "100*(x2-x1^2)^2+(1-x1)^2"
#define HS35       "9-8*x1-6*x2-4*x3+2*x1^2+2*x2^2+x3^2+2*x1*x2+2*x1*x3"
#define HS71       "x1*x4*(x1+x2+x3)+x3"

#define HS84A "-145421.402*x1+2931.1506*x1*x2-40.427932*x1*x3+5106.192*x1*x4+15711.36*x1*x5"
#define HS84B "-155011.1084*x1+4360.53352*x1*x2+12.9492344*x1*x3+10236.884*x1*x4+13176.786*x1*x5"
#define HS84C "-326669.5104*x1+7390.68412*x1*x2-27.8986976*x1*x3+16643.076*x1*x4+30988.146*x1*x5"

#define TWICE         "x1^2-x2^2+(x2-1)^4+x3^2"
#define TWICE_OPTIMUM -2.548914701202683

static const NLP problems[] = {
  {"HS1", ROSENBROCK, "", "", ": -1.5:", "-2 1", 0.0, NLP_SOLVED, NULL},
  {"HS2", ROSENBROCK, "", "", ": 1.5:", "-2 1", 0.0504261879, NLP_SOLVED, "4.94122931799"},
  {"HS3", "x2+1e-5*(x2-x1)^2", "", "", ": 0:", "10 1", 0.0, NLP_SOLVED, NULL},
  {"HS4", "(x1+1)^3/3+x2", "", "", "1: 0:", "1.125 0.125", 2.66666666667, NLP_SOLVED, NULL},
  {"HS5", "sin(x1+x2)+(x1-x2)^2-1.5*x1+2.5*x2+1", "", "", "-1.5:4 -3:3", "0 0", -1.91322295498, NLP_SOLVED,
    "1.22836970"},
  {"HS6", "(1-x1)^2", "", "10*(x2-x1^2)", "", "-1.2 1", 0.0, NLP_SOLVED, NULL},
  {"HS7", "log(1+x1^2)-x2", "", "(1+x1^2)^2+x2^2-4", "", "2 2", -1.73205080757, NLP_SOLVED, NULL},
  {"HS8", "-1", "", "x1^2+x2^2-25; x1*x2-9", "", "2 1", -1.0, NLP_SOLVED, NULL},
  {"HS9", "sin(3.14159265358979*x1/12)*cos(3.14159265358979*x2/16)", "", "4*x1-3*x2", "", "0 0", -0.5, NLP_SOLVED,
    NULL},
  {"HS10", "x1-x2", "-3*x1^2+2*x1*x2-x2^2+1", "", "", "-10 10", -1.0, NLP_SOLVED, NULL},
  {"HS11", "(x1-5)^2+x2^2-25", "x2-x1^2", "", "", "4.9 0.1", -8.49846422315, NLP_SOLVED, NULL},
  {"HS12", "0.5*x1^2+x2^2-x1*x2-7*x1-7*x2", "25-4*x1^2-x2^2", "", "", "0 0", -30.0, NLP_SOLVED, NULL},
  {"HS13", "(x1-2)^2+x2^2", "(1-x1)^3-x2", "", "0: 0:", "-2 -2", 1.0, NLP_DEGENERATE, NULL},
  {"HS14", "(x1-2)^2+(x2-1)^2", "-0.25*x1^2-x2^2+1", "x1-2*x2+1", "", "2 2", 1.39346498, NLP_SOLVED, NULL},
  {"HS15", ROSENBROCK, "x1*x2-1; x1+x2^2", "", ":0.5 :", "-2 1", 306.5, NLP_SOLVED, "360.379767"},
  {"HS16", ROSENBROCK, "x1+x2^2; x1^2+x2", "", "-0.5:0.5 :1", "-2 1", 0.25, NLP_SOLVED, "23.1446611"},
  {"HS17", ROSENBROCK, "x2^2-x1; x1^2-x2", "", "-0.5:0.5 :1", "-2 1", 1.0, NLP_SOLVED, NULL},
  {"HS18", "0.01*x1^2+x2^2", "x1*x2-25; x1^2+x2^2-25", "", "2:50 0:50", "2 2", 5.0, NLP_SOLVED, NULL},
  {"HS19", "(x1-10)^3+(x2-20)^3", "(x1-5)^2+(x2-5)^2-100; -(x2-5)^2-(x1-6)^2+82.81", "", "13:100 0:100", "20.1 5.84",
    -6961.81387558, NLP_SOLVED, NULL},
  {"HS20", ROSENBROCK, "x1+x2^2; x1^2+x2; x1^2+x2^2-1", "", "-0.5:0.5 :", "-2 1", 38.1987298108, NLP_SOLVED,
    "40.1987302"},
  {"HS21", "0.01*x1^2+x2^2-100", "10*x1-x2-10", "", "2:50 -50:50", "-1 -1", -99.96, NLP_SOLVED, NULL},
  {"HS22", "(x1-2)^2+(x2-1)^2", "-x1-x2+2; -x1^2+x2", "", "", "2 2", 1.0, NLP_SOLVED, NULL},
  {"HS23", "x1^2+x2^2", "x1+x2-1; x1^2+x2^2-1; 9*x1^2+x2^2-9; x1^2-x2; x2^2-x1", "", "-50:50 -50:50", "3 1", 2.0,
    NLP_SOLVED, NULL},
  {"HS24", "((x1-3)^2-9)*x2^3/(27*sqrt(3))", "x1/sqrt(3)-x2; x1+sqrt(3)*x2; -x1-sqrt(3)*x2+6", "", "0: 0:", "1 0.5",
    -1.0, NLP_SOLVED, NULL},
  {"HS26", "(x1-x2)^2+(x2-x3)^4", "", "(1+x2^2)*x1+x3^4-3", "", "-2.6 2 2", 0.0, NLP_SOLVED, NULL},
  {"HS27", "0.01*(x1-1)^2+(x2-x1^2)^2", "", "x1+x3^2+1", "", "2 2 2", 0.04, NLP_SOLVED, NULL},
  {"HS28", "(x1+x2)^2+(x2+x3)^2", "", "x1+2*x2+3*x3-1", "", "-4 1 1", 0.0, NLP_SOLVED, NULL},
  {"HS29", "-x1*x2*x3", "-x1^2-2*x2^2-4*x3^2+48", "", "", "1 1 1", -22.6274169980, NLP_SOLVED, NULL},
  {"HS30", "x1^2+x2^2+x3^2", "x1^2+x2^2-1", "", "1:10 -10:10 -10:10", "1 1 1", 1.0, NLP_SOLVED, NULL},
  {"HS31", "9*x1^2+x2^2+9*x3^2", "x1*x2-1", "", "-10:10 1:10 -10:1", "1 1 1", 6.0, NLP_SOLVED, NULL},
  {"HS32", "(x1+3*x2+x3)^2+4*(x1-x2)^2", "6*x2+4*x3-x1^3-3", "1-x1-x2-x3", "0: 0: 0:", "0.1 0.7 0.2", 1.0, NLP_SOLVED,
    NULL},
  {"HS33", "(x1-1)*(x1-2)*(x1-3)+x3", "x3^2-x2^2-x1^2; x1^2+x2^2+x3^2-4", "", "0: 0: 0:5", "0 0 3", -4.58578643763,
    NLP_SOLVED, "-4"},
  {"HS34", "-x1", "x2-exp(x1); x3-exp(x2)", "", "0:100 0:100 0:10", "0 1.05 2.9", -0.834032445, NLP_SOLVED, NULL},
  {"HS35", HS35, "3-x1-x2-2*x3", "", "0: 0: 0:", "0.5 0.5 0.5", 0.111111111111, NLP_SOLVED, NULL},
  {"HS36", "-x1*x2*x3", "72-x1-2*x2-2*x3", "", "0:20 0:11 0:42", "10 10 10", -3300.0, NLP_SOLVED, NULL},
  {"HS37", "-x1*x2*x3", "72-x1-2*x2-2*x3; x1+2*x2+2*x3", "", "0:42 0:42 0:42", "10 10 10", -3456.0, NLP_SOLVED, NULL},
  {"HS38", "100*(x2-x1^2)^2+(1-x1)^2+90*(x4-x3^2)^2+(1-x3)^2+10.1*((x2-1)^2+(x4-1)^2)+19.8*(x2-1)*(x4-1)", "", "",
    "-10:10 -10:10 -10:10 -10:10", "-3 -1 -3 -1", 0.0, NLP_SOLVED, NULL},
  {"HS39", "-x1", "", "x2-x1^3-x3^2; x1^2-x2-x4^2", "", "2 2 2 2", -1.0, NLP_SOLVED, NULL},
  {"HS40", "-x1*x2*x3*x4", "", "x1^3+x2^2-1; x1^2*x4-x3; x4^2-x2", "", "0.8 0.8 0.8 0.8", -0.25, NLP_SOLVED, NULL},
  {"HS42", "(x1-1)^2+(x2-2)^2+(x3-3)^2+(x4-4)^2", "", "x1-2; x3^2+x4^2-2", "", "1 1 1 1", 13.8578643763, NLP_SOLVED,
    NULL},
  {"HS43", "x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4",
    "8-x1^2-x2^2-x3^2-x4^2-x1+x2-x3+x4; 10-x1^2-2*x2^2-x3^2-2*x4^2+x1+x4; 5-2*x1^2-x2^2-x3^2-2*x1+x2+x4", "", "",
    "0 0 0 0", -44.0, NLP_SOLVED, NULL},
  {"HS44", "x1-x2-x3-x1*x3+x1*x4+x2*x3-x2*x4", "8-x1-2*x2; 12-4*x1-x2; 12-3*x1-4*x2; 8-2*x3-x4; 8-x3-2*x4; 5-x3-x4", "",
    "0: 0: 0: 0:", "0 0 0 0", -15.0, NLP_SOLVED, "-3 -13"},
  {"HS45", "2-x1*x2*x3*x4*x5/120", "", "", "0:1 0:2 0:3 0:4 0:5", "2 2 2 2 2", 1.0, NLP_SOLVED, NULL},
  {"HS48", "(x1-1)^2+(x2-x3)^2+(x4-x5)^2", "", "x1+x2+x3+x4+x5-5; x3-2*(x4+x5)+3", "", "3 5 -3 2 -2", 0.0, NLP_SOLVED,
    NULL},
  {"HS49", "(x1-x2)^2+(x3-1)^2+(x4-1)^4+(x5-1)^6", "", "x1+x2+x3+4*x4-7; x3+5*x5-6", "", "10 7 2 -3 0.8", 0.0,
    NLP_SOLVED, NULL},
  {"HS50", "(x1-x2)^2+(x2-x3)^2+(x3-x4)^4+(x4-x5)^2", "", "x1+2*x2+3*x3-6; x2+2*x3+3*x4-6; x3+2*x4+3*x5-6", "",
    "35 -31 11 5 -5", 0.0, NLP_SOLVED, NULL},
  {"HS51", "(x1-x2)^2+(x2+x3-2)^2+(x4-1)^2+(x5-1)^2", "", "x1+3*x2-4; x3+x4-2*x5; x2-x5", "", "2.5 0.5 2 -1 0.5", 0.0,
    NLP_SOLVED, NULL},
  {"HS52", "(4*x1-x2)^2+(x2+x3-2)^2+(x4-1)^2+(x5-1)^2", "", "x1+3*x2; x3+x4-2*x5; x2-x5", "", "2 2 2 2 2",
    5.32664756447, NLP_SOLVED, NULL},
  {"HS53", "(x1-x2)^2+(x2+x3-2)^2+(x4-1)^2+(x5-1)^2", "", "x1+3*x2; x3+x4-2*x5; x2-x5",
    "-10:10 -10:10 -10:10 -10:10 -10:10", "2 2 2 2 2", 4.09302325581, NLP_SOLVED, NULL},
  {"HS60", "(x1-1)^2+(x1-x2)^2+(x2-x3)^4", "", "x1*(1+x2^2)+x3^4-4-3*sqrt(2)", "-10:10 -10:10 -10:10", "2 2 2",
    0.03256820025, NLP_SOLVED, NULL},
  {"HS61", "4*x1^2+2*x2^2+2*x3^2-33*x1+16*x2-24*x3", "", "3*x1-2*x2^2-7; 4*x1-x3^2-11", "", "0 0 0", -143.646142201,
    NLP_SOLVED, NULL},
  {"HS63", "1000-x1^2-2*x2^2-x3^2-x1*x2-x1*x3", "", "8*x1+14*x2+7*x3-56; x1^2+x2^2+x3^2-25", "0: 0: 0:", "2 2 2",
    961.715172127, NLP_SOLVED, NULL},
  {"HS64", "5*x1+50000/x1+20*x2+72000/x2+10*x3+144000/x3", "1-4/x1-32/x2-120/x3", "", "1e-5: 1e-5: 1e-5:", "1 1 1",
    6299.84242821, NLP_SOLVED, NULL},
  {"HS65", "(x1-x2)^2+(x1+x2-10)^2/9+(x3-5)^2", "48-x1^2-x2^2-x3^2", "", "-4.5:4.5 -4.5:4.5 -5:5", "-5 5 0",
    0.953528856757, NLP_SOLVED, NULL},
  {"HS66", "0.2*x3-0.8*x1", "x2-exp(x1); x3-exp(x2)", "", "0:100 0:100 0:10", "0 1.05 2.9", 0.518163274159, NLP_SOLVED,
    NULL},
  {"HS71", HS71, "x1*x2*x3*x4-25", "x1^2+x2^2+x3^2+x4^2-40", "1:5 1:5 1:5 1:5", "1 5 5 1", 17.0140172892, NLP_SOLVED,
    NULL},
  {"HS76", "x1^2+0.5*x2^2+x3^2+0.5*x4^2-x1*x3+x3*x4-x1-3*x2+x3-x4", "5-x1-2*x2-x3-x4; 4-3*x1-x2-2*x3+x4; x2+4*x3-1.5",
    "", "0: 0: 0: 0:", "0.5 0.5 0.5 0.5", -4.68181818182, NLP_SOLVED, NULL},
  {"HS77", "(x1-1)^2+(x1-x2)^2+(x3-1)^2+(x4-1)^4+(x5-1)^6", "", "x1^2*x4+sin(x4-x5)-2*sqrt(2); x2+x3^4*x4^2-8-sqrt(2)",
    "", "2 2 2 2 2", 0.241505128786, NLP_SOLVED, NULL},
  {"HS78", "x1*x2*x3*x4*x5", "", "x1^2+x2^2+x3^2+x4^2+x5^2-10; x2*x3-5*x4*x5; x1^3+x2^3+1", "", "-2 1.5 2 -1 -1",
    -2.91970040911, NLP_SOLVED, NULL},
  {"HS79", "(x1-1)^2+(x1-x2)^2+(x2-x3)^2+(x3-x4)^4+(x4-x5)^4", "",
    "x1+x2^2+x3^3-2-3*sqrt(2); x2-x3^2+x4+2-2*sqrt(2); x1*x5-2", "", "2 2 2 2 2", 0.0787768208538, NLP_SOLVED, NULL},
  {"HS80", "exp(x1*x2*x3*x4*x5)", "", "x1^2+x2^2+x3^2+x4^2+x5^2-10; x2*x3-5*x4*x5; x1^3+x2^3+1",
    "-2.3:2.3 -2.3:2.3 -3.2:3.2 -3.2:3.2 -3.2:3.2", "-2 2 2 -1 -1", 0.0539498477624, NLP_SOLVED, NULL},
  {"HS93",
    "0.0204*x1*x4*(x1+x2+x3)+0.0187*x2*x3*(x1+1.57*x2+x4)+0.0607*x1*x4*x5^2*(x1+x2+x3)+0.0437*x2*x3*x6^2*(x1+1.57*x2+"
    "x4)",
    "0.001*x1*x2*x3*x4*x5*x6-2.07; 1-0.00062*x1*x4*x5^2*(x1+x2+x3)-0.00058*x2*x3*x6^2*(x1+1.57*x2+x4)", "",
    "0: 0: 0: 0: 0: 0:", "5.54 4.4 12.02 11.82 0.702 0.852", 135.075961, NLP_SOLVED, NULL},
  {"HS100", "(x1-10)^2+5*(x2-12)^2+x3^4+3*(x4-11)^2+10*x5^6+7*x6^2+x7^4-4*x6*x7-10*x6-8*x7",
    "127-2*x1^2-3*x2^4-x3-4*x4^2-5*x5; 282-7*x1-3*x2-10*x3^2-x4+x5; 196-23*x1-x2^2-6*x6^2+8*x7; "
    "-4*x1^2-x2^2+3*x1*x2-2*x3^2-5*x6+11*x7",
    "", "", "1 2 0 4 0 1 1", 680.630057374, NLP_SOLVED, NULL},
  {"HS104", "0.4*x1^0.67*x7^-0.67+0.4*x2^0.67*x8^-0.67+10-x1-x2",
    "1-0.0588*x5*x7-0.1*x1; 1-0.0588*x6*x8-0.1*x1-0.1*x2; 1-4*x3/x5-2*x3^-0.71/x5-0.0588*x3^-1.3*x7; "
    "1-4*x4/x6-2*x4^-0.71/x6-0.0588*x4^-1.3*x8;"
    "0.4*x1^0.67*x7^-0.67+0.4*x2^0.67*x8^-0.67+10-x1-x2-0.1; 4.2-0.4*x1^0.67*x7^-0.67-0.4*x2^0.67*x8^-0.67-10+x1+x2",
    "", "0.1:10 0.1:10 0.1:10 0.1:10 0.1:10 0.1:10 0.1:10 0.1:10", "6 3 0.4 0.2 6 6 1 0.5", 3.95116343955, NLP_SOLVED,
    NULL},
  {"HS106", "x1+x2+x3",
    "1-0.0025*(x4+x6); 1-0.0025*(x5+x7-x4); 1-0.01*(x8-x5); x1*x6-833.33252*x4-100*x1+83333.333; "
    "x2*x7-1250*x5-x2*x4+1250*x4; x3*x8-1250000-x3*x5+2500*x5",
    "", "100:10000 1000:10000 1000:10000 10:1000 10:1000 10:1000 10:1000 10:1000", "5000 5000 5000 200 350 150 225 425",
    7049.24802053, NLP_SOLVED, NULL},
  {"HS108", "-0.5*(x1*x4-x2*x3+x3*x9-x5*x9+x5*x8-x6*x7)",
    "1-x3^2-x4^2; 1-x9^2; 1-x5^2-x6^2; 1-x1^2-(x2-x9)^2; 1-(x1-x5)^2-(x2-x6)^2; 1-(x1-x7)^2-(x2-x8)^2; "
    "1-(x3-x5)^2-(x4-x6)^2;"
    "1-(x3-x7)^2-(x4-x8)^2; 1-x7^2-(x8-x9)^2; x1*x4-x2*x3; x3*x9; -x5*x9; x5*x8-x6*x7",
    "", ": : : : : : : : 0:", "1 1 1 1 1 1 1 1 1", -0.866025403784, NLP_SOLVED, "-0.674981442 -0.671391168 -0.5"},
  {"HS113",
    "x1^2+x2^2+x1*x2-14*x1-16*x2+(x3-10)^2+4*(x4-5)^2+(x5-3)^2+2*(x6-1)^2+5*x7^2+7*(x8-11)^2+2*(x9-10)^2+(x10-7)^2+45",
    "105-4*x1-5*x2+3*x7-9*x8; -10*x1+8*x2+17*x7-2*x8; 8*x1-2*x2-5*x9+2*x10+12; -3*(x1-2)^2-4*(x2-3)^2-2*x3^2+7*x4+120; "
    "-5*x1^2-8*x2-(x3-6)^2+2*x4+40;"
    "-0.5*(x1-8)^2-2*(x2-4)^2-3*x5^2+x6+30; -x1^2-2*(x2-2)^2+2*x1*x2-14*x5+6*x6; 3*x1-6*x2-12*(x9-8)^2+7*x10",
    "", "", "2 3 5 5 1 2 7 3 6 10", 24.3062090681, NLP_SOLVED, NULL},

  /* Waechter and Biegler 2000: interior point methods without restoration end at a point that is not feasible */
  {"WB", "x1", "", "x1^2-x2-1; x1-x3-0.5", ": 0: 0:", "-2 3 1", 1.0, NLP_SOLVED, NULL},
  /* complementarity as a product: no multipliers are bounded */
  {"MPCC", "(x1-1)^2+(x2-1)^2", "-x1*x2", "", "0: 0:", "2 0.5", 1.0, NLP_DEGENERATE, NULL},
  /* one constraint twice, thrice */
  {"twice", "(x1+x2)^2+(x2+x3)^2", "", "x1+2*x2+3*x3-1; 2*x1+4*x2+6*x3-2", "", "-4 1 1", 0.0, NLP_SOLVED, NULL},
  {"thrice", HS35, "3-x1-x2-2*x3; 3-x1-x2-2*x3; 6-2*x1-2*x2-4*x3", "", "0: 0: 0:", "0.5 0.5 0.5", 0.111111111111,
    NLP_SOLVED, NULL},
  /* the Hessian is indefinite on a constraint stated twice, in units that scale both regularizations */
  {"twice0", TWICE, "", "x1+x2+x3-1; x1+x2+x3-1", "", "0.5 0.5 0.5", TWICE_OPTIMUM, NLP_SOLVED, NULL},
  {"twice4", "1e4*(" TWICE ")", "", "x1+x2+x3-1; x1+x2+x3-1", "", "0.5 0.5 0.5", 1e4 * TWICE_OPTIMUM, NLP_SOLVED, NULL},
  {"twice8", "1e8*(" TWICE ")", "", "x1+x2+x3-1; x1+x2+x3-1", "", "0.5 0.5 0.5", 1e8 * TWICE_OPTIMUM, NLP_SOLVED, NULL},
  {"twice-8", "1e-8*(" TWICE ")", "", "x1+x2+x3-1; x1+x2+x3-1", "", "0.5 0.5 0.5", 1e-8 * TWICE_OPTIMUM, NLP_SOLVED,
    NULL},
  {"twice rows", TWICE, "", "1e4*(x1+x2+x3-1); 1e4*(x1+x2+x3-1)", "", "0.5 0.5 0.5", TWICE_OPTIMUM, NLP_SOLVED, NULL},
  /* a gradient that has a zero at the start only */
  {"hyperbola", "x1^2+x2^2", "x1*x2-1", "", "", "0 2", 2.0, NLP_SOLVED, NULL},
  /* a point of inflection that Newton's steps halve the way to; an objective below its epigraph, and a product with a
     slack, that start on their bounds */
  {"inflection", "x1^3+x2^2", "5-x1", "", "", "1 1", 0.0, NLP_UNBOUNDED, NULL},
  {"inflection2", "x3", "5-x1; x3-(x1^3+x2^2)", "", "", "1 1 0", 0.0, NLP_UNBOUNDED, NULL},
  {"epigraph", "x3", "x3-(x1-x2)^4", "", "", "2 -1 81", 0.0, NLP_SOLVED, NULL},
  {"MPCC with a slack", "(x1-1)^2+(x2-1)^2", "", "-x1*x2-x3", "0: 0: 0:", "2 0.5 0", 1.0, NLP_REACHED, NULL},
  /* HS35 and HS71 with a variable fixed where the solution has it */
  {"fixed", HS35, "3-x1-x2-2*x3", "", "0: 0.777777777777778:0.777777777777778 0:", "0.5 0.5 0.5", 0.111111111111,
    NLP_SOLVED, NULL},
  {"fixed71", HS71, "x1*x2*x3*x4-25", "x1^2+x2^2+x3^2+x4^2-40", "1:1 1:5 1:5 1:5", "1 5 5 1", 17.0140172892, NLP_SOLVED,
    NULL},
  /* indefinite Hessians; Newton's method left to itself ends in the saddle of the first */
  {"saddle", "-x1^2+x2^2", "", "", "-1:2 -1:2", "0.5 0.1", -4.0, NLP_SOLVED, NULL},
  {"bilinear", "x1*x2", "", "", "-1:2 -1:3", "-0.5 1.5", -3.0, NLP_SOLVED, "-2"},
  {"bilinear2", "x1*x2", "", "", "-1:2 -1:3", "0.5 0.5", -3.0, NLP_SOLVED, "-2"},
  {"bilinear3", "x1*x2", "", "", "-1:2 -1:3", "0.1 -0.2", -3.0, NLP_SOLVED, "-2"},
  {"concave", "-x1^2-x2^2", "1-x1-x2", "", "0: 0:", "0.1 0.5", -1.0, NLP_SOLVED, NULL},
  /* stated in units far off */
  {"large", "1e8*((x1-2)^2+(x2-1)^2)", "1e8*(-x1-x2+2); 1e-8*(-x1^2+x2)", "", "", "2 2", 1e8, NLP_SOLVED, NULL},
  {"small", "1e-8*(" HS71 ")", "1e8*(x1*x2*x3*x4-25)", "1e-8*(x1^2+x2^2+x3^2+x4^2-40)", "1:5 1:5 1:5 1:5", "1 5 5 1",
    17.0140172892e-8, NLP_SOLVED, NULL},

  /* unknowns, rows and bounds whose sizes have nothing to do with one another: none is to be measured by that of
     another */
  {"HS54",
    "-exp(-(((x1-1e4)^2/6.4e7+(x1-1e4)*(x2-1)/2e4+(x2-1)^2)/0.96+(x3-2e6)^2/4.9e13+(x4-10)^2/2.5e3+(x5-1e-3)^2/"
    "2.5e-3+(x6-1e8)^2/2.5e17)/2)",
    "", "x1+4e3*x2-1.76e4", "0:2e4 -10:10 0:1e7 0:20 -1:1 0:2e8", "6e3 1.5 4e6 2 3e-3 5e7", -0.9080747577659853,
    NLP_SOLVED, NULL},
  {"HS74", "3*x1+1e-6*x1^3+2*x2+2e-6/3*x2^3", "x4-x3+0.55; x3-x4+0.55",
    "1000*sin(-x3-0.25)+1000*sin(-x4-0.25)+894.8-x1; 1000*sin(x3-0.25)+1000*sin(x3-x4-0.25)+894.8-x2; "
    "1000*sin(x4-0.25)+1000*sin(x4-x3-0.25)+1294.8",
    "0:1200 0:1200 -0.55:0.55 -0.55:0.55", "0 0 0 0", 5126.4981, NLP_SOLVED, NULL},
  {"HS98", "4.3*x1+31.8*x2+63.3*x3+15.8*x4+68.5*x5+4.7*x6",
    "17.1*x1+38.2*x2+204.2*x3+212.3*x4+623.4*x5+1495.5*x6-169*x1*x3-3580*x3*x5-3810*x4*x5-18500*x4*x6-24300*x5*x6-32."
    "97; 17.9*x1+36.8*x2+113.9*x3+169.7*x4+337.8*x5+1385.2*x6-139*x1*x3-2450*x4*x5-16600*x4*x6-17200*x5*x6-25.12; "
    "-273*x2-70*x4-819*x5+26000*x4*x5--124.08; 159.9*x1-311*x2+587*x4+391*x5+2198*x6-14000*x1*x6--173.02",
    "", "0:0.31 0:0.046 0:0.068 0:0.042 0:0.028 0:0.0134", "0 0 0 0 0 0", 3.1358091, NLP_SOLVED, "4.07124638"},
  {"far upper bounds", "(x1+1)^2+(x2+1)^2+(x3-1)^2", "", "", "0:1e9 0:1e9 0:1e9", "100 100 100", 2.0, NLP_SOLVED, NULL},
  {"gaps of 1e-3 and 1e6", "0.5*x1^2+0.5*x2^2-x1-x2", "", "", "0:0.001 0:1e6", "0.0005 1", -0.5009995, NLP_SOLVED,
    NULL},
  {"rows with gaps of 1e-3 and 1e6", "0.5*x1^2+0.5*x2^2-x1-x2", "0.001-x1; 1e6-x2; x1+1e6; x2", "", "", "0 0",
    -0.5009995, NLP_SOLVED, NULL},
  {"mixed units, QP", "(1e6*x1-3)^2+(1e-6*x2-2)^2", "3-1e6*x1-1e-6*x2", "", "", "0 0", 2.0, NLP_SOLVED, NULL},
  {"mixed units, HS35", "9-8e6*x1-6*x2-4e-6*x3+2e12*x1^2+2*x2^2+1e-12*x3^2+2e6*x1*x2+2*x1*x3", "3-1e6*x1-x2-2e-6*x3",
    "", "0: 0: 0:", "0.5e-6 0.5 0.5e6", 0.1111111111111111, NLP_SOLVED, NULL},
  /* a gradient that is zero everywhere, and constraints that all are active at the penalty step */
  {"constant objective, disc", "0", "1-x1^2-x2^2", "", "", "3 4", 0.0, NLP_SOLVED, NULL},
  {"line by two inequalities", "x1^2+x2^2", "x1+x2-1; 1-x1-x2", "", "", "2 0", 0.5, NLP_SOLVED, NULL},
  /* next to no curvature but in kinks: only what the bounds hold back says how large the barrier is to be */
  {"kinks in a box", "sqrt((x1-1)^2+1e-6)+sqrt((x2-2)^2+1e-6)", "3-x1-x2; x1-x2+4", "", "-4:4 -4:4", "-3 3.5", 2e-3,
    NLP_SOLVED, NULL},
  /* the filter remembers iterates of another valley, and lets hardly a step pass in this one */
  {"two decays in a ball",
    "(x1*exp(-x2^2*0.0)+x3*exp(-x4^2*0.0)-0.29299689032415976)^2"
    "+(x1*exp(-x2^2*0.3333333333333333)+x3*exp(-x4^2*0.3333333333333333)-1.050672629088706)^2"
    "+(x1*exp(-x2^2*0.6666666666666666)+x3*exp(-x4^2*0.6666666666666666)-1.2131996763103259)^2"
    "+(x1*exp(-x2^2*1.0)+x3*exp(-x4^2*1.0)-1.2335581739912609)^2"
    "+(x1*exp(-x2^2*1.3333333333333333)+x3*exp(-x4^2*1.3333333333333333)-1.258247635014007)^2"
    "+(x1*exp(-x2^2*1.6666666666666667)+x3*exp(-x4^2*1.6666666666666667)-1.3333475880257675)^2"
    "+(x1*exp(-x2^2*2.0)+x3*exp(-x4^2*2.0)-1.2646752941640136)^2"
    "+(x1*exp(-x2^2*2.3333333333333335)+x3*exp(-x4^2*2.3333333333333335)-1.2236341960973356)^2"
    "+(x1*exp(-x2^2*2.6666666666666665)+x3*exp(-x4^2*2.6666666666666665)-1.1923559168807798)^2"
    "+(x1*exp(-x2^2*3.0)+x3*exp(-x4^2*3.0)-1.1843070385749834)^2",
    "4-x1^2/4-x2^2/4-x3^2/4-x4^2/4", "", "-5:5 -5:5 -5:5 -5:5", "-1.465 2.2036 0.2897 -0.2183", 8.597992812278e-3,
    NLP_SOLVED, NULL},
  /* complementarity without an interior: a slack vanishes before mu does, and hypre meets a pivot of zero */
  {"jr2", "(x2-1)^2+x1^2", "x2; x2-x1; -(x2)*(x2-x1)", "", "", "0 0", 0.5, NLP_DEGENERATE, NULL},
  /* linear programs but for products of two unknowns, whose first steps do not lead to the interior */
  {"HS83", "5.3578547*x3^2+0.8356891*x1*x5+37.293239*x1-40792.141",
    "85.334407+0.0056858*x2*x5+0.0006262*x1*x4-0.0022053*x3*x5; "
    "92-85.334407-0.0056858*x2*x5-0.0006262*x1*x4+0.0022053*x3*x5;"
    "80.51249+0.0071317*x2*x5+0.0029955*x1*x2+0.0021813*x3^2-90; "
    "110-80.51249-0.0071317*x2*x5-0.0029955*x1*x2-0.0021813*x3^2;"
    "9.300961+0.0047026*x3*x5+0.0012547*x1*x3+0.0019085*x3*x4-20; "
    "25-9.300961-0.0047026*x3*x5-0.0012547*x1*x3-0.0019085*x3*x4",
    "", "78:102 33:45 27:45 27:45 27:45", "78 33 27 27 27", -30665.53867, NLP_SOLVED, NULL},
  {"HS84", "24345+8720288.849*x1-150512.5253*x1*x2+156.6950325*x1*x3-476470.3222*x1*x4-729482.8271*x1*x5",
    HS84A "; 294000-(" HS84A ");" HS84B "; 294000-(" HS84B ");" HS84C "; 277200-(" HS84C ")", "",
    "0:1000 1.2:2.4 20:60 9:9.3 6.5:7", "2.52 2 37.5 9.25 6.8", -5280335.1, NLP_SOLVED, NULL},
  /* complementarity (MacMPEC, Leyffer): a >= 0, b >= 0, a b <= 0 has no interior */
  {"bard1", "(x1-5)^2+(2*x2+1)^2",
    "3*x1-x2-3; x3; -(3*x1-x2-3)*x3; -x1+0.5*x2+4; x4; -(-x1+0.5*x2+4)*x4; -x1-x2+7; x5; -(-x1-x2+7)*x5",
    "2*(x2-1)-1.5*x1+x3-0.5*x4+x5", "0: 0: : : :", "0 0 0 0 0", 17.0, NLP_REACHED, NULL},
  {"jr1", "(x1-1)^2+x2^2", "x2; x2-x1; -(x2)*(x2-x1)", "", "", "0 0", 0.5, NLP_REACHED, NULL},
  {"ralph1", "2*x1-x2", "x2; x2-x1; -(x2)*(x2-x1)", "", "0: :", "1 0", 0.0, NLP_REACHED, NULL},
  /* from a symmetric start to a symmetric point that is a saddle */
  {"scale4", "(100*x1-1)^2+(100*x2-1)^2", "x1; x2; -x1*x2", "", "", "0.01 0.01", 1.0, NLP_REACHED, NULL},
  /* starts that are stationary, but maxima or saddles on the equality constraints */
  {"circle from its maximum", "x1", "", "x1^2+x2^2-1", "", "1 0", -1.0, NLP_SOLVED, NULL},
  {"sphere from its maximum", "-x1^2-2*x2^2-3*x3^2", "", "x1^2+x2^2+x3^2-1", "", "1 0 0", -3.0, NLP_SOLVED, NULL},
  {"line from its maximum", "-(x1-x2)^2+x3^2+x1+x2", "", "x1+x2-2", "-3:3 -3:3 :", "1 1 0", -14.0, NLP_SOLVED, NULL},
  {"circle and half-plane from the maximum", "x1+0.1*x2^2", "x2+2", "x1^2+x2^2-1", "", "1 0", -1.0, NLP_SOLVED, NULL},
  /* beside kinks there is no curvature, steps are far too long, and bounds or the line search cut them */
  {"zigzag",
    "sqrt((x1+0.845)^2+1e-6)+sqrt((x2-0.057)^2+1e-6)+sqrt((x3+1.12)^2+1e-6)+sqrt((x4+0.166)^2+1e-6)"
    "+sqrt((x5+0.228)^2+1e-6)+sqrt((x6-1.71)^2+1e-6)+sqrt((x7-1.3)^2+1e-6)+sqrt((x8+0.254)^2+1e-6)+0.01*x1^2",
    "1.42*x2-2.18*x6^2+0.71*x7+5.148; 1.42*x2-2.18*x6^2+0.71*x7+5.148; "
    "-0.3*x3+1.56*x5*x6+1.58*x1*x3-1.425; -0.3*x3+1.56*x5*x6+1.58*x1*x3-1.425; "
    "1.42*x5+2.81*x3+1.91*x7+0.7812; 1.42*x5+2.81*x3+1.91*x7+0.7812",
    "", "-4:4 -4:4 -4:4 -4:4 -4:4 -4:4 -4:4 -4:4", "-1.6467 2.3125 -0.1972 -1.819 -0.16 1.1706 -1.4589 -2.0449",
    0.15990086, NLP_SOLVED, NULL},
  /* the gradient of the constraint vanishes where it is met */
  {"x^2=0", "x1", "", "x1^2", "", "1", 0.0, NLP_REACHED, NULL},
  {"x^2=0 and y", "(x1-1)^2+(x2-2)^2", "", "x1^2", "", "1 1", 1.0, NLP_REACHED, NULL},
  /* the least value is attained nowhere */
  {"runs off", "exp(-2*x1)", "", "", "", "0", 0.0, NLP_SOLVED, NULL},

  {"apart", "x1^2", "x1-1; -x1", "", "", "0.5", 0.0, NLP_INFEASIBLE, NULL},
  {"nowhere", "x1", "-x1^2-1", "", "", "3", 0.0, NLP_INFEASIBLE, NULL},
  {"circles", "x1+x2", "", "x1^2+x2^2-1; (x1-3)^2+x2^2-1", "", "1 1", 0.0, NLP_INFEASIBLE, NULL},
  /* multipliers of equality constraints that cannot be met outgrow everything */
  {"square of -1", "x1", "", "x1^2+1", "", "2", 0.0, NLP_INFEASIBLE, NULL},
  {"bounded out", "x1", "", "x1+x2-3", "0:1 0:1", "0.5 0.5", 0.0, NLP_INFEASIBLE, NULL},
  /* the violation is least where a bound stops it */
  {"stopped", "x1", "0.25-exp(2*x1)", "", "0:", "1.5", 0.0, NLP_INFEASIBLE, NULL},
  /* and here far from zero, where the curvature of the constraints counts as much as their gradients */
  {"symmetric functions", "0", "", "x1+x2+x3-0.1; x1*x2+x2*x3+x3*x1; x1*x2*x3-2", "", "1 0.5 -1", 0.0, NLP_INFEASIBLE,
    NULL},
  {"line", "-x1", "", "", "0:", "1", 0.0, NLP_UNBOUNDED, NULL},
  {"cubic", "x1^3", "", "", "", "-1", 0.0, NLP_UNBOUNDED, NULL},
  {"ray", "-x1-x2", "x1-x2^2+4", "", "", "1 1", 0.0, NLP_UNBOUNDED, NULL},
  /* steps along the parabola become too short long before the objective has fallen far */
  {"parabola", "-x1-x2", "x2^2-x1", "", "", "0 1", 0.0, NLP_UNBOUNDED, NULL},
  /* CUTEst: the unknowns start at a bound, where the objective has hardly any curvature */
  {"EXPLIN",
    "exp(0.1*x1*x2)+exp(0.1*x2*x3)+exp(0.1*x3*x4)+exp(0.1*x4*x5)+exp(0.1*x5*x6)-10*x1-20*x2-30*x3-40*x4-50*x5-60*x6-70*"
    "x7-80*x8-90*x9-100*x10",
    "", "", "0:10 0:10 0:10 0:10 0:10 0:10 0:10 0:10 0:10 0:10", "0 0 0 0 0 0 0 0 0 0", -4775.211148206, NLP_SOLVED,
    NULL},
  /* CUTEst: the unknowns grow a thousandfold, to their bounds, where the Hessian needs a shift */
  {"QRTQUAD", "0.01*(x1*x2)^4+0.02*(x2*x3)^4+0.03*(x3*x4)^4+0.04*(x4*x5)^4-10*x1-20*x2-30*x3-40*x4-50*x5", "", "",
    "0:10 0:10 0:10 0:10 0:10", "0 0 0 0 0", -911.1108296716, NLP_SOLVED, NULL},
  /* EIGMINA of CUTEst: at each eigenvector a bound touches the sphere. Each eigenvalue is a local minimum. */
  {"eigenvalue", "x6", "", "x1^2+x2^2+x3^2+x4^2+x5^2-1; x1*x6-1*x1; x2*x6-2*x2; x3*x6-3*x3; x4*x6-4*x4; x5*x6-5*x5",
    "-1:1 -1:1 -1:1 -1:1 -1:1 :", "1 1 1 1 1 2", 1.0, NLP_SOLVED, "2 3 4 5"},
  /* Newton's method passes a point whose violation is negligible beside that at the start only */
  {"square root from afar", "0", "", "1000*(x1^2-2)", "", "5791.816135971869", 0.0, NLP_SOLVED, NULL},
  /* the objective is small at the start alone */
  {"long lever", "-x1*x2", "", "x1-1e3*x3; x2-1e3*x3; x3^2+x4^2-1", "", "1e-5 1e-5 0 0.5", -1e6, NLP_SOLVED, NULL},
  /* CUTEst: the watchdog reaches the solution, ten shortened steps after the start */
  {"HATFLDFLNE", "0", "", "x1+x2*x3-0.032; x1+x2*x3^2-0.056; x1+x2*x3^3-0.099", "", "1.2 -1.2 0.98", 0.0, NLP_SOLVED,
    NULL},
  /* CUTEst: the Hessian is so badly conditioned that Newton's method must be exact */
  {"PALMER6E",
    "(x1+0*x2+0*x3+0*x4+0*x5+0*x6+x8*exp(-0*x7)-10.678659)^2"
    "+(x1+2.46740007362*x2+6.08806312328*x3+15.0216873986*x4+37.064512593*x5+91.4529811006*x6"
    "+x8*exp(-2.46740007362*x7)-75.414511)^2"
    "+(x1+1.94955036517*x2+3.80074662633*x3+7.40974697328*x4+14.4456749176*x5+28.1625708106*x6"
    "+x8*exp(-1.94955036517*x7)-41.513459)^2"
    "+(x1+1.4926241929*x2+2.22792698123*x3+3.3254577122*x4+4.96365863369*x5+7.40887696195*x6"
    "+x8*exp(-1.4926241929*x7)-20.104735)^2"
    "+(x1+1.0966236512*x2+1.20258343238*x3+1.31878143449*x4+1.44620691183*x5+1.58594470405*x6"
    "+x8*exp(-1.0966236512*x7)-7.432436)^2"
    "+(x1+0.761544202225*x2+0.579949571943*x3+0.441657234096*x4+0.336341505996*x5+0.256138923859*x6"
    "+x8*exp(-0.761544202225*x7)-1.298082)^2"
    "+(x1+0.616850018404*x2+0.380503945205*x3+0.234713865603*x4+0.144783252317*x5+0.0893095518561*x6"
    "+x8*exp(-0.616850018404*x7)-0.171300)^2"
    "+(x1+0.536979718521*x2+0.288347218103*x3+0.154836608013*x4+0.0831441181877*x5+0.0446467051811*x6"
    "+x8*exp(-0.536979718521*x7)-0)^2"
    "+(x1+0.487388289424*x2+0.237547344668*x3+0.115777793975*x4+0.0564287409587*x5+0.0275027075302*x6"
    "+x8*exp(-0.487388289424*x7)-0.068203)^2"
    "+(x1+0.373156048225*x2+0.139245436327*x3+0.0519602767531*x4+0.0193892915379*x5+0.00723523140815*x6"
    "+x8*exp(-0.373156048225*x7)-0.774499)^2"
    "+(x1+0.274155912801*x2+0.0751614645237*x3+0.020605959914*x4+0.00564924574935*x5+0.00154877412505*x6"
    "+x8*exp(-0.274155912801*x7)-2.070002)^2"
    "+(x1+0.121847072356*x2+0.0148467090417*x3+0.00180902803086*x4+0.00022042476937*x5+2.68581128224e-05*x6"
    "+x8*exp(-0.121847072356*x7)-5.574556)^2"
    "+(x1+0.030461768089*x2+0.000927919315108*x3+2.82660629821e-05*x4+8.61034255351e-07*x5+2.62286258032e-08*x6"
    "+x8*exp(-0.030461768089*x7)-9.026378)^2",
    "", "", ": : : : : : 0: :", "1 1 1 1 1 1 1 1", 0.000223955033980, NLP_SOLVED, NULL},
  /* a bounded objective that falls from -1e-4 to -7e11; two of the seven stages */
  {"HS99EXP", "-x6^2", "",
    "405000*cos(x1)-x2; 405000*sin(x1)-x4-129600; 405000*sin(x1)-x3-129600; x2+405000*cos(x5)-x6; "
    "x4+4050*x3+405000*sin(x5)-x8-100000; x3+405000*sin(x5)-x7-1000",
    "0:1.58 : : : 0:1.58 : : :", "0.5 0 0 0 0.5 0 0 0", -656100000000.0, NLP_SOLVED, NULL},
  /* the longest step inside the bounds is a tiny fraction of the direction */
  {"concave", "-2*x1^2+x1-3*x2^2+x2", "", "", "-1e5:1e6 -1e5:1e6", "1 1", -4999998000000.0, NLP_SOLVED, NULL},
  {"empty_row", "(x1-1)^2+x2^2", "0*x1", "", "", "3 2", 0.0, NLP_SOLVED, NULL},
};

#endif
