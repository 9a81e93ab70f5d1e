// @generated from machines/andrews_squeezer.machine by `cargo xtask generate`; edits are lost.

//! Andrews' squeezing mechanism: seven bodies in three loops, driven by a constant torque, on
//! a spring.
//! G. C. Andrews and M. K. Ormrod, Advent: a simulation program for constrained planar
//! kinematic and
//! dynamic systems, 1986; W. Schiehlen (ed.), Multibody systems handbook, 1990; letters,
//! numbers and
//! the signs of the multipliers as in the Test set for initial value problem solvers.
//!
//! 7 coordinates, 42 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 56 | 21 | 4 | 0 | 0 | 81 |
//! | `mass_matrix` | 20 | 20 | 0 | 3 | 0 | 46 |
//! | `bias` | 33 | 14 | 0 | 3 | 0 | 53 |
//! | `applied` | 15 | 12 | 1 | 1 | 1 | 31 |
//! | `forces` | 56 | 32 | 1 | 4 | 1 | 98 |
//! | `constraint_positions` | 14 | 21 | 0 | 7 | 0 | 49 |
//! | `constraint_rates` | 21 | 18 | 0 | 7 | 0 | 53 |
//! | `constraint_matrix` | 14 | 11 | 0 | 7 | 0 | 39 |
//! | `constraint_bias` | 28 | 20 | 0 | 7 | 0 | 62 |
//! | `accelerations` | 252 | 195 | 10 | 7 | 1 | 472 |
//! | `multipliers` | 239 | 185 | 10 | 7 | 1 | 449 |
//! | `projection` | 245 | 225 | 10 | 10 | 0 | 500 |
//! | `kinetic_energy` | 51 | 22 | 0 | 4 | 0 | 81 |
//! | `potential_energy` | 8 | 8 | 0 | 1 | 1 | 19 |
//! | `work_rate` | 1 | 0 | 0 | 0 | 0 | 1 |
//!
//! Sine and cosine of one angle count once; subtractions and changes of sign are additions. A
//! function that is not here gives zeros.

// A program uses some of it.
#![allow(dead_code, unreachable_pub)]
// Names and numbers are those of the description.
#![allow(non_snake_case, non_camel_case_types)]
#![allow(clippy::approx_constant, clippy::upper_case_acronyms)]
// Formulas are written as derived.
#![allow(clippy::let_and_return, clippy::too_many_arguments)]
#![allow(clippy::just_underscores_and_digits, clippy::excessive_precision)]
#![allow(clippy::pedantic, clippy::nursery)]
// What the description says is no Markdown.
#![allow(rustdoc::all)]

/// Andrews' squeezing mechanism: seven bodies in three loops, driven by a constant torque, on
/// a spring.
/// G. C. Andrews and M. K. Ormrod, Advent: a simulation program for constrained planar
/// kinematic and
/// dynamic systems, 1986; W. Schiehlen (ed.), Multibody systems handbook, 1990; letters,
/// numbers and
/// the signs of the multipliers as in the Test set for initial value problem solvers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AndrewsSqueezer<S = f64> {
    /// `m1`. Unit: `kg`. Default: 0.04325.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 0.00365.
    pub m2: S,
    /// `m3`. Unit: `kg`. Default: 0.02373.
    pub m3: S,
    /// `m4`. Unit: `kg`. Default: 0.00706.
    pub m4: S,
    /// `m5`. Unit: `kg`. Default: 0.0705.
    pub m5: S,
    /// `m6`. Unit: `kg`. Default: 0.00706.
    pub m6: S,
    /// `m7`. Unit: `kg`. Default: 0.05498.
    pub m7: S,
    /// `I1`. Unit: `kg*m^2`. Default: 0.000002194.
    pub I1: S,
    /// `I2`. Unit: `kg*m^2`. Default: 0.000000441.
    pub I2: S,
    /// `I3`. Unit: `kg*m^2`. Default: 0.000005255.
    pub I3: S,
    /// `I4`. Unit: `kg*m^2`. Default: 0.0000005667.
    pub I4: S,
    /// `I5`. Unit: `kg*m^2`. Default: 0.00001169.
    pub I5: S,
    /// `I6`. Unit: `kg*m^2`. Default: 0.0000005667.
    pub I6: S,
    /// `I7`. Unit: `kg*m^2`. Default: 0.00001912.
    pub I7: S,
    /// `xa`. Unit: `m`. Default: -0.06934.
    pub xa: S,
    /// `ya`. Unit: `m`. Default: -0.00227.
    pub ya: S,
    /// `xb`. Unit: `m`. Default: -0.03635.
    pub xb: S,
    /// `yb`. Unit: `m`. Default: 0.03273.
    pub yb: S,
    /// `xc`. Unit: `m`. Default: 0.014.
    pub xc: S,
    /// `yc`. Unit: `m`. Default: 0.072.
    pub yc: S,
    /// `d`. Unit: `m`. Default: 0.028.
    pub d: S,
    /// `da`. Unit: `m`. Default: 0.0115.
    pub da: S,
    /// `e`. Unit: `m`. Default: 0.02.
    pub e: S,
    /// `ea`. Unit: `m`. Default: 0.01421.
    pub ea: S,
    /// `zf`. Unit: `m`. Default: 0.02.
    pub zf: S,
    /// `fa`. Unit: `m`. Default: 0.01421.
    pub fa: S,
    /// `rr`. Unit: `m`. Default: 0.007.
    pub rr: S,
    /// `ra`. Unit: `m`. Default: 0.00092.
    pub ra: S,
    /// `ss`. Unit: `m`. Default: 0.035.
    pub ss: S,
    /// `sa`. Unit: `m`. Default: 0.01874.
    pub sa: S,
    /// `sb`. Unit: `m`. Default: 0.01043.
    pub sb: S,
    /// `sc`. Unit: `m`. Default: 0.018.
    pub sc: S,
    /// `sd`. Unit: `m`. Default: 0.02.
    pub sd: S,
    /// `zt`. Unit: `m`. Default: 0.04.
    pub zt: S,
    /// `ta`. Unit: `m`. Default: 0.02308.
    pub ta: S,
    /// `tb`. Unit: `m`. Default: 0.00916.
    pub tb: S,
    /// `u`. Unit: `m`. Default: 0.04.
    pub u: S,
    /// `ua`. Unit: `m`. Default: 0.01228.
    pub ua: S,
    /// `ub`. Unit: `m`. Default: 0.00449.
    pub ub: S,
    /// Stiffness and free length of the spring. Unit: `N/m`. Default: 4530.
    pub c0: S,
    /// `l0`. Unit: `m`. Default: 0.07785.
    pub l0: S,
    /// Torque on the crank. Unit: `N*m`. Default: 0.033.
    pub mom: S,
}

impl<S: ::lagrangian::emitted::Scalar> AndrewsSqueezer<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let e_minus_ea = self.e - self.ea;
        let zf_minus_fa = self.zf - self.fa;
        let m1_ra2 = self.ra * (self.ra * self.m1);
        let m2_da = self.m2 * self.da;
        let m2_da2 = self.da * m2_da;
        let I2_plus_m2_da2 = self.I2 + m2_da2;
        let k10 = self.m4 * e_minus_ea;
        let k0 = e_minus_ea * k10;
        let k1 = self.I4 + k0;
        let k12 = self.m6 * zf_minus_fa;
        let k2 = zf_minus_fa * k12;
        let k3 = self.I6 + k2;
        let m3_sa = self.m3 * self.sa;
        let m3_sb = self.m3 * self.sb;
        let t0 = self.I1 + m1_ra2;
        let t1 = self.ta * self.ta;
        let t2 = self.tb * self.tb;
        let t3 = self.ub * self.ub;
        let t4 = self.ua * self.ua;
        let m2_rr = self.m2 * self.rr;
        let k9 = self.zt * k10;
        let m4_zt = self.m4 * self.zt;
        let m5_ta2_plus_m5_tb2 = self.m5 * t2 + self.m5 * t1;
        let k11 = self.u * k12;
        let m6_u = self.m6 * self.u;
        let m7_ub2_plus_m7_ua2 = self.m7 * t4 + self.m7 * t3;
        let m2_da_rr = self.rr * m2_da;
        let k13 = self.I3 + (self.sa * m3_sa + self.sb * m3_sb);
        let k27 = S::ONE / k3;
        let k29 = k11 * k27;
        let k28 = S::ONE / k1;
        let k30 = k9 * k28;
        let k32 = S::ONE / I2_plus_m2_da2;
        let k31 = m2_da_rr * k32;
        let k33 = S::ONE / k13;
        let k23 = self.c0 * k33;
        let half_c0 = S::from_f64(0.5) * self.c0;
        let sc_c0 = self.sc * self.c0;
        let sd_c0 = self.sd * self.c0;
        let da2 = self.da * self.da;
        let k4 = e_minus_ea * e_minus_ea;
        let k5 = zf_minus_fa * zf_minus_fa;
        let k6 = S::from_f64(0.5) * t0;
        let k7 = S::from_f64(0.5) * (self.I5 + self.m5 * (t1 + t2));
        let k8 = S::from_f64(0.5) * (self.I7 + self.m7 * (t3 + t4));
        let minus_d = -self.d;
        let minus_zf = -self.zf;
        let k14 = k11 * k29;
        let k15 = m7_ub2_plus_m7_ua2 + (self.I7 + self.u * m6_u);
        let k16 = k12 * k27;
        let k17 = k9 * k30;
        let k18 = m5_ta2_plus_m5_tb2 + (self.I5 + self.zt * m4_zt);
        let k19 = k10 * k28;
        let k20 = m2_da * k31;
        let k21 = m2_da_rr * k31;
        let k22 = t0 + self.rr * m2_rr;
        let k24 = m2_da * k32;
        let k25 = self.zt * k9;
        let k26 = self.u * k11;
        let k34 = self.ss * k23;
        let k35 = self.e * k10;
        let k36 = self.zf * k12;
        let pivots = [
            (5, k3, k3),
            (3, k1, k1),
            (1, I2_plus_m2_da2, I2_plus_m2_da2),
            (2, k13, k13),
        ];
        Prepared {
            m2: self.m2,
            m3: self.m3,
            m4: self.m4,
            m6: self.m6,
            I1: self.I1,
            I2: self.I2,
            I3: self.I3,
            I4: self.I4,
            I5: self.I5,
            I6: self.I6,
            I7: self.I7,
            xa: self.xa,
            ya: self.ya,
            xb: self.xb,
            yb: self.yb,
            xc: self.xc,
            yc: self.yc,
            d: self.d,
            da: self.da,
            e: self.e,
            zf: self.zf,
            rr: self.rr,
            ss: self.ss,
            sa: self.sa,
            sb: self.sb,
            sc: self.sc,
            sd: self.sd,
            zt: self.zt,
            u: self.u,
            l0: self.l0,
            mom: self.mom,
            e_minus_ea,
            zf_minus_fa,
            m1_ra2,
            half_c0,
            m2_da2,
            I2_plus_m2_da2,
            k0,
            k1,
            k2,
            k3,
            m3_sa,
            m3_sb,
            sc_c0,
            sd_c0,
            da2,
            k4,
            k5,
            k6,
            k7,
            k8,
            m2_da,
            m2_rr,
            k9,
            k10,
            m4_zt,
            m5_ta2_plus_m5_tb2,
            k11,
            k12,
            m6_u,
            m7_ub2_plus_m7_ua2,
            m2_da_rr,
            k13,
            minus_d,
            minus_zf,
            k14,
            k15,
            k16,
            k17,
            k18,
            k19,
            k20,
            k21,
            k22,
            k23,
            k24,
            k25,
            k26,
            k27,
            k28,
            k29,
            k30,
            k31,
            k32,
            k33,
            k34,
            k35,
            k36,
            k37: k33,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let beta = S::from_f64(-0.06171389001427645) + S::from_f64(-1.1434870511134074e-18);
        let zero = S::ZERO;
        let gamma = S::from_f64(0.45527981916307037) + S::from_f64(1.522689981395877e-17);
        let Phi = S::from_f64(0.22266839016588588) + S::from_f64(2.4930154103630337e-18);
        let delta = S::from_f64(0.48736497954384256) + S::from_f64(-7.815122678924794e-18);
        let Omega = S::from_f64(-0.22266839016588588) + S::from_f64(-2.4930154103630337e-18);
        let epsilon = S::from_f64(1.2305474445498212) + S::from_f64(-4.1863820199071897e-17);
        let q = [beta, zero, gamma, Phi, delta, Omega, epsilon];
        let v = [S::ZERO; 7];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`AndrewsSqueezer`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `beta`. Unit: `rad`.
    pub beta: S,
    /// `Theta`. Unit: `rad`.
    pub Theta: S,
    /// `gamma`. Unit: `rad`.
    pub gamma: S,
    /// `Phi`. Unit: `rad`.
    pub Phi: S,
    /// `delta`. Unit: `rad`.
    pub delta: S,
    /// `Omega`. Unit: `rad`.
    pub Omega: S,
    /// `epsilon`. Unit: `rad`.
    pub epsilon: S,
}

