//! Machines with frames that are turned by four numbers: their programs by every way that there is, against Lagrange's equations.

use crate::harness::{compiled, differentiated};
use crate::machines::assert_proved;

/// A body that floats, with an arm on a hinge that a spring holds and a damper brakes.
const FLOATING: &str = "machine Floating in space {
    parameters { m: kg = 3, M: kg = 1, l: m = 0.3, k: N*m = 2, c: N*m*s = 0.1, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m, z: m, e[0]: 1 = 1, e[1..3]: 1, phi: rad }
    frames { body = ground.shift(x, y, z).turn(e[0], e[1], e[2], e[3]), arm = body.shift(0.1, 0, 0).turn(y, phi) }
    bodies {
        body { mass: m, inertia: (0.1, 0.2, 0.3, 0.01, 0, 0.02), frame: body },
        arm { mass: M, inertia: (0.01, 0.01, 0.001), frame: arm, at: arm.point(0, 0, -l) },
    }
    gravity (0, 0, -g);
    torsion_springs { hinge { stiffness: k, twist: phi } }
    dissipations { hinge: c/2*der(phi)^2 }
}";

/// Two bodies on ball joints, on a ground that turns by itself; what brakes them depends on how they turn, and a torque on how they are
/// turned.
const CHAIN: &str = "machine Chain in space {
    parameters { m: kg = 1, l: m = 0.3, w: rad/s = 2, c: N*m*s = 0.1, k: N*m = 0.3, g: m/s^2 = 9.81 }
    coordinates { e[0]: 1 = 1, e[1..3]: 1, f[0]: 1 = 1, f[1..3]: 1 }
    frames {
        base = ground.shift(l*sin(w*t), 0, 0).turn(z, w*t),
        upper = base.turn(e[0], e[1], e[2], e[3]),
        lower = upper.shift(0, 0, -l).turn(f[0], f[1], f[2], f[3]),
    }
    bodies {
        upper { mass: m, inertia: (0.1, 0.2, 0.3), frame: upper, at: upper.point(0, 0.1, -l) },
        lower { mass: m, inertia: (0.01, 0.01, 0.001), frame: lower, at: lower.point(0, 0, -l) },
    }
    gravity (0, 0, -g);
    dissipations { air: c/2*dot(upper.spin, upper.spin)*(1 + dot(upper.spin, upper.spin)*(1*s)^2) }
    torques { holds { on: lower, torque: -k*lower.vector(f[1], f[2], f[3]) } }
}";

/// Particles at places that no frame has, and a constraint.
const LOOSE: &str = "machine Loose in space {
    parameters { m: kg = 1, l: m = 0.3, g: m/s^2 = 9.81 }
    coordinates { x: m, e[0]: 1 = 1, e[1..3]: 1 }
    frames { body = ground.shift(x, 0, 0).turn(e[0], e[1], e[2], e[3]) }
    bodies {
        body { mass: m, inertia: (0.1, 0.2, 0.3), frame: body },
        drop { mass: m, at: (x, dot(body.vector(0, l, 0), (0, 1, 0)), dot(body.vector(0, l, 0), (1, 0, 0))) },
    }
    gravity (0, 0, -g);
    constraints { level: dot(body.vector(0, 0, 1), (1, 0, 0)) = 0 }
}";

#[test]
fn machines_on_quaternions_obey_lagranges_equations() {
    for text in [FLOATING, CHAIN, LOOSE] {
        compiled(text, &[], assert_proved);
    }
}

/// Derivatives of accelerations know of the lengths what these know.
#[test]
fn derivatives_on_quaternions_are_those_of_the_accelerations() {
    differentiated(FLOATING, &[], assert_proved);
}
