//! The paper's own solution for two coordinates, (24)–(55), typed in by hand with its misprints corrected or, one at a
//! time, as printed. It shares nothing with the crate: it uses another metric, another parameter and another quadrature.

use std::f64::consts::PI;

/// The formula that is taken as printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Print {
    Mended,
    /// φ printed for 2ρ in the denominator of λ.
    Eq44,
    /// ρ printed for φ, twice.
    Eq45,
    /// ρ printed for φ in numerator and denominator of Ṽ.
    Eq48,
    /// `ψρ′ − ρψ′` and `ρψ(φ − ρ′)` printed in Ṽ′.
    Eq49,
    /// A wrong sign in ϑ₄.
    Eq50,
    /// q¹ printed for q².
    Eq53,
}

/// `a`, `r = b + c` and `d` in the machine's coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Machine {
    pub a: [[f64; 2]; 2],
    pub b: [f64; 2],
    pub c: [f64; 2],
    pub d: [[f64; 2]; 2],
}

/// The problem in normal coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Paper {
    pub r: [f64; 2],
    pub d: [[f64; 2]; 2],
    pub print: Print,
}

/// The results.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    pub start: f64,
    pub end: f64,
    pub time: f64,
    pub c: [f64; 2],
}

impl Paper {
    /// Transforms to normal coordinates by (24), (27), (29), (33).
    pub fn new(machine: &Machine, print: Print) -> Paper {
        let Machine { a: m, b, c, d } = machine;
        let (a12, a) = (m[0][1], m[0][0] + 2.0 * m[0][1] + m[1][1]);
        let s = -(m[0][0] + a12) / (a12 + m[1][1]);
        let b_ = m[0][0] + 2.0 * s * a12 + s * s * m[1][1];
        let (k1, k2) = (1.0 / a.sqrt(), 1.0 / b_.sqrt());
        let k = [[k1, k1], [k2, s * k2]];
        let r = [0, 1].map(|i| (0..2).map(|j| k[i][j] * (b[j] + c[j])).sum());
        let d = [0, 1].map(|i| {
            [0, 1].map(|j| {
                let pairs = (0..2).flat_map(|l| (0..2).map(move |m| (l, m)));
                pairs.map(|(l, m)| k[i][l] * d[l][m] * k[j][m]).sum()
            })
        });
        Paper { r, d, print }
    }

    /// ψ, ψ′, φ, φ′, ρ, ρ′ of (33), (35).
    fn functions(&self, e: f64) -> [f64; 6] {
        let ([r1, r2], [[d11, d12], [d21, d22]]) = (self.r, self.d);
        let (r3, r4) = (d12 + d21, d11 - d22);
        let (sin, cos, sin2, cos2) = (e.sin(), e.cos(), (2.0 * e).sin(), (2.0 * e).cos());
        [
            r1 * cos + r2 * sin,
            r2 * cos - r1 * sin,
            1.0 + d22 + r4 * cos * cos + r3 / 2.0 * sin2,
            r3 * cos2 - r4 * sin2,
            -d21 + r3 * cos * cos - r4 / 2.0 * sin2,
            -r4 * cos2 - r3 * sin2,
        ]
    }

    /// (43), on the branch on which the motion is driven.
    pub fn start(&self) -> f64 {
        let ([r1, r2], [[d11, d12], [d21, d22]]) = (self.r, self.d);
        let e = ((-r2 * (1.0 + d11) + r1 * d21) / (r2 * d12 - r1 * (1.0 + d22))).atan();
        if self.functions(e)[0] < 0.0 {
            e
        } else {
            e + PI
        }
    }

    /// `C₂/C₁`, (45).
    fn ratio(&self, end: f64) -> f64 {
        let [_, _, phi, _, rho, _] = self.functions(end);
        let tan = end.tan();
        match self.print {
            Print::Eq45 => (rho + rho * tan) / (rho - rho * tan),
            _ => (rho + phi * tan) / (phi - rho * tan),
        }
    }

    /// ϑ₃ and ϑ₄, (48), (50).
    fn thetas(&self, e: f64, end: f64) -> [f64; 2] {
        let k = self.ratio(end);
        let sign = if self.print == Print::Eq50 { -1.0 } else { 1.0 };
        [e.sin() - k * e.cos(), e.cos() + sign * k * e.sin()]
    }

