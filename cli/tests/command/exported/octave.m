m = MACHINE();
q = PLACES; v = RATES; t = TIME;
p = m.prepare(m.parameter_defaults); u = m.input_defaults;
a = m.accelerations(p, t, q, v, u);
M = m.mass_matrix(p, t, q);
printf('%.17g\n', M', a, m.kinetic_energy(p, t, q, v), m.potential_energy(p, t, q, u));
names = fieldnames(m);
for k = 1:numel(names)
    if strncmp(names{k}, 'output_', 7)
        printf('%.17g\n', m.(names{k})(p, t, q, v, u, a));
    end
end
