from typing import Any, Dict, List, Optional, Sequence, Tuple, final

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Diagnostic = Tuple[str, str, str, Optional[str], str, int, int]
_States = Tuple[_Array, _Array, _Array]
_Column = Tuple[str, Optional[str], Any]

__version__: str

@final
class Program:
    name: str
    docs: str
    file: str
    text: str
    files: List[Tuple[str, str]]
    constants: List[Tuple[str, str]]
    parameters: List[Tuple[str, str, str, Optional[float]]]
    inputs: List[Tuple[str, str, str, float]]
    derived_parameters: List[Tuple[str, str, str]]
    coordinates: List[Tuple[str, str, str]]
    outputs: List[Tuple[str, str, str]]
    constraints: List[Tuple[str, str]]
    contacts: List[str]
    elements: List[Tuple[str, str]]
    warnings: List[_Diagnostic]
    formulas: List[int]
    is_continued: Tuple[bool, bool]
    def state(self) -> str: ...
    def with_formulas(self, formulas: Sequence[Tuple[str, str, str, Optional[str]]]) -> Program: ...
    def with_constants(self, constants: Sequence[Tuple[str, str]]) -> Program: ...
    def with_given(self, names: Sequence[str]) -> Program: ...
    def refusal(self, values: Sequence[float]) -> Optional[str]: ...
    def derive(self, form: str) -> str: ...

class Machine:
    _program: Program
    _values: Tuple[List[float], List[float]]
    def __new__(cls, program: Program, parameters: Sequence[float], inputs: Sequence[float]) -> Any: ...
    def _start(self) -> Tuple[_Array, _Array]: ...
    def accelerations(
        self,
        q: Any = ...,
        v: Any = ...,
        t: Any = ...,
        *,
        u: Any = ...,
        parameters: Any = ...,
        singular: str = ...,
        out: Optional[_Array] = ...,
    ) -> _Array: ...

@final
class Run:
    start: _States
    end: _States
    ending: str
    statistics: Dict[str, Any]
    warnings: List[str]
    choices: List[Tuple[float, str, str]]
    def samples(self) -> _States: ...
    def at(self, times: Sequence[float]) -> _States: ...
    def columns(self, times: Optional[Sequence[float]] = ...) -> List[Tuple[str, str, _Array]]: ...
    def inputs(self, t: Sequence[float], q: Sequence[float], v: Sequence[float]) -> _Array: ...
    def events(self) -> Tuple[List[str], List[int], _States]: ...
    def energy(self) -> Optional[Dict[str, float]]: ...
    def objection(self) -> Optional[str]: ...
    def page(
        self,
        machine: Machine,
        asked: Tuple[str, str, Sequence[Tuple[str, str]]],
        method: str,
        error: Optional[str],
    ) -> str: ...

@final
class Kept:
    plan: str
    ending: str
    def __new__(
        cls, text: str, folder: str, file: Optional[str], ending: str, fresh: bool
    ) -> Kept: ...
    def missing(self) -> List[int]: ...
    def keep(self, chunk: int, rows: bytes, samples: Optional[bytes]) -> None: ...
    def run(self, threads: int, tell: Any) -> None: ...
    def end(self) -> Tuple[List[_Column], Optional[List[_Column]]]: ...

@final
class Stop:
    def __new__(cls) -> Stop: ...
    def set(self) -> None: ...

def derive(
    name: str,
    text: Optional[str],
    files: Optional[Sequence[Tuple[str, str]]],
    constants: Sequence[Tuple[str, str]],
) -> Program: ...
def rebuild(state: str) -> Program: ...
def sensitivities(
    machine: Machine,
    by: Sequence[Tuple[str, str]],
    start: Tuple[float, Sequence[float], Sequence[float]],
    instants: Sequence[float],
    until: float,
    tolerance: float,
    method: str,
    max_steps: int,
    keep: Optional[Sequence[str]],
) -> Tuple[_Array, _Array, _Array, _Array]: ...
def symbolic(
    program: Program,
) -> Tuple[List[Tuple[str, str, List[Tuple[int, str]]]], List[Tuple[str, List[int]]]]: ...
def command(arguments: Sequence[str]) -> int: ...
def answer_of_file(command: str, path: str, options: Sequence[str]) -> Tuple[int, str, str]: ...
def answer(program: Program, command: str, options: Sequence[str]) -> Tuple[int, str, str]: ...
def set_engine(name: str) -> None: ...
def engine() -> str: ...
def set_threads(count: int) -> None: ...
def methods() -> List[str]: ...
def accelerations(
    machine: Machine,
    t: _Array,
    q: _Array,
    v: _Array,
    u: _Array,
    varied: Sequence[Tuple[str, Any]],
    out: _Array,
    raises: bool,
) -> None: ...
def evaluate(
    machine: Machine,
    t: _Array,
    q: _Array,
    v: _Array,
    u: _Array,
    varied: Sequence[Tuple[str, Any]],
    raises: bool,
) -> Tuple[Dict[str, _Array], List[bool]]: ...
def linearize(
    machine: Machine,
    t: float,
    q: Sequence[float],
    v: Sequence[float],
    u: Sequence[float],
) -> Tuple[_Array, _Array]: ...
def modes(
    machine: Machine,
    start: Tuple[float, Sequence[float], Sequence[float]],
    inputs: Sequence[float],
    steady: Tuple[Sequence[bool], Sequence[bool]],
) -> Dict[str, Any]: ...
def linear_model(
    machine: Machine,
    start: Tuple[float, Sequence[float], Sequence[float]],
    inputs: Sequence[float],
    steady: Optional[Tuple[Sequence[bool], Sequence[bool]]],
    wanted: Tuple[Sequence[int], Sequence[Tuple[str, int]]],
) -> Dict[str, Any]: ...
def simulate(of: Machine, settings: Dict[str, Any]) -> Tuple[Run, Optional[str]]: ...
def written(text: str, input: str, unit: str) -> str: ...
def plan(text: str) -> Tuple[str, int, int, Optional[str]]: ...
def chunk_file(text: str, chunk: int, ending: str) -> Tuple[bytes, Optional[bytes]]: ...
def run_chunk(text: str, chunk: int, stop: Optional[Stop] = ...) -> Tuple[List[_Column], Optional[List[_Column]]]: ...
