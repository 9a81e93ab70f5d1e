/* Takes parameters, the defaults where `p` is null, and computes what depends on them alone. To be called before the first
 * evaluation and whenever parameters change, and not while another function of the library runs. */
void eval_setup(const double *p);

/* The accelerations `qdd` at `y`, which holds the coordinates and behind them their rates, and time `t`, in s. Of `p` the
 * inputs are read, behind the parameters; where it is null, they have their defaults. Where the mass matrix is singular, and
 * before `eval_setup`, every acceleration is NaN. `qdd` lies apart from all that is read. Any number of threads may evaluate at
 * once. */
void eval(const double *y, double t, const double *p, double *qdd);

LANES
/* How many there are; their names and units in UTF-8, null beyond the last; their values in the description, NaN without. */
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
