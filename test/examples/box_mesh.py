# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that checks make for themselves, as texts of OFF."""


def off(vertices, faces):
    return "OFF\n%d %d 0\n" % (len(vertices), len(faces)) + "".join("%r %r %r\n" % tuple(v) for v in vertices) + \
        "".join("3 %d %d %d\n" % tuple(f) for f in faces)


def box(n, size=(2.0, 2.0, 2.0)):
    """A box about the origin, each side cut into n x n squares of two triangles."""
    number, faces = {}, []

    def vertex(i, j, k):
        return number.setdefault((i, j, k), len(number))

    def square(a, b, c, d):
        faces.extend([(a, b, c), (a, c, d)])

    for i in range(n):
        for j in range(n):
            square(*(vertex(x, y, n) for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
            square(*(vertex(x, y, 0) for x, y in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(n, y, z) for y, z in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
            square(*(vertex(0, y, z) for y, z in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(x, n, z) for x, z in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))))
            square(*(vertex(x, 0, z) for x, z in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))))
    return off([[s * (c / n - 0.5) for s, c in zip(size, v)] for v in number], faces)
