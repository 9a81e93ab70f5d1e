/* Contacts that open and close. `eval` gives the accelerations with all of them open; its caller has to determine which of them are closed,
 * from the following. Each pointer may be null, and 0 stands for what does not exist. `gaps[i]`, in m, is positive if contact i is open;
 * `rates[2*i]` is the rate at which it opens and `rates[2*i + 1]` that at which it slips, in m/s. These are linear in the rates of the
 * coordinates: row j of `rows`, its COORDINATES numbers from `rows[COORDINATES*j]` on, has the derivatives of `rates[j]` with respect to
 * them, and `bias[j]` is d/dt of `rates[j]` if all accelerations are 0. So a normal force and a friction force along the slip add their
 * magnitudes times these rows to the generalized forces. `coefficients[4*i]` and the three after it are the restitution along the normal
 * and along the tangent, or the parameters of a compliant contact, and the coefficients of sliding and of static friction. */
void eval_contacts(const double *y, double t, double *gaps, double *rates, double *rows, double *bias, double *coefficients);

/* The mass matrix M, row by row, and the matrix G of the constraints, CONSTRAINTS rows of COORDINATES numbers; each pointer may be null. With
 * a from `eval` and generalized forces F of contacts the accelerations are a + b, where M b = F + G' l and G b = 0. The same equations with
 * impulses in place of forces, and changes of rates in place of b, describe an impact. */
void eval_inertia(const double *y, double t, double *mass, double *constraints);

/* The number of contacts, their names, and their laws: `newton`, `poisson`, `poisson_glocker`, `stronge`, or, of compliant contacts, `linear`,
 * `hertz`, `hunt_crossley`, `layer`; null beyond the last. A contact that leans on the one before it shares the gap and the normal force of
 * that contact and has its own slip: 1 if it is the rolling of that contact (the slip is in rad/s, the friction a torque of at most
 * `coefficients` times the normal force), 2 if it is its second tangent (the two friction forces are limited together), 0 if it is
 * independent, -1 beyond the last. */
int contacts(void);
const char *contact_name(int i);
const char *contact_law(int i);
int contact_leans(int i);
