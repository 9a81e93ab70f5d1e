//! Tests of accelerations, reactions, energies and their derivatives at random states.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{At, ContactForce, Machine as _, System as _, contact_forces, least_multipliers};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::{Arguments, Interpreter, Program, Role};
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model;
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_spec::syntax::SectionKind;
use lagrangian_symbolic::Dag;

use super::Tally;
use super::generate::{self, Kind};
use super::machine::Machine;
use super::random::Random;
use super::rewrite::{BESIDES, REWRITINGS, Rewritten, shuffled};
use super::text::{self, Item};
use super::truth::{State, Truth, Variable, World, on_constraints};

type Wide = DoubleDouble;

/// States with a smaller ratio of the smallest pivot to the largest are skipped, because they are nearly singular.
const LEAST_PIVOT: f64 = 1e-6;

/// The error bound of a result in roundings: programs have hundreds to thousands of operations.
const ROUNDINGS: f64 = 4096.0;

/// Sections that no random machine contains. The first needs a language for impacts, and only it uses `spheres`; `methods` has
/// requirements that not every machine meets and does not change the equations, and so has `charts`; the next two belong to other
/// commands, which have their own tests. The others describe energies, forces and constraints that random machines write out;
/// `crates/mechanics/tests/mechanics/parts.rs` tests each of them against its formulas.
const LEFT_OUT: [&str; 15] = [
    "contacts",
    "spheres",
    "methods",
    "charts",
    "published",
    "brachistochrone",
    "rotors",
    "stops",
    "drag",
    "transmissions",
    "ropes",
    "wheels",
    "states",
    "energies",
    "losses",
];

/// The features that must occur in a full run.
pub fn parts() -> Vec<String> {
    let sections = SectionKind::ALL.iter().map(|kind| kind.as_str());
    let sections = sections.filter(|name| !LEFT_OUT.contains(name));
    let sections = sections.map(|name| format!("section {name}"));
    let rewritings = REWRITINGS.iter().chain(&BESIDES).map(|(name, _)| *name);
    let rewritings = rewritings
        .chain(LAYOUTS)
        .map(|name| format!("rewriting: {name}"));
    let spaces = ["plane", "space"].map(|name| format!("in {name}"));
    sections.chain(rewritings).chain(spaces).collect()
}

/// Rewritings that only change the text.
const LAYOUTS: [&str; 2] = ["order of sections", "variant flattened"];

/// The rewriting of a chain into families, which is tested by one machine in every `EVERY`.
const UNROLLED: &str = "family unrolled";
const EVERY: usize = 20;

const PANICS: &str = "the compiler panics";

/// Compiles a spec in the same way as the command line.
pub fn compile(text: &str, files: &[(String, String)]) -> Result<Proved, String> {
    let compiled = catch_unwind(AssertUnwindSafe(|| compile_or_panic(text, files)));
    compiled.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let said = panic.downcast_ref::<String>().cloned().or(text);
        Err(format!("{PANICS}: {}\n", said.unwrap_or_default()))
    })
}

fn compile_or_panic(text: &str, files: &[(String, String)]) -> Result<Proved, String> {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let mut disk = InMemory::new();
    for (name, text) in files {
        disk = disk.with(name.clone(), text.clone());
    }
    let compiled = lagrangian_spec::model(
        &dag,
        "random.machine",
        text,
        &[],
        &mut disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::new(model, &mut report));
    match compiled {
        Some(compiled) => Ok(compiled.program),
        None => Err(report.render_short(&sources)),
    }
}

fn wide(values: &[f64]) -> Vec<Wide> {
    values.iter().map(|x| Wide::from_f64(*x)).collect()
}

fn plain(values: &[Wide]) -> Vec<f64> {
    values.iter().map(|x| x.to_f64()).collect()
}

fn largest(values: &[Wide]) -> f64 {
    values.iter().map(|x| x.abs().to_f64()).fold(0.0, f64::max)
}

/// A machine with a state on its constraints, and the true results there.
pub struct Case {
    pub machine: Machine,
    pub state: State<Wide>,
    pub truth: Truth<Wide>,
}

