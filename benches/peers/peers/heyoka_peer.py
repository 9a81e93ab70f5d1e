"""heyoka: functions compiled by LLVM, for one state and for several at once.

Its expressions are transcribed, operation by operation, from CasADi's graphs, so that the same forms are compared. The object code
of the compiled functions is linked into a library, so that it is called in the same way as that of the other peers.
"""

import subprocess
from pathlib import Path

import casadi as ca
import heyoka as hy

import tasks
from peers import casadi_peer, pinocchio_peer
from peers.common import Clock, ready


def transcribed(f, read):
    """The results of a CasADi function as heyoka's expressions; `read[i][k]` is element k of its argument i."""
    work, results = {}, [hy.expression(0.0)] * f.numel_out(0)
    binary = {
        ca.OP_ADD: lambda a, b: a + b,
        ca.OP_SUB: lambda a, b: a - b,
        ca.OP_MUL: lambda a, b: a * b,
        ca.OP_DIV: lambda a, b: a / b,
    }
    unary = {
        ca.OP_NEG: lambda a: -a,
        ca.OP_SQ: lambda a: a * a,
        ca.OP_TWICE: lambda a: 2.0 * a,
        ca.OP_INV: lambda a: 1.0 / a,
        ca.OP_SIN: hy.sin,
        ca.OP_COS: hy.cos,
        ca.OP_SQRT: hy.sqrt,
        ca.OP_ASSIGN: lambda a: a,
    }
    for k in range(f.n_instructions()):
        op, i, o = f.instruction_id(k), f.instruction_input(k), f.instruction_output(k)
        if op == ca.OP_CONST:
            work[o[0]] = hy.expression(f.instruction_constant(k))
        elif op == ca.OP_INPUT:
            work[o[0]] = read[i[0]][i[1]]
        elif op == ca.OP_OUTPUT:
            results[o[1]] = work[i[0]]
        elif op in binary:
            work[o[0]] = binary[op](work[i[0]], work[i[1]])
        else:
            work[o[0]] = unary[op](work[i[0]])
    return results


def linked(folder, name, functions):
    """A library of compiled functions: {symbol: (object code, lanes)}."""
    stem = folder / name
    shim, objects = ["typedef void one(double *, const double *, const double *, const double *);"], []
    shim.append("typedef void many(double *, const double *, const double *, const double *, unsigned long);")
    for symbol, (code, lanes) in functions.items():
        path = folder / f"{name}_{symbol}.o"
        path.write_bytes(code)
        words = ["objcopy", "--redefine-sym", f"cfunc=cfunc_{symbol}", "--strip-symbol=heyoka.obj_trigger"]
        subprocess.run([*words, str(path)], check=True)
        objects.append(str(path))
        if lanes == 1:
            shim.append(f"extern one cfunc_{symbol};")
            shim.append(f"void {symbol}(const double *y, double t, const double *p, double *qdd)")
            shim.append(f"{{ cfunc_{symbol}(qdd, y, p, &t); }}")
        else:
            # Parameters are read lane by lane, so each number is repeated for every lane.
            shim.append(f"extern many cfunc_{symbol};")
            shim.append(f"static double p_{symbol}[{lanes} * 512];")
            shim.append(f"void setup_{symbol}(const double *p, int n)")
            shim.append(f"{{ for (int i = 0; i < n * {lanes}; ++i) p_{symbol}[i] = p[i / {lanes}]; }}")
            shim.append(f"void {symbol}(const double *y, const double *t, const double *p, double *qdd)")
            shim.append(f"{{ cfunc_{symbol}(qdd, y, p_{symbol}, t, {lanes}); }}")
    return stem, shim, objects


def sources(task, variant, folder):
    """The CasADi functions that are transcribed, with the time of their derivation."""
    clock = Clock()
    if task == "crusher":
        for form in ("projected", "by hand"):
            yield f"{form}, LDL", casadi_peer.function(task, variant, form, "LDL"), clock.lap()
        return
    if task != "arm" and tasks.Task(task).n <= 8:
        yield "by hand, LDL", casadi_peer.function(task, variant, "by hand", "LDL"), clock.lap()
    stem, derive, _ = pinocchio_peer.generate(task, "local", folder)
    yield "Pinocchio's ABA", ca.Function.load(str(stem) + ".casadi"), derive


def forms(task, variant, folder):
    n, count = tasks.Task(task).n, len(tasks.Task(task).parameters)
    wheel = Path(hy.__file__).resolve().parent.parent / "heyoka.libs"
    vectors = [*wheel.glob("libheyoka-*"), *wheel.glob("libsleef-*")]  # contain vectorized sines
    variables = [hy.expression(f"y{i}") for i in range(2 * n)]
    for name, f, derive in sources(task, variant, folder):
        clock = Clock()
        read = [variables, [hy.time], [hy.par[i] for i in range(count)]]
        results = transcribed(f, read)
        derive += clock.lap()
        # Functions of this size are only compiled in compact mode.
        compact = f.n_instructions() > 20000
        compiled = {lanes: None for lanes in (8, 4)}
        for lanes in compiled:
            compiled[lanes] = hy.cfunc(
                results, variables, batch_size=lanes, force_avx512=lanes == 8, compact_mode=compact
            )
            if lanes == 8:
                jit = clock.lap()
        code = {"eval": (compiled[8].llvm_states[0].object_code, 1)}
        for lanes, function in compiled.items():
            code[f"eval{lanes}"] = (function.llvm_states[2].object_code, lanes)
        stem, shim, objects = linked(folder, name.replace(", ", "_").replace(" ", "_").replace("'", ""), code)
        shim.append("void eval_setup(const double *p) {")
        shim += [f"    setup_{symbol}(p, {count});" for symbol, (_, lanes) in code.items() if lanes > 1] + ["}"]
        source, library = stem.with_suffix(".c"), stem.with_suffix(".so")
        source.write_text("\n".join(shim) + "\n")
        words = ["gcc", "-O2", "-shared", "-fPIC", "-o", library, source, *objects, *vectors, f"-Wl,-rpath,{wheel}", "-lm"]
        subprocess.run([str(word) for word in words], check=True)
        mode = ", compact mode" if compact else ""
        yield ready(f"{name}{mode}, LLVM", library, derive, 0.0, jit)
