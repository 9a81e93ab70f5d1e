"""The equations as SymPy expressions."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Callable, Dict, List, Mapping

from . import _native


class Symbolic:
    """The equations of a machine as expressions of SymPy: ``M a = f + Gᵀ λ`` with ``f = Q − h``.

    Symbols are real; numbers are exact. A rate is called ``der(x)``, an acceleration ``der(x, 2)``, as in the spec's language.
    """

    t: Any
    """Time."""
    q: Mapping[str, Any]
    """Coordinates by name."""
    v: Mapping[str, Any]
    """Rates by the names of coordinates."""
    a: Mapping[str, Any]
    """Accelerations by the names of coordinates."""
    parameters: Mapping[str, Any]
    inputs: Mapping[str, Any]
    mass_matrix: Any
    """M(q, t): a Matrix (n, n)."""
    bias: Any
    """h(q, v, t): a Matrix (n, 1)."""
    applied: Any
    """Q(q, v, t, u): a Matrix (n, 1)."""
    forces: Any
    """f = Q − h: a Matrix (n, 1)."""
    kinetic_energy: Any
    """T in J."""
    potential_energy: Any
    """V in J."""
    dissipation: Any
    """Rayleigh's function D in W."""
    constraints: Mapping[str, Any]
    """The constraints by name, as expressions that are 0: of positions if they are holonomic, otherwise of rates."""
    constraint_jacobian: Any
    """G(q, t): a Matrix (c, n); accelerations obey G a = γ."""
    constraint_bias: Any
    """γ(q, v, t): a Matrix (c, 1)."""
    outputs: Mapping[str, Any]
    """The outputs by name; they may contain accelerations."""

    def __init__(self, **parts: Any) -> None:
        self.__dict__.update(parts)

    def dynamicsymbols(self) -> "Symbolic":
        """The same equations with functions of time in place of coordinates, and with their derivatives in place of rates and
        accelerations, as in ``sympy.physics``."""
        from sympy.physics.mechanics import dynamicsymbols

        time = dynamicsymbols._t
        known: Dict[Any, Any] = {self.t: time}
        functions = {name: dynamicsymbols(_plain(name)) for name in self.q}
        for name, function in functions.items():
            known[self.q[name]] = function
            known[self.v[name]] = function.diff(time)
            known[self.a[name]] = function.diff(time, 2)

        def changed(part: Any) -> Any:
            if isinstance(part, Mapping):
                return MappingProxyType({name: changed(of) for name, of in part.items()})
            return part.xreplace(known)

        return Symbolic(**{name: changed(part) for name, part in self.__dict__.items()})

    def __repr__(self) -> str:
        return f"<Symbolic: {', '.join(self.__dict__)}>"


def _plain(name: str) -> str:
    """A name without brackets, which would make SymPy split it."""
    return name.replace("[", "_").replace("]", "").replace(",", "_").replace(" ", "")


def symbolic(self: Any) -> Symbolic:
    """The equations as expressions of SymPy, which must be installed: see :class:`Symbolic`."""
    import sympy

    nodes, quantities = _native.symbolic(self._program)
    functions: Dict[str, Callable[..., Any]] = {
        "ln": sympy.log,
        "abs": sympy.Abs,
        "min": sympy.Min,
        "max": sympy.Max,
        "pow": sympy.Pow,
    }
    made: List[Any] = []
    symbols: Dict[str, Dict[str, Any]] = {kind: {} for kind in ("t", "q", "v", "a", "parameter", "input", "other")}
    shown = {"v": "der({})", "a": "der({}, 2)"}

    def symbol(kind: str, name: str) -> Any:
        if name not in symbols[kind]:
            symbols[kind][name] = sympy.Symbol(shown.get(kind, "{}").format(name), real=True)
        return symbols[kind][name]

    for kind, name, operands in nodes:
        if kind == "number":
            made.append(sympy.Rational(name))
        elif kind == "pi":
            made.append(sympy.pi)
        elif kind == "sum":
            made.append(sympy.Add(*(sympy.Rational(number) * made[i] for i, number in operands)))
        elif kind == "product":
            made.append(sympy.Mul(*(made[i] ** int(power) for i, power in operands)))
        elif kind == "function":
            function = functions.get(name) or getattr(sympy, name)
            made.append(function(*(made[i] for i, _ in operands)))
        else:
            made.append(symbol(kind, name))
    found = {name: [made[i] for i in places] for name, places in quantities}
    names, held = self.coordinates, self.constraints
    n, c = len(names), len(held)

    def by_name(kind: str, known: Any) -> Mapping[str, Any]:
        return MappingProxyType({name: symbol(kind, name) for name in known})

    return Symbolic(
        t=symbol("t", "t"),
        q=by_name("q", names),
        v=by_name("v", names),
        a=by_name("a", names),
        parameters=by_name("parameter", self.parameters),
        inputs=by_name("input", self.inputs),
        mass_matrix=sympy.Matrix(n, n, found["mass_matrix"]),
        bias=sympy.Matrix(n, 1, found["bias"]),
        applied=sympy.Matrix(n, 1, found["applied"]),
        forces=sympy.Matrix(n, 1, found["forces"]),
        kinetic_energy=found["kinetic_energy"][0],
        potential_energy=found["potential_energy"][0],
        dissipation=found["dissipation"][0],
        constraints=MappingProxyType(dict(zip(held, found["constraints"]))),
        constraint_jacobian=sympy.Matrix(c, n, found["rows"]),
        constraint_bias=sympy.Matrix(c, 1, found["biases"]),
        outputs=MappingProxyType(dict(zip(self.outputs, found["outputs"]))),
    )
