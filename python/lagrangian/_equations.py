"""The equations of motion, and the arithmetic that was derived from them."""

from __future__ import annotations

from typing import Any


class Equations:
    """The derivation of a machine's equations of motion."""

    def __init__(self, program: Any) -> None:
        self._program = program

    def markdown(self) -> str:
        """As Markdown, formulas between ``$`` and ``$$``."""
        return str(self._program.derive("markdown"))

    def latex(self) -> str:
        """As a document of its own in LaTeX."""
        return str(self._program.derive("latex"))

    def html(self) -> str:
        """As a page of its own."""
        return str(self._program.derive("html"))

    def _repr_markdown_(self) -> str:
        return self.markdown()

    def __repr__(self) -> str:
        return f"<equations of {self._program.name}: .markdown(), .latex(), .html()>"


class Program:
    """The straight-line arithmetic of a machine."""

    def __init__(self, program: Any) -> None:
        self.text: str = program.derive("program")
        """The listing."""

    def __repr__(self) -> str:
        return self.text
