//! The gate: the compiler releases no program that does not agree with Lagrange's equations of its machine.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::{Disagreement, Proved, Witness};
use lagrangian_program::contact_parts::{ContactParts, QUANTITIES};
use lagrangian_program::{Mutant, Op, Program, Role, mutants};
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

use crate::harness::{compiled, machine};
use crate::machines::same_values;

/// The errors for a text that cannot be compiled.
fn told(text: &str) -> (Vec<Code>, String) {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "test",
        text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let made = model.and_then(|model| Compiled::new(model, &mut report));
    assert!(made.is_none(), "nothing is emitted");
    let codes = report.diagnostics().iter().map(|one| one.code).collect();
    (codes, report.render_short(&sources))
}

/// Asserts that the gate stops damaged programs, unless the damage has no effect.
fn assert_stopped(machine: &Compiled<'_>, stride: usize) {
    let Compiled {
        model,
        equations,
        program,
        ..
    } = machine;
    let (mut tried, mut idle) = (0, 0);
    for Mutant {
        change,
        program: mutant,
    } in mutants(program, stride)
    {
        tried += 1;
        match Proved::new(mutant.clone(), model, equations) {
            Err(unproved) => {
                let diagnostic = unproved.diagnostic(model);
                assert!(
                    matches!(diagnostic.code, Code::Internal | Code::Undefined),
                    "{unproved}"
                );
            }
            Ok(_) => {
                idle += 1;
                assert!(
                    same_values(model, program, &mutant),
                    "{}: let through: {change}",
                    program.name
                );
            }
        }
    }
    println!("{}: {tried} tried, {idle} without effect", program.name);
    assert!(
        tried >= 15 && 5 * idle <= tried,
        "{}: {idle} of {tried}",
        program.name
    );
}

#[test]
fn damaged_programs_of_every_kind_of_machine_are_stopped() {
    for (name, stride) in [
        ("heavy_top", 7),
        ("four_bar", 17),
        ("rolling_coin", 23),
        ("slider_crank", 13),
        ("wedge_and_block", 5),
        ("prisms", 7),
        ("bead_on_helix", 2),
        ("bead_on_hoop", 5),
        ("puck_in_slot", 3),
        ("two_body_orbit", 3),
        ("small_angle_crusher", 61),
        ("frozen_crusher", 61),
        ("rolling_cylinder", 2),
    ] {
        machine(name, &[], |machine| assert_stopped(machine, stride));
    }
}

/// In a field half of all numbers have no root. √(y² − x²) in place of √(y² + x²) may lack a value at every point that is tried, and is not
/// proved then.
#[test]
fn an_output_that_lacks_its_value_is_stopped() {
    for name in ["motor_crusher", "cushioned_crusher"] {
        machine(name, &[], |machine| {
            let Compiled {
                model,
                equations,
                program,
                ..
            } = machine;
            let outputs: Vec<Role> = (0..model.outputs.len()).map(Role::Output).collect();
            let program = Program::with_only(program, &outputs);
            let stopped = mutants(&program, 1).filter(|mutant| {
                let is_stopped = Proved::new(mutant.program.clone(), model, equations).is_err();
                let is_equal = || same_values(model, &program, &mutant.program);
                assert!(
                    is_stopped || is_equal(),
                    "{name}: let through: {}",
                    mutant.change
                );
                is_stopped
            });
            assert!(stopped.count() > 0, "{name}");
        });
    }
}

