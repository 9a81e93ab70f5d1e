"""Sweeps: many runs of one machine."""

from __future__ import annotations

import itertools
import json
import math
import os
import sys
import tempfile
import time
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _batch, _native, _signals
from ._named import State
from ._simulate import in_notebook
from .errors import unknown


class _Distribution:
    """The distribution of a varied quantity."""

    _kind = ""

    def __init__(self, *numbers: float) -> None:
        self._numbers = [float(x) for x in numbers]
        if not all(map(math.isfinite, self._numbers)):
            raise ValueError(f"{self!r}: the numbers must be finite")

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._numbers))})"


class Uniform(_Distribution):
    """A uniform distribution between a and b."""

    _kind = "uniform"

    def __init__(self, a: float, b: float) -> None:
        super().__init__(a, b)
        if not a < b:
            raise ValueError(f"{self!r}: the first end must be the lower one")


class LogUniform(_Distribution):
    """A distribution whose logarithm is uniform, between a and b of the same sign."""

    _kind = "log_uniform"

    def __init__(self, a: float, b: float) -> None:
        super().__init__(a, b)
        if not (a < b and a * b > 0):
            raise ValueError(f"{self!r}: both ends must have the same sign, and the first must be the lower one")


class Normal(_Distribution):
    """A normal distribution with this mean and standard deviation."""

    _kind = "normal"

    def __init__(self, mean: float, deviation: float) -> None:
        super().__init__(mean, deviation)
        if not deviation > 0:
            raise ValueError(f"{self!r}: the deviation must be greater than 0")


class Triangular(_Distribution):
    """A triangular distribution between a and b: its density rises linearly to the peak and falls linearly from there."""

    _kind = "triangular"

    def __init__(self, a: float, b: float, peak: float) -> None:
        super().__init__(a, b, peak)
        if not (a < b and a <= peak <= b):
            raise ValueError(f"{self!r}: the peak must lie between the ends")


#: A column: name, unit, values.
_Column = Tuple[str, Optional[str], Any]


