"""The signals that drive the inputs of a run."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _batch, _native


class Table:
    """Values at instants, which an input follows. A step of the run ends wherever the interpolant is not smooth enough.

    ``kind`` is ``"hold"`` (a value holds until the next), ``"linear"`` or ``"cubic"`` (a spline with two continuous
    derivatives); ``beyond``, for times before the first instant and after the last, is ``"hold"``, ``"error"`` or ``"repeat"``. The times,
    (k,), in s, must increase; the values, (k,), are in the unit of the input.
    """

    def __init__(self, t: Any, values: Any, kind: str = "linear", beyond: str = "hold") -> None:
        times, numbers = (_batch.number_array(x, what).ravel() for x, what in ((t, "t"), (values, "values")))
        if times.shape != numbers.shape:
            raise ValueError(f"there are {times.size} times and {numbers.size} values")
        if kind not in ("hold", "linear", "cubic"):
            raise ValueError(f"kind={kind!r}: must be 'hold', 'linear' or 'cubic'")
        if beyond not in ("hold", "error", "repeat"):
            raise ValueError(f"beyond={beyond!r}: must be 'hold', 'error' or 'repeat'")
        self.t: np.ndarray = times
        self.values: np.ndarray = numbers
        self.kind = kind
        self.beyond = beyond

    def __repr__(self) -> str:
        return f"<Table of {self.t.size} rows, kind={self.kind!r}, beyond={self.beyond!r}>"

    def _law(self) -> Dict[str, Any]:
        rows = {"times": self.t.tolist(), "values": self.values.tolist()}
        return {"table": {**rows, "between": self.kind, "beyond": self.beyond}}


class Sampled:
    """A controller that samples the machine at the start and then once every ``every`` seconds. The value that it sets acts ``delay``
    seconds later, until the next one does.

    ``what`` is a formula of the spec's language or a function ``f(t, q, v)``, which is called once for each sample, in the order of
    time, and may therefore have a state of its own.
    """

    def __init__(self, what: Union[str, Callable[..., float]], every: float, delay: float = 0.0) -> None:
        if not every > 0 or not np.isfinite(every):
            raise ValueError(f"every={every!r}: must be greater than 0")
        if not delay >= 0 or not np.isfinite(delay):
            raise ValueError(f"delay={delay!r}: must not be negative")
        if not isinstance(what, str) and not callable(what):
            raise TypeError(f"a sampled controller must be a formula or a function, not {what!r}")
        self.what = what
        self.every = float(every)
        self.delay = float(delay)

    def __repr__(self) -> str:
        return f"Sampled({self.what!r}, every={self.every!r}, delay={self.delay!r})"


#: The law of an input: a formula, a function or the rows of a table, and for sampled laws period and delay.
Driven = Tuple[
    Optional[str],
    Optional[Callable[..., Any]],
    Optional[Tuple[str, List[float], List[float], str, str]],
    Optional[Tuple[float, float]],
]


def law_of(what: Any, name: str, unit: str) -> Optional[Dict[str, Any]]:
    """The law of an input in the form of a sweep's plan; None if it is a number or a function."""
    if isinstance(what, (str, os.PathLike)):
        text = os.fspath(what)
        law: Dict[str, Any] = json.loads(_native.written(text, name, unit))
        if not isinstance(what, str) and "table" not in law:
            raise ValueError(f"input {name}: {text} is not a table `.csv` or `.parquet`")
        return law
    if isinstance(what, Sampled) and isinstance(what.what, str):
        return {"sampled": {"formula": what.what, "every": what.every, "delay": what.delay}}
    if isinstance(what, tuple) and len(what) == 2:
        what = Table(*what)
    return what._law() if isinstance(what, Table) else None


def driven(what: Any, name: str, unit: str) -> Optional[Driven]:
    """The law of an input in a run; None if it is a number."""
    law = law_of(what, name, unit)
    if law is None:
        if isinstance(what, Sampled):
            return (None, what.what, None, (what.every, what.delay))  # type: ignore[return-value]
        return (None, what, None, None) if callable(what) else None
    if "formula" in law:
        return (law["formula"], None, None, None)
    if "sampled" in law:
        of = law["sampled"]
        return (of["formula"], None, None, (of["every"], of["delay"]))
    rows = law["table"]
    shown = f"the table of input {name}"
    return (None, None, (shown, rows["times"], rows["values"], rows["between"], rows["beyond"]), None)
