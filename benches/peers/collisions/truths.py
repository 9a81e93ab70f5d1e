"""What is exact in the tasks of contacts.py: closed forms, and a run of the slider-crank typed in by hand, in arithmetic of 40 digits."""

import math

GRAVITY = 9.81


def ball(t, height=1.0, restitution=0.8):
    """The height of a ball at time t after a release from rest: its flights are parabolas."""
    begins, speed = math.sqrt(2 * height / GRAVITY), math.sqrt(2 * GRAVITY * height)
    if t < begins:
        return height - GRAVITY * t * t / 2
    while True:
        speed *= restitution
        if t < begins + 2 * speed / GRAVITY:
            return speed * (t - begins) - GRAVITY * (t - begins) ** 2 / 2
        begins += 2 * speed / GRAVITY


HALF_WIDTH, HALF_HEIGHT, TILT = 0.25, 1.0, 0.12248933156343208


def first_fall():
    """The time at which a rigid block with R = √(b² + h²) that rocks from rest first stands upright.

    θ̈ = −p² sin(α − θ) with p² = 3 g/(4 R) and tan α = b/h (G. W. Housner, 1963), from rest at TILT; by Simpson's rule over u, in
    which the time is smooth: θ = TILT (1 − u²).
    """
    radius = math.hypot(HALF_WIDTH, HALF_HEIGHT)
    alpha = math.atan2(HALF_WIDTH, HALF_HEIGHT)
    square = 3 * GRAVITY / (4 * radius)

    def integrand(u):
        # θ̇² = 2 p² (cos(α − TILT) − cos(α − θ)), without cancellation, over u².
        mean = alpha - TILT + TILT * u * u / 2
        half = TILT * u * u / 2
        share = math.sin(half) / half if half > 0 else 1.0
        return 2 * TILT / math.sqrt(4 * square * math.sin(mean) * share * TILT / 2)

    count = 1000
    inner = sum((4 if k % 2 else 2) * integrand(k / count) for k in range(1, count))
    return (integrand(0.0) + inner + integrand(1.0)) / (3 * count)


# P. Flores, R. Leine, Ch. Glocker, Multibody Syst. Dyn. 23 (2010) 165–190, as in machines/contacts/slider_crank_clearance.machine.
CRANK, ROD, PLAY = 0.153, 0.306, 0.001
HALF_LENGTH, HALF_SIDE = 0.05, 0.025
MASSES, INERTIAS = (0.038, 0.038, 0.076), (7.4e-5, 5.9e-4, 2.7e-6)
RATES = (150.0, -75.0)
RESTITUTION, FRICTION = 0.4, 0.01
# Within this time there are five impacts of both upper corners at once.
SLIDER_END = 0.009
# `python -m collisions.truths`: angles of crank and rod, in rad.
SLIDER = (0.8796189391761878, -0.3919382036069971)


def slider():
    """Angles of crank and rod at SLIDER_END, by Taylor series of 40 digits between impacts, in two angles.

    The slider does not turn: it starts so, and when both corners of one side hit at once, Newton's law gives both the rate −e
    times the one before, and thus no rate of turning. It is a particle at the end of the rod, up to |y| = PLAY. Both corners
    slip in the same direction throughout, so that friction is μ times the whole normal impulse.
    """
    from mpmath import cos, matrix, mp, mpf, odefun, lu_solve, sign, sin

    mp.dps = 40
    l1, l2, c, mu, e, g = (mpf(repr(x)) for x in (CRANK, ROD, PLAY, FRICTION, RESTITUTION, GRAVITY))
    m1, m2, m3 = (mpf(repr(x)) for x in MASSES)
    J1, J2, _ = (mpf(repr(x)) for x in INERTIAS)
    a11, a12, a22 = J1 + m1 * l1**2 / 4 + (m2 + m3) * l1**2, (m2 / 2 + m3) * l1 * l2, J2 + m2 * l2**2 / 4 + m3 * l2**2
    w1, w2 = (m1 / 2 + m2 + m3) * g * l1, (m2 / 2 + m3) * g * l2

    def inertia(a, b):
        across = a12 * cos(a - b)
        return matrix([[a11, across], [across, a22]])

    def rates(_, y):
        a, b, u, v = y
        skew = a12 * sin(a - b)
        turn = lu_solve(inertia(a, b), matrix([-skew * v * v - w1 * cos(a), skew * u * u - w2 * cos(b)]))
        return [u, v, turn[0], turn[1]]

    def height(y):
        return l1 * sin(y[0]) + l2 * sin(y[1])

    def climb(y):
        return l1 * cos(y[0]) * y[2] + l2 * cos(y[1]) * y[3]

    def hit(y):
        a, b, u, v = y
        normal, along = matrix([l1 * cos(a), l2 * cos(b)]), matrix([-l1 * sin(a), -l2 * sin(b)])
        before = matrix([u, v])
        slip = (along.T * before)[0]
        # Upper corners: the impulse is downwards, and friction against the slip; its size is μ times that of the normal one.
        change = lu_solve(inertia(a, b), -normal - mu * sign(slip) * along)
        size = -(1 + e) * (normal.T * before)[0] / (normal.T * change)[0]
        after = before + size * change
        assert sign((along.T * after)[0]) == sign(slip) and size > 0
        return [a, b, after[0], after[1]]

    at, y, end = mpf(0), [mpf(0), mpf(0), *(mpf(repr(x)) for x in RATES)], mpf(repr(SLIDER_END))
    hits = []
    while True:
        motion = odefun(rates, at, y)
        # Both the search and the steps are much shorter than the flights.
        t, step = at + mpf("1e-6"), mpf("2e-5")
        while t < end and not (height(motion(t)) > c and climb(motion(t)) > 0):
            t += step
        if t >= end:
            return motion(end)[:2], hits
        for _ in range(8):
            state = motion(t)
            t -= (height(state) - c) / climb(state)
        assert t > at
        y, at = hit(motion(t)), t
        hits.append(t)


if __name__ == "__main__":
    (one, two), hits = slider()
    print([str(hit)[:22] for hit in hits])
    print(f"SLIDER = ({float(one)!r}, {float(two)!r})")
