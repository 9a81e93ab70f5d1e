/* Contacts that open and close. `eval` has the accelerations with all of them open; which of them press is for its caller to find out, from
 * what follows, where each place may be null, and 0 stands for what is not there. `gaps[i]`, in m, is positive where contact i is open;
 * `rates[2*i]` is the rate at which it opens and `rates[2*i + 1]` that at which it slips, in m/s; these are linear in the rates of the
 * coordinates: row j of `rows`, its COORDINATES numbers from `rows[COORDINATES*j]` on, has the derivatives of `rates[j]` by these, and
 * `drift[j]` is d/dt of `rates[j]` where all accelerations are 0. So a normal force and a friction along the slip add their sizes times
 * these rows to the generalized forces. `coefficients[4*i]` and the three behind it are restitution along the normal and along the tangent,
 * or the parameters of what yields, and the friction of what slips and of what sticks. */
void eval_contacts(const double *y, double t, double *gaps, double *rates, double *rows, double *drift, double *coefficients);

/* The mass matrix M, row after row, and the matrix G of the constraints, CONSTRAINTS rows of COORDINATES numbers; each place may be null. With
 * a from `eval` and generalized forces F of contacts the accelerations are a + b of M b = F + G' l, G b = 0; with impulses in place of
 * forces, and changes of rates in place of b, so is an impact. */
void eval_inertia(const double *y, double t, double *mass, double *constraints);

/* How many contacts there are, their names, and their laws: `newton`, `poisson`, `poisson_glocker`, `stronge`, or of what yields `linear`,
 * `hertz`, `hunt_crossley`, `layer`; null beyond the last. One that leans on the contact before it has the gap and the normal force of that, and its
 * own slip: 1 where it is its rolling (the slip is in rad/s, the friction a torque of at most `coefficients` times the normal force), 2
 * where it is its second tangent (both frictions together are limited), 0 where it stands alone, -1 beyond the last. */
int contacts(void);
const char *contact_name(int i);
const char *contact_law(int i);
int contact_leans(int i);
