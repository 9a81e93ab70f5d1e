//! Steps from frame to frame: shifts along axes, and turns about them.

use super::number::{Angle, Number};

/// The axes of a frame.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// A product that a person would not write out: nothing, the thing itself, or its negative.
fn scaled(factor: f64, value: &str) -> String {
    match factor {
        0.0 => "0".to_owned(),
        1.0 => value.to_owned(),
        -1.0 => format!("-{value}"),
        _ => format!("{}*{value}", Number::computed(factor)),
    }
}

/// The step along an axis.
pub fn slide(axis: &[f64; 3], value: &str) -> String {
    let [x, y, z] = axis.map(|factor| scaled(factor, value));
    format!(".shift({x}, {y}, {z})")
}

/// The turn about any axis: about one of the frame's own, between turns that lead there and back.
pub fn turn(axis: &[f64; 3], value: &str) -> Vec<String> {
    let (there, own, sign) = straightened(axis);
    conjugated(&there, vec![format!(".turn({}, {sign}{value})", AXES[own])])
}

/// Steps between constant turns and those back.
pub fn conjugated(there: &[(usize, Angle)], steps: Vec<String>) -> Vec<String> {
    let step = |axis: usize, angle: &Angle| format!(".turn({}, {angle})", AXES[axis]);
    let lead = there.iter().map(|(axis, angle)| step(*axis, angle));
    let back = there
        .iter()
        .rev()
        .map(|(axis, angle)| step(*axis, &angle.negated()));
    lead.chain(steps).chain(back).collect()
}

/// Constant turns that lead one of a frame's own axes to a unit vector: the turns, the axis, and `-` where it leads to its
/// opposite.
pub fn straightened(axis: &[f64; 3]) -> (Vec<(usize, Angle)>, usize, &'static str) {
    let [x, y, z] = *axis;
    let of = Angle::computed;
    for (own, along) in axis.iter().enumerate() {
        if along.abs() == 1.0 && axis.iter().filter(|x| **x != 0.0).count() == 1 {
            return (Vec::new(), own, if *along < 0.0 { "-" } else { "" });
        }
    }
    let (there, own) = match (x == 0.0, y == 0.0, z == 0.0) {
        // The turn about x takes z to (0, -sin, cos).
        (true, ..) => (vec![(0, of((-y).atan2(z)))], 2),
        (_, true, _) => (vec![(1, of(x.atan2(z)))], 2),
        (.., true) => (vec![(2, of(y.atan2(x)))], 0),
        // First about z, then about y, take z to (sin β cos α, sin β sin α, cos β).
        _ => (vec![(2, of(y.atan2(x))), (1, of(x.hypot(y).atan2(z)))], 2),
    };
    (there, own, "")
}
