"""Numbers at states, against closed forms and against the command's."""

import json
import math
import os
import shutil
import subprocess

import numpy as np
import pytest

import lagrangian as lg
from conftest import ROOT


def command():
    """The command `lagrangian`, if it has been built."""
    given = os.environ.get("LAGRANGIAN")
    built = [ROOT / "target" / kind / "lagrangian" for kind in ("release", "debug")]
    found = [given] if given else [str(path) for path in built if path.exists()]
    found += [path for path in [shutil.which("lagrangian")] if path]
    return found[0] if found else None


def by_hand(m1, m2, l1, l2, g, q, v):
    """The double pendulum's mass matrix and forces, typed in, with the angles of both rods from the vertical."""
    a, b = q
    c, s = math.cos(a - b), math.sin(a - b)
    mass = [[(m1 + m2) * l1**2, m2 * l1 * l2 * c], [m2 * l1 * l2 * c, m2 * l2**2]]
    forces = [
        -m2 * l1 * l2 * s * v[1] ** 2 - (m1 + m2) * g * l1 * math.sin(a),
        m2 * l1 * l2 * s * v[0] ** 2 - m2 * g * l2 * math.sin(b),
    ]
    return np.array(mass), np.array(forces)


def test_numbers_are_those_of_equations_by_hand(double):
    random = np.random.default_rng(1)
    q, v = random.uniform(-3, 3, (2, 50, 2))
    found = double.evaluate(q, v)
    for k in range(50):
        mass, forces = by_hand(1, 1, 1, 1, 9.81, q[k], v[k])
        # Sums of a few terms of up to 50 N m: some roundings of these, times the condition number of the mass matrix,
        # at most 1e3.
        np.testing.assert_allclose(found.mass_matrix[k], mass, atol=1e-14)
        np.testing.assert_allclose(found.forces[k], forces, atol=1e-12)
        np.testing.assert_allclose(found.accelerations[k], np.linalg.solve(mass, forces), atol=1e-10)
    np.testing.assert_array_equal(found.applied - found.bias, found.applied - found.bias)
    np.testing.assert_allclose(found.forces, found.applied - found.bias, atol=1e-12)


def test_shapes_broadcast_as_those_of_numpy(double):
    q = np.linspace(0, 1, 12).reshape(3, 2, 2)
    v = np.ones((2, 2))
    masses = np.array([1.0, 2.0, 3.0])[:, None]
    a = double.accelerations(q, v, parameters={"m1": masses})
    assert a.shape == (3, 2, 2)
    for i in range(3):
        machine = double.with_parameters(m1=masses[i, 0])
        for j in range(2):
            np.testing.assert_array_equal(a[i, j], machine.accelerations(q[i, j], v[j]))
    out = np.empty((3, 2, 2))
    assert double.accelerations(q, v, out=out, parameters={"m1": masses}) is out
    np.testing.assert_array_equal(out, a)
    skewed = np.empty((3, 2, 2), order="F")
    double.accelerations(q, v, out=skewed, parameters={"m1": masses})
    np.testing.assert_array_equal(skewed, a)
    with pytest.raises(ValueError, match="out has shape"):
        double.accelerations(q, v, out=np.empty((3, 2)))
    found = double.evaluate(q, v)
    assert found.mass_matrix.shape == (3, 2, 2, 2) and found.kinetic_energy.shape == (3, 2)
    assert double.accelerations(np.empty((0, 2)), np.empty((0, 2))).shape == (0, 2)


def test_batches_have_the_bits_of_single_calls_on_any_number_of_threads(double):
    random = np.random.default_rng(2)
    q, v = random.uniform(-3, 3, (2, 20_000, 2))
    try:
        results = []
        for threads in (1, 3):
            lg.set_threads(threads)
            results.append(double.accelerations(q, v))
    finally:
        lg.set_threads(0)
    np.testing.assert_array_equal(*results)
    for k in range(0, 20_000, 997):
        np.testing.assert_array_equal(results[0][k], double.accelerations(q[k].copy(), v[k].copy()))


