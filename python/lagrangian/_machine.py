"""Machines: specs with derived equations and values of their parameters."""

from __future__ import annotations

import math
import os
import re
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np

from . import _batch, _command, _exact, _fit, _linear, _looks, _native, _orbit, _sensitive, _simulate, _sweep, _sympy
from ._equations import Equations, Program
from ._named import Named, State, rates, state_of
from .errors import Diagnostic, SingularError, unknown

Number = Union[int, float]
_T = TypeVar("_T")


def load(path: Union[str, "os.PathLike[str]"], *, constants: Optional[Mapping[str, Any]] = None, **parameters: Number) -> "Machine":
    """Reads a machine from a spec file; specs that it extends are found relative to its folder.

    >>> m = load("machines/double_pendulum.machine", l2=0.5)
    >>> m.parameters["l2"]
    0.5
    """
    program = _native.derive(os.fspath(path), None, None, _constants(constants))
    return Machine._of(program)._set(parameters)


def loads(
    text: str,
    *,
    name: str = "text.machine",
    folder: Optional[Union[str, "os.PathLike[str]"]] = None,
    files: Optional[Mapping[str, str]] = None,
    constants: Optional[Mapping[str, Any]] = None,
    **parameters: Number,
) -> "Machine":
    """Reads a machine from a spec in a string.

    ``name`` is its name in messages. Specs that it extends are looked up in ``files``, or read from ``folder``.
    """
    if folder is not None and files is not None:
        raise ValueError("the specs that it extends come from `files` or from `folder`, not from both")
    if folder is not None:
        name = os.path.join(os.fspath(folder), name)
    given = None if files is None else list(files.items())
    program = _native.derive(name, text, given, _constants(constants))
    return Machine._of(program)._set(parameters)


def from_urdf(
    path: Union[str, "os.PathLike[str]"],
    *,
    base: str = "fixed",
    ball: Optional[str] = None,
    friction: Optional[str] = None,
    limits: str = "none",
    drop_massless: bool = False,
    ignore: Sequence[str] = (),
    constants: Optional[Mapping[str, Any]] = None,
    **parameters: Number,
) -> "Machine":
    """The machine of a robot in a URDF file; ``machine.text`` is its spec, as ``lagrangian import`` writes it.

    The keywords are the options of that command: ``base`` is ``"fixed"`` or ``"floating"``; ``ball``, the axes of angles of spherical and floating
    joints, ``"xyz"``, ``"zyx"`` or ``"zxz"``, or ``"quaternion"``; ``friction`` ``"none"`` or ``"smooth=1e-3"``; ``limits`` ``"none"``, ``"assume"`` or
    ``"stop"``; ``drop_massless`` leaves out joints that move no mass; ``ignore`` names elements and
    attributes that are left out.

    What was left out is reported by warnings of Python. A faulty file raises a ValueError that gives the line.
    """
    return _imported(path, [f"--base={base}"], ball, friction, limits, drop_massless, ignore, constants, parameters)


def from_mjcf(
    path: Union[str, "os.PathLike[str]"],
    *,
    ball: Optional[str] = None,
    friction: Optional[str] = None,
    limits: str = "none",
    drop_massless: bool = False,
    ignore: Sequence[str] = (),
    constants: Optional[Mapping[str, Any]] = None,
    **parameters: Number,
) -> "Machine":
    """The machine of a robot in an MJCF file, ``.xml`` or ``.mjcf``; ``machine.text`` is its spec, as ``lagrangian import`` writes it.
    The file itself states by ``freejoint`` which bodies float.

    The keywords are options of that command, as for :func:`from_urdf`. What was left out is reported by warnings of Python. A
    faulty file raises a ValueError that gives the line.
    """
    if os.fspath(path).lower().endswith(".urdf"):
        raise ValueError(f"{os.fspath(path)}: this is a URDF file, which from_urdf reads")
    return _imported(path, [], ball, friction, limits, drop_massless, ignore, constants, parameters)


