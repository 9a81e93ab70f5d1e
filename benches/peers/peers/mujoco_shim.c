// MuJoCo's smooth forward dynamics (no contacts, no constraints, no integration) with the interface of the timing loop.
// MODEL and ABSOLUTE are defined on the compiler's command line.
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

static mjModel *m;
static mjData *d;

void eval_setup(const double *p) {
    (void)p; // the model contains the parameters
    char message[1000] = "";
    m = mj_loadXML(MODEL, 0, message, sizeof message);
    if (!m) {
        fprintf(stderr, "%s\n", message);
        exit(1);
    }
    d = mj_makeData(m);
}

void eval(const double *y, double t, const double *p, double *qdd) {
    (void)p;
    const int n = m->nv;
    d->time = t;
    for (int i = 0; i < n; ++i) {
        const int relative = ABSOLUTE && i > 0;
        d->qpos[i] = y[i] - (relative ? y[i - 1] : 0);
        d->qvel[i] = y[n + i] - (relative ? y[n + i - 1] : 0);
    }
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_makeM(m, d);
    mj_factorM(m, d);
    mj_comVel(m, d);
    mj_passive(m, d);
    mj_rne(m, d, 0, d->qfrc_bias);
    mj_fwdAcceleration(m, d);
    double sum = 0;
    for (int i = 0; i < n; ++i) qdd[i] = sum = d->qacc_smooth[i] + (ABSOLUTE ? sum : 0);
}
