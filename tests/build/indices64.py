"""Writes the matrices and vectors of PETSc's binary files as a PETSc with 64-bit integers reads them: python3
indices64.py FILE..."""
import sys

import numpy

VEC, MAT = 1211214, 1211216


def objects(data):
    """(integers, values) of each object in a file of 32-bit integers"""
    at = 0
    while at < len(data):

        def integers(n):
            nonlocal at
            at += 4 * n
            return numpy.frombuffer(data, ">i4", n, at - 4 * n)

        head = integers(2)
        if head[0] == MAT:
            head = numpy.append(head, integers(2))  # class, rows, columns, nonzeros
            n, head = head[3], numpy.append(head, integers(head[1]))
            head = numpy.append(head, integers(n))
        elif head[0] == VEC:
            n = head[1]
        else:
            raise SystemExit(f"neither a matrix nor a vector: class {head[0]}")
        yield head, numpy.frombuffer(data, ">f8", n, at)
        at += 8 * n


for name in sys.argv[1:]:
    with open(name, "rb") as file:
        content = list(objects(file.read()))
    with open(name, "wb") as file:
        for head, values in content:
            file.write(head.astype(">i8").tobytes() + values.tobytes())
