"""The history of a run, <basename>.csv: lists of numbers by the names of the columns."""
import csv


def history(name):
    with open(name + ".csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: [float(row[key]) for row in rows] for key in rows[0]}
