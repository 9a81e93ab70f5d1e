//! Accelerations in stages equal those at once, and no operation is repeated.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::{Proved, prove};
use lagrangian_program::{
    Arguments, Candidate, Counts, Function, Interpreter, Mutant, Op, Program, Role, Source, mutants,
};
use lagrangian_scalar::{DoubleDouble, Scalar};

use crate::harness::{compiled, library_text, machine, smooth_machines};

/// All requests for stages.
const REQUESTS: [&str; 3] = ["time, coordinates", "coordinates", "time"];

/// A machine of the library with stages requested.
fn staged<R>(
    name: &str,
    constants: &[(&str, i64)],
    request: &str,
    look: impl for<'d> FnOnce(&Compiled<'d>) -> R,
) -> R {
    let text = library_text(name);
    let end = text.rfind('}').expect("a machine ends");
    let text = format!("{} stages {{ {request} }} }}", &text[..end]);
    compiled(&text, constants, look)
}

fn assert_proved(Compiled { model, program, .. }: &Compiled<'_>) {
    assert_eq!(program.verify(), Ok(()), "{}", program.name);
    let proof = prove(program, model, &Oracle::derive(model));
    assert_eq!(proof, Ok(()), "{}", program.name);
}

fn function(program: &Program, role: Role) -> &Function {
    program.function(role).expect("it is asked for")
}

#[test]
fn the_stages_of_every_machine_lead_to_its_accelerations() {
    for name in smooth_machines() {
        for request in REQUESTS {
            staged(&name, &[], request, |machine| {
                assert!(!machine.program.staged_roles().is_empty(), "{name}");
                assert_proved(machine);
            });
        }
    }
}

#[test]
fn every_way_to_compute_in_stages_leads_to_the_accelerations() {
    for name in [
        "crusher9",
        "double_pendulum",
        "kapitza_pendulum",
        "heavy_top",
    ] {
        staged(name, &[], "time, coordinates", |machine| {
            let Compiled {
                model, equations, ..
            } = machine;
            let expanded = equations.expanded();
            let choice = machine.program.choice(Role::AccelerationsAt);
            let ways = choice.map_or(1, |choice| choice.candidates.len());
            assert!(ways > 1, "{name}");
            for way in 0..ways {
                let choose = |candidates: &[Candidate]| match candidates[0].form.role {
                    Role::AccelerationsAt => way,
                    _ => 0,
                };
                let program =
                    lagrangian_mechanics::lower_by(model, equations, expanded.as_ref(), &choose);
                let program = Proved::new(program, model, equations).expect("a proof");
                assert_proved(&Compiled {
                    program,
                    ..machine.clone()
                });
            }
        });
    }
}

#[test]
fn no_mistake_in_a_stage_survives() {
    for (name, stride) in [("cart_pole", 1), ("kapitza_pendulum", 1), ("crusher9", 3)] {
        staged(name, &[], "time, coordinates", |machine| {
            let Compiled { model, program, .. } = machine;
            let oracle = Oracle::derive(model);
            let names = program.staged_roles();
            let names: Vec<String> = names.into_iter().map(Role::name).collect();
            let of_stages =
                |mutant: &Mutant| names.iter().any(|name| mutant.change.starts_with(name));
            let (mut tried, mut survived) = (0, Vec::new());
            for mutant in mutants(program, stride).filter(of_stages) {
                tried += 1;
                if prove(&mutant.program, model, &oracle).is_ok() {
                    survived.push(mutant.change);
                }
            }
            // The correction of a phase's rounding is 0 in a field, whatever multiplies it.
            survived.retain(|change: &String| {
                !(change.starts_with("at_time") && change.contains("Sin") && change.contains("Cos"))
            });
            println!("{name}: {tried} mistakes, without effect: {survived:?}");
            assert!(tried > 15, "{name}: {tried}");
            assert!(survived.is_empty(), "{name}: {survived:?}");
        });
    }
}

