"""Drake: error-controlled Runge–Kutta methods for trees; machines with loops in its discrete mode, the only one with constraints."""

import time

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import DiscreteContactApproximation, MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    LinearSpringDamper,
    RevoluteJoint,
    RotationalInertia,
    SpatialInertia,
)
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator

from runs.bodies import machine

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def plant_of(of, step):
    """The plant, and its joints in the order of coordinates."""
    plant = MultibodyPlant(step)
    plant.mutable_gravity_field().set_gravity_vector(of.gravity)
    bodies, joints = [], [None] * len(of.bodies)
    place = lambda i: plant.world_body() if i < 0 else bodies[i]
    for i, body in enumerate(of.bodies):
        xx, yy, zz, xy, xz, yz = body.inertia
        inertia = SpatialInertia.MakeFromCentralInertia(body.mass, body.centre, RotationalInertia(xx, yy, zz, xy, xz, yz))
        bodies.append(plant.AddRigidBody(f"body{i}", inertia))
        before = plant.AddFrame(FixedOffsetFrame(f"frame{i}", place(body.parent).body_frame(), RigidTransform(list(body.at))))
        joint = RevoluteJoint(f"joint{i}", before, bodies[i].body_frame(), AXES[body.axis], body.damping)
        joints[body.coordinate] = plant.AddJoint(joint)
    for one, at, other, point in of.loops:
        plant.AddBallConstraint(place(one), at, place(other), point)
    if of.spring:
        on = of.spring
        plant.AddForceElement(
            LinearSpringDamper(bodies[on.body], on.at, plant.world_body(), on.ground, on.length, on.stiffness, 0.0)
        )
    if of.torque:
        plant.AddJointActuator("motor", joints[of.torque[0]])
    if step:
        plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.Finalize()
    return plant, joints


class Peer:
    trees = {
        "Drake, RK5": "runge_kutta5",
        "Drake, RK3": "runge_kutta3",
        "Drake, Radau3": "radau3",
    }
    discrete = ("Drake, discrete (SAP)",)

    def __init__(self, run):
        self.run, self.machine, self.made = run, machine(run.name), {}
        self.tools = () if not self.machine else self.discrete if self.machine.loops else self.trees
        # Drake 1.51.1 ends with a segmentation fault if a ball constraint joins a body to the ground.
        if self.machine and any(-1 in (one, other) for one, _, other, _ in self.machine.loops):
            self.tools = ()

    def settings(self, tool):
        if tool in self.discrete:
            return [self.run.until / 2**k for k in range(9, 16)]
        # Beyond these, RK5 takes the smallest steps that it can distinguish, and the others seconds.
        return (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)[: {"Drake, RK5": 6, "Drake, RK3": 5, "Drake, Radau3": 4}[tool]]

    def simulator(self, tool, setting):
        """It, its plant, and the places of coordinates in the plant's state."""
        is_discrete = tool in self.discrete
        key = (tool, setting) if is_discrete else tool
        if key not in self.made:
            plant, joints = plant_of(self.machine, setting if is_discrete else 0.0)
            simulator = Simulator(plant)
            if not is_discrete:
                ResetIntegratorFromFlags(simulator, self.trees[tool], self.run.until)
            elif self.machine.torque:
                plant.get_actuation_input_port().FixValue(simulator.get_mutable_context(), [self.machine.torque[1]])
            self.made[key] = simulator, plant, [joint.position_start() for joint in joints]
        return self.made[key]

    def call(self, tool, setting):
        simulator, plant, places = self.simulator(tool, setting)
        n = len(places)
        context = simulator.get_mutable_context()
        context.SetTime(0.0)
        state = np.empty(2 * n)
        for part, y in enumerate((self.run.start[:n], self.run.start[n:])):
            state[[part * n + at for at in places]] = self.machine.joints(y)
        plant.SetPositionsAndVelocities(context, state)
        if tool not in self.discrete:
            integrator = simulator.get_mutable_integrator()
            integrator.set_target_accuracy(setting)
            integrator.request_initial_step_size_target(min(1e-2, setting**0.25) * 1e-2)
        simulator.Initialize()
        clock = time.process_time()
        simulator.AdvanceTo(self.run.until)
        seconds = time.process_time() - clock
        state = plant.GetPositionsAndVelocities(context)
        ends = [self.machine.coordinates(state[[part * n + at for at in places]]) for part in (0, 1)]
        return seconds, np.concatenate(ends)
