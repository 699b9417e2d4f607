"""Judges plasticity.sh: forces of bars, the plastic zone, residual stress and collapse of a tube"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "tests", "lib"))
import h5py
from summaries import load, say, say_same_steps

E, NU = 200.0, 0.3


class Bar:
    """Stress of a bar that is strained from state to state: radial return of one number"""

    def __init__(self, stress, kinematic):
        self.stress, self.kinematic, self.p, self.alpha = stress, kinematic, 0.0, 0.0

    def strain(self, e):
        trial = E * (e - self.p) - self.kinematic * self.p
        low, high = 0.0, abs(trial) / E
        for _ in range(200):
            d = (low + high) / 2
            if abs(trial) - (E + self.kinematic) * d > self.stress(self.alpha + d): low = d
            else: high = d
        self.p += math.copysign(low, trial)
        self.alpha += low
        return E * (e - self.p)


def table(a):
    return 0.2 + 25 * min(a, 0.002) + 6.25 * min(max(a - 0.002, 0), 0.008)


def bars(name, factors=(0.1, 1, 0.9, -1, 1.5)):
    made = {
        "full": Bar(lambda a: 0.2 + 10 * a, 20),
        "bbar": Bar(lambda a: 0.2, 20),
        "modes": Bar(lambda a: 0.2 + 0.1 * (1 - math.exp(-100 * a)), 5),
        "second": Bar(table, 0),
        "both": Bar(lambda a: 0.2 + 10 * a, 20),
        "elastic": Bar(lambda a: 1e6, 0),
        "hot": Bar(lambda a: 0.2 + 10 * a, 20),
    }
    errors, strains, work = {}, {}, []
    for step, factor in zip(load(name)["steps"], factors):
        forces = {
            face["name"].split(".")[0]: face["reaction"][0]
            for face in step["faces"]
            if face["name"].endswith("xmax")
        }
        largest = {body["name"]: body["plastic_strain"] for body in step["bodies"]}
        for bar, law in made.items():
            exact = law.strain(factor * (-0.003 if bar == "hot" else 0.005))
            errors[bar] = max(errors.get(bar, 0), abs(forces[bar] - exact) / 0.2)
            strains[bar] = max(strains.get(bar, 0), abs(largest[bar] - law.alpha))
        work.append(step["plastic_work"])
    return errors, strains, work


for ranks in (1, 2, 3):
    errors, strains, work = bars("bars%d" % ranks)
    say("bars on %d ranks: forces of the closed form" % ranks, max(errors.values()) < 1e-7, errors)
    say("  and their equivalent plastic strains", max(strains.values()) < 1e-9, strains)
    say("  plastic work grows while they yield",
        all(b > a for a, b in zip(work[1:2] + work[3:], work[3:])) and work[0] == 0 and abs(work[2] - work[1]) < 1e-12,
        work)

compared = ("energy", "plastic_work", "plastic_strain")
for ranks in (1, 3):
    say_same_steps("restarted on %d ranks: the same" % ranks, load("part%d" % ranks), load("whole"), compared, 1e-9)
say_same_steps("restarted on a refined mesh, 2 ranks: the same, since the strain is uniform", load("finer"),
               load("whole"), compared, 1e-7)

k, a, b, G = 1.0, 1.0, 2.0, 1000 / 2 / 1.4999


def border(p):
    """Radius of the plastic zone under a pressure, by Hill"""
    low, high = a, b
    for _ in range(100):
        c = (low + high) / 2
        if 2 * k * math.log(c / a) + k * (1 - c * c / b / b) < p: low = c
        else: high = c
    return c


def widening(p):
    """Displacement outside: elastic up to the first yield, then k c^2/(2 G b)"""
    limit = k * (1 - a * a / b / b)
    return k * a * a / (2 * G * b) * p / limit if p <= limit else k * border(p)**2 / (2 * G * b)


tube = load("tube")["steps"]
outside = [step["probes"][0]["displacement"][0] for step in tube]
pressures = [0.74, 0.9, 1.1, 1.3]
say("tube below its elastic limit does not yield", tube[0]["plastic_strain"] == 0, tube[0]["plastic_strain"])
off = [u / widening(p) - 1 for u, p in zip(outside, pressures)]
say("widened as its plastic zone grows, to 1 %", max(map(abs, off)) < 1e-2, off)
hoop = 2 * k - 1.3 - 1.3 * (a * a + b * b) / (b * b - a * a)
found = tube[4]["probes"][1]["stress_yy"]
say("residual hoop stress at the bore, to 8 % on 16 cells", abs(found / hoop - 1) < 0.08, (found, hoop))
residual = outside[3] - k * a * a / (2 * G * b) * 1.3 / 0.75
say("residual widening", abs(outside[4] / residual - 1) < 1e-2, (outside[4], residual))
say("unloading does no plastic work",
    abs(tube[4]["plastic_work"] / tube[3]["plastic_work"] - 1) < 1e-9,
    (tube[4]["plastic_work"], tube[3]["plastic_work"]))
say("balance: work is stored or plastic, to 2 %",
    all(abs((s["energy"] + s["plastic_work"]) / s["work"] - 1) < 0.02 for s in tube[:4]),
    [(s["energy"], s["plastic_work"], s["work"]) for s in tube])
refined, fine = load("refined")["steps"], load("fine")["steps"]
ends = [[steps[-1][key]
         for key in ("plastic_work", "plastic_strain")] + steps[-1]["probes"][0]["displacement"][:1]
        for steps in (refined, tube, fine)]
say("plastic strains on a refined mesh: after unloading as on the first mesh to 1 %",
    len(refined) == 1 and all(abs(x / y - 1) < 1e-2 for x, y in zip(*ends[:2])), ends)
with h5py.File("tube_0004.h5") as file:
    strain, equivalent = file["plastic_strain"][:], file["equivalent_plastic_strain"][:]
say(
    "fields: plastic strain without volume, zero outside the plastic zone",
    abs(strain[:, 0] + strain[:, 3] + strain[:, 5]).max() < 1e-12 and (equivalent > 0).mean() > 0.5
    and equivalent.min() == 0 and equivalent.max() <= tube[3]["plastic_strain"], (equivalent.min(), equivalent.max()))

for name in "collapse", "modes":
    end = load(name)["steps"][-1]
    held = 1.36 + 0.06 * (end["reason"] and float(end["reason"].rsplit(" ", 1)[1]) - 2)
    failed = 1.36 + 0.06 * (float(end["reason"].split("time ")[1].split(":")[0]) - 2)
    limit = 2 * k * math.log(b / a)
    say(name + ": collapse pressure between what was held and what was not, to 1 %", held < 1.01 * limit
        and failed > 0.99 * limit and failed - held < 0.01, (held, limit, failed))
    say("Newton steps until then below 100", end["ip_iterations"] < 100, end["ip_iterations"])
