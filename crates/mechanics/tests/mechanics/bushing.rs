//! Bushings, compared with equations typed in by hand.

use crate::by_hand::{assert_agreement, mutate};
use crate::harness::derived;

/// A part on an arm that turns: the forces of the bushing turn with the arm and react on it.
const TURNING: &str = r#"
machine Mounted in plane {
    parameters {
        m: kg = 3, J: kg*m^2 = 0.2, I: kg*m^2 = 0.5,
        kx: N/m = 400, ky: N/m = 900, kphi: N*m = 30,
        bx: N*s/m = 2, by: N*s/m = 3, bphi: N*m*s = 0.1,
        Fx: N = 5, Fy: N = -7, M: N*m = 0.3,
    }
    coordinates { theta: rad = 0.2, x: m = 0.5, y: m, phi: rad = 0.1 }
    frames { arm = ground.turn(theta), part = ground.shift(x, y).turn(phi) }
    bodies {
        arm { mass: 1, inertia: I, frame: arm },
        part { mass: m, inertia: J, frame: part },
    }
    bushings {
        mount {
            from: arm, to: part,
            stiffness: (kx, ky, kphi), damping: (bx, by, bphi), preload: (Fx, Fy, M),
        }
    }
    define {
        p = cos(theta)*x + sin(theta)*y,
        s = cos(theta)*y - sin(theta)*x,
        p_rate = cos(theta)*der(x) + sin(theta)*der(y) + s*der(theta),
        s_rate = cos(theta)*der(y) - sin(theta)*der(x) - p*der(theta),
        along = kx*p + bx*p_rate - Fx,
        across = ky*s + by*s_rate - Fy,
        about = kphi*(phi - theta) + bphi*(der(phi) - der(theta)) - M,
    }
    published "by hand" {
        potential_energy = 1/2*kx*p^2 + 1/2*ky*s^2 + 1/2*kphi*(phi - theta)^2
            - Fx*p - Fy*s - M*(phi - theta),
        dissipation = 1/2*bx*p_rate^2 + 1/2*by*s_rate^2 + 1/2*bphi*(der(phi) - der(theta))^2,
        equation theta: I*der(der(theta)) + along*s - across*p = about,
        equation x: m*der(der(x)) + along*cos(theta) - across*sin(theta) = 0,
        equation y: m*der(der(y)) + along*sin(theta) + across*cos(theta) = 0,
        equation phi: J*der(der(phi)) + about = 0,
    }
}
"#;

/// A slider on a platform: the bushing depends on the slider's displacement relative to the platform, and
/// not on the platform's motion.
const CARRIED: &str = r#"
machine Carried in plane {
    parameters {
        m: kg = 3, J: kg*m^2 = 0.2, h: m = 0.1,
        kx: N/m = 400, ky: N/m = 900, kphi: N*m = 30, bx: N*s/m = 2, bphi: N*m*s = 0.1,
        Fx: N = 5, Fy: N = -7,
    }
    coordinates { x: m, y: m, theta: rad, s: m = 0.2, psi: rad = 0.3 }
    frames {
        platform = ground.shift(x, y).turn(theta),
        slider = platform.shift(s, h).turn(psi),
    }
    bodies {
        platform { mass: m, inertia: J, frame: platform },
        slider { mass: m, inertia: J, frame: slider },
    }
    bushings {
        mount {
            from: platform, to: slider,
            stiffness: (kx, ky, kphi), damping: (bx, 0, bphi), preload: (Fx, Fy, 0),
        }
    }
    published "by hand" {
        potential_energy = 1/2*kx*s^2 + 1/2*ky*h^2 + 1/2*kphi*psi^2 - Fx*s - Fy*h,
        dissipation = 1/2*bx*der(s)^2 + 1/2*bphi*der(psi)^2,
        force x = 0,
        force y = 0,
        force theta = 0,
        force s = Fx - kx*s - bx*der(s),
        force psi = -kphi*psi - bphi*der(psi),
    }
}
"#;

#[test]
fn a_bushing_on_a_turning_arm_is_what_is_typed_by_hand() {
    assert_agreement(TURNING, 6);
}

#[test]
fn every_wrong_sign_and_coefficient_of_a_bushing_is_found() {
    let (made, survivors) = mutate(TURNING);
    assert!(survivors.is_empty(), "not found: {survivors:?}");
    assert!(made >= 60, "{made} mutants");
}

#[test]
fn a_bushing_knows_nothing_of_what_carries_both_its_frames() {
    assert_agreement(CARRIED, 7);
    derived(CARRIED, |model, equations| {
        // No sine of the platform's angle is left that would have to cancel.
        let loads = &equations.applied;
        assert!(loads[..3].iter().all(|load| load.is_zero()));
        let angle = model.coordinates[2].q.as_symbol().expect("a symbol");
        assert!(!loads.iter().any(|load| load.depends_on(angle)));
    });
}

/// A bushing with a single stiffness gives the same loads as a spring.
#[test]
fn a_bushing_of_one_stiffness_is_a_spring() {
    let machine = |element: &str| {
        format!(
            "machine Slider in plane {{
                parameters {{ m: kg = 3, k: N/m = 400 }}
                coordinates {{ x: m = 0.1, y: m }}
                frames {{ slider = ground.shift(x, y) }}
                bodies {{ slider {{ mass: m, at: slider.origin }} }}
                {element}
            }}"
        )
    };
    let shown = |element: &str| {
        derived(&machine(element), |_, equations| {
            let all = equations.applied.iter().map(|load| load.to_string());
            all.collect::<Vec<_>>()
        })
    };
    assert_eq!(
        shown("bushings { a { from: ground, to: slider, stiffness: (0, k, 0) } }"),
        shown("springs { a { stiffness: k, stretch: y } }"),
    );
}
