"""Steps of a deck, and histories of the loads and displacements that they prescribe."""
import numpy as np

MAX_LOAD_STEPS = 20  # of a static step, unless its increments are fixed by DIRECT
STICKS = 1e3  # from this coefficient on friction sticks


class Step:
    """A static or dynamic step. n: its load steps; period: its duration"""

    def __init__(self, where, nlgeom):
        self.where, self.nlgeom = where, nlgeom
        self.kind, self.period, self.n, self.increment = None, 1.0, 1, None

    def set_static(self, numbers, direct):
        self.kind = "static"
        increment, period = [value or 1.0 for value in (list(numbers) + [None, None])[:2]]
        self.period = period
        steps = max(1, int(np.ceil(period / increment - 1e-9)))
        self.n = steps if direct else min(steps, MAX_LOAD_STEPS)

    def set_dynamic(self, numbers, explicit):
        self.kind = "dynamic"
        increment, period, _, largest = (list(numbers) + [None] * 4)[:4]
        self.period = period or 1.0
        self.increment = largest or (increment if increment and not explicit else self.period / 100)
        self.increment = max(self.increment, self.period / 1000)
        self.n = max(1, int(np.ceil(self.period / self.increment - 1e-9)))

    def times(self):
        """Times of the ends of the load steps within the step"""
        return [self.period * (k + 1) / self.n for k in range(self.n)]


class Amplitude:
    """A table of times and values. total: times since the start of the deck, not of the step"""

    def __init__(self, pairs, total):
        self.times, self.values = zip(*sorted(pairs))
        self.total = total

    def at(self, time, start):
        return float(np.interp(time + (start if self.total else 0.0), self.times, self.values))


class Histories:
    """{key: values at the ends of all load steps} of what one keyword prescribes. A key keeps its value, or its
    amplitude, until it is given anew; removed keys return to 0"""

    def __init__(self):
        self.values, self.now, self.rule, self.lines = {}, {}, {}, {}
        self.starts = {}

    def give(self, key, value, amplitude, where):
        self.rule[key] = (value, amplitude)
        self.lines.setdefault(key, where)

    def remove(self, key):
        self.rule[key] = (0.0, None)

    def advance(self, step, begin, start, given):
        """Appends the values in the load steps of a step. begin: number of load steps before it; given: keys that the
        step gives or removes"""
        for key, (value, amplitude) in self.rule.items():
            table = self.values.setdefault(key, [0.0] * begin)
            last = self.now.get(key, 0.0)
            for time in step.times():
                if amplitude is not None:
                    table.append(value * amplitude.at(time, start))
                elif key in given and step.kind == "static":
                    table.append(last + (value - last) * time / step.period)
                else:
                    table.append(value)
            if begin == 0:
                at_once = value if amplitude is None else value * amplitude.at(0.0, 0.0)
                self.starts[key] = at_once if step.kind == "dynamic" else 0.0
            self.now[key] = table[-1]


class Ramps:
    """Ramps by their factors, each with a name. The ramp of the scene itself, `load`, has none"""

    def __init__(self, steps):
        n = sum(step.n for step in steps)
        dynamic = steps[0].kind == "dynamic"
        self.names = {tuple([1.0] * (n + 1) if dynamic else np.round(np.arange(n + 1) / n, 12)): None}
        self.factors = []

    def split(self, values, start=0.0):
        """(value at factor 1, name of the ramp)"""
        values = np.array([start, *values], float)
        size = max(values, key=abs)
        if size == 0.0:
            return 0.0, None
        return float(size), self.name(values / size)

    def name(self, factors):
        """The name of the ramp with these factors at the start and at the ends of the load steps"""
        key = tuple(np.round(factors, 12))
        if key not in self.names:
            self.names[key] = f"ramp_{len(self.factors) + 1}"
            self.factors.append((self.names[key], key))
        return self.names[key]
