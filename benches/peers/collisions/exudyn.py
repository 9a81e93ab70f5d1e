"""Exudyn: soft contacts, in steps of generalized-α; steps in which contact begins or ends are repeated. Settings are a step in s and a stiffness in 1/s²."""

import time

import exudyn
import exudyn.utilities as items

from collisions.truths import GRAVITY

NAME = f"Exudyn {exudyn.__version__}"
SETTINGS = {"ball": [(1e-3, 1e5), (1e-4, 1e7), (2.5e-5, 1e8)]}


def said(setting):
    return f"{setting[0]:g} s, {setting[1]:g} /s²"


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
