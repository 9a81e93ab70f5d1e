//! Steps and evaluations depending on the stiffness of a machine, by `radau5` and by the default method.
//!
//! `cargo bench --bench stiffness` prints a table. It counts steps and times nothing, so the numbers are the same
//! on every computer, up to the effect of rounding on a step.

use lagrangian::{Error, METHODS, Method, Simulation};

lagrangian::machine! {
    /// A slider-crank on an elastic shaft: a flywheel drives the crank by a spring and a damper.
    machine ShaftDrive in plane {
        parameters {
            a: m = 0.15, b: m = 0.35,
            m1: kg = 0.5, m2: kg = 0.8, m3: kg = 1.2,
            J0: kg*m^2 = 0.5, J1: kg*m^2 = 1e-3, J2: kg*m^2 = 8e-3,
            k: N*m = 100, settling: s = 0.01, g: m/s^2 = 9.81, omega: rad/s = 20,
        }
        coordinates {
            /// Angles of flywheel, crank and rod from the rail.
            psi: rad = pi/2, theta: rad = pi/2, phi: rad = -asin(a/b),
            /// Position of the slider.
            s: m = sqrt(b^2 - a^2),
            der(psi): rad/s = omega, der(theta): rad/s = omega, der(s): m/s = -a*omega,
        }
        assume { cos(phi) > 0 }
        bodies {
            flywheel { mass: m1, inertia: J0, at: (0, 0), angle: psi },
            crank  { mass: m1, inertia: J1, at: polar(a/2, theta), angle: theta },
            rod    { mass: m2, inertia: J2, at: polar(a, theta) + polar(b/2, phi), angle: phi },
            slider { mass: m3, at: (s, 0) },
        }
        gravity (0, -g);
        torsion_springs { shaft { stiffness: k, twist: theta - psi } }
        dissipations { shaft: settling*k*(der(theta) - der(psi))^2/2 }
        constraints {
            along:  a*cos(theta) + b*cos(phi) = s,
            across: a*sin(theta) + b*sin(phi) = 0,
        }
    }
}

/// A run that needs more steps is given up.
const MOST_STEPS: usize = 2_000_000;

fn main() {
    println!("| k [N m] | method | steps | given up | evaluations | greatest residual |");
    println!("| --: | --- | --: | --: | --: | --: |");
    for k in [1e2, 1e4, 1e6, 1e8, 1e10] {
        let machine = ShaftDrive {
            k,
            ..Default::default()
        };
        for method in METHODS.first().into_iter().chain(Method::named("radau5")) {
            let run = Simulation::new(&machine)
                .method(method)
                .tolerance(1e-8)
                .max_steps(MOST_STEPS)
                .forget_steps()
                .until(2.0)
                .run(machine.start());
            let name = method.tableau.name;
            match run {
                Ok(run) => {
                    let work = run.statistics();
                    println!(
                        "| {k:.0e} | {name} | {} | {} | {} | {:.0e} |",
                        work.steps, work.rejected, work.evaluations, work.constraint_residual
                    );
                }
                Err(Error::TooManySteps { t, .. }) => {
                    println!("| {k:.0e} | {name} | {MOST_STEPS} to t = {t:.1e} s | | | |");
                }
                Err(error) => println!("| {k:.0e} | {name} | {error} | | | |"),
            }
        }
    }
}
