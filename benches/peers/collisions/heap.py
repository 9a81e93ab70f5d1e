"""How far a heap of discs is from rest in its bowl: the greatest depth of a disc in another or in the bowl, in m, and the greatest speed."""

import math

RADIUS, BOWL = 0.05, 0.5
# Engines without hollow shapes get the lower half of the bowl as a polygon about it, with so many sides; its corners lie 0.08 mm outside.
SIDES = 90


def normals():
    """Unit vectors from the centre to the middle of each side."""
    angles = (math.pi * (1 + (k + 0.5) / SIDES) for k in range(SIDES))
    return [(math.cos(angle), math.sin(angle)) for angle in angles]


def measured(x, y, u, v, is_polygon=False):
    if is_polygon:
        depths = [max(a * p + b * q for p, q in normals()) + RADIUS - BOWL for a, b in zip(x, y)]
    else:
        depths = [math.hypot(*at) + RADIUS - BOWL for at in zip(x, y)]
    places = list(zip(x, y))
    for i, (a, b) in enumerate(places):
        depths += [2 * RADIUS - math.hypot(a - c, b - d) for c, d in places[i + 1 :]]
    return [max(0.0, *depths), max(math.hypot(*rate) for rate in zip(u, v))]