impl Case {
    pub fn random(random: &mut Random, kind: Kind) -> Option<Case> {
        let machine = generate::machine(random, kind);
        let of = |f: fn(&super::machine::Coordinate) -> f64| -> Vec<Wide> {
            machine
                .coordinates
                .iter()
                .map(|c| Wide::from_f64(f(c)))
                .collect()
        };
        let state = State {
            t: Wide::from_f64(random.number(0.0, 2.0)),
            q: of(|c| c.start),
            v: of(|c| c.rate),
        };
        let state = on_constraints(&machine, &state)?;
        Case::at(machine, state)
    }

    pub fn at(mut machine: Machine, state: State<Wide>) -> Option<Case> {
        let world = World::new(&machine, &state);
        let truth = world.truth()?;
        let all = [
            largest(&truth.accelerations),
            truth.size,
            largest(&truth.outputs),
        ];
        let is_finite = all.iter().all(|x| x.is_finite() && *x < 1e5)
            && truth.kinetic.is_finite()
            && truth.potential.is_finite();
        if !is_finite || truth.pivot < LEAST_PIVOT {
            return None;
        }
        for (coordinate, (q, v)) in machine
            .coordinates
            .iter_mut()
            .zip(state.q.iter().zip(&state.v))
        {
            (coordinate.start, coordinate.rate) = (q.to_f64(), v.to_f64());
        }
        Some(Case {
            machine,
            state,
            truth,
        })
    }
}

/// The expected results.
pub struct Expected {
    pub state: State<Wide>,
    pub accelerations: Vec<Wide>,
    /// By name.
    pub multipliers: Vec<(String, Wide)>,
    /// By name: slip, normal reaction and friction.
    pub contacts: Vec<(String, [Wide; 3])>,
    pub energies: [Option<Wide>; 3],
    pub outputs: Vec<Wide>,
    /// The ratio of the smallest pivot to the largest, and the largest number.
    pub pivot: f64,
    pub size: f64,
    /// Whether a constraint occurs twice.
    pub doubled: bool,
}

impl Expected {
    /// The expected results of a machine in its original form.
    pub fn of(case: &Case) -> Expected {
        let truth = &case.truth;
        let rewritten = Rewritten::new(&case.machine);
        Expected {
            state: case.state.clone(),
            accelerations: truth.accelerations.clone(),
            multipliers: multipliers(case, &rewritten),
            contacts: contacts(case, &rewritten),
            energies: [truth.kinetic, truth.potential, truth.dissipation].map(Some),
            outputs: truth.outputs.clone(),
            pivot: truth.pivot,
            size: truth.size.max(1.0),
            doubled: false,
        }
    }

    /// The expected results of a rewritten machine, or `None` if its new form is nearly singular.
    pub fn of_rewritten(
        case: &Case,
        rewritten: &Rewritten,
        single: &Rewritten,
    ) -> Result<Option<Expected>, String> {
        let world = World::new(&case.machine, &case.state);
        let truth = &case.truth;
        let [q, v, a] = world.motion(&rewritten.coordinates, &truth.accelerations);
        let t = case.state.t;
        if rewritten.by_formulas {
            // From formulas the evaluator cannot determine the forces that a guide carries. If the spec is accepted, they must be
            // those of the original form.
            return Ok(Some(Expected {
                state: State { t, q, v },
                accelerations: a,
                multipliers: multipliers(case, rewritten),
                contacts: contacts(case, rewritten),
                energies: [None; 3],
                outputs: truth.outputs.clone(),
                pivot: truth.pivot * LEAST_PIVOT,
                size: truth.size.max(1.0),
                doubled: false,
            }));
        }
        // Evaluates the rewritten machine in f64, for its conditioning and to check that the rewriting is correct.
        let state = State {
            t: t.to_f64(),
            q: plain(&q),
            v: plain(&v),
        };
        let Some(own) = World::new(&single.machine, &state).truth() else {
            return Ok(None);
        };
        if own.pivot < LEAST_PIVOT || !own.size.is_finite() || own.size > 1e5 {
            return Ok(None);
        }
        let size = own.size.max(truth.size).max(1.0);
        let bound = f64::EPSILON * ROUNDINGS * 64.0 * size / own.pivot.min(truth.pivot);
        for (i, (found, a)) in own.accelerations.iter().zip(&a).enumerate() {
            if (found - a.to_f64()).abs() > bound {
                return Err(format!(
                    "the rewriting is wrong: acceleration {i} is {found}, it was {} ({bound:e})",
                    a.to_f64()
                ));
            }
        }
        let energies = [truth.kinetic, truth.potential, truth.dissipation];
        let energies = [0, 1, 2].map(|k| rewritten.energies[k].then_some(energies[k]));
        Ok(Some(Expected {
            state: State { t, q, v },
            accelerations: a,
            multipliers: multipliers(case, rewritten),
            contacts: contacts(case, rewritten),
            energies,
            outputs: truth.outputs.clone(),
            pivot: own.pivot.min(truth.pivot),
            size,
            doubled: rewritten.constraints.len() > single.constraints.len(),
        }))
    }
}

