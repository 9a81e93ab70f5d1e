"""Derivatives of a motion by its start, by parameters and by inputs."""

from __future__ import annotations

import json
import math
import os
from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _batch, _native
from ._named import Named, integral_of, rates, state_of
from .errors import unknown


class Sensitivities:
    """A motion at k instants, with its derivatives with respect to s variables, from exact derivatives of the equations."""

    t: np.ndarray
    """(k,), in s."""
    q: Named
    """(k, n)"""
    v: Named
    """(k, n)"""
    by: Tuple[str, ...]
    """The variables: parameters, inputs, ``start(x)``, ``rate(x)``."""
    sensitivities: np.ndarray
    """(k, 2n, s): the derivatives of coordinates, then of rates, by each variable, in the unit of the former over that of the latter."""

    def __init__(self, machine: Any, by: Tuple[str, ...], t: np.ndarray, arrays: Sequence[np.ndarray]) -> None:
        names = machine.coordinates
        k, n, s = len(t), len(names), len(by)
        q, v, by_q, by_v = arrays
        self.t, self.by = t, by
        self.q, self.v = Named(q.reshape(k, n), names), rates(v.reshape(k, n), names)
        # The native module returns all coordinates for each variable.
        both = np.concatenate([by_q.reshape(k, s, n), by_v.reshape(k, s, n)], axis=2)
        self.sensitivities = np.ascontiguousarray(np.swapaxes(both, 1, 2))
        for array in (self.t, self.sensitivities):
            array.flags.writeable = False
        self._rows = (*names, *(state_of(name) or f"der({name})" for name in names))

    def sensitivity(self, of: str, by: str) -> np.ndarray:
        """The derivative of a coordinate, a rate ``der(x)`` or a state of first order by a variable, (k,)."""
        if of not in self._rows:
            raise unknown("coordinate or rate", of, self._rows)
        if by not in self.by:
            raise unknown("variable", by, self.by)
        found: np.ndarray = self.sensitivities[:, self._rows.index(of), self.by.index(by)]
        return found

    def __repr__(self) -> str:
        return f"<Sensitivities of {', '.join(self.q.names)} by {', '.join(self.by)} at {len(self.t)} instants>"


def sensitivities(
    self: Any,
    until: float,
    by: Union[str, Sequence[str]],
    *,
    start: Any = None,
    rate: Any = None,
    t0: float = 0.0,
    tolerance: float = 1e-9,
    method: str = "dop853",
    every: Optional[float] = None,
    at: Optional[Sequence[float]] = None,
    max_steps: int = 10_000_000,
    keep: Optional[Sequence[str]] = None,
) -> Sensitivities:
    """The motion from t0 until a time, with its derivatives by parameters, inputs and start values.

    ``by``: names of parameters and inputs, ``start(x)``, ``rate(x)``. Everything else is as in :meth:`simulate`; inputs are
    constant. Start values are independent of parameters here: if the spec computes one from a parameter, the derivative by the
    parameter does not include that dependence.

    If the machine has constraints, the start depends on the variables by its projection onto the constraints, in which the values of
    ``keep``, by default those that the spec keeps, stay as they are; the derivatives satisfy the constraints from the start on. Later
    states are not projected: if the motion or its derivatives violate the constraints by more than 1e-5 of their values, a
    ``ValueError`` is raised. It is also raised for constraints that follow from others.

    Derivatives are continued across impacts and other changes of contacts, and if the spec names ``charts`` the motion is
    computed in Cartesian coordinates, as by ``lagrangian sensitivities``; both require ``t0 = 0`` and equal intervals.
    """
    from ._linear import _start

    by = (by,) if isinstance(by, str) else tuple(by)
    numbers = (*self.parameters, *self.inputs)
    kinds: List[Tuple[str, str]] = []
    varied: List[str] = []
    for name in by:
        kind, inner = "set", name
        for place in ("start", "rate"):
            if name.startswith(place + "(") and name.endswith(")"):
                kind, inner = place, name[len(place) + 1 : -1].strip()
        if kind == "start" and inner in self.states:
            kind, inner = "rate", integral_of(inner)
        known = numbers if kind == "set" else self.coordinates
        if inner not in known:
            raise unknown("parameter or input" if kind == "set" else "coordinate", inner, known)
        kinds.append((kind, inner))
        if kind == "set":
            varied.append(inner)
    if not by or len(set(by)) < len(by):
        raise ValueError("by must name at least one variable, and each once")
    given = _start(self, start, rate, t0)
    until = float(until)
    collides, is_charted = self._program.is_continued
    is_even = at is None and given[0] == 0.0
    if collides and not is_even:
        raise ValueError("derivatives across changes of contacts are computed from t0 = 0, at equal intervals: leave `t0` and `at` out")
    if collides or (is_charted and is_even):
        return _continued(self, by, given, until, every, {
            "tolerance": repr(float(tolerance)),
            "method": method,
            "max-steps": str(int(max_steps)),
            "keep": None if keep is None else ",".join(keep),
        })
    machine = type(self)._with(_native.rebuild(_variant(self, varied)), *self._values)
    if at is not None:
        if every is not None:
            raise ValueError("instants are kept by `every` or by `at`, not by both")
        instants = np.array(_batch.number_array(at, "at")).ravel()
    else:
        length = until - given[0]
        count = 1000 if every is None else math.floor(abs(length) / every * (1 + 1e-12))
        step = length / 1000 if every is None else math.copysign(every, length)
        instants = given[0] + step * np.arange(count + 1)
        if abs(until - instants[-1]) > 1e-12 * abs(length):
            instants = np.append(instants, until)
        instants[-1] = until
    low, high = sorted((given[0], until))
    if not ((instants >= low) & (instants <= high)).all():
        raise ValueError(f"at is outside of the run, from {given[0]} s to {until} s")
    kept = None if keep is None else list(keep)
    arrays = _native.sensitivities(
        machine, kinds, given, instants.tolist(), until, float(tolerance), method, int(max_steps), kept
    )
    return Sensitivities(self, by, instants, arrays)


