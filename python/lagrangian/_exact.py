"""The accuracy of runs: error estimates, runs in double-double, and enclosures, as in ``lagrangian simulate``."""

from __future__ import annotations

from decimal import Decimal
from typing import Any, Dict, Mapping, NamedTuple, Optional, Sequence, Tuple

from ._command import answer
from ._looks import Names, _run


class GlobalError(NamedTuple):
    """The error of the end of a run, compared with the exact motion."""

    kind: str
    """``"estimate"`` or ``"bound"``."""
    by: str
    """What the run was compared with, in words."""
    errors: Dict[str, float]
    """The errors of coordinates and rates ``der(x)``, by name, in their units."""
    greatest: float
    """The largest error relative to the scale of its coordinate or rate."""
    is_rounding: bool
    """Whether the error is due to rounding, so that no tolerance would make it smaller."""


class Precise(NamedTuple):
    """The end of a run in double-double numbers, which have about 31 digits."""

    t: float
    q: Dict[str, Decimal]
    v: Dict[str, Decimal]
    difference: float
    """Its distance from the end of a run at another tolerance, an estimate of its error."""
    method: str
    tolerance: float
    steps: int
    evaluations: int


class Enclosure(NamedTuple):
    """Proved bounds on the state at the end of a motion."""

    t: float
    q: Dict[str, Tuple[float, float]]
    """The lower and the upper bound, by name."""
    v: Dict[str, Tuple[float, float]]
    steps: int


def _end(machine: Any, flags: Sequence[str], until: float, start: Any, rate: Any, keep: Names, numbers: Mapping[str, Any]) -> Dict[str, Any]:
    return answer(machine, "simulate", [*_run(machine, until, (), start, rate, keep, numbers), *flags])


def global_error(
    self: Any,
    until: float,
    *,
    start: Any = None,
    rate: Any = None,
    keep: Names = (),
    tolerance: Optional[float] = None,
    method: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> GlobalError:
    """The error of the end of ``simulate(until, …)``, as by ``lagrangian simulate --global-error``: by comparison with a run in
    double-double if the machine has one, otherwise with a run at a finer tolerance. ``method`` and ``tolerance`` are those of the run
    whose error is sought."""
    numbers = {"tolerance": tolerance, "method": method or "dop853", "max_steps": max_steps}
    found = _end(self, ["--global-error"], until, start, rate, keep, numbers)["global_error"]
    return GlobalError(**{name: found[name] for name in GlobalError._fields})


def precise(
    self: Any,
    until: float,
    *,
    start: Any = None,
    rate: Any = None,
    tolerance: Optional[float] = None,
    method: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> Precise:
    """The end of a run in double-double, as ``lagrangian simulate --precision dd``, for references. Machines with constraints or
    contacts have no such run and raise an error."""
    numbers = {"tolerance": tolerance, "method": method, "max_steps": max_steps}
    found = _end(self, ["--precision=dd"], until, start, rate, (), numbers)
    q, v = ({name: Decimal(text) for name, text in found[kind].items()} for kind in ("q", "v"))
    t, difference, method, tolerance, steps, evaluations = (found[name] for name in Precise._fields if name not in ("q", "v"))
    return Precise(t, q, v, difference, method, tolerance, steps, evaluations)


def validated(
    self: Any,
    until: float,
    *,
    start: Any = None,
    rate: Any = None,
    tolerance: Optional[float] = None,
    max_steps: Optional[int] = None,
) -> Enclosure:
    """Proved bounds on the state at ``until``, as by ``lagrangian simulate --validated``, for short motions of machines that have a
    Taylor series and neither constraints nor contacts; others raise an error."""
    numbers = {"tolerance": tolerance, "max_steps": max_steps}
    found = _end(self, ["--validated"], until, start, rate, (), numbers)
    bounds = {kind: {name: (low, high) for name, (low, high) in found[kind].items()} for kind in ("q", "v")}
    return Enclosure(found["t"], bounds["q"], bounds["v"], found["steps"])
