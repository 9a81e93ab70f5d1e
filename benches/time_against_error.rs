//! Work-precision data: run time against true error, by every method and over all tolerances, for every run whose end is known to 30
//! digits (`tests/data/references/`).
//!
//! ```sh
//! cargo bench --bench time_against_error [-- --only NAME,NAME] [--methods NAME;NAME] [--tolerances NUMBER,NUMBER] [--repeats COUNT] [--costs]
//! ```
//!
//! A second table compares the method that a simulation chooses, `auto`, with the best one at each error. With `--costs` there is one table instead: the
//! times of steps, measured and as `auto` estimates them.
//!
//! `benches/peers/work_precision.py` calls it for one run at a time, alternating with its peers, and plots all of them.

#[path = "../tests/support/mod.rs"]
mod support;
mod timing;

use lagrangian::{
    Batched, Ensemble, Machine, Method, Simulation, State, System, Trajectory, Vector,
};
use lagrangian_machines::{Crusher9, DoublePendulum};
use support::known_runs::KnownRun;

/// Machines of the library with their series, compiled.
mod in_series {
    lagrangian::machine! {
        machine HeavyTop extends "../machines/heavy_top.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine SphericalPendulum extends "../machines/spherical_pendulum.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine ElasticPendulum extends "../machines/elastic_pendulum.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine ChainOf8 extends "../machines/chain.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine ChainOf16 extends "../machines/chain.machine" { constants { N = 16 } methods { taylor } }
    }
    lagrangian::machine! {
        machine SixJointArm extends "../machines/six_joint_arm.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine FourBar extends "../machines/four_bar.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine ClosedPendulum extends "../machines/closed_pendulum.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine AndrewsSqueezer extends "../machines/andrews_squeezer.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine FlyballGovernor extends "../machines/flyball_governor.machine" { methods { taylor } }
    }
    lagrangian::machine! {
        machine TwoBodyOrbit extends "../machines/two_body_orbit.machine" { methods { taylor } }
    }
}

/// The method that a simulation chooses where none is given.
const AUTO: &str = "auto";

/// True errors at which `auto` is compared with the best method.
const ERRORS: [f64; 6] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13];

/// The number of trajectories in an ensemble.
const LANES: usize = 4;

/// A setting that takes longer than this, in s, is run only once, and finer settings of its method are skipped.
const LONG: f64 = 0.5;

/// The options of the command line.
struct Call {
    only: Option<Vec<String>>,
    methods: Option<Vec<String>>,
    tolerances: Option<Vec<f64>>,
    repeats: usize,
    costs: bool,
}

impl Call {
    fn read() -> Self {
        let words: Vec<String> = std::env::args().skip(1).collect();
        let after = |option: &str| {
            let at = words.iter().position(|word| word == option)?;
            words.get(at + 1).cloned()
        };
        let list = |by: char| move |text: String| text.split(by).map(str::to_owned).collect();
        Self {
            only: after("--only").map(list(',')),
            methods: after("--methods").map(list(';')),
            tolerances: after("--tolerances").map(|text| {
                let each = text.split(',');
                each.map(|x| x.parse().expect("a tolerance")).collect()
            }),
            repeats: after("--repeats")
                .map_or(7, |count| count.parse().expect("a number of repeats")),
            costs: words.iter().any(|word| word == "--costs"),
        }
    }

    /// Tolerances, or lengths of steps, from coarse to fine.
    fn settings(&self, method: &Method, until: f64) -> Vec<f64> {
        if method.has_fixed_steps() {
            let halvings = 8..=20;
            return halvings
                .map(|power| until / f64::from(1 << power))
                .collect();
        }
        self.tolerances.clone().unwrap_or_else(|| {
            let halves = (4..=30).step_by(2);
            halves
                .map(|half| 10_f64.powf(-0.5 * f64::from(half)))
                .collect()
        })
    }

    fn asks_for(&self, method: &str) -> bool {
        let names = self.methods.as_ref();
        names.is_none_or(|names| names.iter().any(|name| name == method))
    }

    /// Runs all settings of all methods; returns the row of `auto` beside the best method.
    fn race<M: Machine>(&self, name: &str, machine: &M) -> Option<String>
    where
        M::System: Batched<LANES> + 'static,
    {
        if let Some(only) = &self.only
            && !only.iter().any(|wanted| wanted == name)
        {
            return None;
        }
        let known = KnownRun::named(name);
        if self.costs {
            self.costs_of_steps(name, &known, machine);
            return None;
        }
        let mut alone = Vec::new();
        for method in Method::all().filter(|method| self.asks_for(method.tableau.name)) {
            for setting in self.settings(method, known.until) {
                let point = self.alone(&known, machine, Some(method), setting);
                let goes_on = print(name, method.tableau.name, setting, point.as_ref());
                alone.extend(point.map(|point| (method.tableau.name, point)));
                if !goes_on {
                    break;
                }
            }
        }
        if self.asks_for(AUTO) {
            for setting in self.settings(Method::DOP853, known.until) {
                let point = self.alone(&known, machine, None, setting);
                let goes_on = print(name, AUTO, setting, point.as_ref());
                alone.extend(point.map(|point| (AUTO, point)));
                if !goes_on {
                    break;
                }
            }
        }
        for method in [Method::DOP853, Method::TAYLOR] {
            let label = format!("{}, {LANES} lanes", method.tableau.name);
            let has_constraints = machine.prepare().constraints().next().is_some();
            if !self.asks_for(&label) || has_constraints {
                continue;
            }
            for setting in self.settings(method, known.until) {
                let point = self.in_lanes(&known, machine, method, setting);
                if !print(name, &label, setting, point.as_ref()) {
                    break;
                }
            }
        }
        beside_the_best(name, &alone)
    }

