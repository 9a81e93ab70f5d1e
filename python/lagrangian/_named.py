"""Arrays whose last axis has names."""

from __future__ import annotations

from typing import Any, NamedTuple, Sequence, Tuple

import numpy as np

from .errors import unknown


class Named(np.ndarray):
    """A read-only array (…, n) that is indexed by name as well: ``q["theta1"]`` is ``q[..., 0]``."""

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
            if key not in self.names:
                raise unknown("coordinate", key, self.names)
            return np.asarray(self)[..., self.names.index(key)][()]
        # Rows of named arrays are named, and columns are arrays.
        found = super().__getitem__(key)
        if isinstance(found, Named) and (
            not found.ndim or found.shape[-1] != len(self.names)
        ):
            return np.asarray(found)
        return found

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        # What is computed from named numbers has other names, or none.
        array = np.asarray(array)
        return array[()] if return_scalar or array.ndim == 0 else array

    def __reduce__(self) -> Any:
        return (Named, (np.asarray(self), self.names))

    def __repr__(self) -> str:
        if self.ndim == 1 and len(self.names) == self.shape[0]:
            inner = ", ".join(f"{n}={float(x)!r}" for n, x in zip(self.names, np.asarray(self)))
            return f"Named({inner})"
        return f"Named({np.asarray(self)!r}, names={self.names!r})"


class State(NamedTuple):
    """Time in s, coordinates and rates."""

    t: Any
    q: Named
    v: Named

    @property
    def y(self) -> np.ndarray:
        """Coordinates, then rates: (…, 2n)."""
        return np.concatenate([np.asarray(self.q), np.asarray(self.v)], axis=-1)
