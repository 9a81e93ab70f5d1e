"""Analyses of one or two runs, as in ``lagrangian spectrum``, ``peaks``, ``section`` and ``compare``."""

from __future__ import annotations

import math
import os
import tempfile
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np

from ._command import _places, answer, settings
from ._named import State
from .errors import unknown

Names = Union[str, Iterable[str]]


class Line(NamedTuple):
    """A frequency in a run."""

    frequency: float
    """In Hz, interpolated between the frequencies of the spectrum."""
    amplitude: float
    """Its amplitude, in the unit of the quantity."""
    phase: float
    """The phase of the cosine at the first sample, in rad."""


class Spectrum:
    """Amplitudes by frequency: ``spectrum["theta1"]`` is (k,), and ``lines["theta1"]`` are the lines in it, the largest first."""

    names: Tuple[str, ...]
    units: Dict[str, str]
    frequencies: np.ndarray
    """(k,), in Hz."""
    mean: Dict[str, float]
    lines: Dict[str, List[Line]]
    resolution: float
    """The spacing of the frequencies, in Hz."""
    step: float
    """The spacing of the samples, in s."""
    samples: int

    def __init__(self, document: Mapping[str, Any], table: Mapping[str, np.ndarray]) -> None:
        found = document["quantities"]
        self.names = tuple(one["name"] for one in found)
        self.units = {one["name"]: one["unit"] for one in found}
        self.mean = {one["name"]: float(one["mean"]) for one in found}
        self.lines = {one["name"]: [Line(x["frequency"], x["amplitude"], x["phase"]) for x in one["lines"]] for one in found}
        self.resolution, self.step = float(document["resolution"]), float(document["step"])
        self.samples = int(document["samples"])
        columns = list(table.values())
        self.frequencies = columns[0]
        self._amplitudes = dict(zip(self.names, columns[1:]))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._amplitudes:
            raise unknown("quantity", name, self.names)
        return self._amplitudes[name]

    def __repr__(self) -> str:
        return f"<Spectrum of {', '.join(self.names)}: {len(self.frequencies)} frequencies up to {self.frequencies[-1]:.6g} Hz>"