fn multipliers(case: &Case, rewritten: &Rewritten) -> Vec<(String, Wide)> {
    let truth = &case.truth.multipliers;
    let machine = &rewritten.machine;
    let mut list = Vec::new();
    for (constraint, stands_for) in machine.constraints.iter().zip(&rewritten.constraints) {
        if let Some((base, factor)) = stands_for {
            // The reaction of a repeated constraint is divided equally among its copies.
            let same = rewritten.constraints.iter().flatten();
            let count = same.filter(|(other, _)| other == base).count();
            let share = Wide::from_f64(factor * count as f64);
            list.push((constraint.name.clone(), truth[*base] / share));
        }
    }
    let before = case.machine.constraints.len();
    for (k, rolling) in machine.rolling.iter().enumerate() {
        for (place, what) in ["gap", "slip"].iter().enumerate() {
            let name = format!("{}.{what}", rolling.name);
            list.push((name, truth[before + 2 * k + place]));
        }
    }
    list
}

fn contacts(case: &Case, rewritten: &Rewritten) -> Vec<(String, [Wide; 3])> {
    let guides = rewritten.machine.sliding.iter().zip(&rewritten.guides);
    guides
        .map(|(guide, (base, direction, normal))| {
            let truth = case.truth.contacts[*base];
            let (along, across) = (Wide::from_f64(*direction), Wide::from_f64(*normal));
            let values = [
                truth.slip * along,
                truth.normal * across,
                truth.friction * along,
            ];
            (guide.name.clone(), values)
        })
        .collect()
}

/// Compares numbers with the expected ones.
struct Held<'f> {
    failures: &'f mut Vec<String>,
    /// In units of the rounding of double-doubles, and of f64.
    bound: f64,
}

impl Held<'_> {
    fn wide(&mut self, what: &str, found: &[Wide], expected: &[Wide]) {
        // Double-doubles are accurate to 2⁻¹⁰⁰.
        let bound = self.bound * 2f64.powi(-100);
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let error = (*found - *expected).abs().to_f64();
            if error.is_nan() || error > bound {
                let (found, expected) = (found.to_f64(), expected.to_f64());
                self.failures.push(format!(
                    "{what} {i} is {found}, not {expected} (off by {error:e}, may be {bound:e})"
                ));
                return;
            }
        }
    }

    fn plain(&mut self, what: &str, found: &[f64], expected: &[Wide]) {
        let bound = self.bound * f64::EPSILON;
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let error = (found - expected.to_f64()).abs();
            if error.is_nan() || error > bound {
                let expected = expected.to_f64();
                self.failures.push(format!(
                    "{what} {i} is {found}, not {expected} (off by {error:e}, may be {bound:e})"
                ));
                return;
            }
        }
    }
}

