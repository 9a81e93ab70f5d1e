"""Arrays whose last axis has names."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from .errors import unknown


def state_of(coordinate: str) -> Optional[str]:
    """The state of first order of which a coordinate is the integral over time, if it is that.

    >>> state_of("integral(i)"), state_of("integral(T)[3]"), state_of("phi")
    ('i', 'T[3]', None)
    """
    base, bracket, index = coordinate[len("integral(") :].partition(")")
    is_integral = coordinate.startswith("integral(") and bracket and (not index or index[0] + index[-1] == "[]")
    return base + index if is_integral else None


def integral_of(state: str) -> str:
    """The coordinate that is the integral of a state over time.

    >>> integral_of("i"), integral_of("T[3]")
    ('integral(i)', 'integral(T)[3]')
    """
    base, bracket, index = state.partition("[")
    return f"integral({base}){bracket}{index}"


def rate_names(coordinates: Sequence[str]) -> Tuple[str, ...]:
    """The names of rates v: those of the coordinates, and of the integral of a state of first order the state."""
    return tuple(state_of(name) or name for name in coordinates)


class Named(np.ndarray):
    """A read-only array (…, n) that can also be indexed by name: ``q["theta1"]`` is ``q[..., 0]``.

    In rates v a state of first order has its own name, ``v["i"]``; ``v["integral(i)"]`` is the same number.
    """

    names: Tuple[str, ...]

    def __new__(cls, values: Any, names: Sequence[str]) -> "Named":
        made = np.asarray(values, dtype=np.float64).view(cls)
        made.names = tuple(names)
        made.flags.writeable = False
        return made

    def __array_finalize__(self, other: Any) -> None:
        self.names = getattr(other, "names", ())

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            own = key if key in self.names else state_of(key)
            if own not in self.names:
                raise unknown("coordinate", key, self.names)
            return np.asarray(self)[..., self.names.index(own)][()]
        # Rows of named arrays keep their names; columns become plain arrays.
        found = super().__getitem__(key)
        if isinstance(found, Named) and (
            not found.ndim or found.shape[-1] != len(self.names)
        ):
            return np.asarray(found)
        return found

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        # The results of computations on named numbers have no names.
        array = np.asarray(array)
        return array[()] if return_scalar or array.ndim == 0 else array

    def __reduce__(self) -> Any:
        return (Named, (np.asarray(self), self.names))

    def __repr__(self) -> str:
        if self.ndim == 1 and len(self.names) == self.shape[0]:
            inner = ", ".join(f"{n}={float(x)!r}" for n, x in zip(self.names, np.asarray(self)))
            return f"Named({inner})"
        return f"Named({np.asarray(self)!r}, names={self.names!r})"


def rates(values: Any, coordinates: Sequence[str]) -> Named:
    """Rates of coordinates, (…, n), by name; states of first order among them."""
    return Named(values, rate_names(coordinates))


class State(NamedTuple):
    """Time in s, coordinates and rates; states of first order are among the rates."""

    t: Any
    q: Named
    v: Named

    @property
    def y(self) -> np.ndarray:
        """Coordinates, then rates: (…, 2n)."""
        return np.concatenate([np.asarray(self.q), np.asarray(self.v)], axis=-1)
