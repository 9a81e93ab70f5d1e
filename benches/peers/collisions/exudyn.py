"""Exudyn: soft contacts. The ball runs by generalized-α, which repeats steps in which contact begins or ends; the others by the explicit
midpoint rule. Settings begin with a step in s and a stiffness in N/m. Finer steps and harder contacts end in errors of its solver."""

import math
import time

import exudyn
import exudyn.utilities as items
import numpy as np

from collisions.heap import BOWL, RADIUS, SIDES, measured
from collisions.truths import GRAVITY, HALF_HEIGHT, HALF_WIDTH, TILT

NAME = f"Exudyn {exudyn.__version__}"
SETTINGS = {
    "ball": [(1e-3, 1e5), (1e-4, 1e7)],
    "block": [(5e-5, 1e7, 1e-3, 1e-3), (1e-5, 1e8, 1e-4, 1e-3), (5e-6, 1e8, 1e-4, 1e-4)],
    "pile": [(1e-4, 1e4), (5e-5, 1e5)],
}


def said(setting):
    return f"{setting[0]:g} s, {setting[1]:g} N/m"


def ball(setting, until):
    """A ball of 1 kg with a prescribed restitution of 0.8, by the model of Gonthier and others (2); the other one (1) is less accurate."""
    step, stiffness = setting
    machine = exudyn.SystemContainer().AddSystem()
    ball, fixed = machine.AddNode(items.Node1D()), machine.AddNode(items.NodePointGround())
    machine.AddObject(items.Mass1D(mass=1.0, nodeNumber=ball))
    of_ball, of_floor = (machine.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in (ball, fixed))
    machine.AddLoad(items.LoadCoordinate(markerNumber=of_ball, load=-GRAVITY))
    machine.AddObject(
        items.ObjectContactCoordinate(
            markerNumbers=[of_floor, of_ball],
            nodeNumber=machine.AddNode(items.NodeGenericData(initialCoordinates=[1.0, 0.0], numberOfDataCoordinates=2)),
            contactStiffness=stiffness,
            restitutionCoefficient=0.8,
            minimumImpactVelocity=1e-3,
            impactModel=2,
            offset=-1.0,
        )
    )
    machine.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = until
    settings.timeIntegration.numberOfSteps = round(until / step)
    settings.solution.file.write = False
    clock = time.process_time()
    machine.SolveDynamic(settings)
    seconds = time.process_time() - clock
    return seconds, [1.0 + float(machine.GetNodeOutput(ball, exudyn.OutputVariableType.Coordinates))]


def general(machine, friction, slip, cells):
    """Contact of spheres with each other and with triangles, and a marker of the ground; below the slip, in m/s, friction is viscous."""
    contact = machine.AddGeneralContact()
    contact.verboseMode = 0
    contact.frictionProportionalZone = slip
    contact.SetFrictionPairings(np.array([[friction]]))
    contact.SetSearchTreeCellSize(numberOfCells=cells)
    ground = machine.AddObject(items.ObjectGround())
    return contact, machine.AddMarker(items.MarkerBodyRigid(bodyNumber=ground))


def flat_body(machine, mass, inertia, at):
    """A body in the plane x, y under gravity: its node and number."""
    node = machine.AddNode(items.NodeRigidBody2D(referenceCoordinates=at))
    body = machine.AddObject(items.ObjectRigidBody2D(physicsMass=mass, physicsInertia=inertia, nodeNumber=node))
    weighed = machine.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    machine.AddLoad(items.LoadMassProportional(markerNumber=weighed, loadVector=[0, -GRAVITY, 0]))
    return node, body


def strip(points, depth=0.2):
    """Triangles of a surface over a broken line in the plane x, y; their normals point to its left."""
    corners = [[x, y, z] for x, y in points for z in (-depth, depth)]
    triangles = []
    for i in range(len(points) - 1):
        a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        triangles += [[a, b, c], [b, d, c]]
    return corners, triangles


