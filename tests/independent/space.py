"""Vectors and rotations in space: tuples of three numbers, matrices as tuples of rows. Angles in radians."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(a, 1 / norm(a))


def mix(a, b, t):
    """The point at share t of the way from a to b."""
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def angle(a, b):
    """Angle between two directions, in radians, exact also near 0 and pi."""
    return math.atan2(norm(cross(a, b)), dot(a, b))


def turn(axis, t, v):
    """The vector v turned about the unit vector axis by t, right-handed (Rodrigues)."""
    c, s = math.cos(t), math.sin(t)
    return add(add(scale(v, c), scale(cross(axis, v), s)), scale(axis, dot(axis, v) * (1 - c)))


def solve3(columns, right):
    """x with columns[0] x0 + columns[1] x1 + columns[2] x2 = right (Cramer)."""
    a, b, c = columns
    det = dot(a, cross(b, c))
    return (dot(right, cross(b, c)) / det, dot(a, cross(right, c)) / det, dot(a, cross(b, right)) / det)


def great_circle(u0, u1, t):
    """The unit vector at share t of the angle from u0 to u1; the two must not be opposite."""
    whole = angle(u0, u1)
    if whole < 1e-12:
        return u1
    return unit(add(scale(u0, math.sin((1 - t) * whole)), scale(u1, math.sin(t * whole))))


def to_segment(p, a, b):
    """Distance of the point p to the segment from a to b."""
    way = sub(b, a)
    length2 = dot(way, way)
    t = 0.0 if length2 == 0 else max(0.0, min(1.0, dot(sub(p, a), way) / length2))
    return norm(sub(p, add(a, scale(way, t))))
