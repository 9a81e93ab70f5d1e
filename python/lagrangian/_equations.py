"""The equations of motion, and the arithmetic derived from them."""

from __future__ import annotations

import re
from types import MappingProxyType
from typing import Any, Mapping, Optional

#: Browsers typeset longer formulas too slowly.
_LONGEST = 3000


class Equations:
    """The derivation of a machine's equations of motion."""

    def __init__(self, program: Any) -> None:
        self._program = program

    def markdown(self) -> str:
        """The derivation as Markdown, with formulas between ``$`` and ``$$``."""
        return str(self._program.derive("markdown"))

    def latex(self) -> str:
        """The derivation as a complete LaTeX document."""
        return str(self._program.derive("latex"))

    def html(self) -> str:
        """The derivation as a complete HTML page."""
        return str(self._program.derive("html"))

    def _repr_latex_(self) -> str:
        """The formulas of the derivation, for viewers that show LaTeX but not Markdown; formulas of more than 3000
        characters are omitted."""
        formulas = re.findall(r"\$\$.*?\$\$", self.markdown(), re.S)
        shown = (f if len(f) <= _LONGEST else rf"$$\text{{(a formula of {len(f)} characters)}}$$" for f in formulas)
        return "\n\n".join(shown)

    def _repr_markdown_(self) -> str:
        return self.markdown()

    def __repr__(self) -> str:
        return f"<equations of {self._program.name}: .markdown(), .latex(), .html()>"


class Program:
    """The program of a machine: straight-line arithmetic."""

    def __init__(self, machine: Any) -> None:
        self._machine = machine
        self._found: Optional[Mapping[str, Any]] = None

    @property
    def text(self) -> str:
        """The listing."""
        return str(self._told["text"])

    @property
    def counts(self) -> Mapping[str, Mapping[str, int]]:
        """The operations of each function by kind: ``multiplications``, ``additions``, ``divisions``, ``sincos``, …"""
        return MappingProxyType(self._told["counts"])

    @property
    def cycles(self) -> Mapping[str, float]:
        """For each function that can be computed in several ways, an estimate of the processor cycles of a call in the middle of other work."""
        choices = self._told["choices"]
        return MappingProxyType({name: ways[0]["cycles_among_others"] for name, ways in choices.items()})

    @property
    def _told(self) -> Mapping[str, Any]:
        from ._command import answer

        if self._found is None:
            self._found = answer(self._machine, "derive", ["--as=program"])
        return self._found

    def __repr__(self) -> str:
        return self.text
