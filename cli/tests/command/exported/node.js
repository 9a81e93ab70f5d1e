// The text of a machine, its point by standard input; prints what it computes as one list.
const fs = require('fs');
const machine = new Function(`${fs.readFileSync(process.argv[1], 'utf8')}\nreturn machine;`)();
const { t, q, v } = JSON.parse(fs.readFileSync(0, 'utf8'));
const p = machine.prepare(machine.parameter_defaults);
const u = machine.input_defaults;
const a = machine.accelerations(p, t, q, v, u);
console.log(JSON.stringify([
  machine.mass_matrix(p, t, q),
  a,
  machine.kinetic_energy(p, t, q, v),
  machine.potential_energy(p, t, q, u),
  machine.functions_of_outputs.map((f) => f(p, t, q, v, u, a)),
]));