/// The parameters of a [`AndrewsSqueezer`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m2`
    m2: S,
    /// `m3`
    m3: S,
    /// `m4`
    m4: S,
    /// `m6`
    m6: S,
    /// `I1`
    I1: S,
    /// `I2`
    I2: S,
    /// `I3`
    I3: S,
    /// `I4`
    I4: S,
    /// `I5`
    I5: S,
    /// `I6`
    I6: S,
    /// `I7`
    I7: S,
    /// `xa`
    xa: S,
    /// `ya`
    ya: S,
    /// `xb`
    xb: S,
    /// `yb`
    yb: S,
    /// `xc`
    xc: S,
    /// `yc`
    yc: S,
    /// `d`
    d: S,
    /// `da`
    da: S,
    /// `e`
    e: S,
    /// `zf`
    zf: S,
    /// `rr`
    rr: S,
    /// `ss`
    ss: S,
    /// `sa`
    sa: S,
    /// `sb`
    sb: S,
    /// `sc`
    sc: S,
    /// `sd`
    sd: S,
    /// `zt`
    zt: S,
    /// `u`
    u: S,
    /// `l0`
    l0: S,
    /// `mom`
    mom: S,
    /// `e - ea`
    e_minus_ea: S,
    /// `zf - fa`
    zf_minus_fa: S,
    /// `m1*ra^2`
    m1_ra2: S,
    /// `0.5*c0`
    half_c0: S,
    /// `m2*da^2`
    m2_da2: S,
    /// `I2 + m2*da^2`
    I2_plus_m2_da2: S,
    /// `m4*(e - ea)^2`
    k0: S,
    /// `I4 + m4*(e - ea)^2`
    k1: S,
    /// `m6*(zf - fa)^2`
    k2: S,
    /// `I6 + m6*(zf - fa)^2`
    k3: S,
    /// `m3*sa`
    m3_sa: S,
    /// `m3*sb`
    m3_sb: S,
    /// `sc*c0`
    sc_c0: S,
    /// `sd*c0`
    sd_c0: S,
    /// `da^2`
    da2: S,
    /// `(e - ea)^2`
    k4: S,
    /// `(zf - fa)^2`
    k5: S,
    /// `0.5*(I1 + m1*ra^2)`
    k6: S,
    /// `0.5*(I5 + m5*(tb^2 + ta^2))`
    k7: S,
    /// `0.5*(I7 + m7*(ua^2 + ub^2))`
    k8: S,
    /// `m2*da`
    m2_da: S,
    /// `m2*rr`
    m2_rr: S,
    /// `m4*zt*(e - ea)`
    k9: S,
    /// `m4*(e - ea)`
    k10: S,
    /// `m4*zt`
    m4_zt: S,
    /// `m5*ta^2 + m5*tb^2`
    m5_ta2_plus_m5_tb2: S,
    /// `m6*u*(zf - fa)`
    k11: S,
    /// `m6*(zf - fa)`
    k12: S,
    /// `m6*u`
    m6_u: S,
    /// `m7*ub^2 + m7*ua^2`
    m7_ub2_plus_m7_ua2: S,
    /// `m2*da*rr`
    m2_da_rr: S,
    /// `I3 + m3*sb^2 + m3*sa^2`
    k13: S,
    /// `-d`
    minus_d: S,
    /// `-zf`
    minus_zf: S,
    /// `m6^2*u^2*(zf - fa)^2/(I6 + m6*(zf - fa)^2)`
    k14: S,
    /// `I7 + m7*ub^2 + m7*ua^2 + m6*u^2`
    k15: S,
    /// `m6*(zf - fa)/(I6 + m6*(zf - fa)^2)`
    k16: S,
    /// `m4^2*zt^2*(e - ea)^2/(I4 + m4*(e - ea)^2)`
    k17: S,
    /// `I5 + m5*ta^2 + m5*tb^2 + m4*zt^2`
    k18: S,
    /// `m4*(e - ea)/(I4 + m4*(e - ea)^2)`
    k19: S,
    /// `m2^2*da^2*rr/(I2 + m2*da^2)`
    k20: S,
    /// `m2^2*da^2*rr^2/(I2 + m2*da^2)`
    k21: S,
    /// `I1 + m1*ra^2 + m2*rr^2`
    k22: S,
    /// `c0/(I3 + m3*sb^2 + m3*sa^2)`
    k23: S,
    /// `m2*da/(I2 + m2*da^2)`
    k24: S,
    /// `m4*zt^2*(e - ea)`
    k25: S,
    /// `m6*u^2*(zf - fa)`
    k26: S,
    /// `1/(I6 + m6*(zf - fa)^2)`
    k27: S,
    /// `1/(I4 + m4*(e - ea)^2)`
    k28: S,
    /// `m6*u*(zf - fa)/(I6 + m6*(zf - fa)^2)`
    k29: S,
    /// `m4*zt*(e - ea)/(I4 + m4*(e - ea)^2)`
    k30: S,
    /// `m2*da*rr/(I2 + m2*da^2)`
    k31: S,
    /// `1/(I2 + m2*da^2)`
    k32: S,
    /// `1/(I3 + m3*sb^2 + m3*sa^2)`
    k33: S,
    /// `ss*c0/(I3 + m3*sb^2 + m3*sa^2)`
    k34: S,
    /// `m4*e*(e - ea)`
    k35: S,
    /// `m6*zf*(zf - fa)`
    k36: S,
    /// `1/(I3 + m3*sb^2 + m3*sa^2)`
    k37: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(7, 13);

/// Mass matrix `M`.
///
/// ```text
/// M[beta, beta] = m1*ra^2 - 2*m2*da*rr*cos(Theta) + m2*da^2 + m2*rr^2 + I1 + I2
/// M[Theta, beta] = m2*da^2 - m2*da*rr*cos(Theta) + I2
/// M[Theta, Theta] = m2*da^2 + I2
/// M[gamma, gamma] = m3*sa^2 + m3*sb^2 + I3
/// M[Phi, Phi] = (ea - e)^2*m4 + I4
/// M[delta, Phi] = (e - ea)*m4*zt*sin(Phi) + (ea - e)^2*m4 + I4
/// M[delta, delta] = 2*(e - ea)*m4*zt*sin(Phi) + m4*e^2 - 2*m4*e*ea + m4*ea^2 + m4*zt^2 + m5*ta^2
///     + m5*tb^2 + I4 + I5
/// M[Omega, Omega] = (zf - fa)^2*m6 + I6
/// M[epsilon, Omega] = (zf - fa)^2*m6 - (zf - fa)*m6*u*sin(Omega) + I6
/// M[epsilon, epsilon] = m6*zf^2 - 2*(zf - fa)*m6*u*sin(Omega) - 2*m6*zf*fa + m6*fa^2 + m6*u^2
///     + m7*ua^2 + m7*ub^2 + I6 + I7
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7]) -> [[S; 7]; 7] {
    let Theta = q[1];
    let Phi = q[3];
    let Omega = q[5];
    let (sin_Theta, cos_Theta) = Theta.sin_cos();
    let (sin_Phi, cos_Phi) = Phi.sin_cos();
    let (sin_Omega, cos_Omega) = Omega.sin_cos();
    let t0 = p.rr - cos_Theta * p.da;
    let t1 = sin_Phi * p.e_minus_ea + p.zt;
    let t2 = p.u - sin_Omega * p.zf_minus_fa;
    let m21 = sin_Theta * (sin_Theta * p.m2_da2) + p.I2 - t0 * (cos_Theta * p.m2_da);
    let t3 = t1 * (sin_Phi * p.k10) + (cos_Phi * (cos_Phi * p.k0) + p.I4) + p.I5;
    let t4 = cos_Omega * (cos_Omega * p.k2) + p.I6 - t2 * (sin_Omega * p.k12) + p.I7;
    let m11 = t0 * p.m2_rr + p.m1_ra2 + (m21 + p.I1);
    let zero = S::ZERO;
    let m54 = p.k1 + sin_Phi * p.k9;
    let m55 = t1 * p.m4_zt + p.m5_ta2_plus_m5_tb2 + t3;
    let m76 = p.k3 - sin_Omega * p.k11;
    let m77 = t2 * p.m6_u + p.m7_ub2_plus_m7_ua2 + t4;
    [
        [m11, m21, zero, zero, zero, zero, zero],
        [m21, p.I2_plus_m2_da2, zero, zero, zero, zero, zero],
        [zero, zero, p.k13, zero, zero, zero, zero],
        [zero, zero, zero, p.k1, m54, zero, zero],
        [zero, zero, zero, m54, m55, zero, zero],
        [zero, zero, zero, zero, zero, p.k3, m76],
        [zero, zero, zero, zero, zero, m76, m77],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[beta] = 2*m2*da*rr*sin(Theta)*der(beta)*der(Theta) + m2*da*rr*sin(Theta)*der(Theta)^2
/// h[Theta] = -m2*da*rr*sin(Theta)*der(beta)^2
/// h[Phi] = -(e - ea)*m4*zt*cos(Phi)*der(delta)^2
/// h[delta] = (e - ea)*m4*zt*cos(Phi)*der(Phi)^2 + 2*(e - ea)*m4*zt*cos(Phi)*der(Phi)*der(delta)
/// h[Omega] = (zf - fa)*m6*u*cos(Omega)*der(epsilon)^2
/// h[epsilon] = -(zf - fa)*m6*u*cos(Omega)*der(Omega)^2
///     - 2*(zf - fa)*m6*u*cos(Omega)*der(Omega)*der(epsilon)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7], v: &[S; 7]) -> [S; 7] {
    let Theta = q[1];
    let Phi = q[3];
    let Omega = q[5];
    let beta_dot = v[0];
    let Theta_dot = v[1];
    let Phi_dot = v[3];
    let delta_dot = v[4];
    let Omega_dot = v[5];
    let epsilon_dot = v[6];
    let (sin_Theta, cos_Theta) = Theta.sin_cos();
    let (sin_Phi, cos_Phi) = Phi.sin_cos();
    let (sin_Omega, cos_Omega) = Omega.sin_cos();
    let t0 = delta_dot + Phi_dot;
    let t1 = epsilon_dot + Omega_dot;
    let t2 = Theta_dot + beta_dot;
    let t3 = t0 * t0;
    let t4 = t1 * t1;
    let t5 = t2 * t2;
    let t6 = t5 * cos_Theta;
    let t7 = t3 * cos_Phi;
    let t8 = t7 * (sin_Phi * p.k0);
    let t9 = sin_Phi * (t3 * p.e_minus_ea) + delta_dot * (delta_dot * p.zt);
    let t10 = t9 * (cos_Phi * p.k10);
    let t11 = t4 * cos_Omega;
    let t12 = epsilon_dot * (epsilon_dot * p.u) - sin_Omega * (t4 * p.zf_minus_fa);
    let t13 = (beta_dot * (beta_dot * p.rr) - t6 * p.da) * (sin_Theta * p.m2_da);
    let t14 = t13 + t6 * (sin_Theta * p.m2_da2);
    let h_Omega = t11 * (sin_Omega * p.k2) + t12 * (cos_Omega * p.k12);
    let h_beta = sin_Theta * (t5 * p.m2_da_rr) - t14;
    let h_Theta = -t14;
    let zero = S::ZERO;
    let h_Phi = t8 - t10;
    let h_delta = t7 * p.k9 - (t10 - t8);
    let h_epsilon = h_Omega - t11 * p.k11;
    [h_beta, h_Theta, zero, h_Phi, h_delta, h_Omega, h_epsilon]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[beta] = mom
/// Q[gamma] = …
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7]) -> [S; 7] {
    let gamma = q[2];
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let t0 = p.xc - (sin_gamma * p.sc + (cos_gamma * p.sd + p.xb));
    let t1 = p.yc - (sin_gamma * p.sd + p.yb - cos_gamma * p.sc);
    let t2 = (t1 * t1 + t0 * t0).sqrt();
    let t3 = S::ONE / t2 * (p.l0 - t2);
    let t4 = t3 * (cos_gamma * (t0 * p.sc_c0 + t1 * p.sd_c0));
    let zero = S::ZERO;
    let q_gamma = -(t3 * (sin_gamma * (t1 * p.sc_c0 - t0 * p.sd_c0)) + t4);
    [p.mom, zero, q_gamma, zero, zero, zero, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7], v: &[S; 7]) -> [S; 7] {
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let Omega = q[5];
    let beta_dot = v[0];
    let Theta_dot = v[1];
    let gamma_dot = v[2];
    let Phi_dot = v[3];
    let delta_dot = v[4];
    let Omega_dot = v[5];
    let epsilon_dot = v[6];
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_Theta, cos_Theta) = Theta.sin_cos();
    let (sin_Phi, cos_Phi) = Phi.sin_cos();
    let (sin_Omega, cos_Omega) = Omega.sin_cos();
    let t0 = gamma_dot * gamma_dot;
    let t1 = Theta_dot + beta_dot;
    let t2 = delta_dot + Phi_dot;
    let t3 = epsilon_dot + Omega_dot;
    let t4 = t1 * t1;
    let t5 = t2 * t2;
    let t6 = t3 * t3;
    let t7 = t4 * cos_Theta;
    let t8 = sin_Phi * t5;
    let t9 = sin_Omega * t6;
    let t10 = p.xc - (sin_gamma * p.sc + (cos_gamma * p.sd + p.xb));
    let t11 = p.yc - (sin_gamma * p.sd + p.yb - cos_gamma * p.sc);
    let t12 = t0 * (sin_gamma * p.sa + cos_gamma * p.sb);
    let t13 = t0 * (cos_gamma * p.sa - sin_gamma * p.sb);
    let t14 = p.k12 * (epsilon_dot * (epsilon_dot * p.u) - t9 * p.zf_minus_fa);
    let t15 = p.m2_da * (beta_dot * (beta_dot * p.rr) - t7 * p.da) + t7 * p.m2_da2;
    let f_Theta = sin_Theta * t15;
    let t16 = p.k10 * (t8 * p.e_minus_ea + delta_dot * (delta_dot * p.zt)) - t8 * p.k0;
    let f_Phi = cos_Phi * t16;
    let t17 = cos_Omega * (t9 * p.k2 + t14);
    let t18 = (t11 * t11 + t10 * t10).sqrt();
    let t19 = S::ONE / t18 * (p.l0 - t18);
    let t20 = t19 * (t10 * p.sc_c0 + t11 * p.sd_c0) + (t13 * p.m3_sb - p.m3_sa * t12);
    let t21 = t19 * (t11 * p.sc_c0 - t10 * p.sd_c0) + (p.m3_sa * t13 + p.m3_sb * t12);
    let f_beta = f_Theta + (p.mom - sin_Theta * (t4 * p.m2_da_rr));
    let f_gamma = -(sin_gamma * t21 + cos_gamma * t20);
    let f_delta = f_Phi - cos_Phi * (t5 * p.k9);
    let f_Omega = -t17;
    let f_epsilon = cos_Omega * (t6 * p.k11) - t17;
    [f_beta, f_Theta, f_gamma, f_Phi, f_delta, f_Omega, f_epsilon]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[x3] = d*cos(beta + Theta) - rr*cos(beta) + ss*sin(gamma) + xb
