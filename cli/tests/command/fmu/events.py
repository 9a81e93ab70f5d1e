# FMPy as importer of a unit with events: it is valid, and each way of running it counts what closed forms say.
import sys

import fmpy
from fmpy.validation import validate_fmu

unit = sys.argv[1]
problems = validate_fmu(unit)
assert not problems, problems
known = {"event.high": 2, "event.low": 1, "event.begin": 1, "event.bottom": 3}
ways = [{"fmi_type": "ModelExchange"}, {"fmi_type": "CoSimulation"}]
if fmpy.read_model_description(unit).fmiVersion.startswith("3"):
    ways.append({"fmi_type": "CoSimulation", "use_event_mode": True, "early_return_allowed": True})
for way in ways:
    run = fmpy.simulate_fmu(
        unit, stop_time=2.0, relative_tolerance=1e-9, output_interval=0.1, output=list(known), **way
    )
    found = {name: int(run[name][-1]) for name in known}
    assert found == known, (way, found)
    assert abs(run["time"][-1] - 2.0) < 1e-9, run["time"][-1]
print("valid")
