//! The frequency response, `G(iω) = C (iω − A)⁻¹ B + D`.

use nalgebra::{Complex, DMatrix};

use crate::model::LinearModel;

/// `G(iω)`, p × m, at an angular frequency in rad/s; `None` at a pole.
pub fn response(model: &LinearModel, omega: f64) -> Option<DMatrix<Complex<f64>>> {
    let n = model.a.nrows();
    let complex = |m: &DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
    let mut matrix = complex(&-&model.a);
    for i in 0..n {
        matrix[(i, i)] += Complex::new(0.0, omega);
    }
    let states = match n {
        0 => complex(&model.b),
        _ => matrix.lu().solve(&complex(&model.b))?,
    };
    let response = complex(&model.c) * states + complex(&model.d);
    let is_finite = |x: &Complex<f64>| x.re.is_finite() && x.im.is_finite();
    response.iter().all(is_finite).then_some(response)
}
