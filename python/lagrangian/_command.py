"""The command ``lagrangian``, and its results for a machine, computed in this process."""

from __future__ import annotations

import json
import math
import os
import sys
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _batch, _native
from ._named import Named, State
from .errors import Diagnostic, ExportError, LagrangianError, unknown


def main() -> int:
    """Runs the command ``lagrangian`` with the arguments of this process, and returns its exit status."""
    return int(_native.command(sys.argv[1:]))


def answer(machine: Any, command: str, options: Sequence[str], wrong: Sequence[int] = (1,)) -> Dict[str, Any]:
    """The JSON document that a command prints about a machine.

    An exit status in ``wrong`` raises a LagrangianError, and an invalid call a ValueError.
    """
    status, out, err = _native.answer(machine._program, command, ["--json", *options])
    if status == 2 or (status in wrong and status != 0):
        try:
            message = json.loads(out).get("error", "")
        except (ValueError, AttributeError):
            message = ""
        message = message or err.strip()
        raise ValueError(message) if status == 2 else LagrangianError(message)
    document: Dict[str, Any] = json.loads(out)
    return document


def told_of_file(command: str, path: str, options: Sequence[str]) -> str:
    """The output of a command for a file that is not a spec. Raises a ValueError if the file or the call is invalid."""
    status, out, err = _native.answer_of_file(command, path, list(options))
    if status != 0:
        try:
            message = json.loads(out).get("error", "")
        except (ValueError, AttributeError):
            message = ""
        raise ValueError(message or err.strip() or out.strip())
    return out


def imported(path: str, options: Sequence[str]) -> Dict[str, Any]:
    """The JSON document that ``lagrangian import`` prints about a robot's file."""
    document: Dict[str, Any] = json.loads(told_of_file("import", path, ["--json", *options]))
    return document


def settings(machine: Any) -> List[str]:
    """Options that set the parameters and inputs of a machine."""
    values = {**machine.parameters, **machine.inputs}
    return [f"--set={name}={value!r}" for name, value in values.items() if not math.isnan(value)]


class Published(NamedTuple):
    """A published formula, compared with the derived one."""

    block: str
    """The title of the publication in the spec."""
    item: str
    """The formula."""
    agrees: bool
    add: List[str]
    """Terms that the publication lacks."""
    drop: List[str]
    """Terms that the publication has and the derivation has not."""


class Accuracy(NamedTuple):
    """The accuracy of one quantity of a machine's program, by comparison with 30 digits at many states."""

    quantity: str
    states: int
    median: float
    """The median over the states of the error, relative to the error that rounding of the arguments alone may cause."""
    worst: float
    """The greatest of these."""
    ulps: float
    """The error there, in units in the last place of the result."""
    error: float
    """The error there, in the unit of the quantity."""
    result: str
    """Which number of the quantity it is."""
    kind: str
    """How the worst state was chosen."""
    state: Dict[str, Any]
    """The worst state: ``t``, and by name ``q`` and ``v``."""


