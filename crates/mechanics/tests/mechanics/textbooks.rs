//! The machines of the library compared with equations of textbooks, typed in by hand; and the
//! comparison finds one wrong sign, coefficient or power anywhere in them.

use lagrangian_mechanics::Equations;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use crate::by_hand::{assert_agreement, mutate};
use crate::harness::{derived, residues, text_of};

/// L. D. Landau, E. M. Lifshitz, *Mechanics*, 3rd ed. 1976, section 11, problem 1.
const SIMPLE_PENDULUM: &str = r#"
machine Textbook extends "simple_pendulum.machine" {
    published "Landau, Lifshitz" {
        kinetic_energy = 1/2*m*l^2*der(theta)^2,
        potential_energy = -m*g*l*cos(theta),
        position bob = (l*sin(theta), -l*cos(theta)),
        equation theta: der(der(theta)) + g/l*sin(theta) = 0,
    }
}
"#;

/// A. H. Nayfeh, D. T. Mook, *Nonlinear Oscillations*, 1979, ch. 6 (spring pendulum).
const ELASTIC_PENDULUM: &str = r#"
machine Textbook extends "elastic_pendulum.machine" {
    published "Nayfeh, Mook" {
        kinetic_energy = 1/2*m*(der(r)^2 + r^2*der(theta)^2),
        potential_energy = 1/2*k*(r - l0)^2 - m*g*r*cos(theta),
        equation r: der(der(r)) - r*der(theta)^2 + k/m*(r - l0) - g*cos(theta) = 0,
        equation theta: r^2*der(der(theta)) + 2*r*der(r)*der(theta) + g*r*sin(theta) = 0,
    }
}
"#;

/// L. D. Landau, E. M. Lifshitz, *Mechanics*, section 14, problem 1.
const SPHERICAL_PENDULUM: &str = r#"
machine Textbook extends "spherical_pendulum.machine" {
    published "Landau, Lifshitz" {
        position bob = (l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta)),
        kinetic_energy = 1/2*m*l^2*(der(theta)^2 + sin(theta)^2*der(phi)^2),
        potential_energy = -m*g*l*cos(theta),
        equation theta: der(der(theta)) - sin(theta)*cos(theta)*der(phi)^2 + g/l*sin(theta) = 0,
        equation phi: sin(theta)^2*der(der(phi)) + 2*sin(theta)*cos(theta)*der(theta)*der(phi) = 0,
    }
}
"#;

/// L. D. Landau, E. M. Lifshitz, *Mechanics*, section 5, problem 3 (c), with the angle from the
/// upward vertical and with the total time derivatives that they drop left out as well.
const KAPITZA_PENDULUM: &str = r#"
machine Textbook extends "kapitza_pendulum.machine" {
    published "Landau, Lifshitz" {
        kinetic_energy = 1/2*m*l^2*der(theta)^2 + m*l*a*omega*sin(omega*t)*sin(theta)*der(theta)
            + 1/2*m*a^2*omega^2*sin(omega*t)^2,
        potential_energy = m*g*(l*cos(theta) + a*cos(omega*t)),
        equation theta: der(der(theta)) = (g/l - a*omega^2/l*cos(omega*t))*sin(theta),
    }
}
"#;

/// L. Brillouin, *Wave Propagation in Periodic Structures*, 1946 (monatomic lattice), with free
/// ends and an engine.
const SPRING_MASS_TRAIN: &str = r#"
machine Textbook extends "spring_mass_train.machine" {
    published "Brillouin" {
        equation u[1]: m*der(der(u[1])) = k*(u[2] - u[1]),
        equation u[i in 2..N-1]: m*der(der(u[i])) = k*(u[i+1] + u[i-1] - 2*u[i]),
        equation u[N]: m*der(der(u[N])) = k*(u[N-1] - u[N]) + pull,
    }
}
"#;

/// H. Goldstein, C. Poole, J. Safko, *Classical Mechanics*, 3rd ed. 2002, sections 3.1 and 3.2,
/// with the reduced mass.
const TWO_BODY_ORBIT: &str = r#"
machine Textbook extends "two_body_orbit.machine" {
    published "Goldstein" {
        kinetic_energy = 1/2*m1*m2/(m1 + m2)*(der(r)^2 + r^2*der(phi)^2),
        potential_energy = -G*m1*m2/r,
        equation r: m1*m2/(m1 + m2)*(der(der(r)) - r*der(phi)^2) + G*m1*m2/r^2 = 0,
        equation phi: r^2*der(der(phi)) + 2*r*der(r)*der(phi) = 0,
    }
}
"#;

/// Yaw, pitch and roll of J. Wittenburg, *Dynamics of Multibody Systems*, 2nd ed. 2008, ch. 2
/// (Bryan angles, in the order z y x): the angular velocity along the body's axes; and L. Euler's
/// equations, projected on the axes about which the angles turn.
const ASYMMETRIC_TOP: &str = r#"
machine Textbook extends "asymmetric_top.machine" {
    define {
        w1 = der(roll) - der(yaw)*sin(pitch),
        w2 = der(pitch)*cos(roll) + der(yaw)*cos(pitch)*sin(roll),
        w3 = der(yaw)*cos(pitch)*cos(roll) - der(pitch)*sin(roll),
        // Euler's equations: torques about the body's axes, which are 0.
        n1 = A*der(w1) - (B - C)*w2*w3,
        n2 = B*der(w2) - (C - A)*w3*w1,
        n3 = C*der(w3) - (A - B)*w1*w2,
    }
    published "Wittenburg" {
        kinetic_energy = 1/2*(A*w1^2 + B*w2^2 + C*w3^2),
        equation roll: n1 = 0,
        equation pitch: n2*cos(roll) - n3*sin(roll) = 0,
        equation yaw: n2*cos(pitch)*sin(roll) + n3*cos(pitch)*cos(roll) - n1*sin(pitch) = 0,
    }
}
"#;