/// g[y3] = d*sin(beta + Theta) - rr*sin(beta) - ss*cos(gamma) + yb
/// g[x4] = d*cos(beta + Theta) - rr*cos(beta) + zt*cos(delta) + e*sin(Phi + delta) + xa
/// g[y4] = d*sin(beta + Theta) - rr*sin(beta) + zt*sin(delta) - e*cos(Phi + delta) + ya
/// g[x6] = d*cos(beta + Theta) - rr*cos(beta) + u*sin(epsilon) + zf*cos(Omega + epsilon) + xa
/// g[y6] = d*sin(beta + Theta) - rr*sin(beta) - u*cos(epsilon) + zf*sin(Omega + epsilon) + ya
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 7],
) -> [S; 6] {
    let beta = q[0];
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let delta = q[4];
    let Omega = q[5];
    let epsilon = q[6];
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = Theta + beta;
    let t1 = delta + Phi;
    let (sin_delta, cos_delta) = delta.sin_cos();
    let t2 = epsilon + Omega;
    let (sin_epsilon, cos_epsilon) = epsilon.sin_cos();
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let (sin_t1, cos_t1) = t1.sin_cos();
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t3 = p.rr * cos_beta - p.d * cos_t0;
    let t4 = p.rr * sin_beta - p.d * sin_t0;
    let g1 = p.ss * sin_gamma + p.xb - t3;
    let g2 = p.yb - p.ss * cos_gamma - t4;
    let g3 = p.e * sin_t1 + (p.xa + p.zt * cos_delta) - t3;
    let g4 = p.ya + p.zt * sin_delta - p.e * cos_t1 - t4;
    let g5 = p.zf * cos_t2 + (p.xa + p.u * sin_epsilon) - t3;
    let g6 = p.zf * sin_t2 + (p.ya - p.u * cos_epsilon) - t4;
    [g1, g2, g3, g4, g5, g6]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[x3] = rr*sin(beta)*der(beta) + ss*cos(gamma)*der(gamma)
///     - d*sin(beta + Theta)*(der(beta) + der(Theta))
/// phi[y3] = ss*sin(gamma)*der(gamma) - rr*cos(beta)*der(beta)
///     + d*cos(beta + Theta)*(der(beta) + der(Theta))
/// phi[x4] = rr*sin(beta)*der(beta) - zt*sin(delta)*der(delta)
///     - d*sin(beta + Theta)*(der(beta) + der(Theta)) + e*cos(Phi + delta)*(der(Phi) + der(delta))
/// phi[y4] = zt*cos(delta)*der(delta) - rr*cos(beta)*der(beta)
///     + d*cos(beta + Theta)*(der(beta) + der(Theta)) + e*sin(Phi + delta)*(der(Phi) + der(delta))
/// phi[x6] = rr*sin(beta)*der(beta) + u*cos(epsilon)*der(epsilon)
///     - d*sin(beta + Theta)*(der(beta) + der(Theta))
///     - zf*sin(Omega + epsilon)*(der(Omega) + der(epsilon))
/// phi[y6] = u*sin(epsilon)*der(epsilon) - rr*cos(beta)*der(beta)
///     + d*cos(beta + Theta)*(der(beta) + der(Theta))
///     + zf*cos(Omega + epsilon)*(der(Omega) + der(epsilon))
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 7],
    v: &[S; 7],
) -> [S; 6] {
    let beta = q[0];
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let delta = q[4];
    let Omega = q[5];
    let epsilon = q[6];
    let beta_dot = v[0];
    let Theta_dot = v[1];
    let gamma_dot = v[2];
    let Phi_dot = v[3];
    let delta_dot = v[4];
    let Omega_dot = v[5];
    let epsilon_dot = v[6];
    let t0 = Theta + beta;
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t1 = delta + Phi;
    let (sin_delta, cos_delta) = delta.sin_cos();
    let t2 = epsilon + Omega;
    let (sin_epsilon, cos_epsilon) = epsilon.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let (sin_t1, cos_t1) = t1.sin_cos();
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t3 = beta_dot * p.rr;
    let t4 = delta_dot * p.zt;
    let t5 = epsilon_dot * p.u;
    let t6 = gamma_dot * p.ss;
    let t7 = (Theta_dot + beta_dot) * p.d;
    let t8 = (delta_dot + Phi_dot) * p.e;
    let t9 = (epsilon_dot + Omega_dot) * p.zf;
    let t10 = t3 * sin_beta - t7 * sin_t0;
    let t11 = t3 * cos_beta - t7 * cos_t0;
    let phi1 = t10 + t6 * cos_gamma;
    let phi2 = t6 * sin_gamma - t11;
    let phi3 = t10 - (t4 * sin_delta - t8 * cos_t1);
    let phi4 = t8 * sin_t1 + t4 * cos_delta - t11;
    let phi5 = t10 + (t5 * cos_epsilon - t9 * sin_t2);
    let phi6 = t9 * cos_t2 + t5 * sin_epsilon - t11;
    [phi1, phi2, phi3, phi4, phi5, phi6]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[x3, beta] = rr*sin(beta) - d*sin(beta + Theta)
/// G[x3, Theta] = -d*sin(beta + Theta)
/// G[x3, gamma] = ss*cos(gamma)
/// G[y3, beta] = d*cos(beta + Theta) - rr*cos(beta)
/// G[y3, Theta] = d*cos(beta + Theta)
/// G[y3, gamma] = ss*sin(gamma)
/// G[x4, beta] = rr*sin(beta) - d*sin(beta + Theta)
/// G[x4, Theta] = -d*sin(beta + Theta)
/// G[x4, Phi] = e*cos(Phi + delta)
/// G[x4, delta] = e*cos(Phi + delta) - zt*sin(delta)
/// G[y4, beta] = d*cos(beta + Theta) - rr*cos(beta)
/// G[y4, Theta] = d*cos(beta + Theta)
/// G[y4, Phi] = e*sin(Phi + delta)
/// G[y4, delta] = zt*cos(delta) + e*sin(Phi + delta)
/// G[x6, beta] = rr*sin(beta) - d*sin(beta + Theta)
/// G[x6, Theta] = -d*sin(beta + Theta)
/// G[x6, Omega] = -zf*sin(Omega + epsilon)
/// G[x6, epsilon] = u*cos(epsilon) - zf*sin(Omega + epsilon)
/// G[y6, beta] = d*cos(beta + Theta) - rr*cos(beta)
/// G[y6, Theta] = d*cos(beta + Theta)
/// G[y6, Omega] = zf*cos(Omega + epsilon)
/// G[y6, epsilon] = u*sin(epsilon) + zf*cos(Omega + epsilon)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7]) -> [S; 42] {
    let beta = q[0];
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let delta = q[4];
    let Omega = q[5];
    let epsilon = q[6];
    let t0 = Theta + beta;
    let t1 = delta + Phi;
    let t2 = epsilon + Omega;
    let (sin_beta, cos_beta) = beta.sin_cos();
    let (sin_epsilon, cos_epsilon) = epsilon.sin_cos();
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let (sin_t1, cos_t1) = t1.sin_cos();
    let (sin_t2, cos_t2) = t2.sin_cos();
    let (sin_delta, cos_delta) = delta.sin_cos();
    let g2_2 = cos_t0 * p.d;
    let g3_4 = cos_t1 * p.e;
    let g4_4 = sin_t1 * p.e;
    let g6_6 = cos_t2 * p.zf;
    let t3 = sin_t0 * p.d;
    let g1_1 = sin_beta * p.rr - t3;
    let t4 = sin_t2 * p.zf;
    let g2_1 = g2_2 - cos_beta * p.rr;
    let g1_2 = -t3;
    let g1_3 = cos_gamma * p.ss;
    let zero = S::ZERO;
    let g2_3 = sin_gamma * p.ss;
    let g3_5 = g3_4 - sin_delta * p.zt;
    let g4_5 = g4_4 + cos_delta * p.zt;
    let g5_6 = -t4;
    let g5_7 = cos_epsilon * p.u - t4;
    let g6_7 = g6_6 + sin_epsilon * p.u;
    [
        g1_1, g1_2, g1_3, zero, zero, zero, zero, g2_1, g2_2, g2_3, zero, zero, zero, zero, g1_1,
        g1_2, zero, g3_4, g3_5, zero, zero, g2_1, g2_2, zero, g4_4, g4_5, zero, zero, g1_1, g1_2,
        zero, zero, zero, g5_6, g5_7, g2_1, g2_2, zero, zero, zero, g6_6, g6_7,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[x3] = ss*sin(gamma)*der(gamma)^2 - rr*cos(beta)*der(beta)^2
///     + d*cos(beta + Theta)*(der(beta) + der(Theta))^2
/// gamma[y3] = d*sin(beta + Theta)*(der(beta) + der(Theta))^2 - rr*sin(beta)*der(beta)^2
///     - ss*cos(gamma)*der(gamma)^2
/// gamma[x4] = zt*cos(delta)*der(delta)^2 - rr*cos(beta)*der(beta)^2
///     + d*cos(beta + Theta)*(der(beta) + der(Theta))^2
///     + e*sin(Phi + delta)*(der(Phi) + der(delta))^2
/// gamma[y4] = zt*sin(delta)*der(delta)^2 - rr*sin(beta)*der(beta)^2
///     + d*sin(beta + Theta)*(der(beta) + der(Theta))^2
///     - e*cos(Phi + delta)*(der(Phi) + der(delta))^2
/// gamma[x6] = u*sin(epsilon)*der(epsilon)^2 - rr*cos(beta)*der(beta)^2
///     + d*cos(beta + Theta)*(der(beta) + der(Theta))^2
///     + zf*cos(Omega + epsilon)*(der(Omega) + der(epsilon))^2
/// gamma[y6] = d*sin(beta + Theta)*(der(beta) + der(Theta))^2 - rr*sin(beta)*der(beta)^2
///     - u*cos(epsilon)*der(epsilon)^2 + zf*sin(Omega + epsilon)*(der(Omega) + der(epsilon))^2
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 7],
    v: &[S; 7],
) -> [S; 6] {
    let beta = q[0];
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let delta = q[4];
    let Omega = q[5];
    let epsilon = q[6];
    let beta_dot = v[0];
    let Theta_dot = v[1];
    let gamma_dot = v[2];
    let Phi_dot = v[3];
    let delta_dot = v[4];
    let Omega_dot = v[5];
    let epsilon_dot = v[6];
    let t0 = Theta + beta;
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t1 = epsilon + Omega;
    let (sin_epsilon, cos_epsilon) = epsilon.sin_cos();
    let t2 = delta + Phi;
    let (sin_delta, cos_delta) = delta.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let (sin_t1, cos_t1) = t1.sin_cos();
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t3 = Theta_dot + beta_dot;
    let t4 = epsilon_dot + Omega_dot;
    let t5 = delta_dot + Phi_dot;
    let t6 = beta_dot * (beta_dot * p.rr);
    let t7 = epsilon_dot * (epsilon_dot * p.u);
    let t8 = delta_dot * (delta_dot * p.zt);
    let t9 = gamma_dot * (gamma_dot * p.ss);
    let t10 = t3 * (t3 * p.d);
    let t11 = t4 * (t4 * p.zf);
    let t12 = t5 * (t5 * p.e);
    let t13 = t6 * sin_beta - t10 * sin_t0;
    let t14 = t6 * cos_beta - t10 * cos_t0;
    let gamma1 = t9 * sin_gamma - t14;
    let gamma2 = -(t13 + t9 * cos_gamma);
    let gamma3 = t12 * sin_t2 + t8 * cos_delta - t14;
    let gamma4 = t8 * sin_delta - t12 * cos_t2 - t13;
    let gamma5 = t11 * cos_t1 + t7 * sin_epsilon - t14;
    let gamma6 = -(t13 + (t7 * cos_epsilon - t11 * sin_t1));
    [gamma1, gamma2, gamma3, gamma4, gamma5, gamma6]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along
    /// the machine, factored.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
    ///
    /// So far these are the accelerations `a0` without constraint forces. The multipliers follow
    /// from `C lambda = gamma - G a0`, where now `G` are the rows of the constraints and `C = G
    /// M^-1 G^T`, row after row: `d`, `l` and `z` of constraints are those of `C = L D L^T`.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 7], v: &'a [S; 7] })
        -> Result<[S; 7], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 7], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let beta = n(q[0]);
    let Theta = n(q[1]);
    let gamma = n(q[2]);
    let Phi = n(q[3]);
    let delta = n(q[4]);
    let Omega = n(q[5]);
    let epsilon = n(q[6]);
    let beta_dot = n(v[0]);
    let Theta_dot = n(v[1]);
    let gamma_dot = n(v[2]);
    let Phi_dot = n(v[3]);
    let delta_dot = n(v[4]);
    let Omega_dot = n(v[5]);
    let epsilon_dot = n(v[6]);
    let t0 = Theta + beta;
    let t1 = delta + Phi;
    let t2 = epsilon + Omega;
    let angles = [beta, gamma, delta, t0, epsilon, t1, t2];
    let circular = N::sin_cos_all(angles);
    let (sin_beta, cos_beta) = circular[0];
    let (sin_gamma, cos_gamma) = circular[1];
    let (sin_delta, cos_delta) = circular[2];
    let (sin_t0, cos_t0) = circular[3];
    let (sin_epsilon, cos_epsilon) = circular[4];
    let (sin_t1, cos_t1) = circular[5];
    let (sin_t2, cos_t2) = circular[6];
    let t3 = beta_dot + Theta_dot;
    let t4 = beta_dot * beta_dot;
    let t5 = delta_dot + Phi_dot;
    let t6 = epsilon_dot + Omega_dot;
    let t7 = delta_dot * delta_dot;
    let t8 = t3 * t3;
    let t9 = epsilon_dot * epsilon_dot;
    let t10 = t5 * t5;
    let t11 = gamma_dot * gamma_dot;
    let t12 = t6 * t6;
    let t13 = t8 * n(p.da);
    let t14 = t10 * n(p.e_minus_ea);
    let t15 = t12 * n(p.zf_minus_fa);
    let t16 = cos_beta * n(p.rr);
    let t17 = sin_beta * n(p.rr);
    let t18 = cos_gamma * n(p.ss);
    let t19 = sin_delta * n(p.zt);
    let t20 = sin_gamma * n(p.ss);
    let t21 = cos_delta * n(p.zt);
    let t22 = sin_t0 * n(p.d);
    let t23 = cos_t0 * n(p.d);
    let t24 = t18 * n(p.k33);
    let t25 = cos_t1 * n(p.e);
    let t26 = n(p.k33) * t20;
    let t27 = sin_t1 * n(p.e);
    // Eliminates Theta: coupling l[Theta].
    let t28 = sin_t0.mul_add(sin_beta, cos_t0 * cos_beta);
    let t29 = t17 - t22;
    let t30 = t16 - t23;
    // Eliminates Phi: coupling l[Phi].
    let t31 = sin_t1.mul_sub(cos_delta, cos_t1 * sin_delta);
    let t32 = t19 - t25;
    let t33 = t28 * n(p.k31);
    let t34 = n(p.k30) * t31;
    // Eliminates beta: inertia d[beta].
    let t35 = t28.neg_mul_add(t28 * n(p.k21), n(p.k22));
    let t36 = cos_gamma.mul_add(n(p.sd), n(p.xb));
    // Eliminates delta: inertia d[delta].
    let t37 = t31.neg_mul_add(t31 * n(p.k17), n(p.k18));
    let t38 = t27 + t21;
    let t39 = N::ONE / t35;
    let t40 = sin_gamma.mul_add(n(p.sd), n(p.yb));
    let t41 = n(p.xc) - sin_gamma.mul_add(n(p.sc), t36);
    let t42 = t4 * t16;
    let t43 = N::ONE / t37;
    // Eliminates Omega: coupling l[Omega].
    let t44 = sin_t2.mul_sub(cos_epsilon, cos_t2 * sin_epsilon);
    let t45 = n(p.yc) - cos_gamma.neg_mul_add(n(p.sc), t40);
    let t46 = cos_epsilon * n(p.u);
    let t47 = sin_t2 * n(p.zf);
    let t48 = t4 * t17;
    let t49 = cos_t0.neg_mul_add(t13, t42);
    let t50 = n(p.k29) * t44;
    let t51 = sin_epsilon * n(p.u);
    let t52 = t46 - t47;
    let t53 = sin_t0.neg_mul_add(t13, t48);
    let t54 = t21 * t7;
    // Eliminates epsilon: inertia d[epsilon].
    let t55 = t44.neg_mul_add(t44 * n(p.k14), n(p.k15));
    let t56 = t46 * t9;
    let t57 = t39 * t33.neg_mul_add(t22, t22 + t29);
    let t58 = t39 * t23.neg_mul_add(t33, t23 + t30);
    let t59 = t45.mul_add(t45, t41 * t41).sqrt();
    let t60 = t43 * t25.mul_add(t34, t25 + t32);
    let t61 = t43 * t34.neg_mul_add(t27, t38 - t27);
    let t62 = N::ONE / t55;
    let t63 = t57 + t33.neg_mul_add(t57, t22 * n(p.k32));
    let t64 = t58 + t33.neg_mul_add(t58, t23 * n(p.k32));
    let t65 = t60 + t34.mul_add(t60, t25 * n(p.k28));
    let t66 = cos_beta.mul_sub(t53, sin_beta * t49);
    let t67 = t22.mul_add(t63, t29 * t57);
    let t68 = t23.mul_add(t63, t30 * t57);
    let t69 = t23.mul_add(t64, t30 * t58);
    let t70 = t22.mul_add(t64, t58 * t29);
    let t71 = t61 - t34.neg_mul_add(t61, n(p.k28) * t27);
    let t72 = cos_t0.mul_sub(t53, sin_t0 * t49);
    // Row x3: pivot d[x3].
    let t73 = t18.mul_add(t24, t67);
    let t74 = t24.neg_mul_add(t20, t68);
    let t75 = t20.mul_add(t26, t69);
    let t76 = t67 + t25.mul_add(t65, t32 * t60);
    let t77 = N::ONE / t73;
    let t78 = t19 * t7;
    let t79 = t51 * t9;
    let t80 = t69 + t27.neg_mul_add(t71, t38 * t61);
    let t81 = t62 * t47.neg_mul_add(t50, t47 + t52);
    let t82 = cos_t2 * n(p.zf);
    let t83 = t66.mul_add(n(p.m2_rr), n(p.mom));
    let t84 = t82 + t51;
    let t85 = t39 * t72.neg_mul_add(t28 * n(p.k20), t83);
    // Eliminates x3 from row y3: l[y3, x3].
    let t86 = t77 * t74;
    // Eliminates x3 from row x4: l[x4, x3]; Eliminates x3 from row x6: l[x6, x3].
    let t87 = t67 * t77;
    // Eliminates x3 from row y4: l[y4, x3]; Eliminates x3 from row y6: l[y6, x3].
    let t88 = t77 * t68;
    let t89 = cos_t1 * sin_t1.mul_add(t14, t54);
    let t90 = sin_t1.mul_add(cos_t1.neg_mul_add(t14, t78), t89);
    let t91 = cos_t2 * sin_t2.neg_mul_add(t15, t56);
    let t92 = sin_t2.mul_add(cos_t2.mul_add(t15, t79), t91);
    // Row y3: pivot d[y3].
    let t93 = t74.neg_mul_add(t86, t75);
    let t94 = t74.neg_mul_add(t87, t70);
    let t95 = t74.neg_mul_add(t88, t69);
    let t96 = N::ONE / t93;
    let t97 = t81 + t50.neg_mul_add(t81, t47 * n(p.k27));
    let t98 = cos_gamma * n(p.sc).mul_add(t41, n(p.sd) * t45);
    let t99 = n(p.sc).mul_sub(t45, n(p.sd) * t41);
    let t100 = t10 * sin_t1.mul_add(sin_delta, cos_t1 * cos_delta);
    let t101 = t12 * cos_t2.mul_add(cos_epsilon, sin_t2 * sin_epsilon);
    let t102 = n(p.k24).mul_add(t85.neg_mul_add(t28 * n(p.rr), t72), t85);
    let t103 = t8.neg_mul_add(t23, t42);
    let t104 = t8.neg_mul_add(t22, t48);
    let t105 = t43 * t90.mul_add(t31 * n(p.k19), t100);
    let t106 = t62 * t92.neg_mul_add(t44 * n(p.k16), t101);
    let t107 = t67 + t47.mul_add(t97, t52 * t81);
    let t108 = t22.mul_add(t102, t85 * t29);
    let t109 = sin_gamma.mul_add(t99, t98) * (n(p.l0) - t59);
    let t110 = N::ONE / t59 * t109;
    // Eliminates y3 from row x4: l[x4, y3]; Eliminates y3 from row x6: l[x6, y3].
    let t111 = t96 * t94;
    // Eliminates y3 from row y4: l[y4, y3]; Eliminates y3 from row y6: l[y6, y3].
    let t112 = t96 * t95;
    let t113 = t23.mul_add(t102, t85 * t30);
    let t114 = t94.mul_add(t111, t67 * t87);
    let t115 = t112.mul_add(t94, t67 * t88);
    let t116 = t95.mul_add(t112, t68 * t88);
    // Row x4: pivot d[x4].
    let t117 = t76 - t114;
    let t118 = t68 + t65.neg_mul_add(t27, t60 * t38) - t115;
    let t119 = t67 - t114;
    let t120 = t62 * t50.mul_add(t82, t84 - t82);
    let t121 = N::ONE / t117;
    let t122 = t110 * n(p.k34);
    let t123 = t105.mul_add(t31 * n(p.k25), t90);
    let t124 = n(p.k28).mul_add(t123, n(p.zt) * t105);
    let t125 = t105 * n(p.k9);
    let t126 = t106.neg_mul_add(t44 * n(p.k26), t92);
    let t127 = n(p.k27).mul_add(t126, n(p.u) * t106);
    let t128 = t106 * n(p.k11);
    let t129 = t68 - t115;
    let t130 = t108 + t20.neg_mul_add(t11, t103);
    let t131 = cos_gamma.neg_mul_add(t122, t130);
    let t132 = n(p.k35) * t124;
    let t133 = n(p.k36) * t127;
    let t134 = t120 - t50.mul_add(t120, n(p.k27) * t82);
    // Eliminates x4 from row y4: l[y4, x4].
    let t135 = t121 * t118;
    // Eliminates x4 from row x6: l[x6, x4].
    let t136 = t121 * t119;
    // Eliminates x4 from row y6: l[y6, x4].
    let t137 = t121 * t129;
    let t138 = sin_gamma.neg_mul_add(t122, t18.mul_add(t11, t104) - t113);
    // Row y3: right-hand side z[y3].
    let t139 = t86.mul_add(t131, t138);
    let t140 = t32.mul_add(t125, t103 - t27.mul_add(t10, t54));
    // Row y4: pivot d[y4].
    let t141 = t118.neg_mul_add(t135, t80 - t116);
    let t142 = t95.neg_mul_add(t111, t68.neg_mul_add(t87, t70));
    let t143 = t118.neg_mul_add(t136, t142);
    let t144 = t38.neg_mul_add(t125, t104 - t25.neg_mul_add(t10, t78));
    let t145 = t52.mul_add(t128, t103 - t82.mul_add(t12, t79));
    let t146 = t84.mul_add(t128, t104 + t47.neg_mul_add(t12, t56));
    let t147 = t118.neg_mul_add(t137, t69 - t116);
    let t148 = N::ONE / t141;
    let t149 = t111.neg_mul_add(t139, t87 * t131);
    let t150 = t112.neg_mul_add(t139, t88 * t131);
    let t151 = t69 + t82.neg_mul_add(t134, t84 * t120);
    let t152 = t68 + t97.mul_sub(t82, t81 * t84) - t115;
    // Row x4: right-hand side z[x4].
    let t153 = t108 + cos_t1.mul_add(t132, t140) - t149;
    let t154 = t150 + (sin_t1.mul_add(t132, t144) - t113);
    // Row y4: right-hand side z[y4].
    let t155 = t135.mul_add(t153, t154);
    let t156 = t108 + sin_t2.mul_add(t133, t145) - t149;
    let t157 = t150 + (cos_t2.neg_mul_add(t133, t146) - t113);
    // Eliminates y4 from row x6: l[x6, y4].
    let t158 = t148 * t143;
    // Eliminates y4 from row y6: l[y6, y4].
    let t159 = t148 * t147;
    let t160 = t119.neg_mul_add(t136, t107 - t114);
    // Row x6: pivot d[x6].
    let t161 = t143.neg_mul_add(t158, t160);
    let t162 = t143.neg_mul_add(t159, t119.neg_mul_add(t137, t152));
    // Row x6: right-hand side z[x6].
    let t163 = t158.mul_add(t155, t136.neg_mul_add(t153, t156));
    let t164 = t129.neg_mul_add(t137, t151 - t116);
    let t165 = N::ONE / t161;
    // Eliminates x6 from row y6: l[y6, x6].
    let t166 = t165 * t162;
    let t167 = t159.neg_mul_add(t155, t137.mul_add(t153, t157));
    // Row y6: pivot d[y6].
    let t168 = t162.neg_mul_add(t166, t147.neg_mul_add(t159, t164));
    // Row y6: right-hand side z[y6].
    let t169 = t166.mul_add(t163, t167) / t168;
    // Back substitution: lambda[x6].
    let t170 = t166.mul_add(t169, t165 * t163);
    // Back substitution: lambda[y4].
    let t171 = t158.mul_add(t170, t159.neg_mul_add(t169, t148 * t155));
    let t172 = t169 + t171;
    let t173 = t136.neg_mul_add(t170, t137.mul_add(t169, t121 * t153));
    // Back substitution: lambda[x4].
    let t174 = t135.mul_add(t171, t173);
    let t175 = t170 + t174;
    // Back substitution: lambda[y3].
    let t176 = t111.mul_add(t175, t112.neg_mul_add(t172, t96 * t139));
    let t177 = t87.neg_mul_add(t175, t88.mul_add(t172, t77 * t131));
    // Back substitution: lambda[x3].
    let t178 = t86.mul_add(t176, t177);
    let t179 = t172 + t176;
    let t180 = t175 + t178;
    let beta_ddot = t57.neg_mul_add(t180, t58.mul_add(t179, t85));
    let Theta_ddot = t63.mul_sub(t180, t64.mul_add(t179, t102));
    let gamma_ddot = -t24.mul_add(t178, t26.mul_add(t176, t110 * n(p.k23)));
    let Phi_ddot = t65.neg_mul_add(t174, t71.mul_add(t171, t124 * n(p.k10)));
    let delta_ddot = t60.mul_sub(t174, t61.mul_add(t171, t125));
    let Omega_ddot = t97.mul_add(t170, t134.mul_sub(t169, t127 * n(p.k12)));
    let epsilon_ddot = -t81.mul_add(t170, t120.mul_sub(t169, t128));
    let sound = PIVOTS.hold(t55, t55)
        & PIVOTS.hold(t37, t37)
        & PIVOTS.hold(t35, t35)
        & PIVOTS.hold(t73, t73)
        & PIVOTS.hold(t93, t75)
        & PIVOTS.hold(t117, t76)
        & PIVOTS.hold(t141, t80)
        & PIVOTS.hold(t161, t107)
        & PIVOTS.hold(t168, t151)
        & gamma_ddot.is_finite();
    if !sound {
        let pivots = [
            (6, t55, t55),
            (4, t37, t37),
            (0, t35, t35),
            (7, t73, t73),
            (8, t93, t75),
            (9, t117, t76),
            (10, t141, t80),
            (11, t161, t107),
            (12, t168, t151),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        beta_ddot.store(),
        Theta_ddot.store(),
        gamma_ddot.store(),
        Phi_ddot.store(),
        delta_ddot.store(),
        Omega_ddot.store(),
        epsilon_ddot.store(),
    ];
    Ok(accelerations)
}