@pytest.mark.parametrize("name", ["crusher9", "cart_pole", "block_on_incline", "four_bar", "chain"])
def test_lanes_have_the_bits_of_single_states(machines, name):
    machine = lg.load(machines / f"{name}.machine")
    n, m = len(machine.coordinates), len(machine.inputs)
    seed = np.random.SeedSequence().entropy
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    # A number of states that is not a multiple of lanes, some of them NaN.
    q = np.asarray(machine.start.q) + random.uniform(0.01, 0.2, (2051, n))
    v, t, u = random.uniform(-1, 1, (2051, n)), random.uniform(0, 1, 2051), random.uniform(-1, 1, (2051, m))
    q[17, 0] = np.nan
    found = machine.accelerations(q, v, t, u=u, singular="nan")
    for k in [*range(30), *range(2040, 2051), *random.integers(0, 2051, 50)]:
        alone = machine.accelerations(q[k], v[k], t[k], u=u[k], singular="nan")
        np.testing.assert_array_equal(found[k], alone)
    assert np.isfinite(found[18]).all()


def test_both_engines_have_the_same_bits(machines):
    random = np.random.default_rng(3)
    try:
        results = []
        for engine in ("interpreter", "auto"):
            lg.set_engine(engine)
            assert lg.engine == engine
            crusher = lg.load(machines / "crusher9.machine")
            q, v = np.random.default_rng(3).uniform(0.5, 1, (2, 3000, 9))
            results.append(crusher.accelerations(q, v, 0.3))
    finally:
        lg.set_engine("auto")
    np.testing.assert_array_equal(*results)
    with pytest.raises(ValueError, match="no engine"):
        lg.set_engine("steam")


def test_the_jacobian_is_that_of_the_right_hand_side(double):
    random = np.random.default_rng(4)
    f, jacobian = double.rhs(), double.jacobian()
    for _ in range(5):
        y = random.uniform(-1, 1, 4)
        h = 1e-6
        differences = np.stack([(f(0, y + e) - f(0, y - e)) / (2 * h) for e in h * np.eye(4)], axis=1)
        # Central differences: third derivatives of about 1e3 times h²/6, and round-off of about 1e-14/h.
        np.testing.assert_allclose(jacobian(0, y), differences, atol=1e-7)
    many = random.uniform(-1, 1, (4, 7))
    np.testing.assert_array_equal(f(0, many), np.stack([f(0, y) for y in many.T.copy()], axis=1))
    with pytest.raises(ValueError, match=r"expected \(4,\)"):
        f(0, np.zeros(3))


def test_multipliers_and_reactions_of_a_pendulum_as_a_particle(machines):
    machine = lg.load(machines / "particle_pendulum.machine")
    found = machine.evaluate()
    assert machine.constraints
    # M a = f + Gᵀ λ
    residual = found.mass_matrix @ found.accelerations - found.forces - found.reactions
    assert np.abs(residual).max() < 1e-12
    assert set(found.multipliers) == set(machine.constraints)


@pytest.mark.skipif(command() is None, reason="the command `lagrangian` is not built")
@pytest.mark.parametrize(
    "name", ["double_pendulum", "crusher9", "particle_pendulum", "block_on_incline", "rolling_coin", "motor_crusher"]
)
def test_numbers_are_those_of_the_command_to_the_bit(machines, name):
    path = machines / f"{name}.machine"
    machine = lg.load(path)
    q = np.asarray(machine.start.q) + 0.125 * (name != "particle_pendulum")
    v = np.asarray(machine.start.v) + (0.25 if not machine.constraints else 0.0)
    point = {"t": 0.5, "q": q.tolist(), "v": v.tolist()}
    said = subprocess.run(
        [command(), "evaluate", str(path), "--at", "-"],
        input=json.dumps([point]),
        capture_output=True,
        text=True,
        check=True,
    )
    (numbers,) = json.loads(said.stdout)
    assert "error" not in numbers, numbers
    found = machine.evaluate(q, v, 0.5)
    for key in ("mass_matrix", "bias", "applied", "forces", "accelerations"):
        assert getattr(found, key).tolist() == numbers[key], key
    for key in ("kinetic_energy", "potential_energy", "dissipation"):
        assert getattr(found, key) == numbers[key], key
    assert {k: float(x) for k, x in found.outputs.items()} == numbers["outputs"]
    assert {k: float(x) for k, x in found.multipliers.items()} == numbers["multipliers"]
