# The text of a machine, its point by standard input; prints what it computes as one list.
import json
import runpy
import sys

import sympy as sp

machine = runpy.run_path(sys.argv[1])
point = json.load(sys.stdin)
p = machine["prepare"](machine["PARAMETER_DEFAULTS"])
t, q, v, u = point["t"], point["q"], point["v"], machine["INPUT_DEFAULTS"]
a = machine["accelerations"](p, t, q, v, u)
outputs = [f for name, f in machine.items() if name.startswith("output_")]
values = [
    *list(machine["mass_matrix"](p, t, q)),
    *a,
    machine["kinetic_energy"](p, t, q, v),
    machine["potential_energy"](p, t, q, u),
    *[f(p, t, q, v, u, a) for f in outputs],
]
print(json.dumps([float(sp.N(value)) for value in values]))
