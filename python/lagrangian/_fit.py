"""Estimates parameters and starts from measured motions."""

from __future__ import annotations

import math
import os
import tempfile
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _command

_Data = Union[str, "os.PathLike[str]", Mapping[str, Any], Any]


class Combination(NamedTuple):
    """A combination of fitted numbers that the measurements determine, although they do not determine these numbers separately."""

    formula: str
    """``k/m``, ``m1 + m2``"""
    kind: str
    """``product`` or ``sum``; ``local`` is a sum that holds only for small changes."""
    unit: Optional[str]
    value: float
    standard_error: float


class Fit:
    """The result of a fit of p numbers to m measurements."""

    names: Tuple[str, ...]
    """Parameters, ``start(x)`` and ``rate(x)``; ``start(x) in 2`` is that of the second of several experiments."""
    values: Dict[str, float]
    """In the units of the spec."""
    standard_errors: Dict[str, float]
    """NaN for numbers that the measurements do not determine."""
    standing: Dict[str, str]
    """By name: ``estimated``; ``bound``, at a bound beyond which the sum of squares decreases; ``ineffective``, nothing depends on it;
    ``entangled``, others have the same effect. Only the first has a standard error."""
    covariance: np.ndarray
    """(p, p), NaN for numbers that are not determined."""
    correlation: np.ndarray
    """(p, p)"""
    combinations: List[Combination]
    """The combinations of entangled numbers that the measurements determine."""
    chi_squared: float
    """The sum of the squares of the residuals, each divided by its standard deviation."""
    degrees_of_freedom: int
    measurements: int
    sigma: Dict[str, float]
    """Standard deviations of what is measured, by name: given, or estimated from the residuals."""
    t: np.ndarray
    """The times of the measurements, experiments one after the other, (rows,), in s."""
    experiment: np.ndarray
    """The number of the experiment of each, from 1."""
    residuals: Dict[str, np.ndarray]
    """Measured minus computed values, by name, (rows,); NaN where there is no measurement."""
    computed: Dict[str, np.ndarray]
    """The computed values, in the same form."""
    converged: bool
    derivatives: str
    """How derivatives of the motion were computed: ``integrated`` with it, or by ``differences`` of runs."""
    warnings: List[str]
    machine: Any
    """The machine with the parameters that were fitted."""

    def __init__(self, machine: Any, document: Mapping[str, Any], labels: Mapping[str, str], table: Mapping[str, Any]) -> None:
        fitted = document["fitted"]

        def named(text: str) -> str:
            for file, label in labels.items():
                text = text.replace(f" in {file}", f" in {label}")
            return text

        self.names = tuple(named(one["name"]) for one in fitted)
        self.values = {name: float(one["value"]) for name, one in zip(self.names, fitted)}
        errors = (math.nan if one["standard_error"] is None else one["standard_error"] for one in fitted)
        self.standard_errors = dict(zip(self.names, errors))
        self.standing = {name: one["standing"] for name, one in zip(self.names, fitted)}
        self.covariance = np.array(document["covariance"], dtype=np.float64)
        self.correlation = np.array(document["correlation"], dtype=np.float64)
        for array in (self.covariance, self.correlation):
            array.flags.writeable = False
        self.combinations = [
            Combination(named(one["formula"]), one["kind"], one["unit"], one["value"], one["standard_error"])
            for one in document["combinations"]
        ]
        self.chi_squared = float(document["chi_squared"])
        self.degrees_of_freedom = int(document["degrees_of_freedom"])
        self.measurements = int(document["measurements"])
        spread = math.sqrt(document["variance"]) if document["variance"] is not None else math.nan
        self.sigma = {one["name"]: spread if one["sigma"] is None else one["sigma"] for one in document["columns"]}
        self.t, self.experiment = table["t"], table["experiment"].astype(int)
        self.residuals = {name: table[f"residual({name})"] for name in self.sigma}
        self.computed = {name: table[f"computed({name})"] for name in self.sigma}
        self.converged = bool(document["converged"])
        self.derivatives = document["derivatives"]
        self.warnings = [named(text) for text in document["warnings"]]
        self.machine = machine.with_parameters({name: x for name, x in self.values.items() if name in machine.parameters})

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    def __repr__(self) -> str:
        lines = []
        for name, value in self.values.items():
            error = self.standard_errors[name]
            known = self.standing[name] if math.isnan(error) else f"± {error:.2g}"
            lines.append(f"  {name} = {value:.8g} {known}")
        lines += [f"  {one.formula} = {one.value:.8g} ± {one.standard_error:.2g}" for one in self.combinations]
        return "\n".join([f"<Fit: {len(self.names)} to {self.measurements} measurements", *lines]) + ">"


def _columns(data: Any) -> Mapping[str, Any]:
    """The columns by name, including t, of a mapping, a run or a table with columns."""
    if isinstance(data, Mapping):
        return data
    names = [str(name) for name in data.columns]
    if "t" in names:
        return {name: data[name] for name in names}
    if hasattr(data, "t"):
        return {"t": data.t, **{name: data[name] for name in names}}
    if getattr(data.index, "name", None) == "t":
        return {"t": data.index, **{name: data[name] for name in names}}
    raise ValueError("measured data must have a column `t`")