def _imported(
    path: Union[str, "os.PathLike[str]"],
    options: List[str],
    ball: Optional[str],
    friction: Optional[str],
    limits: str,
    drop_massless: bool,
    ignore: Sequence[str],
    constants: Optional[Mapping[str, Any]],
    parameters: Mapping[str, Number],
) -> "Machine":
    """The machine that ``lagrangian import`` writes for a robot's file."""
    import warnings

    options = [*options, f"--limits={limits}"]
    options += [] if ball is None else [f"--ball={ball}"]
    options += [] if friction is None else [f"--friction={friction}"]
    options += ["--drop-massless"] if drop_massless else []
    options += [f"--ignore={name}" for name in ignore]
    document = _command.imported(os.fspath(path), options)
    for warning in document["warnings"]:
        warnings.warn(str(warning), stacklevel=3)
    name = os.path.splitext(os.path.basename(os.fspath(path)))[0]
    return loads(document["text"], name=f"{name}.machine", files={}, constants=constants)._set(parameters)


def _constants(constants: Optional[Mapping[str, Any]]) -> List[Tuple[str, str]]:
    return sorted((name, _exactly(name, value)) for name, value in (constants or {}).items())


def _exactly(name: str, value: Any) -> str:
    """A constant as text: a float as the decimal that Python prints."""
    if isinstance(value, bool):
        raise TypeError(f"the constant {name} is {value!r}, expected a number")
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, (float, np.floating)):
        if not math.isfinite(value):
            raise ValueError(f"the constant {name} is {value!r}, expected a finite number")
        return format(Fraction(repr(float(value))), "") if float(value) else "0"
    if isinstance(value, str):
        return value
    raise TypeError(f"the constant {name} is of type {type(value).__name__}, expected a number")


class Evaluation:
    """Everything that a machine computes at states of shape S, the same numbers as by ``lagrangian evaluate``."""

    mass_matrix: np.ndarray
    """M, (*S, n, n)."""
    bias: np.ndarray
    """h, (*S, n)."""
    applied: np.ndarray
    """Q, (*S, n)."""
    forces: np.ndarray
    """f = Q − h, (*S, n)."""
    accelerations: np.ndarray
    """a, (*S, n)."""
    reactions: np.ndarray
    """Gᵀ λ, the generalized reactions of the constraints, (*S, n)."""
    kinetic_energy: np.ndarray
    """S, in J."""
    potential_energy: np.ndarray
    """S, in J."""
    dissipation: np.ndarray
    """The dissipation function: S, in W."""
    outputs: Mapping[str, np.ndarray]
    multipliers: Mapping[str, np.ndarray]
    contacts: Mapping[str, Mapping[str, np.ndarray]]
    """By name: ``normal`` and ``friction`` in N, ``slip`` in m/s, ``sticks``; unilateral contacts also have ``gap`` in m and ``closed``."""
    ok: np.ndarray
    """Whether a state has accelerations; the numbers of the others are NaN."""
    columns: Mapping[str, np.ndarray] = MappingProxyType({})
    """In the result of :meth:`Run.observe`: the columns of the run at the requested times, each of shape S."""

    def __init__(self, **numbers: Any) -> None:
        self.__dict__.update(numbers)

    def __getitem__(self, name: str) -> Any:
        """A column of the run, in the result of :meth:`Run.observe`."""
        if name not in self.columns:
            raise unknown("column", name, tuple(self.columns))
        return self.columns[name]

    def __repr__(self) -> str:
        return f"Evaluation(of shape {np.shape(self.ok)}: {', '.join(self.__dict__)})"


