//! The cost of runs in `f64`: the processor time of the best of many runs, in microseconds, and a checksum over the bits of the end
//! state, for comparing two versions of the library.
//!
//! ```sh
//! cargo bench --bench steps
//! ```
//!
//! With a name and a count as arguments, only that run is made, that many times: `valgrind --tool=callgrind` counts the
//! instructions of a program that runs once, and of one that runs six times.

mod timing;

use std::hint::black_box;

use lagrangian::{Machine, Method, Simulation, Stepper, Vector};
use lagrangian_machines::{CartPole, DoublePendulum, FourBars, VibratingCrusher};

/// The runs that the command line selects, and how often each is made.
struct Wanted {
    name: Option<String>,
    times: usize,
}

impl Wanted {
    /// Prints the least time of a run and its checksum.
    fn report(&self, name: &str, mut run: impl FnMut() -> u64) {
        if self.name.as_deref().is_some_and(|wanted| wanted != name) {
            return;
        }
        let (mut best, mut bits) = (f64::INFINITY, 0);
        for _ in 0..self.times {
            let (seconds, found) = timing::seconds(&mut run);
            bits = black_box(found);
            best = best.min(seconds);
        }
        println!("{name:40} {:10.1} us  {bits:016x}", best * 1e6);
    }

    /// Runs both explicit methods, by a stepper and by a simulation with its energy balance.
    fn runs<M: Machine>(&self, machine: &M, name: &str, end: f64)
    where
        M::System: 'static,
    {
        for method in [Method::DOP853, Method::DOPRI5] {
            let name = format!("{name} {}", method.tableau.name);
            self.report(&format!("{name} stepper"), || {
                let stepper = Stepper::builder(machine.prepare()).method(method);
                let stepper = stepper.tolerance(1e-9).start(machine.start());
                let mut stepper = stepper.expect("accelerations");
                stepper.advance_to(end).expect("a run");
                let numbers = stepper.q().as_slice().iter();
                numbers.fold(0, |sum: u64, x| sum.rotate_left(7) ^ x.to_bits())
            });
            self.report(&format!("{name} simulation"), || {
                let run = Simulation::new(machine).method(method).tolerance(1e-9);
                let run = run.until(end).energy_balance(true).run(machine.start());
                run.expect("a run").statistics().steps as u64
            });
        }
    }
}

fn main() {
    // Cargo adds `--bench`.
    let mut words = std::env::args().skip(1).filter(|word| word != "--bench");
    let wanted = Wanted {
        name: words.next(),
        times: words
            .next()
            .and_then(|word| word.parse().ok())
            .unwrap_or(200),
    };
    wanted.runs(&DoublePendulum::default(), "double_pendulum", 20.0);
    wanted.runs(&CartPole::default(), "cart_pole", 20.0);
    wanted.runs(&VibratingCrusher::default(), "crusher", 1.0);
    wanted.runs(&FourBars::default(), "four_bars", 2.0);
}