class Sweep:
    """The rows of a sweep, one for each run. Immutable."""

    def __init__(self, machine: Any, plan: str, columns: List[_Column], samples: Optional[List[_Column]], keywords: Dict[str, Any]) -> None:
        self.machine = machine
        self.plan = plan
        """The plan as JSON, from which every chunk can be computed again."""
        self._columns = {name: values for name, _, values in columns}
        self.units: Mapping[str, str] = {name: unit for name, unit, _ in columns if unit is not None}
        self.samples: Optional[Dict[str, np.ndarray]] = None
        """With ``record="every=…"`` or ``"event=…"``, all samples of all runs: columns ``run``, ``t``, coordinates, rates, and ``event``."""
        if samples is not None:
            self.samples = {name: values for name, _, values in samples}
        self._keywords = keywords

    @property
    def columns(self) -> Tuple[str, ...]:
        """The names of the columns: ``run``, the varied quantities, ``status``, ``error``, ``t``, the end state, recorded instants ``x@0.5``,
        reductions, ``steps``, ``energy residual``."""
        return tuple(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._columns:
            raise unknown("column", name, self.columns)
        values: np.ndarray = self._columns[name]
        return values

    def __len__(self) -> int:
        return len(self._columns["run"])

    @property
    def failed(self) -> np.ndarray:
        """The numbers of the runs that failed; the column ``error`` gives the reasons."""
        return np.flatnonzero(self["status"] == "failed")

    @property
    def path(self) -> Optional[str]:
        """The file or folder with the rows; None if there is none."""
        return self._keywords["path"]  # type: ignore[no-any-return]

    def grid(self, name: str) -> np.ndarray:
        """A column in the shape of the design, with an axis for each varied quantity, in their order."""
        return self[name].reshape(self._keywords["shape"])

    def run(self, i: int, **settings: Any) -> Any:
        """Repeats run i and returns it with all its steps; settings are as for ``simulate``."""
        i = range(len(self))[i]
        values = {name: float(self[name][i]) for name in self._keywords["varied"]}
        start, rate = dict(self._keywords["start"]), dict(self._keywords["rate"])
        given: Dict[str, float] = {}
        for name, value in values.items():
            kind, inner = _place(name)
            {"start": start, "rate": rate, "set": given}[kind][inner] = value
        machine = self.machine.with_parameters(given)
        plain = {"start": start, "rate": rate, **self._keywords["run"], **settings}
        if plain["method"] != "auto":
            plain.pop("one_of", None)
        return machine.simulate(self._keywords["until"], **plain)

    def to_pandas(self) -> Any:
        """A DataFrame, whose index is the number of the run."""
        import pandas

        frame = pandas.DataFrame({name: values for name, values in self._columns.items() if name != "run"})
        frame.index = pandas.Index(self["run"], name="run")
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table``, with units in the metadata of the fields and the plan in that of the table."""
        import pyarrow

        arrays = {name: pyarrow.array(list(v) if v.dtype == object else v) for name, v in self._columns.items()}
        fields = [
            pyarrow.field(name, array.type, metadata={"unit": self.units[name]} if name in self.units else None)
            for name, array in arrays.items()
        ]
        schema = pyarrow.schema(fields, metadata={"plan": self.plan})
        return pyarrow.table(list(arrays.values()), schema=schema)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes all rows: ``.parquet`` or ``.csv``; the file has its name only when it is complete."""
        from ._simulate import _written_beside

        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lower()
        if ending == ".parquet":
            import pyarrow.parquet

            _written_beside(path, lambda file: pyarrow.parquet.write_table(self.to_arrow(), file))
        elif ending == ".csv":
            _written_beside(path, lambda file: file.write(_csv(self._columns).encode()))
        else:
            raise ValueError(f"{path}: the ending must be one of .parquet, .csv")

    def map(
        self,
        path: Union[str, "os.PathLike[str]"],
        of: Union[str, Sequence[str]],
        *,
        over: Union[str, Sequence[str]] = (),
        only: Optional[Mapping[str, float]] = None,
        samples: bool = False,
    ) -> None:
        """Draws columns over the varied quantities, as ``lagrangian map`` does: curves over one, a colour map over two. The file is an
        ``.svg``, or a page ``.html`` that shows the numbers under the pointer.

        ``over`` names the varied quantities of the axes, by default all of them. ``only`` leaves out rows with
        other values. ``samples`` draws a dot for each of :attr:`samples`, which is a bifurcation diagram if they were recorded at events.
        """
        from ._command import told_of_file

        path = os.fspath(path)
        kinds = {".svg": "--plot", ".html": "--report"}
        ending = os.path.splitext(path)[1].lower()
        if ending not in kinds:
            raise ValueError(f"{path}: the ending must be one of {', '.join(kinds)}")
        names = [of] if isinstance(of, str) else list(of)
        axes = [over] if isinstance(over, str) else list(over)
        known = self.columns if not samples else tuple(self.samples or ())
        for name in names:
            if name not in known:
                raise unknown("column", name, known)
        for name in (*axes, *(only or ())):
            if name not in self._keywords["varied"]:
                raise unknown("varied name", name, self._keywords["varied"])
        options = [f"--of={','.join(names)}", f"{kinds[ending]}={os.path.abspath(path)}"]
        if axes:
            options.append(f"--over={','.join(axes)}")
        options += [f"--only={name}={float(value)!r}" for name, value in (only or {}).items()]
        if samples:
            options.append("--samples")
        with tempfile.TemporaryDirectory() as folder:
            # The command reads tables, with the samples in a second one beside that of the rows.
            table = os.path.join(folder, "rows.csv")
            self.save(table)
            if self.samples is not None:
                text = _csv(self.samples)
                with open(os.path.join(folder, "rows.samples.csv"), "w", encoding="utf-8", newline="") as file:
                    file.write(text)
            told_of_file("map", table, options)

    def __repr__(self) -> str:
        return f"<Sweep of {self.machine.name}: {len(self)} runs, {len(self.failed)} failed>"


def _csv(columns: Mapping[str, Any]) -> str:
    """A table in the command's format."""
    import csv
    import io

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)

    def cell(value: Any) -> str:
        if value is None or (isinstance(value, float) and math.isnan(value)):
            return ""
        return repr(float(value)) if isinstance(value, float) else str(value)

    for row in zip(*(np.asarray(values).tolist() for values in columns.values())):
        writer.writerow(map(cell, row))
    return text.getvalue()


