"""Installs a wheel in a new virtual environment, and runs the package's tests and the README's notebook there.

    cd python && maturin build --release --out dist && cd ..
    python python/in_fresh_environment.py python/dist/lagrangian-*.whl [ARGUMENTS OF PYTEST]

This detects missing files and undeclared dependencies of the wheel. The exit status is that of pytest, after a line with the
time of each stage.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

TESTS = Path(__file__).resolve().parent / "tests"

#: Where the package was imported from, and how long that took.
IMPORT = "import time; t = time.perf_counter(); import lagrangian; print(f'{time.perf_counter() - t:.2f} s', lagrangian.__file__)"


def main(wheel: Path, arguments: list[str]) -> int:
    with tempfile.TemporaryDirectory() as folder:
        python = Path(folder) / "fresh" / "bin" / "python"
        times = []

        def timed(what: str, *command: object) -> subprocess.CompletedProcess:
            began = time.perf_counter()
            done = subprocess.run([str(word) for word in command], cwd=folder)
            times.append(f"{what} {time.perf_counter() - began:.1f} s")
            return done

        timed("environment", sys.executable, "-m", "venv", python.parents[1]).check_returncode()
        wanted = f"{wheel.resolve()}[test,notebook,plot]"
        timed("installing", python, "-m", "pip", "install", "-q", wanted).check_returncode()
        said = subprocess.run([python, "-c", IMPORT], cwd=folder, check=True, capture_output=True, text=True).stdout
        if str(python.parents[1].resolve()) not in said:
            raise SystemExit(f"the imported package is not the one from the wheel: {said}")
        times.append(f"import {said.split(' s')[0]} s")
        status = timed("tests", python, "-m", "pytest", "-q", "-p", "no:cacheprovider", TESTS, *arguments).returncode
    print("; ".join(times))
    return status


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
