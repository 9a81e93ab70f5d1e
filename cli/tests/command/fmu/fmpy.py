# FMPy as importer: units are valid, and both kinds move as `lagrangian simulate` says. Arguments: a unit, and a JSON text with
# start values and the states at the end. CVode's tolerance is 1e-10, so 1e-5 of the largest; co-simulation has 1e-11, so 1e-7.
import json
import sys

import fmpy
from fmpy.validation import validate_fmu

unit, text = sys.argv[1:]
wanted = json.loads(text)
problems = validate_fmu(unit)
assert not problems, problems
names = list(wanted["end"])
largest = max(abs(value) for value in wanted["end"].values())
for kind, tolerance, bound in [("CoSimulation", 1e-11, 1e-7), ("ModelExchange", 1e-10, 1e-5)]:
    run = fmpy.simulate_fmu(
        unit,
        fmi_type=kind,
        stop_time=wanted["until"],
        relative_tolerance=tolerance,
        output_interval=wanted["until"] / 20,
        start_values=wanted["start"],
        output=names,
    )
    assert abs(run["time"][-1] - wanted["until"]) < 1e-9, run["time"][-1]
    for name in names:
        error = abs(run[name][-1] - wanted["end"][name]) / largest
        assert error <= bound, (kind, name, run[name][-1], wanted["end"][name])
print("valid")