def _place(name: str) -> Tuple[str, str]:
    """The kind of a varied quantity and its name within it: of a parameter or input, of ``start(x)``, or of ``rate(x)``."""
    for kind in ("start", "rate"):
        if name.startswith(kind + "(") and name.endswith(")"):
            return kind, name[len(kind) + 1 : -1].strip()
    return "set", name


def _factor(name: str, what: Any) -> Tuple[Dict[str, Any], int]:
    """A factor of the design, and the number of its values."""
    if isinstance(what, tuple) and len(what) == 3 and isinstance(what[2], int) and not isinstance(what[2], bool):
        a, b, k = what
        if k < 1:
            raise ValueError(f"{name}: the number of values must be at least 1, not {k}")
        return {"grid": {"name": name, "from": float(a), "to": float(b), "count": k, "log": False}}, k
    values = np.atleast_1d(_batch.number_array(what, f"vary[{name!r}]"))
    if values.ndim != 1 or not len(values):
        raise ValueError(f"vary[{name!r}] has shape {values.shape}, expected (k,)")
    return {"list": {"names": [name], "rows": values[:, None].tolist()}}, len(values)


def _design(
    vary: Any, samples: Optional[int], design: str, seed: int, together: Sequence[str]
) -> Tuple[List[Dict[str, Any]], List[int], List[str]]:
    """The factors of a design, the shape of its grid, and the varied names, in order."""
    if not isinstance(vary, Mapping):
        if not hasattr(vary, "columns"):
            raise TypeError("vary must be a mapping from names to values, or a DataFrame with one row for each run")
        names = [str(name) for name in vary.columns]
        rows = np.asarray(vary, dtype=np.float64)
        return [{"list": {"names": names, "rows": rows.tolist()}}], [len(rows)], names
    drawn = [(n, {w._kind: w._numbers}) for n, w in vary.items() if isinstance(w, _Distribution)]
    fixed = {name: what for name, what in vary.items() if not isinstance(what, _Distribution)}
    if drawn and samples is None:
        raise ValueError(f"{drawn[0][0]} is drawn from a distribution: give the number of samples, samples=…")
    if samples is not None and not drawn:
        raise ValueError("samples are drawn from distributions, and none is given")
    if design not in ("random", "latin", "sobol"):
        raise ValueError(f"design={design!r}: must be 'random', 'latin' or 'sobol'")
    together = list(together)
    for name in together:
        if name not in fixed:
            raise unknown("varied name", name, tuple(fixed))
    factors: List[Dict[str, Any]] = []
    shape: List[int] = []
    names = []
    for name, what in fixed.items():
        if name in together[1:]:
            continue
        if together and name == together[0]:
            parts = [_factor(other, fixed[other]) for other in together]
            counts = {count for _, count in parts}
            if len(counts) != 1:
                raise ValueError(f"together={together}: these have {sorted(counts)} values, but must have the same number")
            factors.append({"together": [part for part, _ in parts]})
            shape.append(counts.pop())
            names.extend(together)
            continue
        factor, count = _factor(name, what)
        factors.append(factor)
        shape.append(count)
        names.append(name)
    if drawn:
        if samples is None or samples < 1:
            raise ValueError(f"samples={samples}: must be at least 1")
        variables = [[name, numbers] for name, numbers in drawn]
        drawing = {"design": design, "count": int(samples), "seed": int(seed), "variables": variables}
        factors.append({"sample": drawing})
        shape.append(int(samples))
        names.extend(name for name, _ in drawn)
    return factors, shape, names


#: Functions of reductions, as plans call them.
_FUNCTIONS = ("max", "min", "range", "mean", "rms", "integral", "first", "last", "when_max", "when_min", "count", "frequency", "power")

#: The second word in the name of an event of a contact, such as ``floor impact``, by which it differs from any formula.
_CONTACT_EVENTS = ("impact", "closes", "lifts", "opens", "turns", "crushes", "sticks", "slips", "reverses", "switches")


