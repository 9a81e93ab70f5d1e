/* Takes the parameters, or the defaults if `p` is null, and computes everything that depends on them alone. Must be called before
 * the first evaluation and whenever parameters change, and not while another function of the library runs. */
void eval_setup(const double *p);

/* The accelerations `qdd` at `y`, which holds the coordinates and then their rates, and at time `t`, in s. Only the inputs are
 * read from `p`, after the parameters; if it is null, they have their defaults. If the mass matrix is singular, and before
 * `eval_setup` is called, every acceleration is NaN. `qdd` must not overlap anything that is read. Any number of threads may
 * evaluate at once. */
void eval(const double *y, double t, const double *p, double *qdd);

LANES
/* Their numbers; their names and units in UTF-8, null beyond the last; their default values in the spec, NaN if it has none. */
int coordinates(void);
const char *coordinate_name(int i);
const char *coordinate_unit(int i);
int parameters(void);
const char *parameter_name(int i);
const char *parameter_unit(int i);
double parameter_default(int i);
int inputs(void);
const char *input_name(int i);
const char *input_unit(int i);
double input_default(int i);
