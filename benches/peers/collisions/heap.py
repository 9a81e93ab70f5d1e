"""How far a heap of discs is from rest in its bowl: the greatest depth of a disc in another or in the bowl, in m, and the greatest speed."""

import math

RADIUS, BOWL = 0.05, 0.5


def measured(x, y, u, v):
    depths = [math.hypot(*at) + RADIUS - BOWL for at in zip(x, y)]
    places = list(zip(x, y))
    for i, (a, b) in enumerate(places):
        depths += [2 * RADIUS - math.hypot(a - c, b - d) for c, d in places[i + 1 :]]
    return [max(0.0, *depths), max(math.hypot(*rate) for rate in zip(u, v))]