def _reduction(name: str, text: str, events: Iterable[str]) -> Dict[str, str]:
    function, bracket, rest = text.strip().partition("(")
    function, rest = function.strip(), rest.strip()
    if not bracket or not rest.endswith(")"):
        raise ValueError(f"reduce[{name!r}]: {text!r} is not a reduction: write max(abs(x))")
    if function not in _FUNCTIONS:
        raise unknown("reduction", function, _FUNCTIONS)
    of = rest[:-1].strip()
    _, space, kind = of.rpartition(" ")
    if function in ("first", "last") and (of in events or (space and kind in _CONTACT_EVENTS)):
        function += "_event"
    return {"name": name, "function": function, "of": of}


def sweep(
    machine: Any,
    vary: Any,
    *,
    until: float,
    samples: Optional[int] = None,
    design: str = "sobol",
    seed: int = 0,
    together: Sequence[str] = (),
    start: Any = None,
    rate: Any = None,
    record: Any = "end",
    reduce: Optional[Mapping[str, str]] = None,
    after: Optional[float] = None,
    inputs: Optional[Mapping[str, Any]] = None,
    events: Optional[Mapping[str, Any]] = None,
    tolerance: float = 1e-9,
    method: str = "dop853",
    max_steps: int = 10_000_000,
    out: Optional[Union[str, "os.PathLike[str]"]] = None,
    fresh: bool = False,
    engine: Any = None,
    threads: Optional[int] = None,
    progress: Any = "auto",
) -> Sweep:
    """Runs the machine for many values. There is one row for each run; the value of the last varied name changes fastest.

    * ``vary``: a mapping from a parameter, an input, a family, ``start(q)`` or ``rate(q)`` to ``(a, b, k)``, which are k values
      from a to b, to an array, or to a distribution (:class:`Uniform`, :class:`LogUniform`, :class:`Normal`,
      :class:`Triangular`), of which ``samples`` are drawn by ``design`` (``random``, ``latin``, ``sobol``); or a DataFrame, one
      row for each run. Names in ``together`` are varied together and are not crossed.
    * ``record``: ``"end"``, ``"at=0.5,1"``, ``"every=0.01"``, or several of these; ``"event=NAME,…"`` has samples at every event
      of these names, from ``after`` on.
    * ``reduce``: a mapping from names to reductions, ``"max(abs(x))"``: ``max``, ``min``, ``range``, ``mean``, ``rms``,
      ``integral``, ``first``, ``last``, ``when_max``, ``when_min`` of an expression; ``count``, ``frequency``, ``first``, ``last`` of an event,
      also of a contact, ``"count(floor impact)"``; ``power`` of a contact; all from the time ``after`` on, in s.
    * ``method``: as for ``simulate``; with ``auto``, the default of the command, each run chooses its methods, and a column ``methods`` tells which.
    * ``inputs``, ``events``: numbers, formulas, tables and sampled formulas, as for ``simulate``. Functions in Python are
      rejected, since they are not portable.
    * ``out``: a ``.csv``, a ``.parquet``, or a folder, to which the rows are written as they are computed. After an interruption, by
      Ctrl-C, a full disk or a power cut, only the chunks in progress are lost, and the same call continues the sweep; ``fresh`` begins
      again. Without ``out`` rows are only in memory.
    * ``engine``: None for the cores of this machine, ``"ray"``, ``"dask"``, or a client of ``dask.distributed``. All give the same
      bits.

    A run that fails is a row whose ``status`` is ``failed``.
    """
    factors, shape, varied = _design(vary, samples, design, seed, together)
    values, driven = machine._values
    names, input_names = tuple(machine.parameters), tuple(machine.inputs)
    is_varied = set()
    for name in varied:
        kind, inner = _place(name)
        if kind == "set":
            is_varied.update(_batch.of_name(inner, names + input_names))
    given = zip(names + input_names, [*values, *driven], itertools.count())
    setting = [[name, x] for name, x, place in given if place not in is_varied and not math.isnan(x)]
    laws = []
    for name, what in (inputs or {}).items():
        law = _signals.law_of(what, name, machine.units.get(name, "1"))
        if law is not None:
            laws.append([name, law])
        elif callable(what) or isinstance(what, _signals.Sampled):
            raise TypeError(
                f"input {name} is a function in Python, which a sweep cannot repeat elsewhere: write a formula, or a loop over simulate"
            )
        else:
            setting = [pair for pair in setting if pair[0] != name] + [[name, float(what)]]
    if set(name for name, _ in laws) & set(input_names):
        setting = [pair for pair in setting if pair[0] not in {name for name, _ in laws}]
    watches = []
    for name, what in (events or {}).items():
        formula = getattr(what, "what", what)
        if not isinstance(formula, str):
            raise TypeError(f"event {name} is a function in Python, which a sweep cannot repeat elsewhere: write a formula")
        if getattr(what, "crossing", "any") != "any" or getattr(what, "terminal", 0) > 1:
            raise ValueError(f"event {name}: in a sweep, events count in both directions, and either the first one ends a run or none does")
        watches.append({"name": name, "formula": formula, "ends": bool(getattr(what, "terminal", False))})
    at: List[float] = []
    every: Optional[float] = None
    at_events: List[str] = []
    for one in [record] if isinstance(record, str) or not isinstance(record, (list, tuple)) else record:
        if one == "end":
            continue
        kind, _, rest = str(one).partition("=")
        if kind == "at":
            at += [float(t) for t in rest.split(",")]
        elif kind == "every":
            every = float(rest)
        elif kind == "event":
            at_events += [name.strip() for name in rest.split(",")]
        else:
            raise ValueError(f"record={one!r}: must be 'end', 'at=0.5,1', 'every=0.01' or 'event=NAME'")
    starts, rates = _by_name(start, machine, "start"), _by_name(rate, machine, "rate")
    plan = {
        "version": 1,
        "spec": {name: value for name, value in json.loads(machine._program.state()).items() if name != "given"},
        "set": setting,
        "start": list(starts.items()),
        "rate": list(rates.items()),
        "keep": None,
        "until": float(until),
        "tolerance": float(tolerance),
        "method": method,
        "max_steps": int(max_steps),
        "inputs": laws,
        "events": watches,
        "at": at,
        "every": every,
        **({"at_events": at_events} if at_events else {}),
        "reduce": [_reduction(name, text, list(events or {})) for name, text in (reduce or {}).items()],
        "after": after,
        "design": factors,
        "chunk": 1,
    }
    text, chunks, runs, warning = _native.plan(json.dumps(plan))
    if warning is not None:
        import warnings

        warnings.warn(warning, stacklevel=3)
    if out is not None:
        kept = _Place(out).kept(text, fresh)
        _keep_all(kept, runs, engine, threads, progress)
        text = kept.plan
        made = [kept.end()]
    else:
        made = _run_all(text, chunks, runs, engine, threads, progress)
    keywords = {
        "path": None if out is None else os.fspath(out),
        "shape": shape,
        "varied": varied,
        "until": until,
        "start": starts,
        "rate": rates,
        "run": {
            "inputs": inputs,
            "events": events or (),
            "tolerance": tolerance,
            "method": method,
            **({"one_of": runs} if method == "auto" else {}),
            "max_steps": max_steps,
        },
    }
    rows = _joined([rows for rows, _ in made])
    parts = [own for _, own in made if own is not None]
    return Sweep(machine, text, rows, _joined(parts) if parts else None, keywords)


