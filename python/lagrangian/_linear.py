"""Equilibria, modes and linear models."""

from __future__ import annotations

import json
import os
import re
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _batch, _native
from ._named import Named, State, rates, state_of
from ._simulate import _written_beside
from .errors import unknown

Steady = Union[str, Sequence[str], Mapping[str, Optional[float]]]


class Mode(NamedTuple):
    """A motion ``Re(shape e^{λt})``."""

    eigenvalue: complex
    """λ in 1/s."""
    frequency: float
    """Hz"""
    damping: float
    """−Re λ/|λ|; NaN where nothing oscillates."""
    kind: str
    shape: Dict[str, complex]
    """By the names of coordinates, scaled so that the largest number is 1."""


class Modes:
    """The modes about an equilibrium or a steady motion, slow ones first; one for each conjugate pair of eigenvalues."""

    eigenvalues: np.ndarray
    """Complex (j,), in 1/s."""
    frequencies: np.ndarray
    """Hz, (j,)"""
    damping: np.ndarray
    """(j,); NaN where nothing oscillates."""
    kinds: Tuple[str, ...]
    """``oscillation``, ``growing oscillation``, ``decaying``, ``growing``, ``free``."""
    shapes: np.ndarray
    """Complex (n, j), a column for each mode, scaled so that its largest number is 1."""
    error: np.ndarray
    """Bounds on the errors of the eigenvalues, in 1/s: (j,)."""
    equilibrium: State
    """The equilibrium, or a state of the steady motion."""

    def __init__(self, machine: Any, found: Mapping[str, Any]) -> None:
        # Those of the Cartesian chart where the coordinates of the spec have no modes.
        self._names = tuple(found["coordinates"] or machine.coordinates)
        n = len(self._names)
        self.eigenvalues = found["re"] + 1j * found["im"]
        self.frequencies = found["im"] / (2 * np.pi)
        self.damping = found["damping"]
        self.kinds = tuple(found["kinds"])
        self.shapes = (found["shapes_re"] + 1j * found["shapes_im"]).reshape(-1, n).T
        self.error = found["error"]
        self.equilibrium = _state(self._names, 0.0, found["q"], found["v"])
        for array in (self.eigenvalues, self.frequencies, self.damping, self.shapes, self.error):
            array.flags.writeable = False

    def __len__(self) -> int:
        return len(self.kinds)

    def __getitem__(self, k: int) -> Mode:
        shape = {name: complex(x) for name, x in zip(self._names, self.shapes[:, k])}
        eigenvalue, frequency = complex(self.eigenvalues[k]), float(self.frequencies[k])
        return Mode(eigenvalue, frequency, float(self.damping[k]), self.kinds[k], shape)

    def __iter__(self) -> Iterator[Mode]:
        return (self[k] for k in range(len(self)))

    def __repr__(self) -> str:
        lines = [f"  {mode.frequency:.6g} Hz, λ = {mode.eigenvalue:.6g} 1/s, {mode.kind}" for mode in self]
        return "\n".join([f"<Modes: {len(self)}", *lines]) + ">"