    /// Prints what a step by series costs, in twelfths of a step of `dop853`: measured, and estimated.
    fn costs_of_steps<M: Machine>(&self, name: &str, known: &KnownRun, machine: &M) {
        let system = machine.prepare();
        let Some(estimated) = system.series_cost() else {
            return;
        };
        let start = start(known, &system);
        for (tolerance, estimated) in TOLERANCES_OF_COSTS.into_iter().zip(estimated) {
            // The beginning and the end of a run do not count: the rest is the difference of two runs.
            let mut least = [[f64::INFINITY; 2]; 2];
            let mut steps = [[0; 2]; 2];
            for _ in 0..self.repeats {
                for (k, method) in [Method::DOP853, Method::TAYLOR].into_iter().enumerate() {
                    for (j, part) in [1.0, 5.0].into_iter().enumerate() {
                        let simulation = Simulation::new(machine).method(method);
                        let simulation = simulation.tolerance(tolerance).forget_steps();
                        let simulation = simulation.until(part * known.until);
                        let (seconds, run) = timing::seconds(|| simulation.run(start.clone()));
                        let Ok(run) = run else { return };
                        let statistics = run.statistics();
                        least[k][j] = least[k][j].min(seconds);
                        steps[k][j] = statistics.steps + statistics.rejected;
                    }
                }
            }
            let [explicit, series] = [0, 1].map(|k| {
                1e9 * (least[k][1] - least[k][0]) / (steps[k][1] as f64 - steps[k][0] as f64)
            });
            let measured = 12.0 * series / explicit;
            println!(
                "| {name} | {tolerance:.0e} | {:.0} | {series:.0} | {measured:.1} | {estimated:.1} | {:.2} |",
                explicit / 12.0,
                estimated / measured
            );
        }
    }

    /// Seconds of the fastest of several runs, evaluations, and the error; with the method that a simulation chooses if none is given.
    fn alone<M: Machine>(
        &self,
        known: &KnownRun,
        machine: &M,
        method: Option<&'static Method>,
        setting: f64,
    ) -> Option<Point> {
        let system = machine.prepare();
        let start = start(known, &system);
        let mut best = Point::default();
        for _ in 0..self.repeats {
            let simulation = Simulation::new(machine);
            let simulation = match method {
                Some(method) if method.has_fixed_steps() => {
                    simulation.method(method).longest_step(setting)
                }
                Some(method) => simulation.method(method).tolerance(setting),
                None => simulation.automatic().tolerance(setting),
            };
            let simulation = simulation.max_steps(MOST_STEPS).forget_steps();
            let simulation = simulation.until(known.until);
            let (of_processor, run) = timing::seconds(|| simulation.run(start.clone()));
            let run = run.ok()?;
            let end = run.end();
            let both = [&end.q, &end.v].map(|x| system.to_vector(x));
            // Its own clock goes on while other programs have the processor, and the other one contains what precedes a run: of short runs a part of it.
            let seconds = run.statistics().seconds.min(of_processor);
            best.seconds = best.seconds.min(seconds);
            best.evaluations = run.statistics().evaluations;
            best.error = known.error(both.iter().flat_map(Vector::as_slice));
            if best.seconds > LONG {
                break;
            }
        }
        Some(best)
    }

    /// The error and the time of this method at this setting for several trajectories at once, in seconds per trajectory.
    fn in_lanes<M: Machine>(
        &self,
        known: &KnownRun,
        machine: &M,
        method: &'static Method,
        setting: f64,
    ) -> Option<Point>
    where
        M::System: Batched<LANES> + 'static,
    {
        let system = machine.prepare();
        let start = start(known, &system);
        let trajectory = || Trajectory::new(machine.prepare(), start.clone(), known.until);
        let ensemble = Ensemble::<LANES>::new().method(method).tolerance(setting);
        let ensemble = ensemble.max_steps(MOST_STEPS);
        let mut best = Point::default();
        for _ in 0..self.repeats {
            let trajectories: [_; LANES] = std::array::from_fn(|_| trajectory());
            let mut ended = None;
            let run = || {
                ensemble.run(trajectories, |_, arrived| ended = arrived.ok());
            };
            let seconds = timing::seconds(run).0 / LANES as f64;
            let arrival = ended?;
            let both = [&arrival.end.q, &arrival.end.v].map(|x| system.to_vector(x));
            best.seconds = best.seconds.min(seconds);
            best.evaluations = arrival.work.evaluations;
            best.error = known.error(both.iter().flat_map(Vector::as_slice));
            if best.seconds > LONG {
                break;
            }
        }
        Some(best)
    }
}

