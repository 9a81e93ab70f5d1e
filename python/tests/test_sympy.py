"""SymPy expressions, against the numbers that the machine computes."""

import math

import numpy as np
import pytest

import lagrangian as lg
from conftest import ROOT

sympy = pytest.importorskip("sympy")

#: The most coordinates of machines whose lambdified expressions are compared.
MOST = 12

LIBRARY = sorted(path.relative_to(ROOT / "machines") for path in (ROOT / "machines").glob("**/*.machine"))


def test_the_equations_of_a_pendulum_are_those_of_a_textbook(pendulum):
    of = pendulum.sympy()
    m, l, g = (of.parameters[name] for name in ("m", "l", "g"))
    theta, rate = of.q["theta"], of.v["theta"]
    assert sympy.simplify(of.mass_matrix[0] - m * l**2) == 0
    assert sympy.simplify(of.forces[0] + m * g * l * sympy.sin(theta)) == 0
    assert sympy.simplify(of.kinetic_energy - m * l**2 * rate**2 / 2) == 0
    # The potential energy is unique up to a constant.
    assert sympy.simplify(of.potential_energy.diff(theta) - m * g * l * sympy.sin(theta)) == 0


def test_lagranges_equations_by_sympy_are_the_forces(double):
    of = double.sympy().dynamicsymbols()
    lagrangian = of.kinetic_energy - of.potential_energy
    for i, q in enumerate(of.q.values()):
        rate = q.diff()
        motion = lagrangian.diff(rate).diff(of.t) - lagrangian.diff(q)
        accelerations = sympy.Matrix([x.diff(of.t, 2) for x in of.q.values()])
        ours = (of.mass_matrix.row(i) * accelerations)[0] - of.forces[i]
        assert sympy.simplify(motion - ours) == 0


def test_numbers_are_exact(oscillator):
    spring = lg.loads(
        "machine Spring in plane { coordinates { x: m } bodies { b { mass: 0.1, at: (x, 0) } } "
        "springs { s { stiffness: 1/3, stretch: x - pi/7 } } gravity none; }"
    )
    of = spring.sympy()
    assert of.mass_matrix[0] == sympy.Rational(1, 10)
    assert sympy.simplify(of.forces[0] + (of.q["x"] - sympy.pi / 7) / 3) == 0


@pytest.mark.parametrize("name", LIBRARY, ids=str)
def test_lambdified_expressions_are_the_numbers_of_the_machine(name):
    machine = lg.load(ROOT / "machines" / name)
    if len(machine.coordinates) > MOST:
        pytest.skip(f"{len(machine.coordinates)} coordinates")
    if any(math.isnan(x) for x in machine.parameters.values()):
        pytest.skip("parameters without values")
    of = machine.sympy()
    # A state slightly off the start, where the machine is away from corners of its equations.
    random = np.random.default_rng(19)
    n = len(machine.coordinates)
    symbols = [of.t, *of.q.values(), *of.v.values(), *of.parameters.values(), *of.inputs.values()]
    wanted = [of.mass_matrix, of.forces, of.bias, of.applied, sympy.Matrix([of.kinetic_energy, of.potential_energy, of.dissipation])]
    function = sympy.lambdify(symbols, wanted, modules="numpy", cse=True)
    compared = 0
    for _ in range(3):
        t = float(random.uniform(0, 1))
        q = np.asarray(machine.start.q) + random.uniform(0.01, 0.1, n)
        v = np.asarray(machine.start.v) + random.uniform(-1, 1, n)
        found = machine.evaluate(q, v, t, singular="nan")
        if not found.ok:
            continue
        mass, forces, bias, applied, energies = function(t, *q, *v, *machine.parameters.values(), *machine.inputs.values())
        # The same formulas in another order: rounding errors of 2^-53 of the largest of a few thousand terms.
        size = max(1.0, *(np.abs(x).max() for x in (forces, bias, applied)))
        np.testing.assert_allclose(found.mass_matrix, mass, rtol=1e-11, atol=1e-11 * np.abs(mass).max())
        np.testing.assert_allclose(found.forces, forces.ravel(), rtol=1e-11, atol=1e-11 * size)
        np.testing.assert_allclose(found.applied - found.bias, (applied - bias).ravel(), rtol=1e-11, atol=1e-11 * size)
        sizes = 1e-11 * max(1.0, np.abs(energies).max())
        ours = [found.kinetic_energy, found.potential_energy, found.dissipation]
        np.testing.assert_allclose(ours, energies.ravel(), rtol=1e-11, atol=sizes)
        compared += 1
    assert compared