::lagrangian::emitted::fast_function! {
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
    ///
    /// So far these are the accelerations `a0` without constraint forces. The multipliers follow
    /// from `C lambda = gamma - G a0`, where now `G` are the rows of the constraints and `C = G
    /// M^-1 G^T`, row after row: `d`, `l` and `z` of constraints are those of `C = L D L^T`.
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 7], v: &'a [S; 7] })
        -> Result<[S; 6], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 6], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let beta = n(q[0]);
    let Theta = n(q[1]);
    let gamma = n(q[2]);
    let Phi = n(q[3]);
    let delta = n(q[4]);
    let Omega = n(q[5]);
    let epsilon = n(q[6]);
    let beta_dot = n(v[0]);
    let Theta_dot = n(v[1]);
    let gamma_dot = n(v[2]);
    let Phi_dot = n(v[3]);
    let delta_dot = n(v[4]);
    let Omega_dot = n(v[5]);
    let epsilon_dot = n(v[6]);
    let t0 = Theta + beta;
    let t1 = delta + Phi;
    let t2 = epsilon + Omega;
    let angles = [beta, gamma, delta, t0, epsilon, t1, t2];
    let circular = N::sin_cos_all(angles);
    let (sin_beta, cos_beta) = circular[0];
    let (sin_gamma, cos_gamma) = circular[1];
    let (sin_delta, cos_delta) = circular[2];
    let (sin_t0, cos_t0) = circular[3];
    let (sin_epsilon, cos_epsilon) = circular[4];
    let (sin_t1, cos_t1) = circular[5];
    let (sin_t2, cos_t2) = circular[6];
    let t3 = beta_dot + Theta_dot;
    let t4 = beta_dot * beta_dot;
    let t5 = delta_dot + Phi_dot;
    let t6 = epsilon_dot + Omega_dot;
    let t7 = delta_dot * delta_dot;
    let t8 = t3 * t3;
    let t9 = epsilon_dot * epsilon_dot;
    let t10 = t5 * t5;
    let t11 = gamma_dot * gamma_dot;
    let t12 = t6 * t6;
    let t13 = t8 * n(p.da);
    let t14 = cos_beta * n(p.rr);
    let t15 = sin_beta * n(p.rr);
    let t16 = cos_gamma * n(p.ss);
    let t17 = sin_delta * n(p.zt);
    let t18 = cos_gamma * n(p.sd);
    let t19 = sin_gamma * n(p.ss);
    let t20 = sin_gamma * n(p.sd);
    let t21 = sin_t0 * n(p.d);
    let t22 = cos_t0 * n(p.d);
    let t23 = t16 * n(p.k33);
    let t24 = cos_t1 * n(p.e);
    let t25 = sin_gamma * n(p.sc);
    // Eliminates Theta: coupling l[Theta].
    let t26 = sin_t0.mul_add(sin_beta, cos_t0 * cos_beta);
    let t27 = t15 - t21;
    let t28 = t14 - t22;
    // Eliminates Phi: coupling l[Phi].
    let t29 = sin_t1.mul_sub(cos_delta, cos_t1 * sin_delta);
    let t30 = t17 - t24;
    let t31 = n(p.k31) * t26;
    let t32 = n(p.k30) * t29;
    // Eliminates beta: inertia d[beta].
    let t33 = t26.neg_mul_add(t26 * n(p.k21), n(p.k22));
    let t34 = cos_gamma * n(p.sc);
    // Eliminates delta: inertia d[delta].
    let t35 = t29.neg_mul_add(t29 * n(p.k17), n(p.k18));
    let t36 = N::ONE / t33;
    let t37 = sin_t1 * n(p.e);
    let t38 = cos_delta * n(p.zt);
    let t39 = N::ONE / t35;
    let t40 = n(p.xc) - (t25 + (t18 + n(p.xb)));
    let t41 = cos_epsilon * n(p.u);
    let t42 = n(p.yc) - (t20 + n(p.yb) - t34);
    let t43 = sin_t2 * n(p.zf);
    let t44 = t37 + t38;
    let t45 = t15 * t4;
    // Eliminates Omega: coupling l[Omega].
    let t46 = sin_t2.mul_sub(cos_epsilon, cos_t2 * sin_epsilon);
    let t47 = t14 * t4;
    let t48 = t41 - t43;
    let t49 = sin_epsilon * n(p.u);
    let t50 = sin_t0.neg_mul_add(t13, t45);
    let t51 = cos_t0.neg_mul_add(t13, t47);
    let t52 = n(p.k29) * t46;
    let t53 = t36 * t21.neg_mul_add(t31, t21 + t27);
    let t54 = t36 * t31.neg_mul_add(t22, t22 + t28);
    let t55 = t42.mul_add(t42, t40 * t40).sqrt();
    let t56 = t39 * t24.mul_add(t32, t24 + t30);
    // Eliminates epsilon: inertia d[epsilon].
    let t57 = t46.neg_mul_add(t46 * n(p.k14), n(p.k15));
    let t58 = t53 + t31.neg_mul_add(t53, t21 * n(p.k32));
    let t59 = t39 * t32.neg_mul_add(t37, t44 - t37);
    let t60 = t54 + t31.neg_mul_add(t54, n(p.k32) * t22);
    let t61 = N::ONE / t57;
    let t62 = t38 * t7;
    let t63 = t56 + t32.mul_add(t56, t24 * n(p.k28));
    let t64 = sin_t1 * t10;
    let t65 = t21.mul_add(t58, t27 * t53);
    let t66 = t58.mul_add(t22, t53 * t28);
    let t67 = t22.mul_add(t60, t28 * t54);
    let t68 = t21.mul_add(t60, t27 * t54);
    // Row x3: pivot d[x3].
    let t69 = t16.mul_add(t23, t65);
    let t70 = t23.neg_mul_add(t19, t66);
    let t71 = t19.mul_add(n(p.k33) * t19, t67);
    let t72 = t41 * t9;
    let t73 = sin_t2 * t12;
    let t74 = t65 + t24.mul_add(t63, t30 * t56);
    let t75 = N::ONE / t55;
    let t76 = N::ONE / t69;
    let t77 = t50.mul_add(cos_beta * n(p.m2_rr), n(p.mom));
    let t78 = t59 - t32.neg_mul_add(t59, n(p.k28) * t37);
    let t79 = cos_t0.mul_sub(t50, sin_t0 * t51);
    let t80 = t17 * t7;
    let t81 = cos_t1 * t10;
    let t82 = t49 * t9;
    let t83 = cos_t2 * t12;
    let t84 = t67 + t37.neg_mul_add(t78, t44 * t59);
    let t85 = t61 * t43.neg_mul_add(t52, t43 + t48);
    let t86 = cos_t2 * n(p.zf);
    let t87 = t51.neg_mul_add(sin_beta * n(p.m2_rr), t77);
    let t88 = t86 + t49;
    // Eliminates x3 from row y3: l[y3, x3].
    let t89 = t76 * t70;
    // Eliminates x3 from row x4: l[x4, x3]; Eliminates x3 from row x6: l[x6, x3].
    let t90 = t65 * t76;
    // Eliminates x3 from row y4: l[y4, x3]; Eliminates x3 from row y6: l[y6, x3].
    let t91 = t76 * t66;
    let t92 = t36 * t79.neg_mul_add(t26 * n(p.k20), t87);
    let t93 = t42 * t75;
    let t94 = t40 * t75;
    let t95 = cos_t1 * n(p.e_minus_ea).mul_add(t64, t62);
    let t96 = sin_t1.mul_add(t81.neg_mul_add(n(p.e_minus_ea), t80), t95);
    // Row y3: pivot d[y3].
    let t97 = t70.neg_mul_add(t89, t71);
    let t98 = t70.neg_mul_add(t90, t68);
    let t99 = t70.neg_mul_add(t91, t67);
    let t100 = N::ONE / t97;
    let t101 = cos_t2 * n(p.zf_minus_fa).neg_mul_add(t73, t72);
    let t102 = sin_t2.mul_add(t83.mul_add(n(p.zf_minus_fa), t82), t101);
    let t103 = t85 + t52.neg_mul_add(t85, t43 * n(p.k27));
    let t104 = sin_delta.mul_add(t64, cos_delta * t81);
    let t105 = cos_epsilon.mul_add(t83, sin_epsilon * t73);
    let t106 = n(p.k24).mul_add(t92.neg_mul_add(t26 * n(p.rr), t79), t92);
    let t107 = t22.neg_mul_add(t8, t47);
    let t108 = t21.neg_mul_add(t8, t45);
    let t109 = t39 * t96.mul_add(t29 * n(p.k19), t104);
    let t110 = t61 * t102.neg_mul_add(t46 * n(p.k16), t105);
    // Eliminates y3 from row x4: l[x4, y3]; Eliminates y3 from row x6: l[x6, y3].
    let t111 = t100 * t98;
    // Eliminates y3 from row y4: l[y4, y3]; Eliminates y3 from row y6: l[y6, y3].
    let t112 = t100 * t99;
    let t113 = t65 + t43.mul_add(t103, t48 * t85);
    let t114 = t21.mul_add(t106, t27 * t92);
    let t115 = t98.mul_add(t111, t65 * t90);
    let t116 = t112.mul_add(t98, t65 * t91);
    let t117 = t99.mul_add(t112, t66 * t91);
    let t118 = t22.mul_add(t106, t28 * t92);
    // Row x4: pivot d[x4].
    let t119 = t74 - t115;
    let t120 = t66 + t63.neg_mul_add(t37, t56 * t44) - t116;
    let t121 = t65 - t115;
    let t122 = N::ONE / t119;
    let t123 = t61 * t52.mul_add(t86, t88 - t86);
    let t124 = t18.mul_add(t93, t25 * t93) + t34.mul_sub(t94, t20 * t94);
    let t125 = t124 * ((n(p.l0) - t55) * n(p.k34));
    let t126 = t109.mul_add(t29 * n(p.k25), t96);
    let t127 = t109 * n(p.k9);
    let t128 = t110.neg_mul_add(t46 * n(p.k26), t102);
    let t129 = t110 * n(p.k11);
    let t130 = t66 - t116;
    let t131 = t114 + t19.neg_mul_add(t11, t107);
    let t132 = cos_gamma.neg_mul_add(t125, t131);
    let t133 = n(p.k35) * n(p.k28).mul_add(t126, n(p.zt) * t109);
    // Eliminates x4 from row y4: l[y4, x4].
    let t134 = t122 * t120;
    // Eliminates x4 from row x6: l[x6, x4].
    let t135 = t122 * t121;
    let t136 = n(p.k36) * n(p.k27).mul_add(t128, n(p.u) * t110);
    // Eliminates x4 from row y6: l[y6, x4].
    let t137 = t122 * t130;
    // Row y4: pivot d[y4].
    let t138 = t120.neg_mul_add(t134, t84 - t117);
    let t139 = t99.neg_mul_add(t111, t66.neg_mul_add(t90, t68));
    let t140 = t120.neg_mul_add(t135, t139);
    let t141 = sin_gamma.neg_mul_add(t125, t16.mul_add(t11, t108) - t118);
    // Row y3: right-hand side z[y3].
    let t142 = t89.mul_add(t132, t141);
    let t143 = t30.mul_add(t127, t107 - t37.mul_add(t10, t62));
    let t144 = N::ONE / t138;
    let t145 = t44.neg_mul_add(t127, t108 - t24.neg_mul_add(t10, t80));
    let t146 = t48.mul_add(t129, t107 - t86.mul_add(t12, t82));
    let t147 = t88.mul_add(t129, t108 + t43.neg_mul_add(t12, t72));
    let t148 = t123 - t52.mul_add(t123, n(p.k27) * t86);
    let t149 = t120.neg_mul_add(t137, t67 - t117);
    let t150 = t111.neg_mul_add(t142, t90 * t132);
    let t151 = t112.neg_mul_add(t142, t91 * t132);
    let t152 = t67 + t86.neg_mul_add(t148, t88 * t123);
    let t153 = t66 + t103.mul_sub(t86, t85 * t88) - t116;
    // Row x4: right-hand side z[x4].
    let t154 = t114 + cos_t1.mul_add(t133, t143) - t150;
    // Eliminates y4 from row x6: l[x6, y4].
    let t155 = t144 * t140;
    // Eliminates y4 from row y6: l[y6, y4].
    let t156 = t144 * t149;
    let t157 = t151 + (sin_t1.mul_add(t133, t145) - t118);
    // Row y4: right-hand side z[y4].
    let t158 = t134.mul_add(t154, t157);
    let t159 = t114 + sin_t2.mul_add(t136, t146) - t150;
    let t160 = t151 + (cos_t2.neg_mul_add(t136, t147) - t118);
    let t161 = t121.neg_mul_add(t135, t113 - t115);
    // Row x6: pivot d[x6].
    let t162 = t140.neg_mul_add(t155, t161);
    let t163 = t140.neg_mul_add(t156, t121.neg_mul_add(t137, t153));
    // Row x6: right-hand side z[x6].
    let t164 = t155.mul_add(t158, t135.neg_mul_add(t154, t159));
    let t165 = t130.neg_mul_add(t137, t152 - t117);
    let t166 = N::ONE / t162;
    // Eliminates x6 from row y6: l[y6, x6].
    let t167 = t166 * t163;
    let t168 = t156.neg_mul_add(t158, t137.mul_add(t154, t160));
    // Row y6: pivot d[y6].
    let t169 = t163.neg_mul_add(t167, t149.neg_mul_add(t156, t165));
    // Row y6: right-hand side z[y6].
    let t170 = t167.mul_add(t164, t168) / t169;
    // Back substitution: lambda[x6].
    let t171 = t167.mul_add(t170, t166 * t164);
    // Back substitution: lambda[y4].
    let t172 = t155.mul_add(t171, t156.neg_mul_add(t170, t144 * t158));
    let t173 = t135.neg_mul_add(t171, t137.mul_add(t170, t122 * t154));
    // Back substitution: lambda[x4].
    let t174 = t134.mul_add(t172, t173);
    let t175 = t111.mul_add(t171, t112.neg_mul_add(t170, t100 * t142));
    let t176 = t90.neg_mul_add(t171, t91.mul_add(t170, t76 * t132));
    // Back substitution: lambda[y3].
    let t177 = t111.mul_add(t174, t112.neg_mul_add(t172, t175));
    let t178 = t90.neg_mul_add(t174, t91.mul_add(t172, t176));
    // Back substitution: lambda[x3].
    let lambda1 = -t89.mul_add(t177, t178);
    let lambda2 = -t177;
    let lambda3 = -t174;
    let lambda4 = -t172;
    let lambda5 = -t171;
    let lambda6 = -t170;
    let sound = PIVOTS.hold(t57, t57)
        & PIVOTS.hold(t35, t35)
        & PIVOTS.hold(t33, t33)
        & PIVOTS.hold(t69, t69)
        & PIVOTS.hold(t97, t71)
        & PIVOTS.hold(t119, t74)
        & PIVOTS.hold(t138, t84)
        & PIVOTS.hold(t162, t113)
        & PIVOTS.hold(t169, t152)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (6, t57, t57),
            (4, t35, t35),
            (0, t33, t33),
            (7, t69, t69),
            (8, t97, t71),
            (9, t119, t74),
            (10, t138, t84),
            (11, t162, t113),
            (12, t169, t152),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [
        lambda1.store(),
        lambda2.store(),
        lambda3.store(),
        lambda4.store(),
        lambda5.store(),
        lambda6.store(),
    ];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 7], v: &'a [S; 7] })
        -> Result<[S; 99], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 99], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let beta = n(q[0]);
    let Theta = n(q[1]);
    let gamma = n(q[2]);
    let Phi = n(q[3]);
    let delta = n(q[4]);
    let Omega = n(q[5]);
    let epsilon = n(q[6]);
    let beta_dot = n(v[0]);
    let Theta_dot = n(v[1]);
    let gamma_dot = n(v[2]);
    let Phi_dot = n(v[3]);
    let delta_dot = n(v[4]);
    let Omega_dot = n(v[5]);
    let epsilon_dot = n(v[6]);
    let t0 = Theta + beta;
    let t1 = delta + Phi;
    let t2 = epsilon + Omega;
    let angles = [Theta, beta, gamma, Phi, t0, delta, Omega, t1, epsilon, t2];
    let circular = N::sin_cos_all(angles);
    let (sin_Theta, cos_Theta) = circular[0];
    let (sin_beta, cos_beta) = circular[1];
    let (sin_gamma, cos_gamma) = circular[2];
    let (sin_Phi, cos_Phi) = circular[3];
    let (sin_t0, cos_t0) = circular[4];
    let (sin_delta, cos_delta) = circular[5];
    let (sin_Omega, cos_Omega) = circular[6];
    let (sin_t1, cos_t1) = circular[7];
    let (sin_epsilon, cos_epsilon) = circular[8];
    let (sin_t2, cos_t2) = circular[9];
    let t3 = Theta_dot + beta_dot;
    let t4 = delta_dot + Phi_dot;
    let t5 = epsilon_dot + Omega_dot;
    let t6 = cos_Theta.neg_mul_add(n(p.da), n(p.rr));
    let t7 = sin_beta * n(p.rr);
    let t8 = cos_beta * n(p.rr);
    let r14 = cos_gamma * n(p.ss);
    let r21 = sin_gamma * n(p.ss);
    let t9 = sin_t0 * n(p.d);
    let r20 = cos_t0 * n(p.d);
    let t10 = r14 * n(p.k37);
    let t11 = sin_Phi.mul_add(n(p.e_minus_ea), n(p.zt));
    let t12 = sin_Theta.mul_add(sin_Theta * n(p.m2_da2), n(p.I2));
    let t13 = t6.neg_mul_add(cos_Theta * n(p.m2_da), t12);
    let t14 = r21 * n(p.k37);
    let r12 = t7 - t9;
    let t15 = t8 - r20;
    let t16 = sin_Phi.mul_add(n(p.k9), n(p.k1));
    let t17 = cos_Phi.mul_add(cos_Phi * n(p.k0), n(p.I4));
    let t18 = sin_delta * n(p.zt);
    let r29 = cos_t1 * n(p.e);
    let r36 = sin_t1 * n(p.e);
    let t19 = n(p.k28) * t16;
    let t20 = cos_delta * n(p.zt);
    let t21 = sin_Omega.neg_mul_add(n(p.zf_minus_fa), n(p.u));
    let r54 = t6.mul_add(n(p.m2_rr), n(p.m1_ra2)) + (t13 + n(p.I1));
    let t22 = r29 * n(p.k28);
    let r37 = r36 + t20;
    let t23 = t11.mul_add(n(p.m4_zt), n(p.m5_ta2_plus_m5_tb2));
    let r58 = t23 + (t11.mul_add(sin_Phi * n(p.k10), t17) + n(p.I5));
    let t24 = r36 * n(p.k28);
    let t25 = N::ONE / r54;
    let t26 = t16.mul_add(t22, t18 - r29);
    let t27 = cos_Omega.mul_add(cos_Omega * n(p.k2), n(p.I6));
    let t28 = sin_Omega.neg_mul_add(n(p.k11), n(p.k3));
    let t29 = t16.neg_mul_add(t19, r58);
    let t30 = t16.neg_mul_add(t24, r37);
    let t31 = sin_t2 * n(p.zf);
    let t32 = cos_epsilon * n(p.u);
    let t33 = n(p.k27) * t28;
    let t34 = N::ONE / t29;
    let r52 = cos_t2 * n(p.zf);
    let t35 = sin_epsilon * n(p.u);
    let r46 = t32 - t31;
    let t36 = t31 * n(p.k27);
    let t37 = t21.neg_mul_add(sin_Omega * n(p.k12), t27) + n(p.I7);
    let r60 = t21.mul_add(n(p.m6_u), n(p.m7_ub2_plus_m7_ua2)) + t37;
    let t38 = r52 * n(p.k27);
    let t39 = r21 * gamma_dot;
    let r53 = r52 + t35;
    let t40 = t9.neg_mul_add(t3, t7 * beta_dot);
    let t41 = t13 * t25;
    let t42 = r12 * t25;
    let t43 = t15 * t25;
    let t44 = t28.neg_mul_add(t33, r60);
    let t45 = t28.mul_add(t36, r46);
    let t46 = t28.neg_mul_add(t38, r53);
    let t47 = t13.neg_mul_add(t41, n(p.I2_plus_m2_da2));
    let t48 = t13.mul_add(t42, t9);
    let t49 = t13.mul_add(t43, r20);
    let t50 = t34 * t26;
    let t51 = N::ONE / t47;
    let t52 = t34 * t30;
    let t53 = N::ONE / t44;
    let t54 = r20.neg_mul_add(t3, t8 * beta_dot);
    let r6 = r14.mul_add(gamma_dot, t40);
    let t55 = t26.mul_add(t50, r29 * t22);
    let t56 = t30.mul_add(t52, r36 * t24);
    let t57 = r21 + n(p.xb);
    let t58 = n(p.yb) - r14;
    let t59 = r36.mul_add(t4, t20 * delta_dot);
    let t60 = r52.mul_add(t5, t35 * epsilon_dot);
    let r8 = t40 - r29.neg_mul_add(t4, t18 * delta_dot);
    let t61 = t15 - t57;
    let t62 = t51 * t48;
    let t63 = t51 * t49;
    let t64 = t53 * t45;
    let t65 = t53 * t46;
    let r10 = t40 + t31.neg_mul_add(t5, t32 * epsilon_dot);
    let t66 = t48.mul_add(t62, r12 * t42);
    let t67 = t48.mul_add(t63, r12 * t43);
    let t68 = t49.mul_add(t63, t15 * t43);
    let t69 = t62.mul_add(t49, t15 * t42);
    let t70 = t45.mul_add(t64, t31 * t36);
    let t71 = t46.mul_add(t65, r52 * t38);
    let t72 = r36 + (t20 + n(p.xa));
    let r87 = r14.mul_add(t10, t66);
    let t73 = r14.mul_sub(t14, t67);
    let r94 = r21.mul_add(t14, t68);
    let t74 = t18 + n(p.ya) - r29;
    let t75 = r52 + (n(p.xa) + t35);
    let t76 = t31 + (n(p.ya) - t32);
    let t77 = N::ONE / r87;
    let r13 = sin_t0 * n(p.minus_d);
    let r19 = r20 - t8;
    let r95 = t66 + t55;
    let r96 = t68 + t56;
    let r97 = t66 + t70;
    let r98 = t68 + t71;
    let t78 = t77 * t73;
    let t79 = t66 * t77;
    let t80 = t77 * t67;
    let r88 = t73.neg_mul_add(t78, r94);
    let t81 = t73.mul_add(t79, t69);
    let t82 = t73.mul_add(t80, t68);
    let t83 = r6.mul_add(t78, t54 - t39);
    let t84 = N::ONE / r88;
    let t85 = t61.neg_mul_add(t78, r12 - t58);
    let t86 = t84 * t81;
    let t87 = t84 * t82;
    let t88 = t81.neg_mul_add(t86, t66.neg_mul_add(t79, t66));
    let t89 = t87.neg_mul_add(t81, t66.neg_mul_add(t80, t67));
    let t90 = t86.mul_add(t83, r6 * t79);
    let t91 = t87.mul_add(t83, r6 * t80);
    let t92 = t85.neg_mul_add(t86, t61 * t79);
    let t93 = t85.neg_mul_add(t87, t61 * t80);
    let r89 = t55 + t88;
    let t94 = t26.neg_mul_add(t52, r29 * t24) - t89;
    let t95 = t68 - t82.mul_add(t87, t67 * t80);
    let t96 = r8 - t90;
    let t97 = N::ONE / r89;
    let t98 = t15 - t72 - t92;
    let t99 = t97 * t94;
    let t100 = t88 * t97;
    let t101 = t97 * t89;
    let r90 = t94.neg_mul_add(t99, t56 + t95);
    let t102 = t82.neg_mul_add(t86, t67.neg_mul_add(t79, t69));
    let t103 = t94.mul_add(t100, t102);
    let t104 = t94.mul_add(t101, t95);
    let t105 = t89 + t45.neg_mul_add(t65, t31 * t38);
    let t106 = t99.mul_add(t96, t54 - t59 - t91);
    let t107 = N::ONE / r90;
    let t108 = t98.neg_mul_add(t99, r12 - t74 + t93);
    let t109 = t107 * t103;
    let t110 = t107 * t104;
    let r91 = t103.neg_mul_add(t109, t88.neg_mul_add(t100, t88 + t70));
    let t111 = t103.neg_mul_add(t110, t88.neg_mul_add(t101, t105));
    let t112 = t109.neg_mul_add(t106, t100.neg_mul_add(t96, r10 - t90));
    let t113 = t101.neg_mul_add(t96, t54 - t60 - t91);
    let t114 = t108.mul_add(t109, t98.neg_mul_add(t100, t15 - t75 - t92));
    let t115 = N::ONE / r91;
    let t116 = t115 * t111;
    let t117 = t115 * t112;
    let t118 = t104.neg_mul_add(t110, t89.neg_mul_add(t101, t95 + t71));
    let r92 = t111.neg_mul_add(t116, t118);
    let t119 = t108.neg_mul_add(t110, t98.mul_add(t101, r12 - t76 + t93));
    let t120 = N::ONE / r92;
    let t121 = t116.neg_mul_add(t112, t110.neg_mul_add(t106, t113));
    let r86 = t120 * t121;
    let r80 = t114.mul_add(t116, t119) * t120;
    let t122 = t116 * r86;
    let r79 = t116.mul_add(r80, t114 * t115);
    let t123 = t117 - t122;
    let r84 = t109.neg_mul_add(t123, t110.neg_mul_add(r86, t107 * t106));
    let r78 = t109.mul_add(r79, t110.neg_mul_add(r80, t108 * t107));
    let t124 = t86.neg_mul_add(t123, t87.neg_mul_add(r86, t84 * t83));
    let t125 = t100.neg_mul_add(t123, t101.neg_mul_add(r86, t97 * t96));
    let t126 = t99.mul_add(r84, t125);
    let t127 = t79.neg_mul_add(t123, t80.neg_mul_add(r86, r6 * t77));
    let t128 = t79.neg_mul_add(r79, t80.mul_add(r80, t61 * t77));
    let t129 = t100.neg_mul_add(r79, t101.mul_add(r80, t98 * t97));
    let r77 = t99.neg_mul_add(r78, t129);
    let t130 = t86.mul_add(r79, t87.neg_mul_add(r80, t85 * t84));
    let r82 = t86.neg_mul_add(t126, t87.neg_mul_add(r84, t124));
    let t131 = t63.mul_add(r84, t62.mul_add(t123, t63 * r86));
    let t132 = t43.mul_add(r84, t42.mul_add(t123, t43 * r86));
    let r76 = t86.mul_add(r77, t87.neg_mul_add(r78, t130));
    let t133 = t63.neg_mul_add(r78, t62.mul_sub(r79, t63 * r80));
    let t134 = t43.neg_mul_add(r78, t42.mul_sub(r79, t43 * r80));
    let t135 = t79.neg_mul_add(t126, t80.neg_mul_add(r84, t127));
    let t136 = t78.mul_add(r82, t135);
    let t137 = t79.neg_mul_add(r77, t80.mul_add(r78, t128));
    let r75 = t78.neg_mul_add(r76, t137);
    let t138 = t50 * r77;
    let t139 = t52 * r78;
    let r67 = t64.mul_add(r79, t65 * r80);
    let t140 = t63.mul_add(r82, t62.mul_add(t126, t131));
    let r69 = t62.mul_add(t136, t140);
    let t141 = t43.mul_add(r82, t42.mul_add(t126, t132));
    let r72 = t50.mul_add(t126, t52 * r84);
    let t142 = t64 * t123;
    let t143 = t65 * r86;
    let t144 = t63.neg_mul_add(r76, t62.mul_add(r77, t133));
    let t145 = t62.mul_add(r75, t144);
    let t146 = t43.neg_mul_add(r76, t42.mul_add(r77, t134));
    let r0 = t57 - t15;
    let r1 = t58 - r12;
    let r2 = t72 - t15;
    let r3 = t74 - r12;
    let r4 = t75 - t15;
    let r5 = t76 - r12;
    let r7 = t39 - t54;
    let r9 = t59 - t54;
    let r11 = t60 - t54;
    let zero = N::ZERO;
    let r30 = r29 - t18;
    let r45 = sin_t2 * n(p.minus_zf);
    let r61 = t41.mul_add(t145, t42.mul_add(r75, t146));
    let r62 = -t145;
    let r63 = t10.mul_add(r75, t14 * r76);
    let r64 = t19.mul_add(t138 - t139, t22.mul_add(r77, t24 * r78));
    let r65 = t139 - t138;
    let r66 = -t33.mul_add(r67, t36.mul_sub(r79, t38 * r80));
    let r68 = -t41.mul_add(r69, t42.mul_add(t136, t141));
    let r70 = t10.neg_mul_add(t136, t14 * r82);
    let r71 = -t19.mul_add(r72, t22.mul_sub(t126, t24 * r84));
    let r73 = t33.mul_add(t142 - t143, t36.mul_add(t123, t38 * r86));
    let r74 = t143 - t142;
    let r81 = -t136;
    let r83 = -t126;
    let r85 = t122 - t117;
    let sound = PIVOTS.hold(n(p.k13), n(p.k13))
        & PIVOTS.hold(t29, r58)
        & PIVOTS.hold(t44, r60)
        & PIVOTS.hold(r54, r54)
        & PIVOTS.hold(t47, n(p.I2_plus_m2_da2))
        & PIVOTS.hold(r87, r87)
        & PIVOTS.hold(r88, r94)
        & PIVOTS.hold(r89, r95)
        & PIVOTS.hold(r90, r96)
        & PIVOTS.hold(r91, r97)
        & PIVOTS.hold(r92, r98)
        & r68.is_finite();
    if !sound {
        let pivots = [
            (2, n(p.k13), n(p.k13)),
            (4, t29, r58),
            (6, t44, r60),
            (0, r54, r54),
            (1, t47, n(p.I2_plus_m2_da2)),
            (7, r87, r87),
            (8, r88, r94),
            (9, r89, r95),
            (10, r90, r96),
            (11, r91, r97),
            (12, r92, r98),
        ];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        r6.store(),
        r7.store(),
        r8.store(),
        r9.store(),
        r10.store(),
        r11.store(),
        r12.store(),
        r13.store(),
        r14.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r19.store(),
        r20.store(),
        r21.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r12.store(),
        r13.store(),
        zero.store(),
        r29.store(),
        r30.store(),
        zero.store(),
        zero.store(),
        r19.store(),
        r20.store(),
        zero.store(),
        r36.store(),
        r37.store(),
        zero.store(),
        zero.store(),
        r12.store(),
        r13.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r45.store(),
        r46.store(),
        r19.store(),
        r20.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r52.store(),
        r53.store(),
        r54.store(),
        n(p.I2_plus_m2_da2).store(),
        n(p.k13).store(),
        n(p.k1).store(),
        r58.store(),
        n(p.k3).store(),
        r60.store(),
        r61.store(),
        r62.store(),
        r63.store(),
        r64.store(),
        r65.store(),
        r66.store(),
        r67.store(),
        r68.store(),
        r69.store(),
        r70.store(),
        r71.store(),
        r72.store(),
        r73.store(),
        r74.store(),
        r75.store(),
        r76.store(),
        r77.store(),
        r78.store(),
        r79.store(),
        r80.store(),
        r81.store(),
        r82.store(),
        r83.store(),
        r84.store(),
        r85.store(),
        r86.store(),
        r87.store(),
        r88.store(),
        r89.store(),
        r90.store(),
        r91.store(),
        r92.store(),
        r87.store(),
        r94.store(),
        r95.store(),
        r96.store(),
        r97.store(),
        r98.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 7],
    v: &[S; 7],
) -> S {
    let Theta = q[1];
    let gamma = q[2];
    let Phi = q[3];
    let Omega = q[5];
    let beta_dot = v[0];
    let Theta_dot = v[1];
    let gamma_dot = v[2];
    let Phi_dot = v[3];
    let delta_dot = v[4];
    let Omega_dot = v[5];
    let epsilon_dot = v[6];
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let (sin_Theta, cos_Theta) = Theta.sin_cos();
    let (sin_Phi, cos_Phi) = Phi.sin_cos();
    let (sin_Omega, cos_Omega) = Omega.sin_cos();
    let t0 = Theta_dot + beta_dot;
    let t1 = gamma_dot * p.sa;
    let t2 = delta_dot + Phi_dot;
    let t3 = gamma_dot * p.sb;
    let t4 = epsilon_dot + Omega_dot;
    let t5 = t0 * t0;
    let t6 = t2 * t2;
    let t7 = t4 * t4;
    let t8 = delta_dot * (delta_dot * p.k7) + beta_dot * (beta_dot * p.k6);
    let t9 = beta_dot * p.rr - cos_Theta * (t0 * p.da);
    let t10 = sin_Phi * (t2 * p.e_minus_ea) + delta_dot * p.zt;
    let t11 = epsilon_dot * p.u - sin_Omega * (t4 * p.zf_minus_fa);
    let t12 = t3 * sin_gamma - cos_gamma * t1;
    let t13 = t3 * cos_gamma + sin_gamma * t1;
    let t14 = (sin_Theta * (sin_Theta * (t5 * p.da2)) + t9 * t9) * p.m2 + t5 * p.I2;
    let t15 = (t13 * t13 + t12 * t12) * p.m3 + gamma_dot * (gamma_dot * p.I3);
    let t16 = (cos_Phi * (cos_Phi * (t6 * p.k4)) + t10 * t10) * p.m4 + t6 * p.I4;
    let t17 = (cos_Omega * (cos_Omega * (t7 * p.k5)) + t11 * t11) * p.m6 + t7 * p.I6;
    let t18 = S::from_f64(0.5) * t15 + (epsilon_dot * (epsilon_dot * p.k8) + t8);
    let t19 = S::from_f64(0.5) * t16 + S::from_f64(0.5) * t14;
    t19 + (S::from_f64(0.5) * t17 + t18)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*c0*(sqrt((xc - (sd*cos(gamma) + sc*sin(gamma) + xb))^2 + (yc - (sd*sin(gamma) -
///     sc*cos(gamma) + yb))^2) - l0)^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 7]) -> S {
    let gamma = q[2];
    let (sin_gamma, cos_gamma) = gamma.sin_cos();
    let t0 = p.xc - (sin_gamma * p.sc + (cos_gamma * p.sd + p.xb));
    let t1 = p.yc - (sin_gamma * p.sd + p.yb - cos_gamma * p.sc);
    let t2 = p.l0 - (t1 * t1 + t0 * t0).sqrt();
    t2 * (t2 * p.half_c0)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = mom*der(beta)
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 7]) -> S {
    let beta_dot = v[0];
    beta_dot * p.mom
}

::lagrangian::emitted::implement! {
    machine AndrewsSqueezer "AndrewsSqueezer" over S, R;
    parameters {
        m1, m2, m3, m4, m5, m6, m7, I1, I2, I3, I4, I5, I6, I7, xa, ya, xb, yb, xc, yc, d, da, e,
        ea, zf, fa, rr, ra, ss, sa, sb, sc, sd, zt, ta, tb, u, ua, ub, c0, l0, mom,
    } [
        m1: "m1" "kg" = 0.04325;
        m2: "m2" "kg" = 0.00365;
        m3: "m3" "kg" = 0.02373;
        m4: "m4" "kg" = 0.00706;
        m5: "m5" "kg" = 0.0705;
        m6: "m6" "kg" = 0.00706;
        m7: "m7" "kg" = 0.05498;
        I1: "I1" "kg*m^2" = 2.194e-6;
        I2: "I2" "kg*m^2" = 4.41e-7;
        I3: "I3" "kg*m^2" = 5.255e-6;
        I4: "I4" "kg*m^2" = 5.667e-7;
        I5: "I5" "kg*m^2" = 1.169e-5;
        I6: "I6" "kg*m^2" = 5.667e-7;
        I7: "I7" "kg*m^2" = 1.912e-5;
        xa: "xa" "m" = -0.06934;
        ya: "ya" "m" = -0.00227;
        xb: "xb" "m" = -0.03635;
        yb: "yb" "m" = 0.03273;
        xc: "xc" "m" = 0.014;
        yc: "yc" "m" = 0.072;
        d: "d" "m" = 0.028;
        da: "da" "m" = 0.0115;
        e: "e" "m" = 0.02;
        ea: "ea" "m" = 0.01421;
        zf: "zf" "m" = 0.02;
        fa: "fa" "m" = 0.01421;
        rr: "rr" "m" = 0.007;
        ra: "ra" "m" = 0.00092;
        ss: "ss" "m" = 0.035;
        sa: "sa" "m" = 0.01874;
        sb: "sb" "m" = 0.01043;
        sc: "sc" "m" = 0.018;
        sd: "sd" "m" = 0.02;
        zt: "zt" "m" = 0.04;
        ta: "ta" "m" = 0.02308;
        tb: "tb" "m" = 0.00916;
        u: "u" "m" = 0.04;
        ua: "ua" "m" = 0.01228;
        ub: "ub" "m" = 0.00449;
        c0: "c0" "N/m" = 4530.0;
        l0: "l0" "m" = 0.07785;
        mom: "mom" "N*m" = 0.033;
    ]
    coordinates 7 Coordinates { beta, Theta, gamma, Phi, delta, Omega, epsilon } [
        beta: "beta" "rad";
        Theta: "Theta" "rad";
        gamma: "gamma" "rad";
        Phi: "Phi" "rad";
        delta: "delta" "rad";
        Omega: "Omega" "rad";
        epsilon: "epsilon" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m2, m3, m4, m6, I1, I2, I3, I4, I5, I6, I7, xa, ya, xb, yb, xc, yc, d, da, e, zf, rr, ss,
        sa, sb, sc, sd, zt, u, l0, mom, e_minus_ea, zf_minus_fa, m1_ra2, half_c0, m2_da2,
        I2_plus_m2_da2, k0, k1, k2, k3, m3_sa, m3_sb, sc_c0, sd_c0, da2, k4, k5, k6, k7, k8, m2_da,
        m2_rr, k9, k10, m4_zt, m5_ta2_plus_m5_tb2, k11, k12, m6_u, m7_ub2_plus_m7_ua2, m2_da_rr,
        k13, minus_d, minus_zf, k14, k15, k16, k17, k18, k19, k20, k21, k22, k23, k24, k25, k26,
        k27, k28, k29, k30, k31, k32, k33, k34, k35, k36, k37,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(p, v);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [
            ("x3", "m", "N", true),
            ("y3", "m", "N", true),
            ("x4", "m", "N", true),
            ("y4", "m", "N", true),
            ("x6", "m", "N", true),
            ("y6", "m", "N", true),
        ];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(7, 6);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