/// Compares the results of a program with the expected ones.
pub fn hold(program: &Proved, expected: &Expected) -> Vec<String> {
    let mut failures = Vec::new();
    // The error of a result comes from the roundings of its terms, which are at most the square of the largest number; the solution
    // multiplies it by the condition number.
    let bound = ROUNDINGS * expected.size * expected.size / expected.pivot;
    let mut held = Held {
        failures: &mut failures,
        bound,
    };
    let State { t, q, v } = &expected.state;
    let n = q.len();
    let value = |slot: &lagrangian_program::Slot| slot.default.as_ref().map_or(0.0, |x| x.value);
    let parameters: Vec<f64> = program.parameters.iter().map(value).collect();
    let inputs = wide(&program.inputs.iter().map(value).collect::<Vec<f64>>());
    let mut interpreter = Interpreter::new(program, &wide(&parameters));
    let arguments = Arguments {
        t: *t,
        q,
        v,
        u: &inputs,
        a: &expected.accelerations,
    };
    let mut call = |role: Role, length: usize| -> Option<Vec<Wide>> {
        program.function(role)?;
        let mut results = vec![Wide::ZERO; length];
        let done = interpreter.call(role, arguments, &mut results);
        Some(match done {
            Ok(()) => results,
            Err(_) => vec![Wide::from_f64(f64::NAN); length],
        })
    };
    if !expected.doubled {
        if let Some(found) = call(Role::Accelerations, n) {
            held.wide("acceleration", &found, &expected.accelerations);
        }
        if let Some(found) = call(Role::Multipliers, program.constraints.len()) {
            held.multipliers(program, &found, expected);
        }
    }
    let energies = [
        Role::KineticEnergy,
        Role::PotentialEnergy,
        Role::Dissipation,
    ];
    for (role, expected) in energies.into_iter().zip(expected.energies) {
        if let Some(expected) = expected {
            let found = call(role, 1).unwrap_or(vec![Wide::ZERO]);
            held.wide(&role.name(), &found, &[expected]);
        }
    }
    for (k, expected) in expected.outputs.iter().enumerate() {
        let found = call(Role::Output(k), 1).unwrap_or(vec![Wide::ZERO]);
        held.wide(&format!("output {k}:"), &found, &[*expected]);
    }
    if program.function(Role::AccelerationsAt).is_some() && !expected.doubled {
        held.wide(
            "acceleration in stages",
            &in_stages(program, &mut interpreter, arguments, n),
            &expected.accelerations,
        );
    }
    held.as_run(program, expected);
    failures
}

/// The accelerations, evaluated stage by stage.
fn in_stages(
    program: &Proved,
    interpreter: &mut Interpreter<Wide>,
    arguments: Arguments<'_, Wide>,
    n: usize,
) -> Vec<Wide> {
    for role in [Role::AtTime, Role::AtPosition] {
        if let Some(function) = program.function(role) {
            let mut values = vec![Wide::ZERO; function.results.len()];
            if interpreter.call(role, arguments, &mut values).is_err() {
                return vec![Wide::from_f64(f64::NAN); n];
            }
            interpreter.set_stage_results(role, &values);
        }
    }
    let mut results = vec![Wide::ZERO; n];
    match interpreter.call(Role::AccelerationsAt, arguments, &mut results) {
        Ok(()) => results,
        Err(_) => vec![Wide::from_f64(f64::NAN); n],
    }
}

