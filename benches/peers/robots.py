#!/usr/bin/env python3
"""Real robots from their URDF files: our accelerations compared with Pinocchio's, and the time of our code with that of its generated code.

    target/peers/python/bin/python benches/peers/robots.py target/release/lagrangian [--only xarm7,g1] [--ball zyx]
        [--states 20] [--no-times]

README.md describes the measurements, and names the robots with their licences.
"""

import argparse
import json
import os
import pathlib
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile
import time

import numpy
import pinocchio

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SITE = pathlib.Path(numpy.__file__).resolve().parent.parent
FILES = SITE / "cmeel.prefix" / "share" / "example-robot-data" / "robots"

# The file, whether its base floats, further options for the import, and the licence of the file.
ROBOTS = {
    "xarm7": ("xarm_description/urdf/xarm7.urdf", False, [], "BSD-3-Clause"),
    "kinova": ("kinova_description/robots/kinova.urdf", False, [], "BSD"),
    "ur5": ("ur_description/urdf/ur5_robot.urdf", False, [], "BSD"),
    "z1": ("z1_description/urdf/z1.urdf", False, [], "MPL-2.0"),
    "solo12": ("solo_description/robots/solo12.urdf", True, [], "BSD-3-Clause"),
    "a1": ("a1_description/urdf/a1.urdf", True, [], "MPL-2.0"),
    "simple_humanoid": (
        "simple_humanoid_description/urdf/simple_humanoid.urdf", True, ["--ignore", "collision_checking"], "BSD-2-Clause"),
    "g1": ("g1_description/urdf/g1_29dof_rev_1_0.urdf", True, ["--ignore", "dont_collapse"], "BSD-3-Clause"),
}

# Relative to the largest acceleration. The two methods differ by some roundings of terms that cancel; the condition numbers of mass
# matrices here are below 1e4.
AGREE = 1e-12


def shell(words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr[-3000:]}")
    return done.stdout


def seconds_of(words):
    """CPU seconds of a command and its child processes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    shell(words)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def coordinates_of(spec):
    """The names of the coordinates in an imported spec."""
    inside = re.sub(r"///.*", "", spec.split("    coordinates {", 1)[1].split("\n    }", 1)[0])
    return re.findall(r"(\w+): (?:rad|m|1)\b", inside)


def parameters_of(spec):
    inside = re.sub(r"///.*", "", spec.split("    parameters {", 1)[1].split("\n    }", 1)[0])
    return [float(number) for number in re.findall(r"\w+: [\w*/^]+ = ([-+\d.e]+)", inside)]


def identifier(name):
    return re.sub(r"\W", "_", name)


def models(name):
    """Pinocchio's model, with its own base for a floating one, and the order of the joints in a spec."""
    path, floats, _, _ = ROBOTS[name]
    root = pinocchio.JointModelFreeFlyer() if floats else None
    model = pinocchio.buildModelFromUrdf(str(FILES / path), root) if floats else pinocchio.buildModelFromUrdf(str(FILES / path))
    return model


def joint_values(model, names, random_of):
    """The values of all joints with one coordinate, by their names in a spec."""
    values = {}
    for joint in model.names[1:]:
        index = model.getJointId(joint)
        if model.joints[index].nv == 1:
            assert identifier(joint) in names, joint
            values[joint] = random_of()
    return values