/// A tolerance for series of each order.
const TOLERANCES_OF_COSTS: [f64; 2] = [1e-4, 1e-9];

const MOST_STEPS: usize = 2_000_000;

/// The cost and the error of one setting.
struct Point {
    seconds: f64,
    evaluations: usize,
    error: f64,
}

impl Default for Point {
    fn default() -> Self {
        Self {
            seconds: f64::INFINITY,
            evaluations: 0,
            error: f64::NAN,
        }
    }
}

/// Prints a row, and returns whether finer settings are worth running.
fn print(name: &str, method: &str, setting: f64, point: Option<&Point>) -> bool {
    let Some(point) = point else {
        // The setting is too coarse for the run to finish, or the method cannot run this machine.
        return true;
    };
    let Point {
        seconds,
        evaluations,
        error,
    } = *point;
    println!(
        "| {name} | {method} | {setting:.1e} | {evaluations} | {:.1} | {error:.2e} |",
        seconds * 1e6
    );
    seconds < LONG
}

/// The row of a run in the table of `auto`: at each error its time over that of the quickest method, and that method.
fn beside_the_best(name: &str, points: &[(&str, Point)]) -> Option<String> {
    let quickest = |is_auto: bool, error: f64| {
        let reached = (points.iter())
            .filter(|(method, point)| (*method == AUTO) == is_auto && point.error <= error);
        reached.min_by(|(_, one), (_, other)| one.seconds.total_cmp(&other.seconds))
    };
    points.iter().find(|(method, _)| *method == AUTO)?;
    let cell = |error: f64| match (quickest(true, error), quickest(false, error)) {
        (Some((_, auto)), Some((method, best))) => {
            format!(" {:.2} {method} |", auto.seconds / best.seconds)
        }
        (None, Some((method, _))) => format!(" – {method} |"),
        (_, None) => " |".into(),
    };
    Some(format!("| {AUTO}, {name} |{}", ERRORS.map(cell).concat()))
}

fn start<S: System>(known: &KnownRun, system: &S) -> State<S::Coordinates> {
    let (q, v) = known.start.split_at(known.start.len() / 2);
    let [q, v] = [q, v].map(|numbers| {
        let mut vector = S::Vector::zeros(numbers.len());
        vector.as_mut_slice().copy_from_slice(numbers);
        system.to_coordinates(&vector)
    });
    State { t: 0.0, q, v }
}

fn main() {
    let call = Call::read();
    if call.costs {
        println!(
            "| run | tolerance | a twelfth of a step of `dop853` [ns] | a step by series [ns] | their ratio | estimated | estimated over measured |"
        );
        println!("| --- | --: | --: | --: | --: | --: | --: |");
    } else {
        println!("| run | method | tolerance or step | evaluations | microseconds | error |");
        println!("| --- | --- | --: | --: | --: | --: |");
    }
    let mut rows = Vec::new();
    let pendulum = DoublePendulum::default();
    rows.extend(call.race("double_pendulum_regular", &pendulum));
    rows.extend(call.race("double_pendulum_chaotic", &pendulum));
    let crusher = Crusher9::default();
    rows.extend(call.race("crusher", &crusher));
    let stiff = Crusher9 {
        cx: 2e9,
        cy: 1.6e9,
        ..crusher
    };
    rows.extend(call.race("stiff_crusher", &stiff));
    rows.extend(call.race("kepler", &in_series::TwoBodyOrbit::default()));
    rows.extend(call.race("heavy_top", &in_series::HeavyTop::default()));
    let spherical = in_series::SphericalPendulum::default();
    rows.extend(call.race("spherical_pendulum", &spherical));
    let elastic = in_series::ElasticPendulum::default();
    rows.extend(call.race("elastic_pendulum", &elastic));
    let stiff = in_series::ElasticPendulum { k: 4e6, ..elastic };
    rows.extend(call.race("stiff_spring_pendulum", &stiff));
    rows.extend(call.race("chain_8", &in_series::ChainOf8::default()));
    rows.extend(call.race("chain_16", &in_series::ChainOf16::default()));
    rows.extend(call.race("six_joint_arm", &in_series::SixJointArm::default()));
    rows.extend(call.race("four_bar", &in_series::FourBar::default()));
    rows.extend(call.race("closed_pendulum", &in_series::ClosedPendulum::default()));
    rows.extend(call.race("andrews_squeezer", &in_series::AndrewsSqueezer::default()));
    rows.extend(call.race("flyball_governor", &in_series::FlyballGovernor::default()));
    if rows.is_empty() {
        return;
    }
    let heads = ERRORS.map(|error| format!(" {error:.0e} |")).concat();
    println!("\n| time over that of the best method, at error |{heads}");
    println!("| --- |{}", " --- |".repeat(ERRORS.len()));
    for row in rows {
        println!("{row}");
    }
}