impl Held<'_> {
    fn multipliers(&mut self, program: &Proved, found: &[Wide], expected: &Expected) {
        for (name, value) in &expected.multipliers {
            let place = program.constraints.iter().position(|one| one.name == *name);
            match place {
                Some(place) => self.wide(
                    &format!("multiplier {name}:"),
                    &found[place..=place],
                    &[*value],
                ),
                None => self.failures.push(format!("there is no constraint {name}")),
            }
        }
    }

    /// Checks the numbers that a run uses, in f64.
    fn as_run(&mut self, program: &Proved, expected: &Expected) {
        let machine = InterpretedMachine::new(program.clone());
        let system = machine.prepare();
        let State { t, q, v } = &expected.state;
        let (t, q, v) = (t.to_f64(), plain(q), plain(v));
        let u = system.default_inputs();
        let mut a = vec![0.0; q.len()];
        let mut multipliers = vec![0.0; program.constraints.len()];
        let done = if expected.doubled {
            least_multipliers(&system, t, &q, &v, &u, &mut a, &mut multipliers)
                .map_err(|error| format!("{error:?}"))
        } else {
            system
                .accelerations(t, &q, &v, &u, &mut a)
                .and_then(|()| system.multipliers(t, &q, &v, &u, &mut multipliers))
                .map_err(|error| format!("{error:?}"))
        };
        if let Err(error) = done {
            self.failures
                .push(format!("a run does not know the accelerations: {error}"));
            return;
        }
        self.plain("acceleration in a run", &a, &expected.accelerations);
        for (name, value) in &expected.multipliers {
            let place = program.constraints.iter().position(|one| one.name == *name);
            if let Some(place) = place {
                self.plain(
                    &format!("multiplier {name} in a run:"),
                    &multipliers[place..=place],
                    &[*value],
                );
            }
        }
        if expected.contacts.is_empty() {
            return;
        }
        let mut forces = vec![ContactForce::default(); program.contacts.len()];
        if contact_forces(
            &system,
            At {
                t,
                q: &q,
                v: &v,
                u: &u,
            },
            &mut [],
            &mut [],
            &mut forces,
        )
        .is_err()
        {
            self.failures
                .push("the forces in contacts are not known".into());
            return;
        }
        for (name, values) in &expected.contacts {
            match program.contacts.iter().position(|contact| contact == name) {
                Some(place) => {
                    let force = forces[place];
                    let found = [force.slip, force.normal, force.friction];
                    self.plain(
                        &format!("slip, normal reaction, friction of {name}: number"),
                        &found,
                        values,
                    );
                }
                None => self.failures.push(format!("there is no contact {name}")),
            }
        }
    }
}

/// Checks the matrix, forces and derivatives of a machine in its original form.
fn hold_equations(program: &Proved, case: &Case, random: &mut Random) -> Vec<String> {
    let mut failures = Vec::new();
    let truth = &case.truth;
    let size = truth.size.max(1.0);
    let mut held = Held {
        failures: &mut failures,
        bound: ROUNDINGS * size * size / truth.pivot,
    };
    let n = case.machine.coordinates.len();
    let value = |slot: &lagrangian_program::Slot| slot.default.as_ref().map_or(0.0, |x| x.value);
    let parameters: Vec<f64> = program.parameters.iter().map(value).collect();
    let inputs = wide(&program.inputs.iter().map(value).collect::<Vec<f64>>());
    let mut interpreter = Interpreter::new(program, &wide(&parameters));
    let State { t, q, v } = &case.state;
    let arguments = Arguments {
        t: *t,
        q,
        v,
        u: &inputs,
        a: &[],
    };
    let mut call = |role: Role, length: usize| {
        let mut results = vec![Wide::ZERO; length];
        // Singular machines are skipped.
        let _ = interpreter.call(role, arguments, &mut results);
        results
    };
    let lower: Vec<Wide> = (0..n).flat_map(|i| truth.mass[i][..=i].to_vec()).collect();
    held.wide(
        "entry of the mass matrix",
        &call(Role::MassMatrix, lower.len()),
        &lower,
    );
    held.wide("bias", &call(Role::Bias, n), &truth.bias);
    held.wide("applied force", &call(Role::Applied, n), &truth.applied);
    if program.derivatives.is_empty() {
        return failures;
    }
    let width = 1 + program.derivatives.len();
    let found = call(Role::Derivatives, n * width);
    let column = random.below(program.derivatives.len());
    let variable = match program.derivatives[column] {
        model::Variable::Coordinate(i) => Variable::Coordinate(i),
        model::Variable::Rate(i) => Variable::Rate(i),
        model::Variable::Input(i) => Variable::Input(i),
        model::Variable::Parameter(i) => Variable::Parameter(i),
    };
    let world = World::new(&case.machine, &case.state);
    let expected = world.derivative(variable, &truth.accelerations, &truth.multipliers);
    let Some(expected) = expected else {
        return failures;
    };
    let found: Vec<Wide> = found.chunks(width).map(|row| row[1 + column]).collect();
    held.bound *= size / truth.pivot;
    held.wide(&format!("derivative by {variable:?}"), &found, &expected);
    failures
}

