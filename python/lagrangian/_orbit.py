"""Periodic motions, as ``lagrangian orbit`` finds them."""

from __future__ import annotations

from typing import Any, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._command import _places, answer, settings
from ._named import Named, State, rates, state_of


class Orbit:
    """A periodic motion of a machine with n coordinates."""

    period: float
    """In s."""
    start: State
    """A state of the orbit."""
    advance: Mapping[str, float]
    """By how much coordinates advance in a period: as given, or as computed for coordinates on which nothing depends."""
    monodromy: np.ndarray
    """The derivative of the state one period later by the state, (k, k), in the numbers that ``states`` names."""
    states: Tuple[str, ...]
    """The independent numbers of a state: coordinates, then rates ``der(x)`` and states of first order. Without constraints these are all
    numbers, except for advancing coordinates on which nothing depends."""
    multipliers: np.ndarray
    """Floquet multipliers, complex (k,): first the trivial one, if there is one, then the others by decreasing magnitude."""
    errors: np.ndarray
    """The uncertainty of each multiplier, (k,)."""
    trivial: np.ndarray
    """Whether a multiplier is 1 because the motion shifted in time is also a motion, (k,)."""
    stability: str
    """``"stable"``, ``"unstable"``, or ``"undecided"`` where no multiplier is outside the unit circle and some are on it."""
    autonomous: bool
    """Whether the machine has no explicit time."""
    family: int
    """The number of parameters of the family of orbits that this one belongs to, such as their energy; their phase does not count."""
    residual: float
    """The largest difference between a number x of the state one period later and at the start, divided by ``max(1, abs(x))``."""

    def __init__(self, machine: Any, document: Mapping[str, Any]) -> None:
        names = tuple(machine.coordinates)
        at, found = document["at"], document["multipliers"]
        # The integral of a state over time starts as in the spec: at 0.
        q = [at["q"].get(name, 0.0) for name in names]
        v = [at["v"][name] if state_of(name) is None else at["states"][state_of(name)] for name in names]
        self.period = float(document["period"])
        self.start = State(float(at["t"]), Named(q, names), rates(v, names))
        self.advance = {name: float(by) for name, by in document["advance"].items()}
        self.monodromy = np.array(document["monodromy"], dtype=float)
        self.states = tuple(document["states"])
        self.multipliers = np.array([complex(one["re"], one["im"]) for one in found])
        self.errors = np.array([one["error"] for one in found], dtype=float)
        self.trivial = np.array([one["trivial"] for one in found], dtype=bool)
        for array in (self.monodromy, self.multipliers, self.errors, self.trivial):
            array.flags.writeable = False
        self.stability = str(document["stability"])
        self.autonomous = bool(document["autonomous"])
        self.family = int(document["family"])
        self.residual = float(document["residual"])
        self._machine = machine

    def simulate(self, periods: float = 1.0, **options: Any) -> Any:
        """A run over this many periods."""
        until = self.start.t + periods * self.period
        return self._machine.simulate(until, start=self.start, **options)

    def __repr__(self) -> str:
        return f"<Orbit of {self._machine.name}: {self.period:.6g} s, {self.stability}>"


def orbit(
    self: Any,
    *,
    period: Optional[Union[float, str]] = None,
    near: Optional[float] = None,
    start: Any = None,
    rate: Any = None,
    keep: Iterable[str] = (),
    advance: Optional[Mapping[str, Union[float, str]]] = None,
    shift: Iterable[str] = (),
    settle: Optional[float] = None,
    tolerance: float = 1e-11,
) -> Orbit:
    """The periodic motion near a start.

    ``period`` in s, or a formula of parameters, ``"2*pi/omega"``, is that of the drive or a multiple of it; for a machine
    without explicit time it may be left out, or ``near`` gives an estimate of it. ``start`` and ``rate`` are mappings from
    coordinates to numbers or arrays (n,). ``keep`` names start values that the search does not change, ``"theta"`` or ``"der(theta)"``;
    ``advance`` gives by how much coordinates advance in a period; ``shift`` names coordinates that may advance by any amount, since nothing
    depends on them, by default all such coordinates; ``settle`` is the time, in s, for which the machine runs before the search.
    """
    options: List[str] = [*settings(self), *_places(self, "--start", start), *_places(self, "--rate", rate)]
    if isinstance(start, State) and rate is None:
        options += _places(self, "--rate", start.v)
    if period is not None:
        options.append(f"--period={period if isinstance(period, str) else repr(float(period))}")
    if near is not None:
        options.append(f"--near={float(near)!r}")
    kept = [keep] if isinstance(keep, str) else list(keep)
    if kept:
        options.append(f"--keep={','.join(kept)}")
    for name, value in (advance or {}).items():
        options.append(f"--advance={name}={value if isinstance(value, str) else repr(float(value))}")
    shifts = [shift] if isinstance(shift, str) else list(shift)
    if shifts:
        options.append(f"--shift={','.join(shifts)}")
    if settle is not None:
        options.append(f"--settle={float(settle)!r}")
    options.append(f"--tolerance={float(tolerance)!r}")
    return Orbit(self, answer(self, "orbit", options))