def _continued(
    machine: Any,
    by: Tuple[str, ...],
    start: Tuple[float, List[float], List[float]],
    until: float,
    every: Optional[float],
    options: Mapping[str, Optional[str]],
) -> Sensitivities:
    """The result of the command, which continues derivatives across changes of contacts and maps them between charts."""
    from ._command import answer, settings

    names = machine.coordinates
    given: List[str] = settings(machine)
    for name, q, v in zip(names, start[1], start[2]):
        state = state_of(name)
        given.append(f"--start={name}={q!r}")
        given.append(f"--rate={name}={v!r}" if state is None else f"--start={state}={v!r}")
    rows = (*names, *(state_of(name) or f"der({name})" for name in names))
    given += [f"--until={until!r}", f"--by={','.join(by)}", f"--of={','.join(rows)}"]
    if every is not None:
        given.append(f"--every={float(every)!r}")
    given += [f"--{name}={value}" for name, value in options.items() if value]
    document = answer(machine, "sensitivities", given)
    t = np.array(document["t"])
    (k, n, s) = (len(t), len(names), len(by))
    values = np.array([column["values"] for column in document["values"]], dtype=float).reshape(2, n, k)
    # A column for each row of the state and each variable; the arrays have all coordinates for each variable.
    slopes = np.array([column["values"] for column in document["derivatives"]], dtype=float).reshape(2, n, s, k)
    q, v = np.moveaxis(values, 2, 1)
    by_q, by_v = np.transpose(slopes, (0, 3, 2, 1))
    return Sensitivities(machine, by, t, [np.ascontiguousarray(array) for array in (q, v, by_q, by_v)])


def _variant(machine: Any, names: Sequence[str]) -> str:
    """The spec of the same machine with derivatives of its accelerations."""
    spec = json.loads(machine._program.state())
    own = spec["name"]
    name = os.path.join(os.path.dirname(own), "differentiated.machine")
    path = os.path.basename(own)
    quoted = path.replace("\\", "\\\\").replace('"', '\\"')
    # The spec can only name a whole family, and all inputs together.
    families = dict.fromkeys("inputs" if name in machine.inputs else name.split("[")[0] for name in names)
    asked = ", ".join(["coordinates", "rates", *families])
    text = f'machine Differentiated extends "{quoted}" {{ derivatives {{ {asked} }} }}'
    base = {"path": path, "from": name, "name": own, "text": spec["text"]}
    return json.dumps({**spec, "name": name, "text": text, "files": [base, *spec["files"]]})
