"""The cycle of the woodpecker toy to 18 digits, for `orbit.rs`: by hand, in mpmath.

Angles are small in the model of R. I. Leine, Ch. Glocker and D. H. van Campen (Nonlinear Dynamics of the Woodpecker Toy, DETC2001/VIB-21608,
equations 6 to 10), so between two events every motion is linear with constant coefficients, and a matrix exponential has all its digits.
Events are roots of these. Friction and impacts are those of a single contact: no other is closed. The bird turns while the sleeve is
jammed, where one number, its angle s, tells all; so s -> P(s) is the whole motion from beat to beat, and P'(s) the one multiplier that is
neither 1 nor 0. It shares nothing with the program. Run `python3 woodpecker.py`, which writes
`woodpecker.json`; it takes mpmath alone, and a quarter of an hour.
"""

import json
from pathlib import Path

from mpmath import expm, inverse, lu_solve, matrix, mp, mpf, nstr, sign, zeros

mp.dps = 34
mM, JM, mS, JS = mpf("3e-4"), mpf("5e-9"), mpf("4.5e-3"), mpf("7e-7")
lM, lG, lS, hS = mpf("0.01"), mpf("0.015"), mpf("0.0201"), mpf("0.02")
hM, rM, r0 = mpf("0.0058"), mpf("0.0031"), mpf("0.0025")
c, e, mu, g = mpf("0.0056"), mpf("0.5"), mpf("0.3"), mpf("9.81")

# Coordinates are y, phiM, phiS; contacts the beak, the lower and the upper end of the sleeve.
BEAK, LOWER, UPPER = 0, 1, 2
MASS = matrix(
    [
        [mS + mM, mS * lM, mS * lG],
        [mS * lM, JM + mS * lM**2, mS * lM * lG],
        [mS * lG, mS * lM * lG, JS + mS * lG**2],
    ]
)
INVERSE = inverse(MASS)
STIFFNESS = matrix([[0, 0, 0], [0, c, -c], [0, -c, c]])
WEIGHT = matrix([-(mS + mM) * g, -mS * g * lM, -mS * g * lG])
GAP = [lM + lG - lS - r0, rM - r0, rM - r0]
NORMAL = [matrix([0, 0, -hS]), matrix([0, hM, 0]), matrix([0, -hM, 0])]
TANGENT = [matrix([1, lM, lG - lS]), matrix([1, rM, 0]), matrix([1, rM, 0])]
RESTITUTION = [e, mpf(0), mpf(0)]
STICKS = "sticks"


def dot(w, x):
    return sum(a * b for a, b in zip(w, x))


def reaction(contact, mode, q):
    """Accelerations, and normal and tangential force of the contact that is closed; `mode` is the sign of its slip, or that it sticks."""
    if contact is None:
        return lu_solve(MASS, WEIGHT - STIFFNESS * q), (mpf(0), mpf(0))
    normal, tangent = NORMAL[contact], TANGENT[contact]
    forces = [(normal, normal), (tangent, tangent)] if mode == STICKS else [(normal - mode * mu * tangent, normal)]
    size = 3 + len(forces)
    system, right = zeros(size, size), zeros(size, 1)
    system[0:3, 0:3] = MASS
    right[0:3, 0] = WEIGHT - STIFFNESS * q
    for j, (along, row) in enumerate(forces):
        for i in range(3):
            system[i, 3 + j], system[3 + j, i] = -along[i], row[i]
    x = lu_solve(system, right)
    return x[0:3], (x[3], x[4] if mode == STICKS else -mode * mu * x[3])


class Motion:
    """The motion while a contact stays as it is: z' = A z with z = (q, v, 1)."""

    known = {}

    def __init__(self, contact, mode):
        self.rates = zeros(7, 7)
        rest, _ = reaction(contact, mode, zeros(3, 1))
        for i in range(3):
            unit = zeros(3, 1)
            unit[i] = 1
            by, _ = reaction(contact, mode, unit)
            self.rates[i, 3 + i] = 1
            for row in range(3):
                self.rates[3 + row, i] = by[row] - rest[row]
            self.rates[3 + i, 6] = rest[i]

    @classmethod
    def of(cls, contact, mode):
        key = (contact, str(mode))
        if key not in cls.known:
            cls.known[key] = cls(contact, mode)
        return cls.known[key]

    def at(self, z, t):
        return expm(self.rates * t) * z

    def first(self, z, margin, within, step):
        """The first time, after a tenth of a microsecond, at which a margin that is positive becomes 0."""
        ahead, t = expm(self.rates * step), mpf("1e-7")
        here = self.at(z, t)
        before = margin(here)
        while t < within:
            here = ahead * here
            after = margin(here)
            if before >= 0 > after:
                return self.root(z, margin, (t, before), (t + step, after))
            t, before = t + step, after
        return None

    def root(self, z, margin, low, high):
        """The Illinois method."""
        side = 0
        for _ in range(200):
            (a, fa), (b, fb) = low, high
            t = (a * fb - b * fa) / (fb - fa)
            value = margin(self.at(z, t))
            if value == 0 or abs(b - a) < mpf(10) ** (4 - mp.dps):
                return t
            if value < 0:
                high, low, side = (t, value), (a, fa / 2 if side < 0 else fa), -1
            else:
                low, high, side = (t, value), (b, fb / 2 if side > 0 else fb), 1
        raise ArithmeticError("no root")