class Linear:
    """A linear model ``ẋ = A x + B u``, ``y = C x + D u`` for small deviations of r states, m inputs and p outputs."""

    A: np.ndarray
    """(r, r); r is 2n without constraints."""
    B: np.ndarray
    """(r, m)"""
    C: np.ndarray
    """(p, r)"""
    D: np.ndarray
    """(p, m)"""
    states: Tuple[str, ...]
    """Coordinates, then rates ``der(x)``."""
    inputs: Tuple[str, ...]
    outputs: Tuple[str, ...]
    units: Mapping[str, str]
    """The units of states, inputs and outputs, by name."""
    at: State
    """The state about which the model is linear."""
    u: np.ndarray
    """The inputs of the machine at that state."""
    y: np.ndarray
    """The outputs at that state, (p,)."""
    drift: np.ndarray
    """ẋ for x = 0 and u = 0, (r,): 0 about an equilibrium and along a steady motion."""
    basis: np.ndarray
    """(2n, r): ``basis @ x`` are the deviations of all coordinates, followed by those of all rates."""
    left_out: Tuple[str, ...]
    """Coordinates that only record the progress of a steady motion, and are not states."""

    def __init__(self, machine: Any, t: float, found: Mapping[str, Any]) -> None:
        self.units = {name: unit for kind in ("states", "inputs", "outputs") for name, unit in found[kind]}
        self.states, self.inputs, self.outputs = (
            tuple(name for name, _ in found[kind]) for kind in ("states", "inputs", "outputs")
        )
        r, m, p = len(self.states), len(self.inputs), len(self.outputs)
        shapes = {"A": (r, r), "B": (r, m), "C": (p, r), "D": (p, m), "basis": (2 * len(machine.coordinates), r)}
        for name in (*shapes, "drift", "u", "y"):
            array = found[name].reshape(shapes.get(name, (-1,)))
            array.flags.writeable = False
            setattr(self, name, array)
        # Those of the Cartesian chart where the coordinates of the spec have no linear model.
        self.at = _state(tuple(found["coordinates"] or machine.coordinates), t, found["q"], found["v"])
        self.left_out = tuple(found["left_out"])
        self._poles: np.ndarray = found["poles_re"] + 1j * found["poles_im"]
        self._zeros: np.ndarray = found["zeros_re"] + 1j * found["zeros_im"]
        self._is_reduced = bool(found["is_reduced"])
        self._machine_inputs = tuple(machine.inputs)

    def eigenvalues(self) -> np.ndarray:
        """The poles in 1/s, complex (r,), both of each conjugate pair; computed with 32 digits."""
        return np.array(self._poles)

    def zeros(self) -> np.ndarray:
        """The invariant zeros of the model with all its inputs and outputs, in 1/s."""
        return np.array(self._zeros)

    def response(self, omega: Any) -> np.ndarray:
        """``C (iω − A)⁻¹ B + D`` at angular frequencies in rad/s of any shape S: complex (*S, p, m)."""
        omega = _batch.number_array(omega, "omega")
        eye = np.eye(len(self.states))
        inverse = np.linalg.solve(1j * omega[..., None, None] * eye - self.A, self.B.astype(complex))
        return np.asarray(self.C @ inverse + self.D)

    def _frequencies(self) -> np.ndarray:
        """Angular frequencies for a plot, which extend two decades beyond all poles and zeros."""
        sizes = np.abs(np.concatenate([self._poles, self._zeros]))
        sizes = sizes[np.isfinite(sizes) & (sizes > 0)]
        low, high = (sizes.min(), sizes.max()) if sizes.size else (1.0, 1.0)
        return np.geomspace(low / 100, high * 100, 2000)

    def _plotted(self, omega: Any) -> Tuple[np.ndarray, np.ndarray]:
        if not self.inputs or not self.outputs:
            raise ValueError("a frequency response is from an input to an output, and the model does not have both")
        omega = self._frequencies() if omega is None else np.ravel(_batch.number_array(omega, "omega"))
        return omega, self.response(omega)

    def bode(self, omega: Any = None) -> Any:
        """A matplotlib figure of gain, in dB, and phase from each input to each output over angular frequencies in rad/s (k,), by
        default those about the poles and zeros; ``lagrangian linearize --bode`` draws the same."""
        import matplotlib.pyplot as plt

        omega, response = self._plotted(omega)
        figure, (gain, phase) = plt.subplots(2, 1, sharex=True)
        for i, output in enumerate(self.outputs):
            for j, name in enumerate(self.inputs):
                to = response[:, i, j]
                with np.errstate(divide="ignore"):
                    gain.semilogx(omega, 20 * np.log10(np.abs(to)), label=f"{name} → {output}")
                phase.semilogx(omega, np.degrees(np.unwrap(np.angle(to))))
        gain.set_ylabel("gain [dB]")
        gain.legend()
        phase.set_ylabel("phase [°]")
        phase.set_xlabel("angular frequency [rad/s]")
        return figure

    def nyquist(self, omega: Any = None) -> Any:
        """A matplotlib figure of the frequency response in the complex plane, for positive and negative frequencies, with −1 marked;
        ``lagrangian linearize --nyquist`` draws the same."""
        import matplotlib.pyplot as plt

        _, response = self._plotted(omega)
        figure, axes = plt.subplots()
        for i, output in enumerate(self.outputs):
            for j, name in enumerate(self.inputs):
                to = response[:, i, j]
                (line,) = axes.plot(to.real, to.imag, label=f"{name} → {output}")
                axes.plot(to.real, -to.imag, "--", color=line.get_color())
        axes.plot([-1.0], [0.0], "k+")
        axes.set_xlabel("Re")
        axes.set_ylabel("Im")
        axes.legend()
        return figure

    def scipy(self) -> Any:
        """``scipy.signal.StateSpace``."""
        import scipy.signal

        return scipy.signal.StateSpace(self.A, self.B, self.C, self.D)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the model: ``.json``, ``.npz``, ``.mat`` (with SciPy), or ``.csv``, a file for each matrix: NAME.A.csv and so
        on. Each is written under a temporary name and renamed when it is complete."""
        path = os.fspath(path)
        stem, ending = os.path.splitext(path)
        arrays = {name: getattr(self, name) for name in ("A", "B", "C", "D", "drift", "basis")}
        names = {kind: getattr(self, kind) for kind in ("states", "inputs", "outputs")}

        def npz(file: Any) -> None:
            every: Dict[str, Any] = {**arrays, **{kind: np.array(of, dtype=str) for kind, of in names.items()}}
            np.savez(file, **every)

        def mat(file: Any) -> None:
            import scipy.io

            cells = {kind: np.array(of, dtype=object).reshape(-1, 1) for kind, of in names.items()}
            scipy.io.savemat(file, {**arrays, **cells}, oned_as="column")

        def as_json(file: Any) -> None:
            file.write((json.dumps(self._document(), indent=2, ensure_ascii=False) + "\n").encode())

        writers = {".json": as_json, ".npz": npz, ".mat": mat}
        ending = ending.lower()
        if ending == ".csv":
            q = tuple(self.at.q.names)
            every = q + tuple(f"der({name})" for name in q)
            labels = {
                "A": (self.states, self.states),
                "B": (self.states, self.inputs),
                "C": (self.outputs, self.states),
                "D": (self.outputs, self.inputs),
                "drift": (self.states, ("drift",)),
                "basis": (every, self.states),
            }
            for name, (rows, columns) in labels.items():
                text = _csv(rows, columns, arrays[name].reshape(len(rows), len(columns)))
                _written_beside(f"{stem}.{name}.csv", lambda file, text=text: file.write(text.encode()))  # type: ignore[misc]
        elif ending in writers:
            _written_beside(path, writers[ending])
        else:
            raise ValueError(f"{path}: the ending must be one of {', '.join([*writers, '.csv'])}")

    def _document(self) -> Dict[str, Any]:
        """The document that ``lagrangian linearize --json`` prints."""

        def labels(names: Sequence[str]) -> List[Dict[str, str]]:
            return [{"name": name, "unit": self.units[name]} for name in names]

        def pairs(values: np.ndarray) -> List[Dict[str, float]]:
            return [{"re": float(x.real), "im": float(x.imag)} for x in values]

        q = self.at.q.names
        return {
            "at": {
                "q": dict(zip(q, np.asarray(self.at.q).tolist())),
                "v": dict(zip(q, np.asarray(self.at.v).tolist())),
                "u": dict(zip(self._machine_inputs, self.u.tolist())),
                "y": dict(zip(self.outputs, self.y.tolist())),
            },
            "states": labels(self.states),
            "inputs": labels(self.inputs),
            "outputs": labels(self.outputs),
            **{name: getattr(self, name).tolist() for name in ("A", "B", "C", "D", "drift")},
            "basis": self.basis.tolist() if self._is_reduced else None,
            "left_out": list(self.left_out),
            "eigenvalues": pairs(self._poles),
            "zeros": pairs(self._zeros),
        }

    def __repr__(self) -> str:
        return (
            f"<Linear: states {', '.join(self.states)}; inputs {', '.join(self.inputs) or 'none'}; "
            f"outputs {', '.join(self.outputs) or 'none'}>"
        )


def _csv(rows: Sequence[str], columns: Sequence[str], matrix: np.ndarray) -> str:
    def cell(name: str) -> str:
        return f'"{name}"' if "," in name else name

    lines = ["," + ",".join(map(cell, columns))] if columns else [""]
    lines += [",".join([cell(name), *map(repr, row)]) for name, row in zip(rows, matrix.tolist())]
    return "\n".join(lines) + "\n"


def _state(names: Tuple[str, ...], t: float, q: np.ndarray, v: np.ndarray) -> State:
    return State(t, Named(q, names), rates(v, names))


def _start(machine: Any, start: Any, rate: Any, t: float) -> Tuple[float, List[float], List[float]]:
    if isinstance(start, State):
        if rate is not None:
            raise ValueError("start is a State, which has rates of its own")
        t = float(start.t) if t == 0.0 else t
        start, rate = start.q, start.v
    q, v = _batch.start_of(machine, start, rate)
    return float(t), q.tolist(), v.tolist()


def _inputs(machine: Any, u: Any) -> List[float]:
    given = _batch.vectors(u, tuple(machine.inputs), list(machine.inputs.values()), "u", "input")
    if given.shape != (len(machine.inputs),):
        raise ValueError(f"u has shape {given.shape}, expected ({len(machine.inputs)},)")
    return [float(x) for x in given]


def _steady(machine: Any, steady: Optional[Steady], v: List[float]) -> Tuple[List[bool], List[bool]]:
    """Which coordinates move steadily, and for which of them the rate is unknown; given rates replace those of the start."""
    names = machine.coordinates
    moves, sought = [False] * len(names), [False] * len(names)
    if isinstance(steady, str):
        steady = [steady]
    given: Mapping[str, Any] = steady if isinstance(steady, Mapping) else {name: None for name in steady or ()}
    for name, value in given.items():
        places = _batch.of_name(name, names)
        if not places:
            raise unknown("coordinate", name, names)
        for place in places:
            moves[place] = True
            if isinstance(value, str) and value == "solve":
                sought[place] = True
            elif value is not None:
                if isinstance(value, (str, bytes)) or np.ndim(value) != 0:
                    raise TypeError(f"steady[{name!r}] is {value!r}, expected a number, None or 'solve'")
                v[place] = float(value)
    return moves, sought


def _outputs(machine: Any, wanted: Optional[Sequence[str]]) -> List[Tuple[str, int]]:
    names, own, held = machine.coordinates, machine.outputs, machine.constraints
    if wanted is None:
        if own:
            return [("output", k) for k in range(len(own))]
        return [("coordinate" if state_of(name) is None else "rate", k) for k, name in enumerate(names)]
    if isinstance(wanted, str):
        wanted = [wanted]
    # The names of states at the indices of their integrals, and empty names at those of coordinates.
    held_states = tuple(state_of(q) or "" for q in names)
    found: List[Tuple[str, int]] = []
    for name in wanted:
        rate = re.fullmatch(r"der\(\s*(.*?)\s*(?:,\s*([12])\s*)?\)", name)
        held_by = re.fullmatch(r"multiplier\(\s*(.*?)\s*\)", name)
        if held_by:
            places = [("multiplier", k) for k in _batch.of_name(held_by[1], held)]
        elif rate:
            kind = "acceleration" if rate[2] == "2" else "rate"
            places = [(kind, k) for k in _batch.of_name(rate[1], names)]
            if not places and rate[2] != "2":
                # The rate of a state is the acceleration of its integral.
                places = [("acceleration", k) for k in _batch.of_name(rate[1], held_states)]
        else:
            places = [("output", k) for k in _batch.of_name(name, own)]
            places = places or [("rate", k) for k in _batch.of_name(name, held_states)]
            places = places or [("coordinate", k) for k in _batch.of_name(name, names)]
        if not places:
            shown = [state_of(q) or q for q in names]
            known = (*own, *shown, *(f"der({q})" for q in shown), *(f"multiplier({c})" for c in held))
            raise unknown("output", name, known)
        found += places
    return found


def linearize(
    self: Any,
    *,
    start: Any = None,
    rate: Any = None,
    t: float = 0.0,
    u: Any = None,
    inputs: Optional[Sequence[str]] = None,
    outputs: Optional[Sequence[str]] = None,
    steady: Optional[Steady] = None,
) -> Linear:
    """The linear model about a state, which need not be an equilibrium; derivatives are exact.

    * ``start``, ``rate``: mappings from names to numbers, which replace those of the spec, or arrays (n,); or ``start`` is a State.
      The state is moved onto the constraints, as at the start of a run.
    * ``steady``: the model is about the steady motion near the start instead, in which the named coordinates have these rates,
      ``{"phi": 150}`` in rad/s. The rate None is that of the start, and the rate ``"solve"`` is computed; ``{}`` is the equilibrium.
    * ``u``: the inputs at that state, a mapping or (m,). ``inputs``, ``outputs``: the names of those that the model has; an output is
      one of the spec, a coordinate, ``der(x)``, ``der(x,2)`` or ``multiplier(rod)``.
    """
    given = _start(self, start, rate, t)
    names = tuple(self.inputs)
    columns = list(range(len(names)))
    if inputs is not None:
        columns = []
        for name in [inputs] if isinstance(inputs, str) else inputs:
            places = _batch.of_name(name, names)
            if not places:
                raise unknown("input", name, names)
            columns += places
    rows = _outputs(self, outputs)
    for what, chosen in (("inputs", columns), ("outputs", rows)):
        if len(set(chosen)) < len(chosen):
            raise ValueError(f"{what} names something more than once")
    motion = None if steady is None else _steady(self, steady, given[2])
    found = _native.linear_model(self, given, _inputs(self, u), motion, (columns, rows))
    return Linear(self, given[0], found)


def modes(self: Any, *, start: Any = None, u: Any = None, steady: Optional[Steady] = None) -> Modes:
    """The modes about the equilibrium, or the steady motion, that is found from a start: eigenvalues and shapes.

    ``steady`` is as for :meth:`linearize`; the rates of all other coordinates are 0.
    """
    given = _start(self, start, None, 0.0)
    moves, sought = _steady(self, steady, given[2])
    return Modes(self, _native.modes(self, given, _inputs(self, u), (moves, sought)))


def equilibrium(self: Any, *, start: Any = None, u: Any = None, steady: Optional[Steady] = None) -> State:
    """The equilibrium, or the steady motion, that is found from a start."""
    return modes(self, start=start, u=u, steady=steady).equilibrium