class Check:
    """What ``lagrangian check`` finds in a spec."""

    coordinates: int
    constraints: int
    independent: Optional[int]
    """The number of constraints that are independent of each other; None if it is not known."""
    degrees_of_freedom: Optional[int]
    published: List[Published]
    """The published formulas of the spec, compared with the derived ones."""
    diagnostics: List[Diagnostic]
    """Warnings, and contradictions of constraints."""
    accuracy: Dict[str, Accuracy]
    """By quantity; empty if it was not requested."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        freedom = document["freedom"] or {}
        self.coordinates = int(freedom.get("coordinates", 0))
        self.constraints = int(freedom.get("constraints", 0))
        self.independent = freedom.get("independent")
        self.degrees_of_freedom = freedom.get("degrees_of_freedom")
        fields = Diagnostic._fields
        self.diagnostics = [Diagnostic(*(told[name] for name in fields)) for told in document["diagnostics"]]
        measured = [Accuracy(*(told[name] for name in Accuracy._fields)) for told in document.get("accuracy") or ()]
        self.accuracy = {one.quantity: one for one in measured}
        self.published = [Published(*(told[name] for name in Published._fields)) for told in document["published"]]

    @property
    def ok(self) -> bool:
        """Whether there is no warning and no published formula that differs from the derived one."""
        return not self.diagnostics and all(formula.agrees for formula in self.published)

    def __repr__(self) -> str:
        wrong = sum(not formula.agrees for formula in self.published)
        freedom = "unknown" if self.degrees_of_freedom is None else self.degrees_of_freedom
        return (
            f"<Check: {self.coordinates} coordinates, {self.constraints} constraints, degrees of freedom {freedom}, "
            f"{len(self.diagnostics)} messages, {wrong} of {len(self.published)} published formulas differ>"
        )


def check(self: Any, *, accuracy: bool = False) -> Check:
    """Counts the degrees of freedom, finds warnings, and compares published equations with the derived ones, as ``lagrangian check``
    does; with ``accuracy`` it also measures how accurate the derived program is, as ``--accuracy`` does."""
    return Check(answer(self, "check", ["--accuracy"] if accuracy else [], wrong=()))


def library(
    self: Any,
    out: Union[str, "os.PathLike[str]"],
    *,
    lanes: Union[int, Sequence[int]] = (4,),
    target_cpu: str = "native",
    source: Optional[Union[str, "os.PathLike[str]"]] = None,
    straight: bool = False,
) -> str:
    """Writes a shared library of the equations with a C interface, and its header beside it, as ``lagrangian library`` does. Returns the
    path of the header.

    It is compiled by a Rust toolchain. Parameters and inputs are arguments of its functions, so their values in this machine have no
    effect; constants are those of this machine. ``lanes``: for how many states at once there are functions besides ``eval``, 2, 4,
    8 or several of them. ``target_cpu`` is a processor as rustc names it, ``source`` a file for the Rust source.
    """
    of_lanes = [lanes] if isinstance(lanes, int) else list(lanes)
    options = [f"--out={os.fspath(out)}", f"--lanes={','.join(map(str, of_lanes))}", f"--target-cpu={target_cpu}"]
    if source is not None:
        options.append(f"--source={os.fspath(source)}")
    if straight:
        options.append("--straight")
    return str(_exported(self, "library", options)["header"])


class Fmu(NamedTuple):
    """A functional mock-up unit that was written."""

    path: str
    fmi: str
    """The version of the interface."""
    kinds: List[str]
    platforms: List[str]
    """The platforms that the unit has libraries for; empty if the importing tool compiles its sources."""
    states: int
    parameters: int
    inputs: int
    outputs: int
    events: int


def fmu(
    self: Any,
    out: Union[str, "os.PathLike[str]"],
    *,
    fmi: int = 3,
    kind: Optional[Sequence[str]] = None,
    outputs: Optional[Sequence[str]] = None,
    events: Optional[Mapping[str, str]] = None,
    method: Optional[str] = None,
    tolerance: float = 1e-9,
    start: Any = None,
    rate: Any = None,
    cc: Optional[str] = None,
    target: Sequence[str] = (),
    sources_only: bool = False,
) -> Fmu:
    """Writes a functional mock-up unit, ``.fmu``, with the parameters and inputs of this machine as defaults, as ``lagrangian fmu`` does.

    A C compiler makes its libraries, unless ``sources_only``, and ``rustc`` beside it those of machines with contacts or guides.
    ``kind``: ``"me"``, model exchange, and ``"cs"``, co-simulation, by ``method``, ``"dop853"`` or ``"dopri5"``, to ``tolerance``; by
    default both, or what the machine allows. ``outputs`` are names; ``events`` maps names to formulas, whose sign changes are reported.
    """
    options = [f"--out={os.fspath(out)}", f"--fmi={fmi}", f"--tolerance={float(tolerance)!r}"]
    if kind is not None:
        options.append(f"--kind={','.join([kind] if isinstance(kind, str) else kind)}")
    if method is not None:
        options.append(f"--method={method}")
    options += [*settings(self), *_places(self, "--start", start), *_places(self, "--rate", rate)]
    if outputs is not None:
        options.append(f"--outputs={','.join([outputs] if isinstance(outputs, str) else outputs)}")
    options += [f"--event={name}={formula}" for name, formula in (events or {}).items()]
    if cc is not None:
        options.append(f"--cc={cc}")
    if target:
        options.append(f"--target={','.join(target)}")
    if sources_only:
        options.append("--sources-only")
    told = _exported(self, "fmu", options)
    counts = [int(told[name]) for name in ("states", "parameters", "inputs", "outputs", "events")]
    return Fmu(told["unit"], told["fmi"], told["kinds"], told["platforms"], *counts)


def _exported(machine: Any, command: str, options: Sequence[str]) -> Dict[str, Any]:
    """The command's output about a file that it wrote; raises ExportError if a compiler or the machine prevents that."""
    try:
        return answer(machine, command, options)
    except LagrangianError as error:
        reason, _, output = str(error).partition("\n")
        raise ExportError(reason, output) from None


