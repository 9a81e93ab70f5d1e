//! Tests of least squares against certified values and closed forms.

mod combinations;
mod motion;
mod nist;