def impact(contact, z):
    """Rates after an impact of one contact by Newton's law with Coulomb's friction; whether it sticks in it."""
    normal, tangent = NORMAL[contact], TANGENT[contact]
    rate, slip = dot(normal, z[3:6]), dot(tangent, z[3:6])
    change = -(1 + RESTITUTION[contact]) * rate
    nn, nt, tt = (dot(a, INVERSE * b) for a, b in ((normal, normal), (normal, tangent), (tangent, tangent)))
    pushed = lu_solve(matrix([[nn, nt], [nt, tt]]), matrix([change, -slip]))
    found = [(pushed[0], pushed[1])] if abs(pushed[1]) <= mu * pushed[0] else []
    for direction in (1, -1):
        push = change / (nn - direction * mu * nt)
        drag = -direction * mu * push
        if push >= 0 and direction * (slip + nt * push + tt * drag) > 0:
            found.append((push, drag))
    (push, drag), = found
    after = z.copy()
    for i, by in enumerate(INVERSE * (normal * push + tangent * drag)):
        after[3 + i] += by
    return after


def beat(s, tell=None):
    """From a turn of the bird at s, with the sleeve jammed, to the next: where it turns there, the time and the way down."""
    z = matrix([0, -(rM - r0) / hM, s, 0, 0, 0, 1])
    t, contact, mode, has_slipped = mpf(0), LOWER, STICKS, False
    while True:
        motion = Motion.of(contact, mode)
        margins = {}
        if contact is not None:
            margins["lifts"] = lambda z: reaction(contact, mode, z[0:3])[1][0]
            if mode == STICKS:
                margins["slips"] = lambda z: mu * reaction(contact, mode, z[0:3])[1][0] - abs(reaction(contact, mode, z[0:3])[1][1])
                margins["turns"] = lambda z: -z[5]
            else:
                margins["sticks"] = lambda z: mode * dot(TANGENT[contact], z[3:6])
        for k in {BEAK, LOWER, UPPER} - {contact}:
            margins[k] = lambda z, k=k: GAP[k] + dot(NORMAL[k], z[0:3])
        if mode == STICKS and not has_slipped:
            del margins["turns"]
        within, step = (mpf("0.2"), mpf("1e-4")) if mode == STICKS else (mpf("0.06"), mpf("4e-5"))
        times = {what: motion.first(z, margin, within, step) for what, margin in margins.items()}
        by, what = min((by, str(what)) for what, by in times.items() if by is not None)
        z, t = motion.at(z, by), t + by
        if what == "turns":
            return z[2], t, z[0]
        if what == "slips":
            # Down.
            mode, has_slipped = mpf(-1), True
        elif what == "sticks":
            mode = STICKS
        elif what == "lifts":
            contact, mode = None, None
        else:
            if contact is not None:
                raise ArithmeticError("two contacts are closed")
            hit = int(what)
            z = impact(hit, z)
            slip = sign(dot(TANGENT[hit], z[3:6]))
            # What does not bounce stays if it is pressed.
            if RESTITUTION[hit] == 0 and reaction(hit, slip, z[0:3])[1][0] > 0:
                contact, mode = hit, slip
        if tell is not None:
            tell.append((what, nstr(t, 8)))


def cycle(s, restitution):
    """The cycle near s: where the bird turns, the period, the way, the multiplier, and what happens when."""
    RESTITUTION[BEAK] = restitution
    # The secant method for P(s) = s.
    other, off = s + mpf("1e-4"), beat(s)[0] - s
    off_other = beat(other)[0] - other
    while abs(s - other) > mpf("1e-25"):
        s, other, off_other = s - off * (s - other) / (off - off_other), s, off
        off = beat(s)[0] - s
    events, h = [], mpf("1e-11")
    _, period, way = beat(s, events)
    return s, period, way, (beat(s + h)[0] - beat(s - h)[0]) / (2 * h), events


if __name__ == "__main__":
    s, cycles = mpf("-0.5295"), {}
    # The cycle of the paper; and some with a harder peck, whose multiplier passes -1 between the third and the fourth.
    for restitution in ("0.5", "0.58", "0.64854", "0.64856", "0.66"):
        s, period, way, multiplier, events = cycle(s, mpf(restitution))
        print("e", restitution, events, flush=True)
        known = {"turn": s, "period": period, "way": way, "multiplier": multiplier}
        cycles[restitution] = {name: nstr(value, 18) for name, value in known.items()}
        Path(__file__).with_suffix(".json").write_text(json.dumps(cycles, indent=4) + "\n")