/// Each stage does all the work that it can, and passes on only values that a later stage reads.
#[test]
fn a_stage_does_all_that_it_can() {
    for name in smooth_machines() {
        staged(&name, &[], "time, coordinates", |machine| {
            let program = &machine.program;
            for (role, allowed) in [
                (Role::AtTime, [false; 3]),
                (Role::AtPosition, [true, false, false]),
                (Role::AccelerationsAt, [false, true, true]),
            ] {
                let reads = function(program, role).reads();
                assert!(reads.time <= (role == Role::AtTime), "{name}");
                assert!(reads.coordinates <= (role == Role::AtPosition), "{name}");
                let found = [reads.at_time, reads.at_position, reads.velocities];
                for (found, allowed) in found.into_iter().zip(allowed) {
                    assert!(found <= allowed, "{name}: {role:?}");
                }
            }
            let is_settled = |op: &Op| {
                matches!(
                    op,
                    Op::Constant(_)
                        | Op::Pi
                        | Op::Read(Source::Prepared(_) | Source::AtTime(_) | Source::AtPosition(_))
                )
            };
            for role in [Role::AtPosition, Role::AccelerationsAt] {
                let function = function(program, role);
                for op in &function.code {
                    let mut operands = op.operands().map(|operand| function.op(operand)).peekable();
                    let is_leaf = operands.peek().is_none();
                    let could = !is_leaf && operands.all(is_settled);
                    assert!(!could, "{name}: {op:?} belongs to the stage before");
                }
            }
            for (before, after) in [
                (Role::AtTime, Role::AtPosition),
                (Role::AtPosition, Role::AccelerationsAt),
            ] {
                let left = function(program, before).results.len();
                let of_before =
                    |op: &&Op| matches!(op, Op::Read(Source::AtTime(_) | Source::AtPosition(_)));
                let read = function(program, after).code.iter().filter(of_before);
                assert_eq!(read.count(), left, "{name}: {before:?}");
            }
        });
    }
}

/// A machine that requests no stages has the same program as without this feature.
#[test]
fn stages_change_nothing_else() {
    for name in ["crusher9", "two_joint_arm", "chain"] {
        let plain = machine(name, &[], |machine| machine.program.clone());
        assert!(plain.staged_roles().is_empty());
        staged(name, &[], "time, coordinates", |machine| {
            for function in &plain.functions {
                let same = machine
                    .program
                    .function(function.role)
                    .expect("it is there");
                assert_eq!(
                    same.counts(),
                    function.counts(),
                    "{name}: {:?}",
                    function.role
                );
            }
        });
    }
}

/// In double-double the rounding errors of the two forms differ by a relative amount of less than
/// 1e-25, as the machines are far from singular here.
#[test]
fn numbers_in_stages_are_the_numbers_at_once() {
    for name in smooth_machines() {
        for request in REQUESTS {
            staged(&name, &[], request, |machine| {
                let program = &machine.program;
                let n = program.dimension();
                let list = |seed: usize, len: usize| -> Vec<DoubleDouble> {
                    let number = |i: usize| 0.3 + (((seed + 13 * i) * 7919) % 101) as f64 / 97.0;
                    (0..len).map(|i| DoubleDouble::from(number(i))).collect()
                };
                let parameters = list(1, program.parameters.len());
                let mut interpreter = Interpreter::new(program, &parameters);
                let (q, v, u) = (list(3, n), list(5, n), list(7, program.inputs.len()));
                let at = Arguments {
                    t: DoubleDouble::from(0.7),
                    q: &q,
                    v: &v,
                    u: &u,
                    a: &[],
                };
                let mut expected = vec![DoubleDouble::ZERO; n];
                if interpreter
                    .call(Role::Accelerations, at, &mut expected)
                    .is_err()
                {
                    return; // random parameters may not give a valid machine
                }
                let mut found = Vec::new();
                for role in program.staged_roles() {
                    found = vec![DoubleDouble::ZERO; function(program, role).results.len()];
                    interpreter
                        .call(role, at, &mut found)
                        .expect("it has accelerations");
                    if role != Role::AccelerationsAt {
                        interpreter.set_stage_results(role, &found);
                    }
                }
                let scale = expected
                    .iter()
                    .fold(1.0_f64, |scale, a| scale.max(a.to_f64().abs()));
                for (found, expected) in found.into_iter().zip(expected) {
                    let error = (found - expected).to_f64().abs();
                    assert!(error <= 1e-25 * scale, "{name}: {error:e} of {scale:e}");
                }
            });
        }
    }
}

