"""Runs, and their options."""

from __future__ import annotations

import math
import os
import sys
import time
from types import MappingProxyType
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _batch, _native, _signals
from ._named import Named, State, rates
from .errors import RunError, unknown


class Event:
    """A function of time and state whose sign changes are events.

    ``what`` is a formula of the spec's language in t, coordinates, rates, parameters, inputs and outputs, or a function
    ``f(t, q, v)``. ``crossing`` is ``"any"``, ``"rising"`` or ``"falling"``; ``terminal=n`` ends the run at the n-th event,
    ``True`` at the first.
    """

    def __init__(
        self,
        what: Union[str, Callable[..., float]],
        crossing: str = "any",
        terminal: Union[bool, int] = False,
    ) -> None:
        if crossing not in DIRECTIONS:
            raise ValueError(f"crossing={crossing!r}: must be 'any', 'rising' or 'falling'")
        if int(terminal) < 0:
            raise ValueError(f"terminal={terminal!r}: must not be negative")
        self.what = what
        self.crossing = crossing
        self.terminal = int(terminal)

    def __repr__(self) -> str:
        return f"Event({self.what!r}, crossing={self.crossing!r}, terminal={self.terminal})"


DIRECTIONS = {"any": 0, "rising": 1, "falling": -1}


class Happened(NamedTuple):
    """An event of a run."""

    t: float
    name: str
    q: Named
    v: Named


class Energy(NamedTuple):
    """The energy balance of a run, in J."""

    residual: float
    """end − start − work + dissipated, 0 except for rounding and the errors that the tolerance permits."""
    work: float
    """Work of drives, applied forces and inputs."""
    dissipated: float
    """Energy dissipated by dampers, friction and impacts."""
    kinetic: np.ndarray
    """At the instants of the run, (k,)."""
    potential: np.ndarray
    """At the instants of the run, (k,)."""
    constraint_residual: float
    """The largest residual of the constraints during the run, relative to the size of their terms."""


