"""What the checks of contact's summaries share."""
import json


def load(name):
    with open(name + ".json") as file:
        return json.load(file)


def say(what, good, seen):
    print(what + (": yes" if good else ": NO, " + str(seen)))


def within(value, target, tolerance):
    return abs(value - target) <= tolerance * abs(target)


def mean(values):
    return sum(values) / len(values)


def each(run, key):
    return [step[key] for step in run["steps"]]