/// Applies up to four rewritings; the last may double a constraint.
pub fn rewrite(case: &Case, random: &mut Random) -> (Rewritten, Rewritten) {
    let mut rewritten = Rewritten::new(&case.machine);
    let mut order = shuffled(REWRITINGS.len(), random);
    let is = |index: usize, name: &str| REWRITINGS[index].0 == name;
    // The rewriting that rebuilds the frames comes first, the one that doubles a constraint last. The one that needs an unchanged
    // constraint often comes before the others, because it would otherwise rarely apply.
    let first = random.chance(50);
    order.sort_by_key(|index| {
        (
            !is(*index, "loop cut elsewhere"),
            !(first && is(*index, "constraint put in")),
            is(*index, "constraint doubled"),
        )
    });
    let most = 1 + random.below(4);
    let world = World::new(&case.machine, &case.state);
    let mut single = rewritten.clone();
    for index in order {
        let (name, rewriting) = REWRITINGS[index];
        let doubles = name == "constraint doubled";
        let wanted = if doubles {
            random.chance(30)
        } else {
            rewritten.names.len() < most && random.chance(60)
        };
        if !wanted || !rewriting(&mut rewritten, random) {
            continue;
        }
        rewritten.names.push(name);
        let [q, v, _] = world.motion(&rewritten.coordinates, &case.truth.accelerations);
        for (coordinate, (q, v)) in rewritten
            .machine
            .coordinates
            .iter_mut()
            .zip(q.iter().zip(&v))
        {
            (coordinate.start, coordinate.rate) = (q.to_f64(), v.to_f64());
        }
        if !doubles {
            single = rewritten.clone();
        }
    }
    for (name, rewriting) in BESIDES {
        if random.chance(15) {
            let mut both = [&mut rewritten, &mut single];
            let again = random.0;
            let mut done = false;
            for one in &mut both {
                random.0 = again;
                done = rewriting(one, random);
            }
            if done {
                rewritten.names.push(name);
            }
        }
    }
    (rewritten, single)
}

/// A spec, and the files that it extends.
pub struct Written {
    pub text: String,
    pub files: Vec<(String, String)>,
    pub layout: Option<&'static str>,
}

/// The machine as text: with sections in the usual order, in another order, or as a variant of another machine.
pub fn write(machine: &Machine, name: &str, random: &mut Random) -> Written {
    let mut items = text::items(machine);
    let (mut layout, mut files) = (None, Vec::new());
    let mut head = text::head(machine, name);
    match random.below(3) {
        0 => {
            // Sections may come in any order and repeat; the items of each section keep their order.
            let mut sections: Vec<&str> = items.iter().map(|item| item.section).collect();
            sections.dedup();
            let order = shuffled(sections.len(), random);
            let rank = |item: &Item| sections.iter().position(|section| *section == item.section);
            items.sort_by_key(|item| rank(item).map(|rank| order[rank]));
            layout = Some(LAYOUTS[0]);
        }
        1 => {
            let (base, variant) = variant(&items, random);
            // A variant without changes is refused.
            if variant.is_empty() {
                let text = text::assemble(&head, &items);
                return Written {
                    text,
                    files,
                    layout,
                };
            }
            files.push((
                "base.machine".into(),
                text::assemble(&text::head(machine, "Base"), &base),
            ));
            head = format!("machine {name} extends \"base.machine\"");
            items = variant;
            layout = Some(LAYOUTS[1]);
        }
        _ => {}
    }
    Written {
        text: text::assemble(&head, &items),
        files,
        layout,
    }
}

