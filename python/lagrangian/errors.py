"""The exceptions of this package, with their details as attributes."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence, Tuple


class Diagnostic(NamedTuple):
    """An error in a spec, or a warning, with its position."""

    severity: str
    """``"error"`` or ``"warning"``."""
    code: str
    """The kind of error, such as ``unknown-name``; it stays the same across versions."""
    message: str
    help: Optional[str]
    """What to write instead."""
    file: str
    line: int
    """From 1."""
    column: int
    """In characters, from 1."""


class LagrangianError(Exception):
    """The base of all exceptions of this package.

    They can be pickled: an exception is restored from the arguments of its constructor.
    """

    def __reduce__(self) -> Any:
        return (type(self), self._arguments)

    _arguments: Tuple[Any, ...] = ()


class SpecError(LagrangianError, ValueError):
    """A spec has errors; the text of the exception underlines the wrong words."""

    def __init__(self, text: str, diagnostics: Sequence[Any] = ()) -> None:
        super().__init__(text)
        self.diagnostics = [Diagnostic(*told) for told in diagnostics]
        self._arguments = (text, [tuple(told) for told in diagnostics])


class UnknownName(LagrangianError, LookupError):
    """Nothing has this name; the message suggests a similar one."""

    def __init__(
        self, what: str, name: str, known: Sequence[str], nearest: Optional[str] = None
    ) -> None:
        if nearest is not None:
            rest = f"did you mean `{nearest}`?"
        elif known:
            rest = "there are: " + ", ".join(known)
        else:
            rest = "there are none"
        super().__init__(f"no {what} named `{name}`; {rest}")
        self.name = name
        self.known = list(known)
        self.nearest = nearest
        self._arguments = (what, name, list(known), nearest)

    def __str__(self) -> str:  # KeyError and its kin show a repr
        return str(self.args[0])


class MissingParameters(LagrangianError, ValueError):
    """Parameters without a default have no value."""

    def __init__(self, text: str, names: Sequence[str]) -> None:
        super().__init__(f"{text}; set them: with_parameters({', '.join(f'{name}=…' for name in names)})")
        self.names = list(names)
        self._arguments = (text, list(names))


class SingularError(LagrangianError, ArithmeticError):
    """A machine has no accelerations at a state."""

    def __init__(
        self, text: str, coordinate: str, ratio: float, index: Any = None
    ) -> None:
        place = f" (state {index})" if index is not None and index != () else ""
        super().__init__(text + place)
        self.coordinate = coordinate
        """The coordinate, or the constraint, at which elimination stopped."""
        self.ratio = ratio
        """The pivot of the elimination, relative to the element on the diagonal."""
        self.index = () if index is None else index
        """The index of the state in a batch."""
        self._arguments = (text, coordinate, ratio, index)


class RunError(LagrangianError, RuntimeError):
    """A run was ended by an error."""

    def __init__(self, text: str, t: Optional[float] = None, run: Any = None) -> None:
        super().__init__(text)
        self.t = t
        """The time of the error, in s; None if the run could not begin."""
        self.run = run
        """The part of the run before the error, if there is one."""
        self._arguments = (text, t, run)


class ExportError(LagrangianError, RuntimeError):
    """A machine could not be exported."""

    def __init__(self, reason: str, output: str = "") -> None:
        super().__init__(reason)
        self.reason = reason
        self.output = output
        self._arguments = (reason, output)


def unknown(what: str, name: str, known: Sequence[str]) -> UnknownName:
    """The error for a name that does not exist, which suggests a similar one."""
    import difflib

    lower = {k.lower(): k for k in reversed(list(known))}
    near = difflib.get_close_matches(name.lower(), list(lower), n=1, cutoff=0.6)
    return UnknownName(what, name, known, lower[near[0]] if near else None)