/// M. W. Spong, S. Hutchinson, M. Vidyasagar, *Robot Modeling and Control*, 2006, ch. 7 (planar
/// elbow manipulator).
const TWO_JOINT_ARM: &str = r#"
machine Textbook extends "two_joint_arm.machine" {
    define {
        d11 = m1*c1^2 + m2*(l1^2 + c2^2 + 2*l1*c2*cos(q2)) + J1 + J2,
        d12 = m2*(c2^2 + l1*c2*cos(q2)) + J2,
        d22 = m2*c2^2 + J2,
        h = -m2*l1*c2*sin(q2),
        phi1 = (m1*c1 + m2*l1)*g*cos(q1) + m2*c2*g*cos(q1 + q2),
        phi2 = m2*c2*g*cos(q1 + q2),
    }
    published "Spong, Hutchinson, Vidyasagar" {
        kinetic_energy = 1/2*d11*der(q1)^2 + d12*der(q1)*der(q2) + 1/2*d22*der(q2)^2,
        force q1 = tau1 - phi1,
        force q2 = tau2 - phi2,
        equation q1: d11*der(der(q1)) + d12*der(der(q2))
            + 2*h*der(q1)*der(q2) + h*der(q2)^2 + phi1 = tau1,
        equation q2: d12*der(der(q1)) + d22*der(der(q2)) - h*der(q1)^2 + phi2 = tau2,
    }
}
"#;

/// K. Magnus, *Kreisel*, 1971 (gyroscope in gimbals), with the inclination measured from the
/// horizontal and a weight.
const GYROSCOPE_IN_GIMBALS: &str = r#"
machine Textbook extends "gyroscope_in_gimbals.machine" {
    define {
        across = C2 + A3 + w*d^2,
        about = A2 + A3 + w*d^2,
        s = der(gamma) + der(alpha)*sin(beta),
    }
    published "Magnus" {
        kinetic_energy = 1/2*(A1 + B2*sin(beta)^2 + across*cos(beta)^2)*der(alpha)^2
            + 1/2*about*der(beta)^2 + 1/2*C3*s^2,
        potential_energy = w*g*d*sin(beta),
        equation beta: about*der(der(beta)) + (across - B2)*sin(beta)*cos(beta)*der(alpha)^2
            - C3*s*cos(beta)*der(alpha) + w*g*d*cos(beta) = 0,
        equation gamma: C3*der(s) = 0,
        equation alpha: (A1 + B2*sin(beta)^2 + across*cos(beta)^2)*der(der(alpha))
            + 2*(B2 - across)*sin(beta)*cos(beta)*der(alpha)*der(beta)
            + C3*der(s)*sin(beta) + C3*s*cos(beta)*der(beta) = 0,
    }
}
"#;

/// Each machine, the number of items that it publishes, and the least number of
/// mistakes that can be made in these.
const ALL: [(&str, usize, usize); 9] = [
    (SIMPLE_PENDULUM, 4, 15),
    (ELASTIC_PENDULUM, 4, 30),
    (SPHERICAL_PENDULUM, 5, 30),
    (KAPITZA_PENDULUM, 3, 30),
    (SPRING_MASS_TRAIN, 8, 60),
    (TWO_BODY_ORBIT, 4, 25),
    (ASYMMETRIC_TOP, 4, 150),
    (TWO_JOINT_ARM, 5, 100),
    (GYROSCOPE_IN_GIMBALS, 5, 100),
];

#[test]
fn the_equations_of_the_library_are_the_textbooks() {
    for (text, items, _) in ALL {
        assert_agreement(text, items);
    }
}

#[test]
fn a_mistake_in_a_textbook_is_found() {
    for (text, _, least) in ALL {
        let (made, survivors) = mutate(text);
        assert!(survivors.is_empty(), "not found: {survivors:?} in {text}");
        assert!(made >= least, "{made} mutants of {text}");
    }
}

/// The bias is `C v` with Christoffel's symbols, `Cᵢⱼ = Σₖ ½ (∂Mᵢⱼ/∂qₖ + ∂Mᵢₖ/∂qⱼ − ∂Mⱼₖ/∂qᵢ) vₖ`.
/// This choice of C makes `Ṁ − 2 C` skew-symmetric, so that the arm is passive.
#[test]
fn the_arms_bias_is_that_of_christoffels_symbols() {
    derived(&text_of("two_joint_arm"), |model, equations| {
        for (row, &exact) in christoffel(model, equations).iter().zip(&equations.bias) {
            let rates = model.coordinates.iter().map(|coordinate| coordinate.v);
            let bias = row.iter().zip(rates).map(|(&c, v)| c * v);
            let both = [model.dag.sum(bias), exact];
            for values in residues(model, equations, &both, false) {
                assert_eq!(values[0], values[1]);
            }
        }
    });
}

fn christoffel<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Vec<Expr<'d>>> {
    let n = model.coordinates.len();
    let slope = |i, j, k: usize| {
        let q = model.coordinates[k].q.as_symbol().expect("a symbol");
        equations.mass_matrix.get(i, j).diff(q)
    };
    let entry = |i, j| {
        let terms = (0..n).map(|k| {
            (slope(i, j, k) + slope(i, k, j) - slope(j, k, i)) * model.coordinates[k].v / 2
        });
        model.dag.sum(terms)
    };
    (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect()
}
