//! Machines with frames oriented by four numbers (quaternions): all candidates of their programs, compared with Lagrange's equations.

use crate::harness::{compiled, differentiated};
use crate::machines::assert_proved;
use lagrangian_program::Role;

/// A floating body with an arm on a hinge, which has a spring and a damper.
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

/// Two bodies on ball joints, on a ground that rotates in time; the damping depends on their angular velocity, and a torque on their orientation.
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

/// Particles at places that are points of no frame, and a constraint.
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

/// Derivatives of the accelerations use the unit length of the quaternions as the accelerations do.
#[test]
fn derivatives_on_quaternions_are_those_of_the_accelerations() {
    differentiated(FLOATING, &[], assert_proved);
}

/// A loop: two arms on ball joints with a common tip.
const LOOP: &str = "machine Loop in space {
    parameters { m: kg = 1, l: m = 0.3, c: N*m*s = 0.1, g: m/s^2 = 9.81 }
    coordinates { e[0]: 1 = 1, e[1..3]: 1, f[0]: 1 = 1, f[1..3]: 1, phi: rad = 0.3, psi: rad = -0.2 }
    frames {
        upper = ground.turn(e[0], e[1], e[2], e[3]),
        lower = upper.shift(0, 0, -l).turn(x, phi),
        other = ground.shift(l, 0.1, 0).turn(f[0], f[1], f[2], f[3]),
        tip = other.shift(0, 0, -l).turn(y, psi),
    }
    bodies {
        upper { mass: m, inertia: (0.1, 0.2, 0.3), frame: upper, at: upper.point(0, 0.1, -l) },
        lower { mass: m, inertia: (0.01, 0.01, 0.001), frame: lower, at: lower.point(0, 0, -l) },
        other { mass: m, inertia: (0.1, 0.1, 0.03), frame: other, at: other.point(0.1, 0, -l) },
        tip { mass: m, inertia: (0.01, 0.02, 0.001), frame: tip, at: tip.point(0, 0, -l) },
    }
    gravity (0, 0, -g);
    dampers { hinge { damping: c, stretch: phi } }
    constraints {
        x: dot(lower.point(0, 0, -l) - tip.point(0, 0, -l), (1, 0, 0)) = 0,
        y: dot(lower.point(0, 0, -l) - tip.point(0, 0, -l), (0, 1, 0)) = 0,
        z: dot(lower.point(0, 0, -l) - tip.point(0, 0, -l), (0, 0, 1)) = 0,
    }
}";

/// A robot of eight joints on a floating base; the text of the base's coordinates and rotation steps is given.
fn robot(turn: [&str; 2]) -> String {
    let [coordinates, steps] = turn;
    let joints: String = (1..=8).map(|k| format!("q{k}: rad = 0.{k}, ")).collect();
    let mut frames = format!("base = ground.shift(x, y, z){steps}");
    let mut bodies = String::from(
        "base { mass: 3, inertia: (0.1, 0.2, 0.3), frame: base, at: base.point(0.01, 0, 0.02) }",
    );
    for k in 1..=8 {
        // Two limbs of four joints.
        let above = match k {
            1 | 5 => "base".to_owned(),
            _ => format!("link{}", k - 1),
        };
        let axis = ["x", "y", "z"][k % 3];
        frames.push_str(&format!(
            ", link{k} = {above}.shift(0.1, 0.0{k}, -0.2).turn({axis}, q{k})"
        ));
        bodies.push_str(&format!(
            ", link{k} {{ mass: 0.{k}, inertia: (0.01, 0.02, 0.015), frame: link{k}, at: link{k}.point(0, 0.01, -0.1) }}"
        ));
    }
    format!(
        "machine Robot in space {{ coordinates {{ x: m, y: m, z: m, {coordinates}, {joints} }} frames {{ {frames} }} \
         bodies {{ {bodies} }} gravity (0, 0, -9.81); derivatives {{ coordinates, rates }} }}"
    )
}