    /// Ṽ of (48), and Ṽ′ of (49).
    pub fn speed(&self, e: f64, end: f64) -> [f64; 2] {
        let [psi, psi1, phi, phi1, rho, rho1] = self.functions(e);
        let [t3, t4] = self.thetas(e, end);
        let slip = if self.print == Print::Eq48 { rho } else { phi };
        let above = psi * (rho - phi1) + slip * psi1;
        let below = t3 * phi * psi + t4 * (2.0 * rho * psi - psi * phi1 + slip * psi1);
        let on_t3 = psi
            * (psi * (2.0 * (rho - phi1).powi(2) - phi * (phi + rho1))
                + phi * psi1 * (3.0 * rho - 2.0 * phi1));
        let on_t4 = match self.print {
            Print::Eq49 => {
                (psi * (phi + rho1) + psi1 * rho) * (psi * rho1 - rho * psi1)
                    - 2.0 * psi * psi * rho * psi * (phi - rho1)
            }
            _ => {
                (psi * (phi + rho1) + psi1 * rho) * (psi * phi1 - phi * psi1)
                    - 2.0 * psi * psi * rho * (phi + rho1)
            }
        };
        [above / below, (t3 * on_t3 + t4 * on_t4) / (below * below)]
    }

    /// λ of (44), for `C₁ = 1`.
    pub fn multiplier(&self, e: f64, end: f64) -> f64 {
        let [psi, psi1, phi, phi1, rho, _] = self.functions(e);
        let [t3, t4] = self.thetas(e, end);
        let twice = if self.print == Print::Eq44 {
            phi
        } else {
            2.0 * rho
        };
        -(t4 * rho + t3 * phi) / (t3 * phi * psi + t4 * ((twice - phi1) * psi + phi * psi1))
    }

    /// `dq¹/dε`, `dq²/dε` for K = 1, and `dt/dε` for `C₁ = 1`, (47), (31).
    fn rates(&self, e: f64, end: f64) -> [f64; 3] {
        let [psi, _, phi, _, rho, _] = self.functions(e);
        let [v, v1] = self.speed(e, end);
        let time = -(v * rho + phi * v1) / psi;
        [v * time * e.cos(), v * time * e.sin(), time]
    }

    /// Φ, Ψ and the time by the trapezoidal rule after the substitution `x = tanh(π/2 sinh s)`. H. Takahasi and M. Mori,
    /// *Double exponential formulas for numerical integration* (1974).
    fn integrals(&self, end: f64) -> [f64; 3] {
        let start = self.start();
        let (half, h) = ((end - start) / 2.0, 1.0 / 32.0);
        let mut sums = [0.0; 3];
        for step in -108..=108 {
            let s = h * f64::from(step);
            let x = (PI / 2.0 * s.sinh()).tanh();
            let weight = h * half * PI / 2.0 * s.cosh() / (PI / 2.0 * s.sinh()).cosh().powi(2);
            let rates = self.rates(start + half * (1.0 + x), end);
            for (sum, rate) in sums.iter_mut().zip(rates) {
                *sum += weight * rate;
            }
        }
        sums
    }

    /// (53) on both sides of the start, (55), (45), and the time.
    pub fn solve(&self, to: [f64; 2]) -> Option<Solved> {
        let start = self.start();
        let delta = |end: f64| {
            let [x, y, _] = self.integrals(end);
            let across = if self.print == Print::Eq53 {
                to[0]
            } else {
                to[1]
            };
            to[0] * y - across * x
        };
        let mut best: Option<Solved> = None;
        for side in [-1.0, 1.0] {
            let at = |step: i32| start + side * PI * (f64::from(step) + 0.5) / 101.0;
            for step in 0..99 {
                let (mut low, mut high) = (at(step), at(step + 1));
                let sign = delta(low) > 0.0;
                if sign == (delta(high) > 0.0) {
                    continue;
                }
                for _ in 0..60 {
                    let middle = (low + high) / 2.0;
                    if (delta(middle) > 0.0) == sign {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                let end = (low + high) / 2.0;
                let [x, y, time] = self.integrals(end);
                let k = (to[0].hypot(to[1])) / x.hypot(y);
                let goes = x * to[0] + y * to[1] > 0.0;
                // V and dt are positive during the motion, and a change of sign of Δ at a pole is not a root.
                let c1 = k.powf(-0.5) * self.speed((start + end) / 2.0, end)[0].signum();
                let found = Solved {
                    start,
                    end,
                    time: time / c1,
                    c: [c1, c1 * self.ratio(end)],
                };
                let root = delta(end).abs() < 1e-9 * to[0].hypot(to[1]) * x.hypot(y);
                if goes
                    && root
                    && found.time > 0.0
                    && best.is_none_or(|best| found.time < best.time)
                {
                    best = Some(found);
                }
            }
        }
        best
    }
}
