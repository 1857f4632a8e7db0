"""Tilted working planes: their zero and turn from the words of G68.2, G68.4 and CYCLE800. A plane is
(zero, columns): a point p of the plane stands in the workpiece frame at zero + p0 columns[0] + p1 columns[1] + p2 columns[2], in mm."""

import math

from space import add, dot, scale, sub, turn

FLAT = ((0.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))


def turned(zero, turns):
    """Turns about axis 0, 1 or 2 of the plane as it stands after the turns before, in degrees."""
    columns = FLAT[1]
    for axis, degrees in turns:
        columns = tuple(turn(columns[axis], math.radians(degrees), c) for c in columns)
    return (zero, columns)


def within(outer, inner):
    """A plane told in the coordinates of another one."""
    return (to_work(outer, inner[0]), tuple(sub(to_work(outer, c), outer[0]) for c in inner[1]))


def to_work(plane, p):
    zero, columns = plane
    return add(zero, add(scale(columns[0], p[0]), add(scale(columns[1], p[1]), scale(columns[2], p[2]))))


def to_plane(plane, q):
    zero, columns = plane
    return tuple(dot(c, sub(q, zero)) for c in columns)


def euler(zero, i, j, k):
    """G68.2: about Z, the turned X, the turned Z (kinematics notes, section 10)."""
    return turned(zero, ((2, i), (0, j), (2, k)))


def cycle800(mode, angles, before, after):
    """MODE tells by two bits each, from the lowest, about which axis (1 X, 2 Y, 3 Z) the first, second, third turn goes; None for other
    readings of the angles (solid, projected, direct). `before`, `after`: shifts in the old and in the new plane."""
    if mode >> 6:
        return None
    order = [(mode >> shift) & 3 for shift in (0, 2, 4)]
    if 0 in order:
        return None
    about = turned((0.0, 0.0, 0.0), [(axis - 1, angle) for axis, angle in zip(order, angles)])
    return within((before, about[1]), (after, FLAT[1]))