/// The items of a base, and those of a variant that turns it into the machine.
fn variant(items: &[Item], random: &mut Random) -> (Vec<Item>, Vec<Item>) {
    let (mut base, mut own) = (Vec::new(), Vec::new());
    for item in items {
        let replaceable = matches!(
            item.section,
            "parameters"
                | "constants"
                | "springs"
                | "dampers"
                | "torsion_springs"
                | "potentials"
                | "forces"
                | "constraints"
        ) && !item.name.is_empty();
        if replaceable && random.chance(40) {
            // The base has another value.
            let mut other = item.clone();
            other.text = match item.section {
                "parameters" => format!("{}: 1 = 4.5", item.name),
                "constants" => format!("{} = 4.5", item.name),
                "springs" => format!(
                    "{} {{ stiffness: 77*one_N/one_m, stretch: 2*one_m }}",
                    item.name
                ),
                "dampers" => format!(
                    "{} {{ damping: 77*one_N*one_s/one_m, stretch: 2*one_m }}",
                    item.name
                ),
                "torsion_springs" => {
                    format!("{} {{ stiffness: 77*one_N*one_m, twist: 1 }}", item.name)
                }
                "potentials" => format!("{}: 3*one_N*one_m", item.name),
                "constraints" => format!("{}: 2 = 2", item.name),
                _ => item.text.clone(),
            };
            base.push(other);
            own.push(item.clone());
            continue;
        }
        base.push(item.clone());
    }
    // The base has an additional spring, and another gravity.
    let extra = |section, name: &str, text: &str| Item {
        section,
        name: name.into(),
        text: text.into(),
    };
    let body = items.iter().find(|item| item.section == "bodies");
    if let Some(body) = body
        && random.chance(50)
    {
        let at = &body.name;
        let text = format!("p_extra {{ at: {at}.at, force: one_N*der({at}.at)/(one_m/one_s) }}");
        base.push(extra("forces", "p_extra", &text));
        own.push(extra("remove", "", "forces.p_extra"));
    }
    if let Some(gravity) = items.iter().find(|item| item.section == "gravity")
        && random.chance(50)
    {
        for item in base.iter_mut().filter(|item| item.section == "gravity") {
            item.text = gravity.text.replace("one_m", "(7*one_m)");
        }
        own.push(gravity.clone());
    }
    (base, own)
}

fn count_sections(machine: &Machine, tally: &mut Tally) {
    let mut sections: Vec<&str> = text::items(machine)
        .iter()
        .map(|item| item.section)
        .collect();
    sections.dedup();
    for section in sections {
        tally.count(format!("section {section}"));
    }
    tally.count(if machine.spatial {
        "in space"
    } else {
        "in plane"
    });
}

/// Errors with which a random machine may be refused because it is not a valid machine.
const REFUSALS: [&str; 3] = ["[no-inertia]", "[no-expansion]", "[undefined]"];

/// The error of a guided machine if the forces that a guide carries do not follow from the spec.
const UNTIED: &str = "[untied]";

/// The error of a bushing between two frames that a constraint keeps on each other, once the constraint is put in.
const ON_ITSELF: &str = "a bushing joins two frames, but both of its ends are the same frame";

/// Compares a chain with its members written one by one and as families.
fn families(random: &mut Random, tally: &mut Tally) {
    let (machine, text) = generate::chain(random);
    let of = |f: fn(&super::machine::Coordinate) -> f64| {
        wide(&machine.coordinates.iter().map(f).collect::<Vec<_>>())
    };
    let state = State {
        t: Wide::from_f64(random.number(0.0, 2.0)),
        q: of(|c| c.start),
        v: of(|c| c.rate),
    };
    let Some(case) = on_constraints(&machine, &state).and_then(|state| Case::at(machine, state))
    else {
        return;
    };
    let unrolled = text::spec(&case.machine, "Unrolled");
    for text in [&text, &unrolled] {
        match compile(text, &[]) {
            Ok(program) => {
                let failures = hold(&program, &Expected::of(&case));
                if !failures.is_empty() {
                    tally
                        .failures
                        .push(format!("{}\n{text}", failures.join("\n")));
                }
            }
            Err(report) => tally.failures.push(format!("{report}{text}")),
        }
    }
    tally.count(format!("rewriting: {UNROLLED}"));
}

/// One machine in this many is compiled to machine code; coprime to the number of kinds, so that all kinds occur.
const COMPILED: usize = 9;

