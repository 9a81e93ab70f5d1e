"""Exudyn: its kinematic tree with the explicit methods, and with constraints by generalized-α, the trapezoidal rule in index 2."""

import sys
import time

import numpy as np

# The module without range checks, which its manual recommends for speed.
sys.exudynFast = True
import exudyn  # noqa: E402
from exudyn.itemInterface import (  # noqa: E402
    MarkerBodyPosition,
    MarkerKinematicTreeRigid,
    NodeGenericODE2,
    ObjectConnectorSpringDamper,
    ObjectGround,
    ObjectJointSpherical,
    ObjectKinematicTree,
)

from runs.bodies import machine  # noqa: E402


def system_of(of):
    """The assembled system; its coordinates are those of the bodies in their order."""
    system = exudyn.SystemContainer().AddSystem()
    bodies, n = of.bodies, len(of.bodies)
    zeros = [0.0] * n
    node = system.AddNode(
        NodeGenericODE2(referenceCoordinates=zeros, initialCoordinates=zeros, initialCoordinates_t=zeros, numberOfODE2Coordinates=n)
    )
    kinds = {"x": exudyn.JointType.RevoluteX, "y": exudyn.JointType.RevoluteY, "z": exudyn.JointType.RevoluteZ}

    def tensor(xx, yy, zz, xy, xz, yz):
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], float)

    torques = [of.torque[1] if of.torque and of.torque[0] == body.coordinate else 0.0 for body in bodies]
    damping = {}
    if any(body.damping for body in bodies):
        others = ("jointPControlVector", "jointPositionOffsetVector", "jointVelocityOffsetVector")
        damping = dict.fromkeys(others, zeros) | {"jointDControlVector": [body.damping for body in bodies]}
    tree = system.AddObject(
        ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[kinds[body.axis] for body in bodies],
            linkParents=[body.parent for body in bodies],
            jointTransformations=exudyn.Matrix3DList([np.eye(3)] * n),
            jointOffsets=exudyn.Vector3DList([list(map(float, body.at)) for body in bodies]),
            linkInertiasCOM=exudyn.Matrix3DList([tensor(*body.inertia) for body in bodies]),
            linkCOMs=exudyn.Vector3DList([list(map(float, body.centre)) for body in bodies]),
            linkMasses=[body.mass for body in bodies],
            gravity=list(of.gravity),
            jointForceVector=torques,
            **damping,
        )
    )
    ground = system.AddObject(ObjectGround()) if of.loops else None

    def marker(body, at):
        at = list(map(float, at))
        if body < 0:
            return system.AddMarker(MarkerBodyPosition(bodyNumber=ground, localPosition=at))
        return system.AddMarker(MarkerKinematicTreeRigid(objectNumber=tree, linkNumber=body, localPosition=at))

    for one, at, other, point in of.loops:
        system.AddObject(ObjectJointSpherical(markerNumbers=[marker(one, at), marker(other, point)], constrainedAxes=[1, 1, 0]))
    if of.spring:
        on = of.spring
        ends = [marker(-1, on.ground), marker(on.body, on.at)]
        system.AddObject(ObjectConnectorSpringDamper(markerNumbers=ends, referenceLength=on.length, stiffness=on.stiffness))
    system.Assemble()
    return system


class Peer:
    trees = {
        "Exudyn, DOPRI5": exudyn.DynamicSolverType.DOPRI5,
        "Exudyn, RK67": exudyn.DynamicSolverType.RK67,
        "Exudyn, trapezoidal": exudyn.DynamicSolverType.TrapezoidalIndex2,
    }
    loops = {
        "Exudyn, trapezoidal, index 2": exudyn.DynamicSolverType.TrapezoidalIndex2,
        "Exudyn, generalized-α": exudyn.DynamicSolverType.GeneralizedAlpha,
    }

    def __init__(self, run):
        self.run, self.machine = run, machine(run.name)
        self.tools = () if not self.machine else self.loops if self.machine.loops else self.trees
        if self.machine:
            self.system = system_of(self.machine)
            self.order = [body.coordinate for body in self.machine.bodies]

    def settings(self, tool):
        if tool.endswith("DOPRI5"):
            return (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)
        # With loops Newton's iteration does not end in coarser steps on the four-bar linkage.
        return [self.run.until / 2**k for k in range(11 if tool in self.loops else 8, 16 if "RK" in tool else 17)]

    def call(self, tool, setting):
        words = exudyn.SimulationSettings()
        words.solutionSettings.writeSolutionToFile = False
        words.timeIntegration.endTime = self.run.until
        words.timeIntegration.verboseMode = 0
        words.linearSolverType = exudyn.LinearSolverType.EigenDense
        words.displayComputationTime = words.displayStatistics = False
        if tool.endswith("DOPRI5"):
            words.timeIntegration.automaticStepSize = True
            words.timeIntegration.relativeTolerance = words.timeIntegration.absoluteTolerance = setting
            # Its longest step is this part of the run, and its first one must be short enough.
            words.timeIntegration.numberOfSteps = 50
            words.timeIntegration.initialStepSize = 1e-3 * self.run.until / 50
            words.timeIntegration.minimumStepSize = 1e-12
        else:
            words.timeIntegration.automaticStepSize = False
            words.timeIntegration.numberOfSteps = round(self.run.until / setting)
            words.timeIntegration.newton.useModifiedNewton = True
            words.timeIntegration.newton.relativeTolerance = 1e-10
            words.timeIntegration.newton.absoluteTolerance = 1e-12
            words.timeIntegration.generalizedAlpha.spectralRadius = 0.9
        n = len(self.order)
        for part, place in (
            (self.run.start[:n], self.system.systemData.SetODE2Coordinates),
            (self.run.start[n:], self.system.systemData.SetODE2Coordinates_t),
        ):
            place(self.machine.joints(part)[self.order], exudyn.ConfigurationType.Initial)
        clock = time.process_time()
        done = self.system.SolveDynamic(words, solverType=(self.trees | self.loops)[tool])
        seconds = time.process_time() - clock
        ends = []
        for read in (self.system.systemData.GetODE2Coordinates, self.system.systemData.GetODE2Coordinates_t):
            joints = np.empty(n)
            joints[self.order] = read()
            ends.append(self.machine.coordinates(joints))
        return seconds, np.concatenate(ends) if done else None