/// The projection onto constraints of positions, and onto constraints of rates alone.
#[test]
fn damaged_projections_are_stopped() {
    for (name, stride) in [
        ("four_bar", 3),
        ("flyball_governor", 1),
        ("chaplygin_sleigh", 1),
    ] {
        machine(name, &[], |machine| {
            let made = Compiled::for_runs(machine.model.clone(), &mut Report::new());
            let Some(Compiled {
                model,
                equations,
                program,
                ..
            }) = made
            else {
                panic!("{name} compiles");
            };
            assert!(machine.program.function(Role::Projection).is_none());
            let (mut tried, mut idle) = (0, 0);
            let of_role = Role::Projection.name();
            for mutant in mutants(&program, stride) {
                if !mutant.change.starts_with(&of_role) {
                    continue;
                }
                tried += 1;
                if Proved::new(mutant.program.clone(), &model, &equations).is_err() {
                    continue;
                }
                idle += 1;
                assert!(
                    same_values(&model, &program, &mutant.program),
                    "{name}: let through: {}",
                    mutant.change
                );
            }
            println!("{name}: {tried} tried, {idle} without effect");
            assert!(
                tried >= 15 && 5 * idle <= tried,
                "{name}: {idle} of {tried}"
            );
        });
    }
}

/// A quantity that is added to programs but not to the proof is unproved, and the
/// gate stops a program with it.
#[test]
fn a_function_that_nothing_is_compared_with_is_stopped() {
    machine("double_pendulum", &[], |machine| {
        let mut program = Program::clone(&machine.program);
        let energy = program.function(Role::KineticEnergy).expect("it is there");
        let mut unknown = energy.clone();
        unknown.role = Role::Assumption(program.assumptions.len());
        let role = unknown.role;
        program.functions.push(unknown);
        let unproved = Proved::new(program, &machine.model, &machine.equations)
            .expect_err("nothing is known of it");
        assert_eq!(unproved.disagreement, Disagreement::NotCompared { role });
        assert_eq!(unproved.diagnostic(&machine.model).code, Code::Internal);
    });
}

/// A function may only read what its row of the table permits: the potential
/// energy does not depend on rates.
#[test]
fn a_function_reads_what_its_row_says() {
    machine("double_pendulum", &[], |machine| {
        let mut program = Program::clone(&machine.program);
        let kinetic = program.function(Role::KineticEnergy).expect("it is there");
        let mut wrong = kinetic.clone();
        wrong.role = Role::PotentialEnergy;
        let place = program.functions.iter().position(|f| f.role == wrong.role);
        program.functions[place.expect("it is there")] = wrong;
        let what = program.verify().expect_err("it reads rates");
        assert!(what.contains("nothing that it may depend on"), "{what}");
    });
}

/// Signs, powers, exponentials, and more roots than the field has squares for.
const ROOTS: &str = "machine Roots in plane {
    parameters { m: kg = 1, k: N/m = 3, c: N = 2, l: m = 1, b: kg/m = 0.1, p: 1 = 2.5 }
    coordinates { x: m = 0.3, y: m = 0.4 }
    bodies { ball { mass: m, at: (x, y) } }
    springs {
        s[i in 1..14] { stiffness: k, from: (i*l, -2*l), to: (x, y), length: l },
    }
    potentials { bowl: k*l^2*(2 + x^2/l^2)^p, well: c*exp(-x/l)*abs(x - y/3) }
    dissipations { drag: b*abs(der(x))^3 }
    forces { wind { at: (x, y), force: (c*max(x, y)/l, c*min(x/l, sin(y/l))) } }
}";

#[test]
fn what_the_field_cannot_carry_is_compared_in_double_doubles() {
    compiled(ROOTS, &[], |machine| {
        let Compiled {
            model,
            equations,
            program,
            ..
        } = machine;
        let mut at_states = 0;
        for Mutant {
            change,
            program: mutant,
        } in mutants(program, 11)
        {
            match Proved::new(mutant.clone(), model, equations) {
                Err(unproved) => {
                    at_states += usize::from(unproved.witness == Witness::States);
                }
                Ok(_) => assert!(
                    same_values(model, program, &mutant),
                    "let through: {change}"
                ),
            }
        }
        assert!(at_states > 45, "{at_states}");
    });
}