class Run:
    """The result of a run: its samples, its events, and everything that can be observed along it. Immutable."""

    def __init__(self, machine: Any, native: _native.Run, keywords: Dict[str, Any], error: Optional[str]) -> None:
        self.machine = machine
        self.error = error
        """The error that ended it early; None if there was none."""
        self._native = native
        self._keywords = keywords
        names = machine.coordinates
        t, q, v = native.samples()
        n = len(names)
        t.flags.writeable = False
        self.t: np.ndarray = t
        """The instants of the samples, (k,), in s."""
        self.q = Named(q.reshape(len(t), n), names)
        """Coordinates, (k, n)."""
        self.v = rates(v.reshape(len(t), n), names)
        """Rates, (k, n)."""
        self._columns: Optional[Dict[str, np.ndarray]] = None
        self._units: Dict[str, str] = {}

    def _observed(self) -> Dict[str, np.ndarray]:
        if self._columns is None:
            columns = {}
            for name, unit, values in self._native.columns():
                if name in self.machine.outputs or not name.startswith(_HIDDEN):
                    values.flags.writeable = False
                    columns[name] = values
                    self._units[name] = unit
            inputs = tuple(self.machine.inputs)
            if inputs:
                flat = self._native.inputs(self.t.tolist(), np.ravel(self.q).tolist(), np.ravel(self.v).tolist())
                flat = flat.reshape(len(self.t), len(inputs))
                for i, name in enumerate(inputs):
                    columns[name] = flat[:, i]
                    self._units[name] = self.machine.units[name]
            self._columns = columns
        return self._columns

    @property
    def columns(self) -> Tuple[str, ...]:
        """The names of the columns, which are those of the command's tables and the inputs: coordinates, ``der(x)``, outputs,
        ``multiplier(rod)``, ``normal(belt)``, energies, inputs."""
        return tuple(self._observed())

    @property
    def units(self) -> Mapping[str, str]:
        """The unit of each column."""
        self._observed()
        return MappingProxyType(self._units)

    def __getitem__(self, name: str) -> np.ndarray:
        """A column by name, (k,)."""
        if name in self.q.names:
            return np.asarray(self.q[name])
        if name == "t":
            return self.t
        columns = self._observed()
        if name not in columns:
            raise unknown("column", name, tuple(columns))
        values: np.ndarray = columns[name]
        return values

    def _state(self, states: Tuple[Any, Any, Any], shape: Tuple[int, ...]) -> State:
        t, q, v = states
        names = self.machine.coordinates
        n = (len(names),)
        return State(
            t.reshape(shape)[()], Named(q.reshape(shape + n), names), rates(v.reshape(shape + n), names)
        )

    def at(self, t: Any) -> State:
        """The state at times of any shape and order, by the dense output of the method."""
        times = _batch.number_array(t, "t")
        order = np.argsort(times, axis=None, kind="stable")
        flat = times.ravel()[order]
        first, last = sorted((self._start_t, self.end.t))
        outside = (flat < first) | (flat > last) | np.isnan(flat)
        if outside.any():
            raise ValueError(f"t = {flat[outside][0]} s is outside of the run, from {first} s to {last} s")
        if not self._keywords["dense"]:
            raise ValueError("the steps of this run were forgotten: dense=False")
        if self.end.t < self._start_t:
            order = order[::-1]
            flat = flat[::-1]
        found, q, v = self._native.at(flat.tolist())
        back = np.empty_like(order)
        back[order] = np.arange(order.size)
        n = len(self.machine.coordinates)
        return self._state((found[back], q.reshape(-1, n)[back], v.reshape(-1, n)[back]), times.shape)

    def observe(self, t: Any) -> Any:
        """Everything that :meth:`Machine.evaluate` computes, at times of any shape S and order, with the inputs of the run.

        ``observe(t)[name]`` is a column of the run at these times, of shape S. In the columns a contact sticks or slides as it did in
        the run; the other results follow from the state alone.
        """
        state = self.at(t)
        times = np.asarray(state.t, dtype=np.float64)
        flat = times.ravel()
        names = self.machine.outputs
        columns = self._native.columns(flat.tolist())
        shown = {
            name: values.reshape(times.shape)[()]
            for name, _, values in columns
            if name in names or not name.startswith(_HIDDEN)
        }
        inputs = tuple(self.machine.inputs)
        u = None
        if inputs:
            u = self._native.inputs(flat.tolist(), np.ravel(state.q).tolist(), np.ravel(state.v).tolist())
            u = u.reshape(times.shape + (len(inputs),))
            shown.update({name: u[..., i][()] for i, name in enumerate(inputs)})
        made = self.machine.evaluate(state.q, state.v, state.t, u=u, singular="nan")
        made.columns = MappingProxyType(shown)
        return made

    @property
    def _start_t(self) -> float:
        return float(self._native.start[0][0])

    @property
    def start(self) -> State:
        """The state at the start, projected onto the constraints."""
        return self._state(self._native.start, ())

    @property
    def end(self) -> State:
        """The state at the end."""
        return self._state(self._native.end, ())

    @property
    def ending(self) -> str:
        """What ended the run: ``"time"``, ``"event NAME"``, ``"stop"`` or ``"error"``."""
        return "error" if self.error is not None else str(self._native.ending)

    @property
    def events(self) -> List[Happened]:
        """The events, in the order of time."""
        names, _, (t, q, v) = self._native.events()
        of = self.machine.coordinates
        q, v = q.reshape(len(t), len(of)), v.reshape(len(t), len(of))
        return [Happened(float(t[i]), name, Named(q[i], of), rates(v[i], of)) for i, name in enumerate(names)]

    def event(self, name: str) -> State:
        """The states at the e events with this name: t (e,), q and v (e, n)."""
        names, _, (t, q, v) = self._native.events()
        known = [*self._keywords["event_names"], *names]
        if name not in known:
            raise unknown("event", name, tuple(dict.fromkeys(known)))
        chosen = np.array([of == name for of in names], dtype=bool)
        n = len(self.machine.coordinates)
        return self._state((t[chosen], q.reshape(-1, n)[chosen], v.reshape(-1, n)[chosen]), (int(chosen.sum()),))

    def poincare(self, event: str) -> np.ndarray:
        """The states y at the e events with this name, coordinates and then rates: (e, 2n)."""
        return self.event(event).y

    @property
    def energy(self) -> Energy:
        """The energy balance."""
        balance = self._native.energy()
        if balance is None:
            raise ValueError("the energy balance was not computed: energy=False")
        return Energy(
            residual=balance["residual"],
            work=balance["work"],
            dissipated=balance["dissipated"],
            kinetic=self["kinetic energy"],
            potential=self["potential energy"],
            constraint_residual=self._native.statistics["constraint_residual"],
        )

    @property
    def statistics(self) -> Mapping[str, Any]:
        """``steps``, ``rejected``, ``evaluations``, ``seconds``, ``constraint_residual``, ``stiff_since``, ``engine``."""
        return MappingProxyType({**self._native.statistics, "engine": self._keywords["engine"]})

    @property
    def warnings(self) -> List[str]:
        """Warnings, which a run may have although it ended without an error."""
        return list(self._native.warnings)

    @property
    def choices(self) -> List[Tuple[float, str, str]]:
        """The methods that a run with ``method="auto"`` used, in order: the time from which it used each, in s, its name, and why it was
        chosen. Empty for other runs."""
        return list(self._native.choices)

    def to_numpy(self, names: Optional[Sequence[str]] = None) -> np.ndarray:
        """The columns of these names, or all of them, as an array (k, columns)."""
        chosen = self.columns if names is None else names
        return np.stack([self[name] for name in chosen], axis=-1)

    def to_pandas(self) -> Any:
        """A DataFrame of all columns, whose index is t."""
        import pandas

        frame = pandas.DataFrame({name: self[name] for name in self.columns})
        frame.index = pandas.Index(self.t, name="t")
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table`` of t and all columns, with their units in the metadata of the fields."""
        import pyarrow

        fields = [pyarrow.field("t", pyarrow.float64(), metadata={"unit": "s"})]
        fields += [
            pyarrow.field(name, pyarrow.float64(), metadata={"unit": self.units[name]}) for name in self.columns
        ]
        arrays = [self.t, *(self[name] for name in self.columns)]
        return pyarrow.table([pyarrow.array(np.asarray(a)) for a in arrays], schema=pyarrow.schema(fields))

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes t and all columns: ``.csv``, ``.npz``, ``.parquet`` or ``.mat``; or the report page, ``.html``. The file is written
        under a temporary name and renamed when it is complete."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lower()
        headers = {name: name if self.units[name] == "1" else f"{name} [{self.units[name]}]" for name in self.columns}
        data = {"t": self.t, **{name: self[name] for name in self.columns}}

        def csv(file: Any) -> None:
            lines = [",".join(["t [s]", *headers.values()])]
            rows = np.stack(list(data.values()), axis=-1).tolist()
            lines += [",".join(map(repr, row)) for row in rows]
            file.write(("\n".join(lines) + "\n").encode())

        def npz(file: Any) -> None:
            np.savez(file, **data)  # type: ignore[arg-type]

        def parquet(file: Any) -> None:
            import pyarrow.parquet

            pyarrow.parquet.write_table(self.to_arrow(), file)

        def mat(file: Any) -> None:
            import scipy.io

            # Names in MATLAB consist of letters, digits and underscores.
            names = {name: _identifier(name) for name in data}
            if len(set(names.values())) < len(names):
                raise ValueError("two columns would have the same name in MATLAB")
            scipy.io.savemat(file, {names[name]: values for name, values in data.items()})

        def html(file: Any) -> None:
            file.write(self.report().html.encode())

        writers = {".csv": csv, ".npz": npz, ".parquet": parquet, ".mat": mat, ".html": html}
        if ending not in writers:
            raise ValueError(f"{path}: the ending must be one of {', '.join(writers)}")
        _written_beside(path, writers[ending])

    def as_ivp(self) -> Any:
        """The run in the form that ``scipy.integrate.solve_ivp`` returns: t, y (2n, k), sol, t_events, y_events, status, message, success, nfev."""
        from scipy.optimize import OptimizeResult

        events = [self.event(name) for name in self._keywords["event_names"]]
        is_event = self.ending.startswith("event ")
        messages = {
            "time": "The solver successfully reached the end of the integration interval.",
            "stop": "A condition ended the run.",
        }
        return OptimizeResult(
            t=np.array(self.t),
            y=np.concatenate([self.q, self.v], axis=-1).T,
            sol=(lambda t: np.moveaxis(self.at(t).y, -1, 0)) if self._keywords["dense"] else None,
            t_events=[np.atleast_1d(event.t) for event in events],
            y_events=[event.y for event in events],
            status=1 if is_event else (-1 if self.error is not None else 0),
            message=self.error or ("A termination event occurred." if is_event else messages[self.ending]),
            success=self.error is None,
            nfev=self.statistics["evaluations"],
        )

    def spectrum(self, name: str, window: str = "hann") -> Tuple[np.ndarray, np.ndarray]:
        """Frequencies in Hz and amplitudes of a column, whose instants must be equally spaced.

        A sine of amplitude A on one of the frequencies has the amplitude A.
        """
        steps = np.diff(self.t)
        even = len(steps) >= 2 and np.ptp(np.abs(steps[:-1])) <= 1e-9 * abs(steps[0])
        if not even or abs(steps[-1]) > (1 + 1e-9) * abs(steps[0]):
            raise ValueError("a spectrum needs equally spaced instants: every=…")
        if window not in ("hann", "none"):
            raise ValueError(f"window={window!r}: must be 'hann' or 'none'")
        values = self[name]
        # An end that is not at a sampling instant is left out.
        if abs(steps[-1] - steps[0]) > 1e-9 * abs(steps[0]):
            values = values[:-1]
        count = len(values)
        # A periodic window, whose next sample would equal the first.
        weights = np.hanning(count + 1)[:-1] if window == "hann" else np.ones(count)
        transformed = np.fft.rfft((values - values.mean()) * weights)
        amplitudes = 2.0 * np.abs(transformed) / weights.sum()
        return np.fft.rfftfreq(count, abs(float(steps[0]))), amplitudes

    def report(self) -> "Report":
        """The report page, which shows the machine in motion, with curves, parameters and equations. A notebook displays it."""
        if not self._keywords["dense"]:
            raise ValueError("the steps of this run were forgotten, and its page needs them: dense=False")
        return Report(self)

    def _repr_html_(self) -> Optional[str]:
        """The report page for a notebook, in a frame without access to the notebook; None if the steps were not kept."""
        return self.report()._repr_html_() if self._keywords["dense"] else None

    def _page(self) -> str:
        relative, absolute = self._keywords["tolerance"]
        tolerance = f"{relative:g}" if relative == absolute else f"{relative:g}, {absolute:g}"
        file = os.path.basename(self.machine._program.file)
        asked = (file, tolerance, self._keywords["driven"])
        page: str = self._native.page(self.machine, asked, self._keywords["method"], self.error)
        return page

    def plot(self, *names: str) -> Any:
        """A matplotlib figure of these columns over t, by default of all coordinates."""
        import matplotlib.pyplot as plt

        chosen = names or self.machine.coordinates
        by_unit: Dict[str, List[str]] = {}
        for name in chosen:
            self[name]
            by_unit.setdefault(self.units[name], []).append(name)
        figure, axes = plt.subplots(len(by_unit), 1, sharex=True, squeeze=False)
        for axis, (unit, group) in zip(axes[:, 0], by_unit.items()):
            for name in group:
                axis.plot(self.t, self[name], label=name)
            axis.set_ylabel(f"[{unit}]")
            axis.legend()
        axes[-1, 0].set_xlabel("t [s]")
        return figure

    def __reduce__(self) -> Any:
        # A pickled run is made again from its arguments, with the same bits.
        return (_run_again, (self.machine, self._keywords["arguments"]))

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        steps = self.statistics["steps"]
        return f"<Run of {self.machine.name}: t = {self._start_t:g} … {float(self.end.t):g} s, {steps} steps, ended by {self.ending}>"


class Report:
    """The report page of a run: one HTML file that needs no other file and no network."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._made: Optional[str] = None

    @property
    def html(self) -> str:
        """The HTML text of the page."""
        if self._made is None:
            self._made = self._run._page()
        return self._made

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the page, ``.html``, under a temporary name, and renames the file when it is complete."""
        path = os.fspath(path)
        if os.path.splitext(path)[1].lower() not in (".html", ".htm"):
            raise ValueError(f"{path}: the ending must be .html")
        _written_beside(path, lambda file: file.write(self.html.encode()))

    def _repr_html_(self) -> str:
        from html import escape

        # The frame's scripts run but cannot access the notebook.
        return (
            f'<iframe sandbox="allow-scripts allow-downloads" srcdoc="{escape(self.html)}" '
            'style="width:100%;height:44em;border:1px solid #ccc"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<Report of {self._run!r}: .html, .save(path)>"


#: Columns of formulas that were added to those of the spec.
_HIDDEN = ("input formula ", "event formula ", "stop formula")


def _run_again(machine: Any, arguments: Tuple[float, Dict[str, Any]]) -> Run:
    until, settings = arguments
    return simulate(machine, until, **{**settings, "on_error": "return", "progress": False})


def _identifier(name: str) -> str:
    made = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name).strip("_")
    return made if made[:1].isalpha() else f"x_{made}"


def _written_beside(path: str, write: Callable[[Any], None]) -> None:
    """Writes a file that gets its name only when it is complete."""
    import tempfile

    folder = os.path.dirname(os.path.abspath(path))
    file = tempfile.NamedTemporaryFile(dir=folder, prefix=".", suffix=os.path.splitext(path)[1], delete=False)
    try:
        with file:
            # Passes the file itself: SciPy needs methods that the wrapper lacks.
            write(file.file)
        mode = os.stat(path).st_mode & 0o777 if os.path.exists(path) else 0o666 & ~_umask()
        os.chmod(file.name, mode)
        os.replace(file.name, path)
    except BaseException:
        os.unlink(file.name)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def in_notebook() -> bool:
    """Whether this process is the kernel of a notebook, which shows what is written to stderr."""
    shell = sys.modules.get("IPython")
    kernel = shell.get_ipython() if shell is not None else None
    return kernel is not None and hasattr(kernel, "kernel")


def _progress(asked: Any, until: float) -> Optional[Callable[[float, float, int], None]]:
    if asked is False or asked is None:
        return None
    if callable(asked):
        return asked  # type: ignore[no-any-return]
    if asked != "auto":
        raise ValueError(f"progress={asked!r}: must be 'auto', False or a function")
    if not (sys.stderr.isatty() or in_notebook()):
        return None
    began = time.monotonic()

    def bar(fraction: float, t: float, steps: int) -> None:
        if time.monotonic() - began >= 2.0:
            done = int(40 * fraction)
            sys.stderr.write(f"\r[{'#' * done}{' ' * (40 - done)}] t = {t:.4g} of {until:g} s, {steps} steps ")
            if fraction >= 1.0:
                sys.stderr.write("\n")
            sys.stderr.flush()

    return bar


def simulate(
    machine: Any,
    until: float,
    *,
    start: Any = None,
    rate: Any = None,
    t0: float = 0.0,
    parameters: Optional[Mapping[str, float]] = None,
    inputs: Any = None,
    events: Any = (),
    stop: Any = None,
    tolerance: float = 1e-9,
    relative: Optional[float] = None,
    absolute: Union[None, float, Mapping[str, float]] = None,
    method: str = "dop853",
    one_of: int = 1,
    every: Optional[float] = None,
    at: Optional[Sequence[float]] = None,
    dense: bool = True,
    energy: bool = True,
    first_step: Optional[float] = None,
    longest_step: Optional[float] = None,
    max_steps: int = 10_000_000,
    keep: Optional[Sequence[str]] = None,
    on_error: str = "raise",
    progress: Any = "auto",
) -> Run:
    """Runs the machine from ``t0`` to ``until``, in s.

    * ``start``, ``rate``: mappings from names to numbers, which replace those of the spec, or arrays (n,); or ``start`` is a State,
      such as ``run.end``, and ``rate`` is omitted.
    * ``inputs``: a mapping from names to what drives each: a number, a formula of the spec's language (``"30*N*theta +
      5*N*s*der(theta)"``), a function ``f(t, q, v)``, a :class:`Table` or its arrays ``(t, values)``, a table in a file as for the command
      (``"run.csv:push,hold"``, or a path), or a :class:`Sampled` controller; or one function of all inputs, which returns an
      array (m,) or a mapping. Functions must depend on their arguments alone, since they are called at times in any order; those of
      sampled controllers are called in the order of time.
    * ``events``: a mapping from names to formulas, functions ``f(t, q, v)``, or :class:`Event`. Each change of sign is located to
      within the rounding of time. The attributes ``terminal`` and ``direction`` of a function have the same meaning as in SciPy.
    * ``stop``: the run ends after the first step at whose end this formula is greater than 0, or this function returns true.
    * ``every``, ``at``: the samples are this many seconds apart, or are at these instants; by default they divide the run into 1000
      intervals. With ``dense=False`` the steps are not kept, and ``run.at`` is not available.
    * ``energy``: whether the energy balance is computed.
    * ``tolerance`` sets both ``relative`` and ``absolute``, which replace it where they are given; ``absolute`` may be a mapping from
      names to numbers.
    * ``method``: with error control ``dop853``, ``dopri5``, ``bs32``, ``taylor``, and for stiff machines ``radau5``, ``radau9`` and
      ``radau13``; in steps of the fixed length ``longest_step``, in s, ``rk4``, ``semi-implicit-euler``, ``gauss4``, ``gauss6``,
      ``gauss8``, ``rattle``, ``generalized-alpha`` and ``moreau``. ``auto`` chooses, and may change its choice during the run
      (``run.choices``): ``taylor`` in long runs where this costs less, a Radau method where the machine is stiff, and time stepping
      where contacts change too often. ``one_of`` is the number of runs that share the derivation of a series, as the rows of a sweep
      do.
    * ``first_step``: the length of the first step, in s; ``max_steps``: the largest number of steps.
    * ``keep``: start values, ``"theta"`` or ``"der(theta)"``, that stay as they are if the start does not satisfy the constraints; the
      others are corrected. By default those that the spec keeps.
    * ``progress``: ``"auto"`` (a line on a terminal after 2 s), False, or ``f(fraction, t, steps)``.

    A run that ends with an error raises :class:`RunError`, with the part that was computed; ``on_error="return"`` returns that part.
    """
    given = dict(locals())
    del given["machine"], given["until"]
    if int(one_of) < 1 or (one_of != 1 and method != "auto"):
        raise ValueError(f"one_of={one_of!r}: a number of runs, of which method='auto' shares the derivation of a series")
    if on_error not in ("raise", "return"):
        raise ValueError(f"on_error={on_error!r}: must be 'raise' or 'return'")
    if parameters:
        machine = machine._set(dict(parameters))
    names = machine.coordinates
    if isinstance(start, State):
        if rate is not None:
            raise ValueError("start is a State, which has rates of its own")
        t0 = float(start.t) if t0 == 0.0 else t0
        start, rate = start.q, start.v
    until, t0 = float(until), float(t0)
    q, v = _batch.start_of(machine, start, rate)
    if not (math.isfinite(until) and math.isfinite(t0)):
        raise ValueError(f"a run must go from one finite time to another, not from {t0} s to {until} s")
    if every is not None and at is not None:
        raise ValueError("instants are kept by `every` or by `at`, not by both")
    instants = None
    if at is not None:
        instants = _batch.number_array(at, "at").ravel()
        direction = math.copysign(1.0, until - t0)
        if (np.diff(instants) * direction < 0).any():
            raise ValueError("at is not sorted in the direction of the run")
        outside = ((instants - t0) * direction < 0) | ((instants - until) * direction > 0) | np.isnan(instants)
        if outside.any():
            raise ValueError(f"at={instants[outside][0]} is outside of the run, from {t0} s to {until} s")

    # Formulas are derived together with the spec, as hidden outputs.
    formulas: List[Tuple[str, str, str, Optional[str]]] = []

    def formula(kind: str, said: str, text: str, unit: Optional[str]) -> int:
        formulas.append((f"{kind} formula {len(formulas)}", said, text, unit))
        return len(formulas) - 1

    driven: Dict[str, Any] = {}
    # The laws of inputs and the observed functions: the index of a formula, or a function.
    rules: List[Tuple[int, str, Optional[int], Optional[Callable[..., Any]], Any, Any]] = []
    watched: List[Tuple[str, Optional[int], Optional[Callable[..., Any]], int, Optional[int]]] = []
    stops: Optional[Tuple[Optional[int], Optional[Callable[..., Any]]]] = None
    all_inputs: Optional[Callable[..., Any]] = None
    known_inputs = tuple(machine.inputs)
    if callable(inputs):
        all_inputs = _all_inputs(inputs, known_inputs, names)
    elif inputs is not None:
        for name, what in inputs.items():
            places = _batch.of_name(name, known_inputs)
            if not places:
                raise unknown("input", name, known_inputs)
            for place in places:
                own = known_inputs[place]
                unit = machine.units[own]
                signal = _signals.driven(what, own, unit)
                if signal is None:
                    driven[own] = what
                    continue
                text, function, table, sampling = signal
                number = None if text is None else formula("input", f"input {own}", text, unit)
                called = None if function is None else _named_arguments(function, names)
                rules.append((place, own, number, called, table, sampling))
    if driven:
        machine = machine._set(driven)
    event_names: List[str] = []
    if not isinstance(events, Mapping):
        if events and not isinstance(events, (list, tuple)):
            raise TypeError("events must be a mapping from names to formulas or functions")
        events = {getattr(e, "__name__", f"event {i}"): e for i, e in enumerate(events)}
    for name, asked in events.items():
        event = asked
        if not isinstance(event, Event):
            direction = float(getattr(asked, "direction", 0.0))
            crossing = "any" if direction == 0 else ("rising" if direction > 0 else "falling")
            event = Event(asked, crossing, int(getattr(asked, "terminal", False)))
        way, ends = DIRECTIONS[event.crossing], event.terminal or None
        event_names.append(name)
        if isinstance(event.what, str):
            number = formula("event", f"event {name}", event.what, None)
            watched.append((name, number, None, way, ends))
        elif callable(event.what):
            watched.append((name, None, _named_arguments(event.what, names), way, ends))
        else:
            raise TypeError(f"event {name} is {event.what!r}, expected a formula or a function")
    if isinstance(stop, str):
        stops = (formula("stop", "stop", stop, None), None)
    elif callable(stop):
        stops = (None, _named_arguments(stop, names))
    elif stop is not None:
        raise TypeError(f"stop is {stop!r}, expected a formula or a function")
    runs = machine
    if formulas:
        program = machine._program.with_formulas(formulas)
        runs = type(machine)._with(program, *machine._values)
        outputs = program.formulas
        rules = [(i, n, None if k is None else outputs[k], *rest) for i, n, k, *rest in rules]
        watched = [(n, None if k is None else outputs[k], f, d, e) for n, k, f, d, e in watched]
        if stops is not None and stops[0] is not None:
            stops = (outputs[stops[0]], None)

    relative = tolerance if relative is None else relative
    absolute_of: Dict[str, float] = {}
    if isinstance(absolute, Mapping):
        absolute_of, absolute = {k: float(x) for k, x in absolute.items()}, None
    absolute = tolerance if absolute is None else absolute
    settings = {
        "t0": t0,
        "q": q.tolist(),
        "v": v.tolist(),
        "until": until,
        "relative": float(relative),
        "absolute": float(absolute),
        "absolute_of": list(absolute_of.items()),
        "method": method,
        "one_of": int(one_of),
        "every": every,
        "at": None if instants is None else instants.tolist(),
        "dense": bool(dense),
        "energy": bool(energy),
        "first_step": first_step,
        "longest_step": longest_step,
        "max_steps": int(max_steps),
        "keep": None if keep is None else list(keep),
        "rules": rules,
        "all_inputs": all_inputs,
        "events": watched,
        "stop": stops,
        "progress": _progress(progress, until),
    }
    native, error = _native.simulate(runs, settings)
    objection = None if error is not None else native.objection()
    keywords = {
        "dense": bool(dense),
        "event_names": event_names,
        "engine": _native.engine(),
        # The last method of a run that chose its own.
        "method": native.choices[-1][1] if native.choices else method,
        "tolerance": (float(relative), float(absolute)),
        "driven": _driven(inputs, known_inputs),
        "arguments": (until, given),
    }
    run = Run(machine, native, keywords, error or objection)
    if run.error is not None and on_error == "raise":
        raise RunError(run.error, float(run.end.t), run)
    return run


def _driven(inputs: Any, names: Tuple[str, ...]) -> List[Tuple[str, str]]:
    """The sources of inputs, as a page names them; constant inputs are listed there anyway."""

    def said(what: Any) -> str:
        if callable(what):
            return f"{getattr(what, '__name__', 'a function')}(t, q, v)"
        if isinstance(what, tuple):
            return "a table"
        return what if isinstance(what, str) else str(what)

    if callable(inputs):
        return [(name, said(inputs)) for name in names]
    given = (inputs or {}).items()
    return [(name, said(what)) for name, what in given if not isinstance(what, (int, float, np.number))]


def _named_arguments(function: Callable[..., Any], names: Tuple[str, ...]) -> Callable[[float, Any, Any], Any]:
    """Wraps a function so that it can access coordinates and rates by name."""

    def called(t: float, q: np.ndarray, v: np.ndarray) -> Any:
        return function(t, Named(q, names), rates(v, names))

    return called


def _all_inputs(
    function: Callable[..., Any], inputs: Tuple[str, ...], names: Tuple[str, ...]
) -> Callable[[float, Any, Any], Any]:
    """Wraps a function of all inputs so that it returns the list of their values."""

    def called(t: float, q: np.ndarray, v: np.ndarray) -> List[float]:
        values = function(t, Named(q, names), rates(v, names))
        if isinstance(values, Mapping):
            if set(values) != set(inputs):
                raise ValueError(f"inputs: the function returned {sorted(values)}, the machine has {sorted(inputs)}")
            return [float(values[name]) for name in inputs]
        return np.asarray(values, dtype=np.float64).ravel().tolist()

    return called