class _Place:
    """The file or folder of a sweep's rows, by the rules of the command."""

    def __init__(self, out: Any) -> None:
        path = os.fspath(out)
        ending = os.path.splitext(path)[1].lower().lstrip(".")
        self.file: Optional[str] = None
        if path.endswith("/") or os.path.isdir(path) or (not ending and not os.path.exists(path)):
            self.folder, self.ending = path, "parquet"
            return
        if ending not in ("csv", "parquet"):
            raise ValueError(
                f"out={path!r}: rows go to a `.csv`, a `.parquet` or a folder; the name of a new folder with a dot in it ends with `/`"
            )
        self.folder, self.file, self.ending = path + ".part", path, ending

    def kept(self, plan: str, fresh: bool) -> _native.Kept:
        spec = json.loads(plan)["spec"]
        for name in (spec["name"], *(file["name"] for file in spec["files"])):
            if self.file is not None and os.path.exists(self.file) and os.path.exists(name) and os.path.samefile(self.file, name):
                raise ValueError(f"out={self.file!r} is the spec, or one that it extends")
        return _native.Kept(plan, self.folder, self.file, self.ending, fresh)


def _keep_all(kept: _native.Kept, runs: int, engine: Any, threads: Optional[int], progress: Any) -> None:
    """Computes the missing chunks, and keeps them."""
    missing = kept.missing()
    plan, ending = kept.plan, kept.ending
    if engine is None:
        tell = _progress(progress, runs, runs)
        kept.run(_threads(threads), tell)
        tell(runs)
        return
    chunk = json.loads(plan)["chunk"]
    tell = _progress(progress, runs, runs)
    done = runs - sum(min(runs, (k + 1) * chunk) - k * chunk for k in missing)
    for number, (rows, samples) in _engine(engine)(_Work(_chunk_file, ending), plan, missing, threads):
        kept.keep(number, rows, samples)
        done += min(runs, (number + 1) * chunk) - number * chunk
        tell(done)