def _write(data: Mapping[str, Any], path: str) -> None:
    columns = {name: np.asarray(values, dtype=np.float64) for name, values in data.items()}
    if "t" not in columns:
        raise ValueError("measured data must have a column `t`")
    shape = columns["t"].shape
    for name, values in columns.items():
        if values.shape != shape or len(shape) != 1:
            raise ValueError(f"column {name!r} has shape {values.shape}, and t {shape}: both must be (rows,)")
    order = ["t", *(name for name in columns if name != "t")]
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(f'"{name}"' for name in order) + "\n")
        for row in zip(*(columns[name].tolist() for name in order)):
            file.write(",".join("" if math.isnan(x) else repr(x) for x in row) + "\n")


def _read(path: str) -> Dict[str, np.ndarray]:
    with open(path, encoding="utf-8") as file:
        header = file.readline().rstrip("\n").split(",")
        rows = [[float(cell) for cell in line.split(",")] for line in file]
    array = np.array(rows, dtype=np.float64)
    names = [name.rsplit(" [", 1)[0] if name.endswith("]") and " [" in name else name for name in header]
    return {name: array[:, place] for place, name in enumerate(names)}


def fit(
    self: Any,
    data: Union[_Data, Sequence[_Data]],
    sought: Union[str, Sequence[str]],
    *,
    bounds: Optional[Mapping[str, Tuple[Optional[float], Optional[float]]]] = None,
    sigma: Union[None, str, Mapping[str, float]] = None,
    columns: Optional[Sequence[str]] = None,
    start: Optional[Mapping[str, float]] = None,
    rate: Optional[Mapping[str, float]] = None,
    inputs: Optional[Mapping[str, Union[float, str]]] = None,
    settings: Optional[Sequence[Mapping[str, Union[float, str]]]] = None,
    starts: int = 1,
    tolerance: float = 1e-9,
    method: str = "dop853",
) -> Fit:
    """Finds parameters, ``start(x)`` and ``rate(x)`` with which the machine moves as measured, as ``lagrangian fit``.

    ``data`` is a mapping from ``t`` in s and the names of coordinates, rates ``der(x)`` and outputs to arrays (rows,) in the units of the
    spec, NaN where nothing was measured; a data frame, a run, or the path of a table; or a list of these, one for each experiment, which has its own
    start. ``settings`` gives the values that differ between experiments, a mapping for each, ``{"start(x)": 0.3, "m": 2}``. ``sigma`` are standard deviations by
    name, or ``"auto"``; without it all columns must have the same unit, and have equal weights. ``inputs`` are numbers, formulas, or tables
    in files. Raises ``LagrangianError`` where no minimum is found.
    """
    if isinstance(data, (str, os.PathLike, Mapping)) or hasattr(data, "columns"):
        data = [data]
    several: List[Any] = list(data)
    special: List[Mapping[str, Any]] = list(settings) if settings is not None else [{} for _ in several]
    if len(special) != len(several):
        raise ValueError(f"settings for {len(special)} experiments are given, but the number of experiments is {len(several)}")
    names = [sought] if isinstance(sought, str) else list(sought)
    driven = dict(inputs or {})
    options = [option for option in _command.settings(self) if option.split("=")[1] not in driven]
    for name, value in driven.items():
        known = "--input" if isinstance(value, str) else "--set"
        options.append(f"{known}={name}={value if isinstance(value, str) else repr(float(value))}")
    for option, given in (("--start", start), ("--rate", rate)):
        options += [f"{option}={name}={float(x)!r}" for name, x in (given or {}).items()]

    def end(x: Optional[float]) -> str:
        return "" if x is None or math.isinf(x) else repr(float(x))

    options += [f"--bounds={name}={end(low)}..{end(high)}" for name, (low, high) in (bounds or {}).items()]
    if isinstance(sigma, str):
        options.append(f"--sigma={sigma}")
    else:
        options += [f"--sigma={name}={float(x)!r}" for name, x in (sigma or {}).items()]
    if columns is not None:
        options.append(f"--columns={_joined(columns)}")
    options += [f"--fit={_joined(names)}", f"--starts={starts}", f"--tolerance={tolerance!r}", f"--method={method}"]
    with tempfile.TemporaryDirectory() as folder:
        labels: Dict[str, str] = {}
        for number, (one, own) in enumerate(zip(several, special), 1):
            if isinstance(one, (str, os.PathLike)):
                path = os.fspath(one)
            else:
                path = os.path.join(folder, f"{number}.csv")
                _write(_columns(one), path)
                labels[path] = str(number)
            said = [f"{name}={x if isinstance(x, str) else repr(float(x))}" for name, x in own.items()]
            options.append(f"--data={','.join([path, *said])}")
        table = os.path.join(folder, "rows.csv")
        document = _command.answer(self, "fit", [*options, f"--table={table}"], wrong=(1,))
        return Fit(self, document, labels, _read(table))


def _joined(names: Iterable[str]) -> str:
    return ",".join(names)