#[test]
fn a_machine_without_any_state_is_refused() {
    let roots: Vec<String> = (1..=16).map(|k| format!("sqrt(-{k} - x^2)")).collect();
    let text = format!(
        "machine Nowhere in plane {{
            parameters {{ c: J = 1, l: m = 1, m: kg = 1 }}
            coordinates {{ x: rad = 0.3 }}
            bodies {{ ball {{ mass: m, at: (l*x, 0) }} }}
            potentials {{ p: c*({}) }}
        }}",
        roots.join(" + ")
    );
    let (codes, text) = told(&text);
    assert_eq!(codes, [Code::Undefined], "{text}");
    assert!(text.contains("no state was found"), "{text}");
}

/// The message for the first damaged operation of a function for which the gate reports this disagreement.
fn blamed(
    machine: &Compiled<'_>,
    role: Role,
    is_it: impl Fn(&Disagreement) -> bool,
) -> Option<String> {
    let Compiled {
        model,
        equations,
        program,
        ..
    } = machine;
    let of_role = mutants(program, 1).filter(|mutant| mutant.change.starts_with(&role.name()));
    let mut found = of_role.filter_map(|mutant| {
        let unproved = Proved::new(mutant.program, model, equations).err()?;
        is_it(&unproved.disagreement).then(|| unproved.diagnostic(model).message)
    });
    found.next()
}

/// A block on a rail, pressed onto it through two rods.
const RODS: &str = "machine Rods in plane {
    parameters { m: kg = 1, l: m = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
    coordinates { s: m = 0, x: m = 0.6, y: m = 0.8, z: m = 1.2, w: m = 0.1 }
    frames { block = ground.shift(s, 0) }
    bodies {
        block { mass: m, frame: block, at: block.origin },
        ball { mass: m, at: (x, y) },
        bob { mass: 2*m, at: (z, w) },
    }
    gravity (0, -g);
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    constraints { near: norm(ball.at - block.at) = l, far: norm(bob.at - ball.at) = l }
}";

#[test]
fn a_wrong_program_is_told_by_the_names_of_the_spec() {
    let constraint = |wanted: usize| move |found: &Disagreement| matches!(found, Disagreement::Constraint { constraint, .. } if *constraint == wanted);
    machine("slider_crank", &[], |machine| {
        for (index, constraint_of) in machine.program.constraints.iter().enumerate() {
            let text = blamed(machine, Role::Accelerations, constraint(index));
            let text = text.expect("a constraint can be broken");
            assert!(
                text.contains(&format!("`{}`", constraint_of.name)),
                "{text}"
            );
        }
    });
    compiled(RODS, &[], |machine| {
        // Only the second constraint is damaged; the message once named the first one, whichever had failed.
        let far = damaged_row(machine, 1);
        assert!(far.contains("`far`") && !far.contains("`near`"), "{far}");
        let reaction = |found: &Disagreement| matches!(found, Disagreement::Reaction { .. });
        let text = blamed(machine, Role::Friction, reaction).expect("a reaction can be wrong");
        assert!(text.contains("`rail`"), "{text}");
    });
    machine("double_pendulum", &[], |machine| {
        let motion = |found: &Disagreement| matches!(found, Disagreement::Motion { .. });
        let text = blamed(machine, Role::Accelerations, motion).expect("a wrong acceleration");
        assert!(text.contains("equation of motion of `theta"), "{text}");
    });
}

/// The message when the row and the drift of one constraint are right, but the accelerations violate it
/// alone: its part of every response is doubled.
fn damaged_row(machine: &Compiled<'_>, constraint: usize) -> String {
    let Compiled {
        model,
        equations,
        program,
        ..
    } = machine;
    let mut wrong: Program = (**program).clone();
    let n = wrong.dimension();
    let friction = wrong.functions.iter_mut();
    let friction = friction.into_iter().find(|f| f.role == Role::Friction);
    let function = friction.expect("it slides");
    // A coordinate that this constraint contains and the others do not.
    let rows = |k: usize| &equations.constraints[k].row;
    let others = (0..equations.constraints.len()).filter(|k| *k != constraint);
    let others: Vec<usize> = others.collect();
    let own = (0..n)
        .find(|&i| !rows(constraint)[i].is_zero() && others.iter().all(|&k| rows(k)[i].is_zero()));
    let place = own.expect("a coordinate of its own");
    let value = function.results[place];
    function.code.push(Op::Add(value, value));
    let doubled = lagrangian_program::Value(function.code.len() as u32 - 1);
    function.results[place] = doubled;
    let unproved = Proved::new(wrong, model, equations).expect_err("it is wrong");
    unproved.diagnostic(model).message
}