/// Compares the machine code of all functions with the interpreter.
fn hold_machine_code(program: &Proved, random: &mut Random, tally: &mut Tally) -> Option<String> {
    lagrangian_jit::Level::here()?;
    let program = Arc::new(Program::clone(program));
    let mut any = || random.number(0.5, 2.0);
    let parameters = program.parameters.iter().map(|slot| match &slot.default {
        Some(default) => default.value,
        None => any(),
    });
    let parameters: Vec<f64> = parameters.collect();
    tally.count("machine code");
    let seed = random.below(1 << 30) as u64;
    let found = super::check::agrees(&program, &parameters, seed, 8);
    found.err().map(|error| format!("machine code: {error}"))
}

/// Tests one machine and two rewritten forms of it.
pub fn task(mut random: Random, number: usize, tally: &mut Tally) {
    if number % EVERY == EVERY - 1 {
        families(&mut random, tally);
        return;
    }
    let kind = Kind::ALL[number % Kind::ALL.len()];
    let Some(case) = Case::random(&mut random, kind) else {
        tally.count(format!("{kind:?}: no state"));
        return;
    };
    let text = text::spec(&case.machine, "Random");
    let program = match compile(&text, &[]) {
        Ok(program) => program,
        Err(report)
            if REFUSALS.iter().any(|code| report.contains(code))
                || (kind == Kind::Guided && report.contains(UNTIED)) =>
        {
            tally.count(format!("{kind:?}: refused"));
            return;
        }
        Err(report) => {
            tally
                .failures
                .push(format!("{kind:?} is refused:\n{report}{text}"));
            return;
        }
    };
    tally.count(format!("{kind:?}"));
    count_sections(&case.machine, tally);
    let expected = Expected::of(&case);
    let mut failures = hold(&program, &expected);
    failures.extend(hold_equations(&program, &case, &mut random));
    if number.is_multiple_of(COMPILED) {
        failures.extend(hold_machine_code(&program, &mut random, tally));
    }
    if !failures.is_empty() {
        let said = at(&expected);
        let failures = failures.join("\n");
        tally
            .failures
            .push(format!("{kind:?}:\n{failures}\n{said}\n{text}"));
    }
    for _ in 0..2 {
        let (rewritten, single) = rewrite(&case, &mut random);
        let written = write(&rewritten.machine, "Rewritten", &mut random);
        if rewritten.names.is_empty() && written.layout.is_none() {
            continue;
        }
        let names = format!("{:?} {:?}", rewritten.names, written.layout);
        let whole = || {
            let files: Vec<&str> = written
                .files
                .iter()
                .map(|(_, text)| text.as_str())
                .collect();
            format!("{}{}\nof\n{text}", written.text, files.concat())
        };
        let expected = match Expected::of_rewritten(&case, &rewritten, &single) {
            Ok(Some(expected)) => expected,
            Ok(None) => {
                tally.count("rewritten: next to singular");
                continue;
            }
            Err(error) => {
                tally
                    .failures
                    .push(format!("{kind:?}, {names}: {error}\n{}", whole()));
                continue;
            }
        };
        let program = match compile(&written.text, &written.files) {
            Ok(program) => program,
            Err(report) if rewritten.refusable && report.contains(UNTIED) => {
                tally.count("rewritten: a reaction is not determined");
                continue;
            }
            Err(report)
                if rewritten.names.contains(&"constraint put in") && report.contains(ON_ITSELF) =>
            {
                tally.count("rewritten: a bushing without ends");
                continue;
            }
            Err(report) => {
                let whole = whole();
                tally
                    .failures
                    .push(format!("{kind:?}, {names} is refused:\n{report}\n{whole}"));
                continue;
            }
        };
        for name in rewritten.names.iter().chain(&written.layout) {
            tally.count(format!("rewriting: {name}"));
        }
        let failures = hold(&program, &expected);
        if !failures.is_empty() {
            let (failures, said, whole) = (failures.join("\n"), at(&expected), whole());
            tally
                .failures
                .push(format!("{kind:?}, {names}:\n{failures}\n{said}\n{whole}"));
        }
    }
}

fn at(expected: &Expected) -> String {
    let State { t, q, v } = &expected.state;
    format!(
        "at t = {}, q = {:?}, v = {:?}; pivot {:e}, size {}",
        t.to_f64(),
        plain(q),
        plain(v),
        expected.pivot,
        expected.size
    )
}
