//! The zero of a function of time between two instants.

use crate::Error;

/// A zero of a function that has opposite signs, or is zero, at both ends, to within `roundoff`.
///
/// T. R. Chandrupatla, *A new hybrid quadratic/bisection algorithm for finding the zero of a
/// nonlinear function without using derivatives*, Adv. Eng. Software 28 (1997) 145–149: inverse
/// quadratic interpolation where that is safe, else bisection.
///
/// The function is called through a pointer: it evaluates a motion, and one copy of the search serves all machines and
/// events, where each would compile its own.
pub(crate) fn root(
    [mut a, mut b]: [f64; 2],
    roundoff: f64,
    f: &mut dyn FnMut(f64) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let (mut f_a, mut f_b) = (f(a)?, f(b)?);
    // The newest point and the one on the other side are `b` and `a`; `c` was there before.
    let mut fraction = 0.5_f64;
    loop {
        if f_a == 0.0 {
            return Ok(a);
        }
        let nearest = if f_a.abs() < f_b.abs() { a } else { b };
        let tolerance = (roundoff / (b - a).abs()).min(0.5);
        if f_b == 0.0 || tolerance >= 0.5 || !(b - a).is_normal() {
            return Ok(if f_b == 0.0 { b } else { nearest });
        }
        let x = a + fraction.clamp(tolerance, 1.0 - tolerance) * (b - a);
        let f_x = f(x)?;
        let (c, f_c);
        if (f_x > 0.0) == (f_a > 0.0) {
            (c, f_c) = (a, f_a);
        } else {
            (c, f_c) = (b, f_b);
            (b, f_b) = (a, f_a);
        }
        (a, f_a) = (x, f_x);

        let xi = (a - b) / (c - b);
        let phi = (f_a - f_b) / (f_c - f_b);
        let safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        fraction = if safe {
            f_a / (f_b - f_a) * f_c / (f_b - f_c)
                + (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_c - f_b)
        } else {
            0.5
        };
    }
}

/// Where a function that is negative at the second of two places was positive last. What has just begun may be
/// positive only a little later than at the first; where it never is, that is the answer.
pub(crate) fn last_positive(
    [from, to]: [f64; 2],
    roundoff: f64,
    f: &mut dyn FnMut(f64) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let mut positive = from;
    if f(from)? <= 0.0 {
        let mut part = 0.5 * (to - from);
        while part > roundoff && f(from + part)? <= 0.0 {
            part *= 0.5;
        }
        if part <= roundoff {
            return Ok(from);
        }
        positive = from + part;
    }
    root([positive, to], roundoff, f)
}
