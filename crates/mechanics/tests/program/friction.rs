//! Machines whose contacts stick and slide: the proof covers the dependence on the
//! friction forces, whatever these are.

use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::prove;
use lagrangian_program::{FrictionLayout, Op, Role};

use crate::harness::{compiled, machine};
use crate::machines::assert_proved;

/// A follower between two walls on a wedge that a spring and an input move; a block on the follower,
/// which shakes; a belt that turns.
const GUIDED: &str = "machine Guided in plane {
    parameters {
        m: kg = 1, M: kg = 2, J: kg*m^2 = 0.1, alpha: rad = 0.4, mu: 1 = 0.2, nu: 1 = 0.1, g: m/s^2 = 9.81,
        k: N/m = 30, b: N*s/m = 0.3, a: m = 0.1, w: rad/s = 3, v0: m/s = 0.2, l: m = 0.5,
    }
    coordinates { x: m, y: m, s: m, phi: rad, z: m }
    inputs { F: N = 1 }
    frames {
        wedge = ground.shift(x, 0),
        follower = ground.shift(0, x*tan(alpha)),
        shelf = follower.turn(a*sin(w*t)/l),
        box = shelf.shift(s, 0.2*l),
        belt = ground.turn((w*t)^2/2).shift(v0*t, 0),
        chest = ground.turn((w*t)^2/2).shift(y, 0),
        arm = chest.turn(phi),
    }
    bodies {
        wedge { mass: M, frame: wedge }, follower { mass: m, inertia: J, frame: follower },
        box { mass: m, inertia: J, frame: box }, chest { mass: M, inertia: J, frame: chest },
        hand { mass: m, inertia: J, at: arm.point(l, 0), frame: arm },
        puck { mass: m, at: (z, 0) + l*direction(alpha) },
    }
    gravity (0, -g);
    springs { tie { stiffness: k, from: box.at, to: hand.at, length: l } }
    dampers { drag { damping: b, from: wedge.at, to: puck.at } }
    forces { push { at: hand.at, force: (F, F/2) } }
    sliding {
        face { body: follower, on: wedge, direction: (-cos(alpha), sin(alpha)), friction: mu },
        slot { body: follower, on: ground, direction: (0, 1), friction: nu },
        shelf { body: box, on: shelf, direction: shelf.vector(1, 0), friction: mu*(1 + der(s)^2/v0^2) },
        belt { body: chest, on: belt, direction: belt.vector(2, 0), friction: mu, static_friction: 2*mu },
        ice { body: puck, on: ground, direction: (1, 0), normal: (0, -1), friction: nu },
    }
}";

/// A cart with a pendulum on a rod, and a slider that a crank drives in a slot.
const HELD: &str = "machine Held in plane {
    parameters {
        M: kg = 2, m: kg = 1, l: m = 1, r: m = 0.3, J: kg*m^2 = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81,
    }
    coordinates { x: m, a: m = 0.6, b: m = -0.8, theta: rad = 0.4, s: m = 1.2 }
    frames { cart = ground.shift(x, 0), slider = ground.shift(s, 0.1*l) }
    bodies {
        cart { mass: M, frame: cart }, bob { mass: m, at: (a, b) },
        crank { mass: m, inertia: J, at: polar(r/2, theta), angle: theta },
        slider { mass: m, frame: slider },
    }
    gravity (0, -g);
    constraints {
        rod: norm(bob.at - cart.at) = l,
        coupler: norm(slider.origin - polar(r, theta)) = l,
        speed: der(theta) = 2 + der(b)/l,
    }
    sliding {
        rail { body: cart, on: ground, direction: (1, 0), friction: mu },
        slot { body: slider, on: ground, direction: (1, 0), friction: mu },
    }
}";

#[test]
fn accelerations_multipliers_and_reactions_are_right_with_any_friction() {
    for text in [GUIDED, HELD] {
        compiled(text, &[], assert_proved);
    }
}

#[test]
fn the_contacts_of_the_library_are_proved() {
    for name in [
        "bead_in_shell",
        "bead_on_helix",
        "bead_on_hoop",
        "prisms",
        "puck_in_slot",
        "wedge_and_block",
        "block_on_incline",
        "stick_slip",
    ] {
        machine(name, &[], assert_proved);
    }
}

/// The proof finds a program with a wrong sign.
#[test]
fn a_wrong_sign_in_what_friction_does_is_found() {
    compiled(GUIDED, &[], |machine| {
        let oracle = Oracle::derive(&machine.model);
        let mut found = 0;
        let function = machine
            .program
            .function(Role::Friction)
            .expect("it is there");
        let layout = FrictionLayout {
            coordinates: 5,
            constraints: 0,
            contacts: 5,
            axes: 1,
        };
        assert_eq!(function.results.len(), layout.len());
        // Rounding errors are 0 in exact arithmetic, which sees no wrong sign of them.
        let is_error =
            |value| matches!(function.op(value), Op::ProductError(..) | Op::SumError(..));
        let corrects = |value| is_error(value) || function.op(value).operands().any(is_error);
        for (place, op) in function.code.iter().enumerate().step_by(4) {
            let turned = match *op {
                Op::Add(a, b) if !corrects(a) && !corrects(b) => Op::Sub(a, b),
                Op::Sub(a, b) if !corrects(a) && !corrects(b) => Op::Add(a, b),
                _ => continue,
            };
            let mut wrong = machine.program.clone().into_program();
            for function in &mut wrong.functions {
                if function.role == Role::Friction {
                    function.code[place] = turned.clone();
                }
            }
            assert!(prove(&wrong, &machine.model, &oracle).is_err(), "{place}");
            found += 1;
        }
        assert!(found > 15, "{found}");
    });
}
