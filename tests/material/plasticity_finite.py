"""Judges plasticity_finite.sh: forces of bars, the widening of a tube, order of Newton's method"""
import math
import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "tests", "lib"))
import h5py
from summaries import load, say, say_same_steps

E, NU = 200.0, 0.3
MU, KAPPA = E / 2 / (1 + NU), E / 3 / (1 - 2 * NU)


class Bar:
    """Force of a bar with section 1 at a stretch. Kirchhoff stress t along it: kappa J (J - 1) = t/3"""

    def __init__(self, stress, kinematic=0.0):
        self.stress, self.kinematic, self.p, self.alpha = stress, kinematic, 0.0, 0.0

    def logarithm(self, t, p):
        return p + t / (3 * MU) + math.log(0.5 + math.sqrt(0.25 + t / (3 * KAPPA))) / 3

    def force(self, stretch):
        sign = 1 if math.log(stretch) > self.logarithm(self.kinematic * self.p, self.p) else -1
        t = lambda d: self.kinematic * (self.p + sign * d) + sign * self.stress(self.alpha + d)
        low, high = 0.0, 3.0
        for _ in range(200):
            d = (low + high) / 2
            if sign * (math.log(stretch) - self.logarithm(t(d), self.p + sign * d)) > 0: low = d
            else: high = d
        result = t(low) / stretch
        self.p += sign * low
        self.alpha += low
        return result


def bars(name):
    made = {
        "full": Bar(lambda a: 0.2 + 4 * a),
        "bbar": Bar(lambda a: 0.2 + 2 * a, 1.5),
        "second": Bar(lambda a: 0.2 + 4 * a + 0.4 * (1 - math.exp(-a))),
        "both": Bar(lambda a: 0.2 + 5 * min(a, 0.2) + 4 * max(a - 0.2, 0)),
    }
    forces, strains = {}, {}
    for step, factor in zip(load(name)["steps"], (0.5, 1, 0.6, 0.2, -0.2)):
        found = {
            face["name"].split(".")[0]: face["reaction"][0]
            for face in step["faces"]
            if face["name"].endswith("xmax")
        }
        largest = {body["name"]: body["plastic_strain"] for body in step["bodies"]}
        for bar, law in made.items():
            exact = law.force(1 + factor * (0.25 if bar == "both" else 1))
            forces[bar] = max(forces.get(bar, 0), abs(found[bar] / exact - 1))
            strains[bar] = max(strains.get(bar, 0), abs(largest[bar] - law.alpha))
    return forces, strains


for ranks in (1, 3):
    forces, strains = bars("bars%d" % ranks)
    say("bars of up to twice their length, pushed back, on %d ranks: forces of the closed form" % ranks,
        max(forces.values()) < 1e-7, forces)
    say("  and their equivalent plastic strains", max(strains.values()) < 1e-8, strains)

for ranks in (1, 2):
    say_same_steps("restarted on %d ranks: the same" % ranks, load("part%d" % ranks), load("whole"),
                   ("energy", "plastic_work", "plastic_strain"), 1e-8)

# rigid-plastic tube: r^2 - R^2 = a^2 - 1; the pressures are those of a = 1.1 and a = 1.3
exact = [math.sqrt(4 + a * a - 1) - 2 for a in (1.1, 1.3)]
for name, cells, limit in ("bbar", "12 cells", 0.02), ("order2", "6 cells of order 2", 0.02):
    found = [step["probes"][0]["displacement"][0] for step in load(name)["steps"][1:]]
    say("tube of %s widened by 8 %%: to 2 %%" % cells, all(abs(u / v - 1) < limit for u, v in zip(found, exact)),
        (found, exact))
found = load("full")["steps"][2]["probes"][0]["displacement"][0]
say("full integration locks: less than half of it", found < 0.5 * exact[1], found)
tube = load("bbar")["steps"]
say("balance: work is stored or plastic, to 8 % in three steps",
    abs((tube[2]["energy"] + tube[2]["plastic_work"]) / tube[2]["work"] - 1) < 0.08,
    (tube[2]["energy"], tube[2]["plastic_work"], tube[2]["work"]))
with h5py.File("tube_0002.h5") as file:
    equivalent = file["equivalent_plastic_strain"][:]
exact = 2 / math.sqrt(3) * math.log(1.3)
say("plastic strain at the bore, 2/sqrt(3) ln(1.3), to 6 % in the first of 12 cells",
    abs(tube[2]["plastic_strain"] / exact - 1) < 0.06 and equivalent.max() < exact, (tube[2]["plastic_strain"], exact))

steps = open("newton.txt").read().split("Load step")[1]
lengths = [float(row.split()[5]) for row in steps.splitlines() if re.match(r" +[1-9]", row)]
order = math.log(lengths[-1] / lengths[-2]) / math.log(lengths[-2] / lengths[-3])
say("Newton's method: order of the last steps above 1.5", order > 1.5, (order, lengths))