class Machine(_native.Machine):
    """A machine: a spec, derived, with values of its parameters. Immutable; equal if text, constants and values are.

    Made by :func:`load` and :func:`loads`.
    """

    __slots__ = ("_known",)
    _known: Dict[str, Any]

    @classmethod
    def _of(cls, program: Any) -> "Machine":
        parameters = [math.nan if value is None else value for *_, value in program.parameters]
        return cls._with(program, parameters, [value for *_, value in program.inputs])

    @classmethod
    def _with(cls, program: Any, parameters: Sequence[float], inputs: Sequence[float]) -> "Machine":
        made: Machine = cls(program, list(parameters), list(inputs))
        made._known = {}
        return made

    def _set(self, values: Mapping[str, Number]) -> "Machine":
        """The machine with other values; those of whole families are set first."""
        if not values:
            return self
        names, inputs = tuple(self.parameters), tuple(self.inputs)
        formulas = self.derived_parameters
        followers = [formulas[k] for name in values for k in _batch.of_name(name, formulas)]
        if followers:
            # Derives again, with parameters instead of formulas.
            program = self._program.with_given(followers)
            free = type(self)._of(program)
            known, held = self.parameters, self.inputs
            return type(self)._with(
                program,
                [known.get(name, value) for name, value in free.parameters.items()],
                [held[name] for name in free.inputs],
            )._set(values)
        given, driven = (list(of) for of in self._values)
        sets_parameter = False
        for is_member in (False, True):
            for name, value in values.items():
                if ("[" in name) is not is_member:
                    continue
                if isinstance(value, (str, bytes)) or np.ndim(value) != 0:
                    raise TypeError(f"{name} is {value!r}, expected a number")
                number = float(value)
                own, others = _batch.of_name(name, names), _batch.of_name(name, inputs)
                if not own and not others:
                    raise unknown("parameter or input", name, names + inputs + self.derived_parameters)
                for place in own:
                    given[place] = number
                    sets_parameter = True
                for place in others:
                    driven[place] = number
        if sets_parameter:
            refusal = self._program.refusal(given)
            if refusal is not None:
                raise ValueError(refusal)
        return type(self)._with(self._program, given, driven)

    def with_parameters(self, values: Optional[Mapping[str, Number]] = None, /, **parameters: Number) -> "Machine":
        """The machine with other values of parameters and inputs; it is not derived again.

        The name of a family sets all its members; names that are not identifiers are given in the mapping: ``{"k[3]": 2.0}``. A derived
        parameter no longer follows its formula and is then among :attr:`parameters`; this case does derive the machine again.
        """
        return self._set({**(values or {}), **parameters})

    def with_constants(self, values: Optional[Mapping[str, Any]] = None, /, **constants: Any) -> "Machine":
        """The machine with other values of constants, derived again. Parameters that still exist keep the values that were set."""
        every = dict(self._program.constants)
        every.update(_constants({**(values or {}), **constants}))
        program = self._program.with_constants(sorted(every.items()))
        made = type(self)._of(program)
        names, inputs = set(made.parameters), set(made.inputs)
        defaults = dict(zip(self.parameters, (value for *_, value in self._program.parameters)))
        kept = {
            name: value
            for name, value in self.parameters.items()
            if name in names and not math.isnan(value) and value != defaults[name]
        }
        driven = dict(zip(self.inputs, (value for *_, value in self._program.inputs)))
        kept.update({n: x for n, x in self.inputs.items() if n in inputs and x != driven[n]})
        return made._set(kept)

    def _once(self, name: str, make: Callable[[], _T]) -> _T:
        if name not in self._known:
            self._known[name] = make()
        return self._known[name]  # type: ignore[no-any-return]

    @property
    def name(self) -> str:
        """The name that the spec gives it."""
        return str(self._program.name)

    @property
    def docs(self) -> str:
        """Its documentation in the spec."""
        return str(self._program.docs)

    @property
    def text(self) -> str:
        """The text of the spec."""
        return str(self._program.text)

    @property
    def files(self) -> Mapping[str, str]:
        """The texts of the specs that it extends, by name."""
        return MappingProxyType(dict(self._program.files))

    @property
    def constants(self) -> Mapping[str, Fraction]:
        """The constants that were given other values."""
        return MappingProxyType({name: Fraction(value) for name, value in self._program.constants})

    @property
    def coordinates(self) -> Tuple[str, ...]:
        """Their names, in the order of the spec."""
        return self._once("coordinates", lambda: tuple(n for n, *_ in self._program.coordinates))

    @property
    def states(self) -> Tuple[str, ...]:
        """The names of states of first order: currents, temperatures, integrals of controllers. They are the rates, ``v["i"]``, of the
        last coordinates, which are their integrals over time."""

        def make() -> Tuple[str, ...]:
            states = (state_of(name) for name in self.coordinates)
            return tuple(state for state in states if state is not None)

        return self._once("states", make)

    @property
    def derived_parameters(self) -> Tuple[str, ...]:
        """The names of parameters that follow from others by a formula of the spec, ``J: kg*m^2 = m*r^2/2``. One that is given a value
        by :func:`load` or :meth:`with_parameters` is among :attr:`parameters` instead."""
        return self._once("derived_parameters", lambda: tuple(n for n, *_ in self._program.derived_parameters))

    @property
    def outputs(self) -> Tuple[str, ...]:
        """Their names, in the order of the spec."""
        return self._once("outputs", lambda: tuple(n for n, *_ in self._program.outputs))

    @property
    def constraints(self) -> Tuple[str, ...]:
        """Their names, in the order of the spec; one that constrains several numbers counts as several."""
        return self._once("constraints", lambda: tuple(n for n, _ in self._program.constraints))

    @property
    def contacts(self) -> Tuple[str, ...]:
        """The names of guided contacts, then of unilateral ones."""
        return self._once("contacts", lambda: tuple(self._program.contacts))

    @property
    def parameters(self) -> Mapping[str, float]:
        """Their values; NaN where there is none."""

        def make() -> Mapping[str, float]:
            names = (n for n, *_ in self._program.parameters)
            return MappingProxyType(dict(zip(names, self._values[0])))

        return self._once("parameters", make)

    @property
    def inputs(self) -> Mapping[str, float]:
        """Their default values."""

        def make() -> Mapping[str, float]:
            names = (n for n, *_ in self._program.inputs)
            return MappingProxyType(dict(zip(names, self._values[1])))

        return self._once("inputs", make)

    @property
    def units(self) -> Mapping[str, str]:
        """The unit of every parameter, input, coordinate, state, rate ``der(name)``, output and ``multiplier(name)``."""

        def make() -> Mapping[str, str]:
            program = self._program
            units = {name: unit for name, unit, *_ in program.parameters + program.inputs}
            units.update({name: unit for name, unit, _ in program.derived_parameters})
            for name, unit, _ in program.coordinates:
                units[name] = unit
                state = state_of(name)
                if state is not None:
                    # The unit of the integral is that of the state times s.
                    units[state] = unit = "1" if unit == "s" else unit[: -len("*s")] if unit.endswith("*s") else unit
                    name = state
                units[f"der({name})"] = "1/s" if unit == "1" else f"{unit}/s"
            units.update({name: unit for name, unit, _ in program.outputs})
            units.update({f"multiplier({name})": unit for name, unit in program.constraints})
            return MappingProxyType(units)

        return self._once("units", make)

    @property
    def docs_of(self) -> Mapping[str, str]:
        """The documentation of every name of :attr:`units`, of constraints and of contacts in the spec; empty where there is none.
        A rate ``der(x)`` has that of x, a multiplier that of its constraint."""

        def make() -> Mapping[str, str]:
            program = self._program
            every = program.parameters + program.inputs + program.coordinates + program.outputs + program.derived_parameters
            docs = {of[0]: of[2] for of in every}
            docs.update({state: of[2] for of in program.coordinates if (state := state_of(of[0])) is not None})
            docs.update({f"der({state_of(of[0]) or of[0]})": of[2] for of in program.coordinates})
            elements = dict(program.elements)

            def of_element(name: str) -> str:
                # A constraint on several numbers has several names, `hinge.x` and `hinge.y`.
                return elements.get(name) or elements.get(re.split(r"[.\[]", name)[0], "")

            for name in self.constraints:
                docs[name] = docs[f"multiplier({name})"] = of_element(name)
            docs.update({name: of_element(name) for name in self.contacts})
            return MappingProxyType(docs)

        return self._once("docs_of", make)

    @property
    def start(self) -> State:
        """The start that the spec defines, with the values of these parameters."""

        def make() -> State:
            q, v = self._start()
            return State(0.0, Named(q, self.coordinates), rates(v, self.coordinates))

        return self._once("start", make)

    @property
    def warnings(self) -> List[Diagnostic]:
        """Warnings about a spec that is otherwise valid."""
        return [Diagnostic(*told) for told in self._program.warnings]

    @property
    def equations(self) -> Equations:
        """The derivation of the equations of motion, which a notebook typesets."""
        return Equations(self._program)

    @property
    def program(self) -> Program:
        """The derived program, with its counts of operations."""
        return self._once("program", lambda: Program(self))

    def derive(self, form: str) -> str:
        """What ``lagrangian derive`` prints in a form: ``markdown``, ``latex``, ``html``, ``rust``, ``c`` or ``program``."""
        return str(self._program.derive(form))

    def evaluate(
        self,
        q: Any = None,
        v: Any = None,
        t: Any = 0.0,
        *,
        u: Any = None,
        parameters: Optional[Mapping[str, Any]] = None,
        singular: str = "raise",
    ) -> Evaluation:
        """Everything that the machine computes, at states of any shape: see :class:`Evaluation`. Arguments are those of ``accelerations``."""
        given = _batch.Arguments(self, q, v, t, u, parameters)
        try:
            numbers, found = _native.evaluate(self, *given.native(), _batch.policy(singular))
        except SingularError as error:
            raise given.singular(error) from None
        n, shape = len(self.coordinates), given.shape

        def shaped(values: Any, *rest: int) -> Any:
            return values.reshape(shape + rest)[()]

        columns = {
            "mass_matrix": shaped(numbers["mass_matrix"], n, n),
            **{
                name: shaped(numbers[name], n)
                for name in ("bias", "applied", "forces", "accelerations", "reactions")
            },
            **{
                name: shaped(numbers[name])
                for name in ("kinetic_energy", "potential_energy", "dissipation")
            },
        }
        for kind, names in (("outputs", self.outputs), ("multipliers", self.constraints)):
            values = shaped(numbers[kind], len(names))
            columns[kind] = MappingProxyType({name: values[..., i][()] for i, name in enumerate(names)})
        contacts: Dict[str, Mapping[str, Any]] = {}
        guides = numbers["contacts"].size // (4 * given.count) if given.count else 0
        both = [
            (numbers["contacts"], self.contacts[:guides], ("normal", "friction", "slip", "sticks")),
            (
                numbers["unilateral"],
                self.contacts[guides:],
                ("gap", "normal", "friction", "slip", "closed", "sticks"),
            ),
        ]
        for values, names, parts in both:
            values = shaped(values, len(names), len(parts))
            for i, name in enumerate(names):
                one = {part: values[..., i, k][()] for k, part in enumerate(parts)}
                for flag in {"sticks", "closed"} & set(one):
                    one[flag] = one[flag] == 1.0
                contacts[name] = MappingProxyType(one)
        ok = np.array(found, dtype=bool).reshape(shape)[()]
        return Evaluation(**columns, contacts=MappingProxyType(contacts), ok=ok)

    def rhs(self, u: Any = None, parameters: Optional[Mapping[str, Number]] = None) -> Callable[[Any, Any], np.ndarray]:
        """``f(t, y)`` for ``solve_ivp`` and similar functions: y is (2n,) or (2n, k), coordinates then rates."""
        machine = self._set(dict(parameters or {})) if parameters else self
        n = len(self.coordinates)

        def f(t: Any, y: Any) -> np.ndarray:
            y = np.asarray(y)
            if y.shape[:1] != (2 * n,):
                raise ValueError(f"y has shape {y.shape}, expected ({2 * n},) or ({2 * n}, k)")
            if y.ndim == 1:
                a = machine.accelerations(y[:n], y[n:], float(t), u=u)
                return np.concatenate([y[n:], a])
            a = machine.accelerations(y[:n].T, y[n:].T, t, u=u)
            return np.concatenate([y[n:], a.T])

        return f

    def jacobian(self, u: Any = None, parameters: Optional[Mapping[str, Number]] = None) -> Callable[[float, Any], np.ndarray]:
        """``f(t, y)``, the derivatives of :meth:`rhs` by y, (2n, 2n); they are exact and not differences."""
        machine = self._set(dict(parameters or {})) if parameters else self
        n = len(self.coordinates)
        inputs = _batch.vectors(u, tuple(self.inputs), list(machine.inputs.values()), "u", "input")

        def f(t: float, y: Any) -> np.ndarray:
            y = _batch.number_array(y, "y")
            if y.shape != (2 * n,):
                raise ValueError(f"y has shape {y.shape}, expected ({2 * n},)")
            by_q, by_v = _native.linearize(machine, float(t), y[:n].tolist(), y[n:].tolist(), inputs.tolist())
            jacobian = np.zeros((2 * n, 2 * n))
            jacobian[:n, n:] = np.eye(n)
            jacobian[n:, :n] = by_q.reshape(n, n)
            jacobian[n:, n:] = by_v.reshape(n, n)
            return jacobian

        return f

    linearize = _linear.linearize
    modes = _linear.modes
    equilibrium = _linear.equilibrium
    simulate = _simulate.simulate
    sweep = _sweep.sweep
    check = _command.check
    campbell = _command.campbell
    library = _command.library
    fmu = _command.fmu
    brachistochrone = _command.brachistochrone
    fit = _fit.fit
    orbit = _orbit.orbit
    spectrum = _looks.spectrum
    peaks = _looks.peaks
    section = _looks.section
    compare = _looks.compare
    global_error = _exact.global_error
    precise = _exact.precise
    validated = _exact.validated
    sympy = _sympy.symbolic
    sensitivities = _sensitive.sensitivities

    def _key(self) -> Tuple[Any, ...]:
        parameters, inputs = self._values
        # NaN marks a parameter without a value; here it must compare equal to itself.
        given = tuple("none" if math.isnan(x) else x for x in parameters)
        return (self._program.state(), given, tuple(inputs))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Machine):
            return NotImplemented
        return self is other or self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._once("key", self._key))

    def __copy__(self) -> "Machine":
        return self

    def __deepcopy__(self, memo: Any) -> "Machine":
        return self

    def __reduce__(self) -> Any:
        return (_again, (self._program.state(), *self._values))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:g}" for name, value in self.parameters.items())
        return f"<Machine {self.name}: {len(self.coordinates)} coordinates; {values}>"

    def _repr_html_(self) -> str:
        from html import escape

        rows: List[Tuple[str, str, Optional[float]]] = []
        start = self.start
        for name, value in self.parameters.items():
            rows.append(("parameter", name, value))
        for name, value in self.inputs.items():
            rows.append(("input", name, value))
        for name in self.coordinates:
            if state_of(name) is None:
                rows.append(("coordinate", name, start.q[name]))
        for name in self.states:
            rows.append(("state", name, start.v[name]))
        for name in self.outputs:
            rows.append(("output", name, None))
        body = "".join(
            f"<tr><td>{kind}</td><td><code>{escape(name)}</code></td><td>{'' if value is None else format(value, 'g')}</td>"
            f"<td>{escape(self.units[name])}</td><td>{escape(self.docs_of[name])}</td></tr>"
            for kind, name, value in rows
        )
        head = "<tr><th></th><th>name</th><th>value</th><th>unit</th><th></th></tr>"
        return f"<b>{escape(self.name)}</b><p>{escape(self.docs)}</p><table>{head}{body}</table>"


def _again(state: str, parameters: List[float], inputs: List[float]) -> Machine:
    """Restores a machine from its pickle."""
    return Machine._with(_native.rebuild(state), parameters, inputs)
