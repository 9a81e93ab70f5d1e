"""Derives the equations of motion of machines from their specs, symbolically, and integrates them.

>>> import lagrangian as lg
>>> m = lg.load("machines/double_pendulum.machine", l2=0.5)
>>> run = m.simulate(10, start={"theta1": 2.0}, tolerance=1e-10)
>>> run["theta1"].shape
(1001,)
"""

from . import errors
from ._command import Accuracy, Brachistochrone, Campbell, Check, Fmu, Published
from ._equations import Equations, Program
from ._exact import Enclosure, GlobalError, Precise
from ._fit import Combination, Fit
from ._linear import Linear, Mode, Modes
from ._machine import Evaluation, Machine, from_mjcf, from_urdf, load, loads
from ._named import Named, State
from ._native import __version__, set_engine, set_threads
from ._looks import Comparison, Peaks, Section, Spectrum
from ._orbit import Orbit
from ._sensitive import Sensitivities
from ._signals import Sampled, Table
from ._simulate import Energy, Event, Report, Run
from ._sweep import LogUniform, Normal, Sweep, Triangular, Uniform, run_chunk
from ._sympy import Symbolic
from .errors import (
    Diagnostic,
    ExportError,
    LagrangianError,
    MissingParameters,
    RunError,
    SingularError,
    SpecError,
    UnknownName,
)


def __getattr__(name: str) -> object:
    if name == "engine":
        from . import _native

        return _native.engine()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = [
    "Accuracy",
    "Brachistochrone",
    "Campbell",
    "Check",
    "Combination",
    "Comparison",
    "Diagnostic",
    "Enclosure",
    "Energy",
    "Equations",
    "Evaluation",
    "Event",
    "ExportError",
    "Fit",
    "Fmu",
    "GlobalError",
    "LagrangianError",
    "Linear",
    "LogUniform",
    "Machine",
    "MissingParameters",
    "Mode",
    "Modes",
    "Named",
    "Normal",
    "Orbit",
    "Peaks",
    "Precise",
    "Program",
    "Published",
    "Report",
    "Run",
    "RunError",
    "Sampled",
    "Section",
    "Sensitivities",
    "SingularError",
    "SpecError",
    "Spectrum",
    "State",
    "Sweep",
    "Symbolic",
    "Table",
    "Triangular",
    "Uniform",
    "UnknownName",
    "__version__",
    "errors",
    "from_mjcf",
    "from_urdf",
    "load",
    "loads",
    "run_chunk",
    "set_engine",
    "set_threads",
]