#[test]
fn derivatives_and_stages_are_proved_too() {
    let library = |name: &str| crate::harness::library_text(name);
    for name in ["double_pendulum", "cart_pole", "kapitza_pendulum"] {
        let text = library(name);
        let end = text.rfind('}').expect("a machine ends");
        for section in [
            "derivatives { coordinates, rates, parameters }",
            "stages { time, coordinates }",
        ] {
            let text = format!("{} {section} }}", &text[..end]);
            compiled(&text, &[], |machine| assert_stopped(machine, 11));
        }
    }
}

#[test]
fn machines_whose_accelerations_are_determined_nowhere_are_let_through_with_their_guards() {
    let text = "machine Twice in plane {
        parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.6, y: m = -0.8 }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: x^2 + y^2 = l^2, again: 2*x^2 + 2*y^2 = 2*l^2 }
    }";
    compiled(text, &[], |machine| {
        assert_eq!(machine.program.constraints.len(), 2);
    });
}

/// A chain whose masses are 10⁴⁰ apart: no state in double-double arithmetic decides about it. The prime field knows its angles as long as they have at most 20
/// decimals; beyond, the program may be right, and nothing says that it is wrong.
#[test]
fn a_program_that_is_not_proved_is_not_called_wrong() {
    let chain = |decimals: &str| {
        let angles = [0.5, -0.8, 0.3].map(|angle| format!("{angle}{decimals}"));
        let [a, b, c] = &angles;
        format!(
            "machine Chain in plane {{
                coordinates {{ p: rad = 0.2, q: rad = 2, r: rad = -2 }}
                bodies {{
                    first {{ mass: 1e20*kg, inertia: 1e20*kg*m^2, at: 1.2*m*(sin(p+({a})), -cos(p+({a}))), angle: p }},
                    second {{ mass: 1e-20*kg, inertia: 1*kg*m^2, at: first.at + 0.9*m*(sin(q+({b})), -cos(q+({b}))), angle: q }},
                    third {{ mass: 1e-20*kg, inertia: 1e-20*kg*m^2, at: second.at + 1.3*m*(sin(r+q+({c})), -cos(r+q+({c}))), angle: r+q }},
                }}
                gravity none;
            }}"
        )
    };
    for decimals in ["", "49680958843", "4968095884364915"] {
        compiled(&chain(decimals), &[], |machine| {
            assert_eq!(machine.model.coordinates.len(), 3);
        });
    }
    let (codes, text) = told(&chain("496809588436491571234"));
    assert_eq!(codes, [Code::TooLarge]);
    assert!(
        text.contains("could not be proved") && text.contains("undecided"),
        "{text}"
    );
    assert!(text.contains("numbers from 1e-20 to 1e20"), "{text}");
    assert!(!text.contains("is wrong"), "{text}");
}

/// The numbers of single contacts are those of the proved functions for all of them: parts of another program are not used.
#[test]
fn parts_of_contacts_are_those_of_the_proved_program() {
    machine("contacts/pile", &[("N", 6)], |pile| {
        let program: &Program = &pile.program;
        let parts = ContactParts::of(program).expect("21 contacts have parts");
        assert!(parts.agree_with(program));
        let of_contacts = program.with_only(&QUANTITIES);
        let mut tried = 0;
        for Mutant {
            change,
            program: mutant,
        } in mutants(&of_contacts, 7)
        {
            // Prepared values are arguments of parts.
            if mutant.functions != of_contacts.functions {
                tried += 1;
                assert!(!parts.agree_with(&mutant), "{change}");
            }
        }
        assert!(tried > 100, "{tried}");
    });
}
