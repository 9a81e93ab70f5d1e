"""Drake. A ball as a hybrid system, whose impacts are found by a witness function (its contacts have no coefficient of restitution);
settings are an accuracy. A block and a heap in its discrete mode, with point contacts; settings are a step in s and a stiffness in N/m."""

import logging
import math
import time
from importlib.metadata import version

import numpy as np
from pydrake.geometry import AddContactMaterial, Box, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction, DiscreteContactApproximation
from pydrake.multibody.tree import PlanarJoint, RotationalInertia, SpatialInertia
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder, EventStatus, LeafSystem, UnrestrictedUpdateEvent, WitnessFunctionDirection

from collisions.heap import BOWL, RADIUS, SIDES
from collisions.truths import GRAVITY, HALF_HEIGHT, HALF_WIDTH, TILT

NAME = f"Drake {version('drake')}"
SETTINGS = {
    "ball": [1e-3, 1e-6, 1e-9],
    "block": [(1e-3, 1e8), (1e-4, 1e9)],
    "pile": [(5e-2, 1e4), (1e-2, 1e4), (2e-3, 1e5)],
}
# It warns that half spaces do not touch deformable bodies.
logging.getLogger("drake").setLevel(logging.ERROR)
# Corners of the block are spheres of this radius, in m: a point has no contact.
TIP = 1e-6


def said(setting):
    return f"{setting[0]:g} s, {setting[1]:g} N/m" if isinstance(setting, tuple) else f"accuracy {setting:g}"


class Ball(LeafSystem):
    def __init__(self):
        LeafSystem.__init__(self)
        self.DeclareContinuousState(1, 1, 0)
        height = lambda context: context.get_continuous_state_vector()[0]
        bounce = UnrestrictedUpdateEvent(system_callback=self.bounce)
        self.hit = self.MakeWitnessFunction("hit", WitnessFunctionDirection.kPositiveThenNonPositive, height, bounce)

    def DoCalcTimeDerivatives(self, context, derivatives):
        derivatives.get_mutable_vector().SetFromVector([context.get_continuous_state_vector()[1], -GRAVITY])

    def DoGetWitnessFunctions(self, context):
        return [self.hit]

    @staticmethod
    def bounce(_system, context, _event, state):
        y, v = context.get_continuous_state_vector().CopyToVector()
        state.get_mutable_continuous_state().get_mutable_vector().SetFromVector([y, -0.8 * v])
        return EventStatus.Succeeded()


def ball(accuracy, until):
    simulator = Simulator(Ball())
    ResetIntegratorFromFlags(simulator, "runge_kutta5", 0.1)
    simulator.get_mutable_integrator().set_target_accuracy(accuracy)
    context = simulator.get_mutable_context()
    # This is how finely the instants of witness functions are found.
    context.SetAccuracy(accuracy)
    context.SetContinuousState([1.0, 0.0])
    simulator.Initialize()
    clock = time.process_time()
    simulator.AdvanceTo(until)
    return time.process_time() - clock, [float(context.get_continuous_state_vector()[0])]


def flat_plant(step):
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, step)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.mutable_gravity_field().set_gravity_vector([0, -GRAVITY, 0])
    return builder, plant, scene


def touching(stiffness, friction):
    material = ProximityProperties()
    AddContactMaterial(
        dissipation=0.0, point_stiffness=stiffness, friction=CoulombFriction(friction, friction), properties=material
    )
    # Its discrete mode dissipates by this time, in s, instead of by the coefficient above.
    material.AddProperty("material", "relaxation_time", 0.0)
    return material


def flat_body(plant, name, mass, inertia):
    body = plant.AddRigidBody(
        name, SpatialInertia.MakeFromCentralInertia(mass, np.zeros(3), RotationalInertia(inertia, inertia, inertia))
    )
    joint = plant.AddJoint(PlanarJoint(f"{name} joint", plant.world_frame(), body.body_frame(), np.zeros(3)))
    return body, joint


def block(setting):
    step, stiffness = setting
    builder, plant, _scene = flat_plant(step)
    material = touching(stiffness, 2.0)
    ground = HalfSpace.MakePose(np.array([0.0, 1.0, 0.0]), np.zeros(3))
    plant.RegisterCollisionGeometry(plant.world_body(), ground, HalfSpace(), "ground", material)
    body, joint = flat_body(plant, "block", 100.0, 100.0 * (HALF_WIDTH**2 + HALF_HEIGHT**2) / 3)
    for across in (-HALF_WIDTH, HALF_WIDTH):
        at = RigidTransform([across, -HALF_HEIGHT + TIP, 0.0])
        plant.RegisterCollisionGeometry(body, at, Sphere(TIP), f"corner {across}", material)
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    height = HALF_WIDTH * math.sin(TILT) + HALF_HEIGHT * math.cos(TILT)
    plant.SetPositions(context, [0.0, height, TILT])
    simulator.Initialize()
    clock, angle = time.process_time(), TILT
    for count in range(1, round(2.0 / step)):
        simulator.AdvanceTo(count * step)
        before, angle = angle, joint.get_rotation(context)
        if angle <= 0:
            return time.process_time() - clock, [count * step - step * angle / (angle - before)]
    return time.process_time() - clock, [math.nan]


def pile(setting, count, until):
    """Spheres in a plane; the bowl is a polygon about its circle, as for MuJoCo."""
    step, stiffness = setting
    mass, radius, apart, bowl = 0.05, RADIUS, 0.07, BOWL
    builder, plant, _scene = flat_plant(step)
    material = touching(stiffness, 0.3)
    for k in range(SIDES):
        angle = math.pi * (1 + (k + 0.5) / SIDES)
        # Half spaces would do, but Drake 1.51.1 ends with a segmentation fault when it gets the fifteenth.
        pose = RigidTransform(
            RotationMatrix.MakeZRotation(angle), (bowl + 0.05) * np.array([math.cos(angle), math.sin(angle), 0.0])
        )
        plant.RegisterCollisionGeometry(plant.world_body(), pose, Box(0.1, 0.02, 0.4), f"side{k}", material)
    places, bodies = [], []
    for i in range(1, count + 1):
        body, _ = flat_body(plant, f"disc{i}", mass, mass * radius**2 / 2)
        plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(radius), "rim", material)
        places += [*(apart * math.sqrt(i) * of(2.4 * i) for of in (math.cos, math.sin)), 0.0]
        bodies.append(body)
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetPositions(context, places)
    simulator.Initialize()
    clock = time.process_time()
    simulator.AdvanceTo(until)
    seconds = time.process_time() - clock
    contacts = plant.get_contact_results_output_port().Eval(context)
    depths = [contacts.point_pair_contact_info(i).point_pair().depth for i in range(contacts.num_point_pair_contacts())]
    rates = plant.GetVelocities(context).reshape(-1, 3)[:, :2]
    return seconds, [max([0.0, *depths]), float(np.hypot(*rates.T).max())]