def settings_for(step, until):
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = until
    settings.timeIntegration.numberOfSteps = round(until / step)
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    return settings


def block(setting):
    """Its lower corners are spheres of the third number of a setting, in m; the fourth is a slip."""
    step, stiffness, tip, slip = setting
    machine = exudyn.SystemContainer().AddSystem()
    contact, ground = general(machine, 2.0, slip, [2, 2, 1])
    height = HALF_WIDTH * math.sin(TILT) + HALF_HEIGHT * math.cos(TILT)
    mass = 100.0
    node, body = flat_body(machine, mass, mass * (HALF_WIDTH**2 + HALF_HEIGHT**2) / 3, [0.0, height, TILT])
    damping = 2 * math.sqrt(stiffness * mass)
    for across in (-HALF_WIDTH, HALF_WIDTH):
        marker = machine.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[across, -HALF_HEIGHT + tip, 0]))
        contact.AddSphereWithMarker(marker, radius=tip, contactStiffness=stiffness, contactDamping=damping, frictionMaterialIndex=0)
    points, triangles = strip([(-1.0, 0.0), (1.0, 0.0)])
    contact.AddTrianglesRigidBodyBased(
        rigidBodyMarkerIndex=ground,
        contactStiffness=stiffness,
        contactDamping=damping,
        frictionMaterialIndex=0,
        pointList=points,
        triangleList=triangles,
    )
    machine.Assemble()
    fall = [TILT, math.nan]

    def after(system, t):
        before, fall[0] = fall[0], TILT + system.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates)[2]
        if before > 0 >= fall[0]:
            fall[1] = t - step * fall[0] / (fall[0] - before)
            system.SetRenderEngineStopFlag(True)
        return True

    machine.SetPreStepUserFunction(after)
    clock = time.process_time()
    machine.SolveDynamic(settings_for(step, 0.52), solverType=exudyn.DynamicSolverType.ExplicitMidpoint)
    return time.process_time() - clock, [fall[1]]


def pile(setting, count, until):
    """The bowl is a polygon about its circle."""
    step, stiffness = setting
    mass, radius, apart = 0.05, RADIUS, 0.07
    machine = exudyn.SystemContainer().AddSystem()
    contact, ground = general(machine, 0.3, 1e-3, [12, 12, 1])
    # A normal collision of two discs loses its speed.
    damping = 2 * math.sqrt(stiffness * mass / 2)
    nodes = []
    for i in range(1, count + 1):
        x, y = (apart * math.sqrt(i) * of(2.4 * i) for of in (math.cos, math.sin))
        node, body = flat_body(machine, mass, mass * radius**2 / 2, [x, y, 0.0])
        marker = machine.AddMarker(items.MarkerBodyRigid(bodyNumber=body))
        contact.AddSphereWithMarker(
            marker, radius=radius, contactStiffness=stiffness, contactDamping=damping, frictionMaterialIndex=0
        )
        nodes.append(node)
    out = BOWL / math.cos(math.pi / (2 * SIDES))
    corners = [math.pi * (1 + k / SIDES) for k in range(SIDES + 1)]
    points, triangles = strip([(out * math.cos(angle), out * math.sin(angle)) for angle in corners])
    contact.AddTrianglesRigidBodyBased(
        rigidBodyMarkerIndex=ground,
        contactStiffness=stiffness,
        contactDamping=damping,
        frictionMaterialIndex=0,
        pointList=points,
        triangleList=triangles,
    )
    machine.Assemble()
    clock = time.process_time()
    machine.SolveDynamic(settings_for(step, until), solverType=exudyn.DynamicSolverType.ExplicitMidpoint)
    seconds = time.process_time() - clock
    read = lambda kind: zip(*(machine.GetNodeOutput(node, kind)[:2] for node in nodes))
    x, y = read(exudyn.OutputVariableType.Position)
    u, v = read(exudyn.OutputVariableType.Velocity)
    return seconds, measured(x, y, u, v, is_polygon=True)