#[test]
fn loops_and_stages_on_quaternions_are_proved_too() {
    compiled(LOOP, &[], assert_proved);
    differentiated(CHAIN, &[], assert_proved);
    for text in [FLOATING, CHAIN] {
        let end = text.rfind('}').expect("a machine");
        for stages in ["stages { time, coordinates }", "stages { coordinates }"] {
            compiled(&format!("{} {stages} }}", &text[..end]), &[], assert_proved);
        }
    }
}

/// Two limbs of joints, each from a ball joint to a common tip.
fn closed(joints: usize) -> String {
    let mut coordinates = String::from("e[0]: 1 = 1, e[1..3]: 1, f[0]: 1 = 1, f[1..3]: 1");
    let mut frames = String::from(
        "one0 = ground.turn(e[0], e[1], e[2], e[3]), two0 = ground.shift(1, 0.1, 0).turn(f[0], f[1], f[2], f[3])",
    );
    let mut bodies = String::new();
    for limb in ["one", "two"] {
        for k in 0..=joints {
            if k > 0 {
                let axis = ["x", "y", "z"][k % 3];
                coordinates.push_str(&format!(", q_{limb}{k}: rad = 0.{k}"));
                let above = k - 1;
                frames.push_str(&format!(
                    ", {limb}{k} = {limb}{above}.shift(0.1, 0.0{k}, -0.2).turn({axis}, q_{limb}{k})"
                ));
            }
            bodies.push_str(&format!(
                "{limb}{k} {{ mass: 0.{}, inertia: (0.01, 0.02, 0.015), frame: {limb}{k}, at: {limb}{k}.point(0, 0.01, -0.1) }}, ",
                k + 1
            ));
        }
    }
    let apart = format!("one{joints}.point(0, 0, -0.2) - two{joints}.point(0, 0, -0.3)");
    format!(
        "machine Closed in space {{ coordinates {{ {coordinates} }} frames {{ {frames} }} bodies {{ {bodies} }} gravity (0, 0, -9.81); \
         constraints {{ x: dot({apart}, (1, 0, 0)) = 0, y: dot({apart}, (0, 1, 0)) = 0, z: dot({apart}, (0, 0, 1)) = 0 }} }}"
    )
}

/// In a loop, too, a rotation has three columns of velocities, not four. Eliminated in
/// the rates of the four numbers, the accelerations of this one took 7870 operations.
#[test]
fn loops_are_eliminated_in_the_velocities_of_turns() {
    let text = closed(4);
    let count = compiled(&text, &[], |machine| {
        assert_proved(machine);
        let function = machine.program.function(Role::Accelerations);
        function.expect("it is there").counts().ops()
    });
    assert!(count <= 7350, "{count}");
}

/// A base on a quaternion costs the same as one on angles, within a twentieth. With derivatives by coordinates and rates it costs at most four tenths more,
/// since eight of the columns are by the four numbers and their rates, none of which leaves a part of the machine unchanged, as yaw does.
#[test]
fn a_robot_on_a_quaternion_costs_what_one_on_angles_does() {
    let count = |turn: [&str; 2]| -> [usize; 2] {
        compiled(&robot(turn), &[], |machine| {
            [Role::Accelerations, Role::Derivatives].map(|role| {
                let function = machine.program.function(role).expect("it is asked for");
                function.counts().ops()
            })
        })
    };
    let four = count(["e[0]: 1 = 1, e[1..3]: 1", ".turn(e[0], e[1], e[2], e[3])"]);
    let three = count([
        "yaw: rad, pitch: rad, roll: rad",
        ".turn(z, yaw).turn(y, pitch).turn(x, roll)",
    ]);
    assert!(four[0] * 20 <= three[0] * 21, "{four:?} {three:?}");
    assert!(four[1] * 10 <= three[1] * 14, "{four:?} {three:?}");
}