class Peaks:
    """Maxima and minima of one quantity."""

    t: np.ndarray
    """(k,), in s."""
    values: np.ndarray
    """(k,)"""
    maximum: np.ndarray
    """Whether it is a maximum; otherwise it is a minimum, (k,)."""
    unit: str
    period: Optional[float]
    """In s; this and the next two are None if there are too few extremes."""
    decrement: Optional[float]
    """Logarithmic decrement."""
    damping: Optional[float]
    """Damping ratio of a linear oscillation with this decrement."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        found = document["extremes"]
        self.t = np.array([one["t"] for one in found], dtype=np.float64)
        self.values = np.array([one["value"] for one in found], dtype=np.float64)
        self.maximum = np.array([one["kind"] == "maximum" for one in found], dtype=bool)
        for array in (self.t, self.values, self.maximum):
            array.flags.writeable = False
        self.unit = document["unit"]
        self.period, self.decrement, self.damping = document["period"], document["decrement"], document["damping"]

    def __repr__(self) -> str:
        return f"<Peaks: {int(self.maximum.sum())} maxima, {int((~self.maximum).sum())} minima>"


class Section:
    """A run at the points of a section: ``section["theta2"]`` is (k,)."""

    t: np.ndarray
    """(k,), in s."""
    names: Tuple[str, ...]
    units: Dict[str, str]

    def __init__(self, document: Mapping[str, Any]) -> None:
        found = document["quantities"]
        self.t = np.array(document["t"], dtype=np.float64)
        self.names = tuple(one["name"] for one in found)
        self.units = {one["name"]: one["unit"] for one in found}
        self._values = {one["name"]: np.array(one["values"], dtype=np.float64) for one in found}
        for array in (self.t, *self._values.values()):
            array.flags.writeable = False

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._values:
            raise unknown("quantity", name, self.names)
        return self._values[name]

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<Section: {len(self.t)} points of {', '.join(self.names)}>"


class Difference(NamedTuple):
    """How far two runs are apart in one quantity."""

    largest: float
    """In the unit of the quantity."""
    at: float
    """The time at which it is largest, in s."""
    rms: float
    """The root of its mean square over time."""
    range: float
    """Largest minus smallest value in the first run, or its value if it is constant."""
    relative: Optional[float]
    """``largest`` relative to ``range``; None if the range is 0 and the difference is not."""


class Comparison:
    """How far two runs are apart: ``comparison["theta1"]`` is a :class:`Difference`."""

    start: float
    """The times between which the runs are compared, in s: ``start`` and ``end``."""
    end: float
    instants: int
    names: Tuple[str, ...]
    units: Dict[str, str]
    only_in_first: List[str]
    only_in_second: List[str]

    def __init__(self, document: Mapping[str, Any]) -> None:
        found = document["quantities"]
        self.start, self.end, self.instants = document["from"], document["to"], int(document["instants"])
        self.names = tuple(one["name"] for one in found)
        self.units = {one["name"]: one["unit"] for one in found}
        self.only_in_first, self.only_in_second = list(document["only_in_first"]), list(document["only_in_second"])
        self._differences = {
            one["name"]: Difference(one["largest"], one["at"], one["rms"], one["range"], one["relative"]) for one in found
        }

    def __getitem__(self, name: str) -> Difference:
        if name not in self._differences:
            raise unknown("quantity", name, self.names)
        return self._differences[name]

    def __repr__(self) -> str:
        largest = max((x.relative for x in self._differences.values() if x.relative is not None), default=math.nan)
        return f"<Comparison of {len(self.names)} quantities at {self.instants} instants: at most {largest:.2g} of a range apart>"


def _run(
    machine: Any,
    until: Optional[float],
    of: Names,
    start: Any,
    rate: Any,
    keep: Names,
    numbers: Mapping[str, Any],
) -> List[str]:
    """The options of a run that is made for an analysis."""
    options = [*settings(machine), *_places(machine, "--start", start), *_places(machine, "--rate", rate)]
    if isinstance(start, State) and rate is None:
        options += _places(machine, "--rate", start.v)
    for option, names in (("--of", of), ("--keep", keep)):
        listed = [names] if isinstance(names, str) else list(names)
        if listed:
            options.append(f"{option}={','.join(listed)}")
    if until is not None:
        options.append(f"--until={float(until)!r}")
    for name, value in numbers.items():
        if value is not None:
            options.append(f"--{name.replace('_', '-')}={value if isinstance(value, (str, int)) else repr(float(value))}")
    return options


def spectrum(
    self: Any,
    until: float,
    of: Names = (),
    *,
    every: Optional[float] = None,
    after: Optional[float] = None,
    window: str = "hann",
    lines: int = 8,
    least: float = 1e-3,
    start: Any = None,
    rate: Any = None,
    keep: Names = (),
    tolerance: Optional[float] = None,
    method: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> Spectrum:
    """The frequencies of a run, as ``lagrangian spectrum`` with its options.

    ``of`` names quantities, by default the coordinates; ``every`` is the spacing of samples, in s; ``after`` the time of the first.
    ``window`` is ``"hann"``, ``"none"`` for whole periods, or ``"blackman-harris"``.
    """
    options = _run(self, until, of, start, rate, keep, {
        "every": every, "after": after, "window": window, "lines": int(lines), "least": least,
        "tolerance": tolerance, "method": method, "max_steps": max_steps,
    })  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "spectrum.csv")
        document = answer(self, "spectrum", [*options, f"--out={path}"])
        rows = np.atleast_2d(np.loadtxt(path, delimiter=",", skiprows=1))
    rows.flags.writeable = False
    return Spectrum(document, {str(k): column for k, column in enumerate(rows.T)})


def peaks(
    self: Any,
    until: float,
    of: Names = (),
    *,
    every: Optional[float] = None,
    after: Optional[float] = None,
    ripple: Optional[float] = None,
    start: Any = None,
    rate: Any = None,
    keep: Names = (),
    tolerance: Optional[float] = None,
    method: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> Dict[str, Peaks]:
    """Maxima and minima in a run by quantity, with period and damping, as ``lagrangian peaks`` with its options.

    ``ripple`` leaves out pairs that differ by no more than this, in the unit of the quantity.
    """
    options = _run(self, until, of, start, rate, keep, {
        "every": every, "after": after, "ripple": ripple, "tolerance": tolerance, "method": method, "max_steps": max_steps,
    })  # fmt: skip
    found = answer(self, "peaks", options)["quantities"]
    return {one["name"]: Peaks(one) for one in found}


def section(
    self: Any,
    until: float,
    of: Names = (),
    *,
    every_period: Optional[Union[float, str]] = None,
    crossing: Optional[str] = None,
    direction: Optional[str] = None,
    after: Optional[float] = None,
    start: Any = None,
    rate: Any = None,
    keep: Names = (),
    tolerance: Optional[float] = None,
    method: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> Section:
    """A run at the points of a section, as ``lagrangian section``: once ``every_period``, in s or a formula ``"2*pi/omega"``, or where
    a formula passes 0, ``crossing="theta"``, or a value, ``"x=5*mm"``. ``direction`` is of a crossing: ``"up"``, as by default,
    ``"down"`` or ``"both"``.
    """
    period = every_period if every_period is None or isinstance(every_period, str) else f"{float(every_period)!r}*s"
    options = _run(self, until, of, start, rate, keep, {
        "every_period": period, "crossing": crossing, "direction": direction, "after": after,
        "tolerance": tolerance, "method": method, "max_steps": max_steps,
    })  # fmt: skip
    return Section(answer(self, "section", options))


def compare(
    self: Any,
    second: Any,
    until: Optional[float] = None,
    of: Names = (),
    *,
    every: Optional[float] = None,
    interpolation: str = "cubic",
    start: Any = None,
    rate: Any = None,
    keep: Names = (),
    tolerance: Optional[float] = None,
    tolerance_second: Optional[float] = None,
    method: Optional[str] = None,
    method_second: Optional[str] = None,
    max_steps: Optional[int] = None,
) -> Comparison:
    """How far a run of this machine and another are apart, as in ``lagrangian compare``.

    ``second`` is the same machine with other parameters, ``machine.with_parameters(k=10)``, or the path of a table, at whose rows the
    two are compared.
    """
    options = _run(self, until, of, start, rate, keep, {
        "every": every, "interpolation": interpolation, "tolerance": tolerance, "tolerance_second": tolerance_second,
        "method": method, "method_second": method_second, "max_steps": max_steps,
    })  # fmt: skip
    if isinstance(second, (str, os.PathLike)):
        return Comparison(answer(self, "compare", [os.fspath(second), *options]))
    if getattr(second, "_program", None) is None or second._program.state() != self._program.state():
        raise ValueError("the second run must be of the same machine with other parameters, or the path of a table")
    options += [f"--set-second={option.split('=', 1)[1]}" for option in settings(second)]
    return Comparison(answer(self, "compare", [self._program.file, *options]))