/// In a long chain each stage takes the same number of operations for every link, and two
/// evaluations in stages take no more than two at once.
#[test]
fn stages_grow_with_the_chain() {
    for name in ["chain", "chain_relative"] {
        let sizes = [24, 48, 96].map(|n| {
            staged(name, &[("N", n)], "time, coordinates", |machine| {
                let program = &machine.program;
                let roles = [Role::Accelerations, Role::AtPosition, Role::AccelerationsAt];
                let functions = roles.map(|role| function(program, role));
                let throughput = functions.map(|function| function.cost().throughput);
                let [at_once, at_position, at_rates] = throughput;
                println!("{name}, N = {n}: {throughput:?} tenths of a cycle");
                assert!(at_position + 2 * at_rates <= 2 * at_once, "{name}, N = {n}");
                functions.map(|function| function.counts().ops())
            })
        });
        let [quarter, half, whole] = sizes;
        for (stage, ops) in whole.into_iter().enumerate() {
            // The number of operations per further link is constant from the 24th to the 96th.
            let (by_24, by_48) = (half[stage] - quarter[stage], ops - half[stage]);
            assert_eq!(by_48, 2 * by_24, "{name}, stage {stage}");
        }
    }
}

/// The part that is repeated when only rates change is less than half of the whole, if positions
/// are not constant; and without explicit time, the stage of time is empty.
#[test]
fn what_is_repeated_is_short() {
    for name in [
        "crusher9",
        "two_joint_arm",
        "six_joint_arm",
        "double_pendulum",
        "kapitza_pendulum",
    ] {
        staged(name, &[], "time, coordinates", |machine| {
            let program = &machine.program;
            let counts = |role| function(program, role).counts();
            let [at_once, at_time, at_position, at_rates] = [
                Role::Accelerations,
                Role::AtTime,
                Role::AtPosition,
                Role::AccelerationsAt,
            ]
            .map(counts);
            println!("{name}: {at_once} | {at_time} | {at_position} | {at_rates}");
            let Counts {
                divisions,
                sincos,
                guards,
                ..
            } = at_rates;
            assert_eq!((divisions, sincos, guards), (0, 0, 0), "{name}");
            assert!(10 * at_rates.cost() < 7 * at_once.cost(), "{name}");
        });
    }
}

/// Unilateral contacts are in other functions: stages, derivatives and approximations are derived and proved beside them.
#[test]
fn machines_with_contacts_have_stages_and_derivatives() {
    for name in [
        "bouncing_ball",
        "colliding_crusher",
        "cue_ball",
        "impact_oscillator",
        "rocking_block",
        "slider_crank_clearance",
        "woodpecker",
    ] {
        let text = library_text(&format!("contacts/{name}"));
        let end = text.rfind('}').expect("a machine ends");
        let text = format!(
            "{} stages {{ time, coordinates }} derivatives {{ coordinates, rates, parameters }} }}",
            &text[..end]
        );
        compiled(&text, &[], |Compiled { program, .. }| {
            assert_eq!(program.verify(), Ok(()), "{name}");
            assert!(!program.unilateral.is_empty(), "{name}");
            assert!(!program.staged_roles().is_empty(), "{name}");
            assert!(program.function(Role::Derivatives).is_some(), "{name}");
            assert!(program.function(Role::Gaps).is_some(), "{name}");
        });
    }
}