class Brachistochrone:
    """The fastest motion from rest at one position to another, under control forces that do no work, at k instants."""

    time: float
    """Its duration, in s."""
    is_motion: bool
    """Whether it is a motion of the machine: guides only press, and a simulation under the control forces arrives at the end."""
    t: np.ndarray
    """(k,), in s."""
    q: Named
    """(k, n)"""
    v: Named
    """(k, n)"""
    control: Named
    """Generalized control forces, (k, n)."""
    reactions: Mapping[str, np.ndarray]
    """Normal reactions of guides by name, (k,), in N."""
    parameters: Mapping[str, Any]
    """Constants of the motion, under the names that ``lagrangian brachistochrone --json`` gives them."""
    method: str
    """``"closed form"`` or ``"direct"``."""
    warnings: List[str]

    def __init__(self, machine: Any, options: List[str], document: Mapping[str, Any]) -> None:
        names = tuple(machine.coordinates)
        path = document["path"]

        def named(what: str) -> Named:
            return Named([[moment[what][name] for name in names] for moment in path], names)

        self.time = float(document["time"])
        self.is_motion = bool(document["is_motion"])
        self.t = np.array([moment["t"] for moment in path])
        self.t.flags.writeable = False
        self.q, self.v, self.control = named("q"), named("v"), named("control")
        guides = path[0]["reactions"]
        self.reactions = {name: np.array([moment["reactions"][name] for moment in path]) for name in guides}
        self.parameters = document["parameters"]
        self.method = document["method"]
        self.warnings = list(document["warnings"])
        self._machine, self._options = machine, options

    @property
    def end(self) -> State:
        """The state at the end of the motion."""
        return State(float(self.t[-1]), self.q[-1], self.v[-1])

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a table ``.csv`` or ``.parquet``, a drawing ``.svg``, or a page ``.html``."""
        path = os.fspath(path)
        kinds = {".csv": "--out", ".parquet": "--out", ".svg": "--plot", ".html": "--report"}
        ending = os.path.splitext(path)[1].lower()
        if ending not in kinds:
            raise ValueError(f"{path}: the ending must be one of {', '.join(kinds)}")
        answer(self._machine, "brachistochrone", [*self._options, f"{kinds[ending]}={path}"], wrong=())

    def __repr__(self) -> str:
        claim = "" if self.is_motion else ", but the machine does not move in this way"
        return f"<Brachistochrone of {self._machine.name}: {self.time:.6g} s, {self.method}{claim}>"


def _places(machine: Any, option: str, given: Any) -> List[str]:
    """Options that set coordinates; those that are not given keep the values of the spec."""
    names = machine.coordinates
    if given is None:
        return []
    if isinstance(given, State):
        given = given.q
    if isinstance(given, Mapping):
        of_states = machine.states if option in ("--start", "--rate") else ()
        for name in given:
            if not _batch.of_name(name, names) and not _batch.of_name(name, of_states):
                raise unknown("coordinate", name, (*names, *of_states))
        said = {name if option == "--start" else _batch.for_command(machine, name): x for name, x in given.items()}
        return [f"{option}={name}={float(x)!r}" for name, x in said.items()]
    values = _batch.number_array(given, option.strip("-"))
    if values.shape != (len(names),):
        raise ValueError(f"{option.strip('-')} has shape {values.shape}, expected ({len(names)},)")
    return [f"{option}={name}={float(x)!r}" for name, x in zip(names, values)]


def brachistochrone(
    self: Any,
    to: Any = None,
    *,
    start: Any = None,
    natural: bool = False,
    guess: Optional[Union[str, "os.PathLike[str]"]] = None,
) -> Brachistochrone:
    """The fastest motion from rest at ``start`` to ``to``, where the machine need not be at rest, as by ``lagrangian brachistochrone``.

    Both are mappings from coordinates to numbers or arrays (n,), by default those of the spec; with ``natural`` they are in normal
    coordinates. ``guess`` is a table of a path near which the motion is sought if there is no closed form.
    """
    options = [*settings(self), *_places(self, "--from", start), *_places(self, "--to", to)]
    if natural:
        options.append("--natural")
    if guess is not None:
        options.append(f"--guess={os.fspath(guess)}")
    return Brachistochrone(self, options, answer(self, "brachistochrone", options, wrong=(1,)))


class Campbell:
    """Eigenvalues along values of a parameter or of a rate, each mode followed from value to value."""

    name: str
    """The name of the varied quantity."""
    unit: str
    values: np.ndarray
    """(k,)"""
    eigenvalues: np.ndarray
    """Complex (k, modes), in 1/s; of each conjugate pair the one with a positive imaginary part. NaN where a mode does not exist."""

    def __init__(self, values: np.ndarray, document: Mapping[str, Any]) -> None:
        self.name, self.unit = document["along"]["name"], document["along"]["unit"]
        rows = document["rows"]
        count = max((row["mode"] for row in rows), default=0)
        self.values = values
        self.eigenvalues = np.full((len(values), count), complex(math.nan, math.nan))
        for row in rows:
            # The command's values are those of the range up to round-off.
            place = int(np.argmin(np.abs(values - row["value"])))
            self.eigenvalues[place, row["mode"] - 1] = complex(row["re"], row["im"])
        self.values.flags.writeable = False
        self.eigenvalues.flags.writeable = False

    @property
    def frequencies(self) -> np.ndarray:
        """Hz, (k, modes)."""
        return np.asarray(self.eigenvalues.imag / (2 * np.pi))

    @property
    def damping(self) -> np.ndarray:
        """−Re λ/|λ|, (k, modes); NaN where nothing oscillates."""
        size = np.abs(self.eigenvalues)
        found = np.full(size.shape, math.nan)
        np.divide(-self.eigenvalues.real, size, out=found, where=(size > 0) & (self.eigenvalues.imag != 0))
        return found

    def plot(self) -> Any:
        """A matplotlib figure of the frequencies and of Re λ over the values."""
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(2, 1, sharex=True)
        axes[0].plot(self.values, self.frequencies, ".-")
        axes[0].set_ylabel("frequency [Hz]")
        axes[1].plot(self.values, self.eigenvalues.real, ".-")
        axes[1].axhline(0.0, color="black", linewidth=0.5)
        axes[1].set_ylabel("Re λ [1/s]")
        axes[1].set_xlabel(self.name if self.unit == "1" else f"{self.name} [{self.unit}]")
        return figure

    def __repr__(self) -> str:
        k, modes = self.eigenvalues.shape
        return f"<Campbell: {modes} modes at {k} values of {self.name}>"


def campbell(
    self: Any,
    parameter: str,
    values: Any,
    *,
    start: Any = None,
    rate: Any = None,
    steady: Any = None,
) -> Campbell:
    """Eigenvalues about the equilibrium, or the steady motion, that is followed along equally spaced values of a parameter, of an
    input, or of the rate of a coordinate that moves steadily: ``(a, b, k)`` or an array (k,). ``steady`` is as for ``linearize``.
    """
    if isinstance(values, tuple) and len(values) == 3 and isinstance(values[2], int):
        values = np.linspace(*values)
    values = np.array(_batch.number_array(values, "values")).ravel()
    even = len(values) >= 2 and np.ptp(np.diff(values)) <= 1e-9 * abs(values[-1] - values[0])
    if not even or values[0] == values[-1]:
        raise ValueError("the values of a Campbell diagram must be two or more, equally spaced: (a, b, k)")
    options = settings(self)
    varied = {name for name in (parameter,) if name in {**self.parameters, **self.inputs}}
    options = [option for option in options if option.split("=")[1] not in varied]
    options += [*_places(self, "--start", start), *_places(self, "--rate", rate)]
    if isinstance(steady, str):
        steady = [steady]
    moves = steady if isinstance(steady, Mapping) else {name: None for name in steady or ()}
    for name, value in moves.items():
        if value is None:
            options.append(f"--steady={name}")
        else:
            options.append(f"--steady={name}={value if isinstance(value, str) else repr(float(value))}")
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        # The command writes the table in any case.
        options.append(f"--out={os.path.join(folder, 'along.csv')}")
        options.append(f"--along={parameter}={float(values[0])!r}..{float(values[-1])!r}:{len(values)}")
        return Campbell(values, answer(self, "linearize", options))