def _by_name(given: Any, machine: Any, what: str) -> Dict[str, float]:
    if given is None:
        return {}
    if isinstance(given, State):
        given = given.q if what == "start" else given.v
    if isinstance(given, Mapping):
        for name in given:
            if not _batch.of_name(name, (*machine.coordinates, *machine.states)):
                raise unknown("coordinate", name, (*machine.coordinates, *machine.states))
        return {name if what == "start" else _batch.for_command(machine, name): float(x) for name, x in given.items()}
    values = _batch.vectors(given, machine.coordinates, np.zeros(len(machine.coordinates)), what, "coordinate")
    return dict(zip(machine.coordinates, values.tolist()))


def _joined(parts: List[List[_Column]]) -> List[_Column]:
    """Concatenates chunks."""

    def values(place: int) -> np.ndarray:
        arrays = [np.asarray(part[place][2], dtype=object if isinstance(part[place][2], list) else None) for part in parts]
        made = np.concatenate(arrays)
        made.flags.writeable = False
        return made

    return [(name, unit, values(place)) for place, (name, unit, _) in enumerate(parts[0])]


#: The rows of a chunk and its samples, if any.
_Chunk = Tuple[List[_Column], Optional[List[_Column]]]


def run_chunk(plan: Union[str, bytes], chunk: int) -> Dict[str, Any]:
    """The rows of one chunk of a plan, by name: the unit of work of a sweep.

    A pure function of its arguments, wherever it runs; the GIL is released meanwhile.
    """
    text = plan.decode() if isinstance(plan, bytes) else plan
    rows, _ = _native.run_chunk(text, chunk)
    return {name: np.asarray(values, dtype=object) if isinstance(values, list) else values for name, _, values in rows}


def _whole_chunk(plan: str, chunk: int) -> _Chunk:
    """Computes a chunk with its samples, on another machine."""
    return _native.run_chunk(plan, chunk)


def _chunk_file(plan: str, chunk: int, ending: str) -> Tuple[bytes, Optional[bytes]]:
    """Computes the contents of a chunk's files, on another machine."""
    return _native.chunk_file(plan, chunk, ending)


class _Work:
    """Work on a chunk in another process: a function of the plan, the chunk and further fixed arguments."""

    def __init__(self, function: Callable[..., Any], *more: Any) -> None:
        self.function = function
        self.more = more


def _run_all(
    plan: str, chunks: int, runs: int, engine: Any, threads: Optional[int], progress: Any
) -> List[_Chunk]:
    """All chunks of a plan, in order."""
    tell = _progress(progress, chunks, runs)
    found: List[Optional[_Chunk]] = [None] * chunks
    done = 0
    for chunk, made in _engine(engine)(_Work(_whole_chunk), plan, range(chunks), threads):
        found[chunk] = made
        done += 1
        tell(done)
    return [made for made in found if made is not None]


def _threads(asked: Optional[int]) -> int:
    count = asked if asked is not None else (os.cpu_count() or 1)
    if count < 1:
        raise ValueError(f"threads={asked}: must be at least 1")
    return count


#: Applies a function to chunks of a plan, in any order; yields the index of each chunk with its result.
_Engine = Callable[[_Work, str, Iterable[int], Optional[int]], Iterator[Tuple[int, Any]]]