def rotation(axis, angle):
    c, s = numpy.cos(angle), numpy.sin(angle)
    return {
        "x": numpy.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "y": numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "z": numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def state(model, floats, ball, spec_names, draw):
    """A random state, in a spec's coordinates and in Pinocchio's, and the map from accelerations of the one to those of the other."""
    uniform = lambda: draw.uniform(-1, 1)
    q, v = dict(), dict()
    pq, pv = pinocchio.neutral(model), numpy.zeros(model.nv)
    for joint in model.names[1:]:
        index = model.getJointId(joint)
        kind = model.joints[index]
        if kind.nv != 1:
            continue
        angle, rate = uniform(), uniform()
        q[identifier(joint)], v[identifier(joint)] = angle, rate
        if kind.nq == 1:
            pq[kind.idx_q] = angle
        else:  # a continuous joint has cosine and sine as coordinates
            pq[kind.idx_q : kind.idx_q + 2] = numpy.cos(angle), numpy.sin(angle)
        pv[kind.idx_v] = rate
    if floats:
        place, speed = numpy.array([uniform() for _ in range(3)]), numpy.array([uniform() for _ in range(3)])
        psi, theta, phi = [uniform() for _ in range(3)]
        axes = rotation("z", psi) @ rotation("y", theta) @ rotation("x", phi)
        rates = numpy.array([uniform() for _ in range(3)])
        turning = numpy.array([
            [-numpy.sin(theta), 0, 1],
            [numpy.sin(phi) * numpy.cos(theta), numpy.cos(phi), 0],
            [numpy.cos(phi) * numpy.cos(theta), -numpy.sin(phi), 0],
        ])
        omega = turning @ rates
        quaternion = pinocchio.Quaternion(axes)
        pq[:7] = [*place, *quaternion.coeffs()]
        pv[:6] = [*(axes.T @ speed), *omega]
        base = next(n for n in spec_names if n.endswith("_x"))[:-2]
        for k, axis in enumerate("xyz"):
            q[f"{base}_{axis}"], v[f"{base}_{axis}"] = place[k], speed[k]
        if ball == "quaternion":
            x, y, z, w = quaternion.coeffs()
            a, b, c = omega / 2
            parts = {"qw": w, "qx": x, "qy": y, "qz": z}
            moving = {"qw": -x * a - y * b - z * c, "qx": w * a + y * c - z * b, "qy": w * b + z * a - x * c, "qz": w * c + x * b - y * a}
        else:
            parts = dict(zip(["yaw", "pitch", "roll"], [psi, theta, phi]))
            moving = dict(zip(["yaw", "pitch", "roll"], rates))
        q.update({f"{base}_{part}": value for part, value in parts.items()})
        v.update({f"{base}_{part}": value for part, value in moving.items()})
    return q, v, pq, pv


def accelerations_agree(name, machine, command, ball, count):
    """The largest difference from Pinocchio's accelerations, relative to the largest acceleration: of the joints, and of the
    position of the base."""
    _, floats, _, _ = ROBOTS[name]
    model = models(name)
    data = model.createData()
    names = coordinates_of(machine.read_text())
    draw = random.Random(f"{name} 2026")
    states = [state(model, floats, ball, names, draw) for _ in range(count)]
    assert all(set(q) == set(names) for q, *_ in states), set(names) ^ set(states[0][0])
    points = [{"q": [q[n] for n in names], "v": [v[n] for n in names]} for q, v, _, _ in states]
    at = machine.with_suffix(".json")
    at.write_text(json.dumps(points))
    ours = json.loads(shell([command, "evaluate", machine, "--at", at]))
    worst = 0.0
    for (q, v, pq, pv), ours_here in zip(states, ours):
        a = dict(zip(names, ours_here["accelerations"]))
        theirs = pinocchio.aba(model, data, pq, pv, -numpy.array(model.damping) * pv)
        largest = numpy.abs(theirs).max()
        for joint in model.names[1:]:
            kind = model.joints[model.getJointId(joint)]
            if kind.nv == 1:
                worst = max(worst, abs(theirs[kind.idx_v] - a[identifier(joint)]) / largest)
        if floats:
            base = next(n for n in names if n.endswith("_x"))[:-2]
            axes = pinocchio.Quaternion(pq[3:7]).matrix()
            # The acceleration of the frame: u' + w x u in its own axes.
            along = axes @ (theirs[:3] + numpy.cross(pv[3:6], pv[:3]))
            for k, axis in enumerate("xyz"):
                worst = max(worst, abs(along[k] - a[f"{base}_{axis}"]) / largest)
    return worst


def compile_pinocchio(folder):
    """The program that generates Pinocchio's code."""
    program = folder / "pinocchio_robot"
    source = HERE / "pinocchio_robot.cpp"
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        prefix, casadi = SITE / "cmeel.prefix", SITE / "casadi"
        boost = ["-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_MPL_LIMIT_LIST_SIZE=30"]
        include = [f"-I{prefix}/include", f"-I{prefix}/include/eigen3", f"-I{prefix}/include/urdfdom_headers", f"-I{casadi}/include"]
        library = next(casadi.glob("libcasadi.so.*"))
        link = [library, f"-L{prefix}/lib", "-lpinocchio_default", "-lpinocchio_parsers", f"-Wl,-rpath,{casadi}:{prefix}/lib"]
        print("compiling Pinocchio with CasADi (about three minutes, once) …", file=sys.stderr)
        shell(["g++", "-std=c++17", "-O0", "-w", *boost, *include, source, "-o", program, *link])
    return program


def write_task(path, parameters, rows):
    n = (len(rows[0]) - 1) // 2
    with open(path, "wb") as file:
        file.write(struct.pack("<4d", n, len(parameters), len(rows), 0))
        for row in [parameters, *rows]:
            file.write(struct.pack(f"<{len(row)}d", *row))


def times(name, machine, command, ball, work):
    """Nanoseconds per call for our code and for the fastest form of Pinocchio's, and the time to derive each."""
    path, floats, _, _ = ROBOTS[name]
    model = models(name)
    spec = machine.read_text()
    names = coordinates_of(spec)
    draw = random.Random(f"{name} times")
    states = [state(model, floats, ball, names, draw) for _ in range(128)]
    inputs = re.sub(r"///.*", "", spec.split("    inputs {", 1)[1].split("\n    }", 1)[0]) if "    inputs {" in spec else ""
    parameters = parameters_of(spec) + [0.0] * len(re.findall(r"\w+: ", inputs))
    ours = work / f"{name}_ours.bin"
    write_task(ours, parameters, [[q[n] for n in names] + [v[n] for n in names] + [0.0] for q, v, _, _ in states])
    library = work / f"lib{name}.so"
    shell([command, "library", machine, "--lanes", "4,8", "--out", library])
    derive = seconds_of([command, "derive", machine, "--as", "rust", "--out", work / f"{name}.rs"])
    timing = work / "timing"
    shell(["gcc", "-O2", "-o", timing, HERE / "timing.c", "-ldl", "-lm"])
    theirs = work / f"{name}_theirs.bin"
    n = model.nq
    pad = [0.0] * (n - model.nv)
    write_task(theirs, [0.0], [[*pq, *pv, *pad, 0.0] for _, _, pq, pv in states])
    forms = []
    for frame in ("local", "world"):
        stem = work / f"{name}_{frame}"
        shell([compile_pinocchio(work), FILES / path, "free" if floats else "fixed", frame, stem])
        source = stem.with_suffix(".c")
        shim = f"void eval(const double *y, double t, const double *p, double *a) {{ const double *in[] = {{y, y + {n}}}; double *out[] = {{a}}; f(in, out, 0, 0, 0); }}"
        source.write_text(source.read_text() + "\n" + shim + "\n")
        shell(["gcc", "-O3", "-march=native", "-shared", "-fPIC", "-w", "-o", stem.with_suffix(".so"), source, "-lm"])
        forms.append(stem.with_suffix(".so"))
    best = {}
    for _ in range(3):
        for key, made, task in [("ours", library, ours), *[("theirs", form, theirs) for form in forms]]:
            found = json.loads(shell([timing, made.resolve(), task]))
            for kind in ("thr", "lat", "eval4"):
                if kind in found:
                    best[key, kind] = min(best.get((key, kind), float("inf")), found[kind])
    return best, derive


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("command", help="the command `lagrangian`")
    words.add_argument("--only", default=",".join(ROBOTS))
    words.add_argument("--ball", default="zyx", choices=["zyx"])
    words.add_argument("--states", type=int, default=20)
    words.add_argument("--no-times", action="store_true")
    call = words.parse_args()
    command = pathlib.Path(call.command).resolve()
    work = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "peers" / "robots"
    work.mkdir(parents=True, exist_ok=True)
    heads = "| robot | licence | coordinates | mul + add | largest difference | derived: s | ours: ns | theirs: ns | ratio | in a row | 4 lanes |"
    print(heads + "\n| --- | --- |" + " --: |" * 9)
    failed = []
    for name in call.only.split(","):
        path, floats, options, licence = ROBOTS[name]
        machine = work / f"{name}.machine"
        base = ["--base", "floating", "--ball", call.ball] if floats else []
        shell([command, "import", FILES / path, *base, "--friction", "none", "--drop-massless", *options, "--out", machine])
        off = accelerations_agree(name, machine, command, call.ball, call.states)
        if off > AGREE:
            failed.append(name)
        program = shell([command, "derive", machine, "--as", "program"])
        mul, add = re.search(r"^accelerations\(.*?// (\d+) mul, (\d+) add", program, re.M).groups()
        cells = [name, licence, str(len(coordinates_of(machine.read_text()))), str(int(mul) + int(add)), f"{off:.1e}"]
        if not call.no_times:
            best, derive = times(name, machine, command, call.ball, work)
            one, row = best["ours", "thr"], best["ours", "lat"]
            peer, peer_row = best["theirs", "thr"], best["theirs", "lat"]
            lanes = best.get(("ours", "eval4"), float("nan"))
            cells += [f"{derive:.2f}", f"{one:.0f}", f"{peer:.0f}", f"{one / peer:.2f}", f"{row / peer_row:.2f}", f"{lanes / peer:.2f}"]
        print("| " + " | ".join(cells) + " |", flush=True)
    if failed:
        sys.exit(f"accelerations differ by more than {AGREE}: {', '.join(failed)}")


if __name__ == "__main__":
    main()
