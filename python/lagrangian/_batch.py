"""Broadcasts the arguments of an evaluation over states."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Tuple

import numpy as np

from . import _native
from ._named import integral_of, rate_names, state_of
from .errors import SingularError, unknown


def number_array(given: Any, what: str) -> np.ndarray:
    """An array of float64, or a TypeError that says what it is instead."""
    array = np.asarray(given)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what} is an array of {array.dtype}, expected numbers")
    return np.asarray(array, dtype=np.float64)


def vectors(given: Any, names: Tuple[str, ...], default: Any, what: str, kind: str) -> np.ndarray:
    """An array (*S, n) from an array, or from a mapping of names to numbers or arrays; omitted names have their defaults."""
    n = len(names)
    usual: np.ndarray = np.asarray(default, dtype=np.float64)
    if given is None:
        return usual
    if isinstance(given, Mapping):
        columns: List[Any] = [usual[i] for i in range(n)]
        for is_member in (False, True):
            for name, value in given.items():
                if ("[" in name) is not is_member:
                    continue
                places = of_name(name, names)
                if not places:
                    raise unknown(kind, name, names)
                for place in places:
                    columns[place] = number_array(value, f"{what}[{name!r}]")
        if not columns:
            return np.zeros(0)
        return np.stack(np.broadcast_arrays(*columns), axis=-1)
    array = number_array(given, what)
    if array.ndim == 0 or array.shape[-1] != n:
        wanted = f"({n},)" if array.ndim < 2 else f"(…, {n})"
        raise ValueError(f"{what} has shape {array.shape}, expected {wanted}")
    return array


def of_name(name: str, names: Tuple[str, ...]) -> List[int]:
    """The indices to which a name refers: its own, or those of the members of a family."""
    found = [i for i, known in enumerate(names) if known == name or known.split("[")[0] == name]
    state = None if found else state_of(name)
    return found if state is None else of_name(state, names)


def start_of(machine: Any, start: Any, rate: Any) -> Tuple[np.ndarray, np.ndarray]:
    """Coordinates and rates of a start, (n,) each; those not given are as in the spec. ``start`` may give first-order states, too, by
    their names; start and rates are arrays or mappings."""
    names, default = machine.coordinates, machine.start
    of_states: Mapping[str, Any] = {}
    if isinstance(start, Mapping) and machine.states:
        of_states = {name: x for name, x in start.items() if not of_name(name, names) and of_name(name, machine.states)}
        start = {name: x for name, x in start.items() if name not in of_states}
    q = vectors(start, names, default.q, "start", "coordinate")
    v = vectors(rate, rate_names(names), default.v, "rate", "coordinate")
    if of_states:
        v = vectors(of_states, rate_names(names), v, "start", "state")
    for what, given in (("start", q), ("rate", v)):
        if given.shape != (len(names),):
            raise ValueError(f"{what} has shape {given.shape}, expected ({len(names)},)")
        if not np.isfinite(given).all():
            raise ValueError(f"{what} is not finite: {given!r}")
    return q, v


def for_command(machine: Any, name: str) -> str:
    """The name in the command of a rate with this name in Python; they differ for the integral of a state."""
    return integral_of(name) if of_name(name, machine.states) and not of_name(name, machine.coordinates) else name


class Arguments:
    """The states of a batch, one in each row."""

    def __init__(
        self, machine: Any, q: Any, v: Any, t: Any, u: Any, parameters: Optional[Mapping[str, Any]]
    ) -> None:
        start = machine.start
        names = machine.coordinates
        inputs = tuple(machine.inputs)
        q = vectors(q, names, start.q, "q", "coordinate")
        v = vectors(v, rate_names(names), start.v, "v", "coordinate")
        u = vectors(u, inputs, list(machine.inputs.values()), "u", "input")
        t = number_array(0.0 if t is None else t, "t")
        varied: Dict[str, np.ndarray] = {}
        for name, values in (parameters or {}).items():
            known = tuple(machine.parameters)
            if not of_name(name, known):
                raise unknown("parameter", name, known)
            varied[name] = number_array(values, f"parameters[{name!r}]")
        shapes = [q.shape[:-1], v.shape[:-1], u.shape[:-1], t.shape]
        shapes += [values.shape for values in varied.values()]
        try:
            self.shape = np.broadcast_shapes(*shapes)
        except ValueError:
            told = ", ".join(
                f"{name} {shape}"
                for name, shape in zip(["q", "v", "u", "t", *varied], shapes)
            )
            raise ValueError(f"the shapes of the states cannot be broadcast together: {told}") from None
        count = int(np.prod(self.shape, dtype=int))

        def rows(array: np.ndarray) -> np.ndarray:
            n = array.shape[-1]
            return np.ascontiguousarray(np.broadcast_to(array, self.shape + (n,)).reshape(count, n))

        def flat(array: np.ndarray) -> np.ndarray:
            return np.ascontiguousarray(np.broadcast_to(array, self.shape).reshape(count))

        self.t, self.q, self.v, self.u = flat(t), rows(q), rows(v), rows(u)
        self.varied = sorted(
            ((name, flat(values)) for name, values in varied.items()),
            key=lambda pair: "[" in pair[0],
        )
        self.count = count

    def native(self) -> Tuple[Any, Any, Any, Any, List[Tuple[str, Any]]]:
        return self.t, self.q, self.v, self.u, self.varied

    def singular(self, error: SingularError) -> SingularError:
        """The error with the place of the state in the shape of the batch."""
        if not self.shape:
            return SingularError(error._arguments[0], error.coordinate, error.ratio)
        index = tuple(int(i) for i in np.unravel_index(error.index, self.shape))
        return SingularError(error._arguments[0], error.coordinate, error.ratio, index)


def policy(singular: str) -> bool:
    if singular not in ("raise", "nan"):
        raise ValueError(f"singular={singular!r}: must be 'raise' or 'nan'")
    return singular == "raise"


def accelerations(
    machine: Any,
    q: Any,
    v: Any,
    t: Any,
    *,
    u: Any = None,
    parameters: Optional[Mapping[str, Any]] = None,
    singular: str = "raise",
    out: Any = None,
) -> np.ndarray:
    given = Arguments(machine, q, v, t, u, parameters)
    n = len(machine.coordinates)
    shape = given.shape + (n,)
    if out is None:
        result = np.empty(shape)
        rows = result.reshape(given.count, n)
    else:
        if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape:
            found = getattr(out, "shape", type(out).__name__)
            raise ValueError(f"out has shape {found}, expected float64 {shape}")
        result = out
        in_place = out.flags.c_contiguous and out.flags.writeable
        rows = out.reshape(given.count, n) if in_place else np.empty((given.count, n))
    try:
        _native.accelerations(machine, *given.native(), rows, policy(singular))
    except SingularError as error:
        raise given.singular(error) from None
    if out is not None and rows.base is not out and rows is not out:
        out[...] = rows.reshape(shape)
    return result