def _engine(engine: Any) -> _Engine:
    if engine is None:
        return _on_threads
    if engine == "ray":
        return _on_ray
    if engine == "dask":
        return lambda work, plan, chunks, threads: _on_dask(work, plan, chunks, threads, None)
    if hasattr(engine, "submit") and hasattr(engine, "scheduler_info"):
        return lambda work, plan, chunks, threads: _on_dask(work, plan, chunks, threads, engine)
    raise ValueError(f"engine={engine!r}: must be None, 'ray', 'dask' or a client of dask.distributed")


def _on_threads(work: _Work, plan: str, chunks: Iterable[int], threads: Optional[int]) -> Iterator[Tuple[int, Any]]:
    """Computes chunks on the cores of this computer; Ctrl-C stops those in progress."""
    count = _threads(threads)
    stop = _native.Stop()
    pool = ThreadPoolExecutor(count)
    todo, running = iter(chunks), {}  # type: ignore[var-annotated]
    try:
        while True:
            # Only as many as are worked on, so that results are returned soon.
            for chunk in itertools.islice(todo, 2 * count - len(running)):
                running[pool.submit(_native.run_chunk, plan, chunk, stop)] = chunk
            if not running:
                return
            done, _ = wait(running, timeout=0.1, return_when=FIRST_COMPLETED)
            for future in done:
                yield running.pop(future), future.result()
    finally:
        stop.set()
        pool.shutdown(wait=True, cancel_futures=True)


def _on_ray(work: _Work, plan: str, chunks: Iterable[int], threads: Optional[int]) -> Iterator[Tuple[int, Any]]:
    """Computes chunks as tasks of Ray: the plan is stored once, and the chunks of a worker that dies are computed again."""
    import ray

    if not ray.is_initialized():
        ray.init(num_cpus=threads, include_dashboard=False, log_to_driver=False)
    task = ray.remote(num_cpus=1, max_retries=3)(work.function)
    reference, todo, running = ray.put(plan), iter(chunks), {}  # type: ignore[var-annotated]
    limit = 4 * max(1, int(ray.cluster_resources().get("CPU", 1)))
    try:
        while True:
            for chunk in itertools.islice(todo, limit - len(running)):
                running[task.remote(reference, chunk, *work.more)] = chunk
            if not running:
                return
            done, _ = ray.wait(list(running), num_returns=1)
            for one in done:
                yield running.pop(one), ray.get(one)
    finally:
        for one in running:
            ray.cancel(one, force=True)


def _on_dask(
    work: _Work, plan: str, chunks: Iterable[int], threads: Optional[int], client: Any
) -> Iterator[Tuple[int, Any]]:
    """Computes chunks as tasks of Dask. Each task contains the plan, because scattered data dies with its worker."""
    import distributed

    own = client is None
    if own:
        client = distributed.Client(
            n_workers=_threads(threads), threads_per_worker=1, processes=False, dashboard_address=None
        )
    try:
        limit = 4 * max(1, sum(client.nthreads().values()))
        todo = iter(chunks)
        waiting = distributed.as_completed([])
        numbers: Dict[Any, int] = {}

        def add(count: int) -> None:
            for chunk in itertools.islice(todo, count):
                future = client.submit(work.function, plan, chunk, *work.more, pure=False, retries=3)
                numbers[future.key] = chunk
                waiting.add(future)

        add(limit)
        for future in waiting:
            yield numbers.pop(future.key), future.result()
            add(1)
    finally:
        if own:
            client.close()


def _progress(asked: Any, parts: int, runs: int) -> Callable[[int], None]:
    """A function that reports the number of finished parts."""
    if not (callable(asked) or asked in ("auto", False, None)):
        raise ValueError(f"progress={asked!r}: must be 'auto', False or a function")
    began = time.monotonic()
    shows = asked == "auto" and (sys.stderr.isatty() or in_notebook())

    def tell(done: int) -> None:
        fraction = done / max(parts, 1)
        if callable(asked):
            asked(fraction, done, parts)
        elif shows and done:
            passed = time.monotonic() - began
            if passed >= 2.0:
                left = passed / fraction - passed
                sys.stderr.write(f"\r{fraction:.0%} of {runs} runs, {left:.0f} s left ")
                if fraction >= 1.0:
                    sys.stderr.write("\n")
                sys.stderr.flush()

    return tell
