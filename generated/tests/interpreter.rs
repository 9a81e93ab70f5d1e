//! Compares the committed code with the interpreter of the program from which it was printed: the same operations in
//! the same order give the same bits, over every kind of number. Accelerations use the fastest arithmetic that the
//! processor has, and the interpreter runs in that arithmetic, too.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

use std::fmt::Debug;

use lagrangian::scalar::{DoubleDouble, Interval, Kernel, Scalar};
use lagrangian::{Machine, Number, Pivot, System};
use lagrangian_machines as machines;
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::{
    Arguments, Interpreter, Program, ProjectionLayout, Role, Shape, Singular,
};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

/// The number of states that are compared.
const STATES: u64 = 20;

/// The program of a machine of the library, as emitted code contains it.
fn program(file: &str) -> Proved {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = format!("{}/../machines/{file}.machine", env!("CARGO_MANIFEST_DIR"));
    let (name, text) = Disk.read(&path, None).expect("the library is there");
    lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::in_charts(model, &mut report))
    .unwrap_or_else(|| panic!("{}", report.render_short(&sources)))
    .0
    .program
}

/// Pseudorandom numbers between −2 and 2, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        // xorshift64*, S. Vigna, An experimental exploration of Marsaglia's xorshift generators, 2016.
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 51) as f64 - 2.0
    }

    fn take(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

/// The bits of the results as text, in which NaN equals itself and −0 differs from 0.
fn bits(values: &[f64]) -> Vec<String> {
    values
        .iter()
        .map(|value| format!("{value:e} {:016x}", value.to_bits()))
        .collect()
}

/// Accelerations or multipliers by the interpreter, in the arithmetic that this processor selects for `f64`.
struct Interpreted<'a> {
    interpreter: &'a mut Interpreter<f64>,
    role: Role,
    len: usize,
    arguments: Arguments<'a, f64>,
}

impl Kernel<f64> for Interpreted<'_> {
    type Output = Result<Vec<f64>, Singular>;

    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        let mut results = vec![0.0; self.len];
        self.interpreter
            .call_in::<N>(self.role, self.arguments, &mut results)?;
        Ok(results)
    }
}

/// Checks that every method of `System` gives the result of the interpreter to the last bit.
fn agrees_in_f64<M: Machine + Default>(
    file: &str,
    to_inputs: impl Fn(&[f64]) -> lagrangian::Inputs<M>,
) where
    lagrangian::Outputs<M>: Debug,
{
    let machine = M::default();
    let program = program(file);
    let parameters: Vec<f64> = machine.parameters().map(|(_, value)| value).collect();
    let mut interpreter = Interpreter::new(&program, &parameters);
    let system = machine.prepare();
    let n = program.dimension();

    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    interpreter.start(&mut q, &mut v);
    let start = machine.start();
    for (emitted, interpreted) in [(&start.q, &q), (&start.v, &v)] {
        let emitted = system.to_vector(emitted);
        assert_eq!(
            bits(lagrangian::Vector::as_slice(&emitted)),
            bits(interpreted),
            "{file}: start"
        );
    }

    for seed in 1..=STATES {
        let mut numbers = Numbers(seed);
        let (t, q, v, a) = (
            numbers.next(),
            numbers.take(n),
            numbers.take(n),
            numbers.take(n),
        );
        let u = numbers.take(program.inputs.len());
        let arguments = Arguments {
            t,
            q: &q,
            v: &v,
            u: &u,
            a: &a,
        };
        let mut interpret = |role: Role, len: usize| -> Result<Vec<f64>, Singular> {
            let mut results = vec![0.0; len];
            interpreter
                .call(role, arguments, &mut results)
                .map(|()| results)
        };
        let vector = |values: &[f64]| {
            let mut vector = <M::System as System>::Vector::zeros(n);
            vector.as_mut_slice().copy_from_slice(values);
            vector
        };
        use lagrangian::Vector;
        let (q, v, a, u) = (vector(&q), vector(&v), vector(&a), to_inputs(&u));
        let mut out = vector(&vec![0.0; n]);

        let place = |what: &str| format!("{file}, seed {seed}: {what}");
        let k = program.contacts.len();
        assert!(
            system
                .contacts()
                .eq(program.contacts.iter().map(String::as_str))
        );
        let mut parts = vec![
            0.0;
            program
                .function(Role::Friction)
                .map_or(0, |f| f.results.len())
        ];
        let (emitted, role) = match k {
            0 => (
                system.accelerations(t, &q, &v, &u, &mut out),
                Role::Accelerations,
            ),
            _ => (system.friction(t, &q, &v, &u, &mut parts), Role::Friction),
        };
        let found = if k == 0 { out.as_slice() } else { &parts[..] };
        match (
            emitted,
            f64::run(Interpreted {
                interpreter: &mut Interpreter::new(&program, &parameters),
                role,
                len: found.len(),
                arguments,
            }),
        ) {
            (Ok(()), Ok(expected)) => {
                assert_eq!(bits(found), bits(&expected), "{}", place(&role.name()))
            }
            (Err(emitted), Err(expected)) => {
                let row = match emitted.at {
                    Pivot::Coordinate(coordinate) => coordinate,
                    Pivot::Constraint(constraint) => n + constraint,
                    other => panic!("{}: {other:?}", place("nothing slides")),
                };
                assert_eq!(row, expected.coordinate, "{}", place("singular"));
                assert_eq!(
                    emitted.ratio.to_bits(),
                    expected.ratio.to_bits(),
                    "{}",
                    place("singular")
                );
            }
            other => panic!("{}: {other:?}", place("accelerations")),
        }
        let sizes = program.sizes();
        let mut compare = |role: Role, write: &dyn Fn(&mut [f64])| {
            let row = role.row();
            if !row.needs.are_met(sizes) {
                return;
            }
            let mut found = vec![0.0; row.extent.shape(sizes).map_or(0, Shape::len)];
            write(&mut found);
            let expected = interpret(role, found.len()).expect("nothing is inverted");
            assert_eq!(bits(&found), bits(&expected), "{}", place(&role.name()));
        };
        // <quantities: compared>
        compare(Role::MassMatrix, &|numbers| {
            let mut own = <M::System as System>::Matrix::zeros(n * n);
            system.mass_matrix(t, &q, &mut own);
            numbers.copy_from_slice(&lower(own.as_slice(), n));
        });
        compare(Role::Bias, &|numbers| {
            let mut own = vector(numbers);
            system.bias(t, &q, &v, &mut own);
            numbers.copy_from_slice(own.as_slice());
        });
        compare(Role::Applied, &|numbers| {
            let mut own = vector(numbers);
            system.applied(t, &q, &v, &u, &mut own);
            numbers.copy_from_slice(own.as_slice());
        });
        compare(Role::Forces, &|numbers| {
            let mut own = vector(numbers);
            system.forces(t, &q, &v, &u, &mut own);
            numbers.copy_from_slice(own.as_slice());
        });
        compare(Role::ConstraintPositions, &|numbers| {
            system.constraint_positions(t, &q, numbers);
        });
        compare(Role::ConstraintRates, &|numbers| {
            system.constraint_rates(t, &q, &v, numbers);
        });
        compare(Role::ConstraintMatrix, &|numbers| {
            system.constraint_matrix(t, &q, numbers);
        });
        compare(Role::ConstraintBias, &|numbers| {
            system.constraint_bias(t, &q, &v, numbers);
        });
        compare(Role::Slips, &|numbers| {
            system.slips(t, &q, &v, numbers);
        });
        compare(Role::SlipMatrix, &|numbers| {
            system.slip_matrix(t, &q, numbers);
        });
        compare(Role::SlipBias, &|numbers| {
            system.slip_bias(t, &q, &v, numbers);
        });
        compare(Role::Gaps, &|numbers| {
            system.gaps(t, &q, numbers);
        });
        compare(Role::ContactRates, &|numbers| {
            system.contact_rates(t, &q, &v, numbers);
        });
        compare(Role::ContactMatrix, &|numbers| {
            system.contact_matrix(t, &q, numbers);
        });
        compare(Role::ContactBias, &|numbers| {
            system.contact_bias(t, &q, &v, numbers);
        });
        compare(Role::ContactCoefficients, &|numbers| {
            system.contact_coefficients(t, &q, &v, numbers);
        });
        compare(Role::ContactFaces, &|numbers| {
            system.contact_faces(t, &q, &v, numbers);
        });
        compare(Role::GuideMatrix, &|numbers| {
            system.guide_matrix(t, &q, numbers);
        });
        compare(Role::GuideLoads, &|numbers| {
            system.guide_loads(t, &q, &v, &u, numbers);
        });
        compare(Role::KineticEnergy, &|numbers| {
            numbers[0] = system.kinetic_energy(t, &q, &v);
        });
        compare(Role::PotentialEnergy, &|numbers| {
            numbers[0] = system.potential_energy(t, &q, &u);
        });
        compare(Role::StateEnergy, &|numbers| {
            numbers[0] = system.state_energy(t, &q, &v);
        });
        compare(Role::Dissipation, &|numbers| {
            numbers[0] = system.dissipation(t, &q, &v, &u);
        });
        compare(Role::WorkRate, &|numbers| {
            numbers[0] = system.work_rate(t, &q, &v, &a, &u);
        });
        compare(Role::DissipationRate, &|numbers| {
            numbers[0] = system.dissipation_rate(t, &q, &v, &u);
        });
        // </quantities>

        let mut check = |role: Role, value: f64| {
            let expected = interpret(role, 1).expect("nothing but accelerations can fail");
            assert_eq!(bits(&[value]), bits(&expected), "{}", place(&role.name()));
        };
        let outputs = system.outputs(t, &q, &v, &a, &u);
        for (i, (_, value)) in system.output_values(&outputs).enumerate() {
            check(Role::Output(i), value);
        }
        for (i, assumption) in system.assumptions(t, &q, &v, &u).enumerate() {
            check(Role::Assumption(i), assumption.margin);
        }

        let m = program.constraints.len();
        assert_eq!(system.constraints().len(), m);
        for (constraint, expected) in system.constraints().zip(&program.constraints) {
            assert_eq!(constraint.name, expected.name);
            assert_eq!(constraint.unit, expected.unit);
            assert_eq!(constraint.multiplier_unit, expected.multiplier_unit);
            assert_eq!(constraint.holonomic, expected.holonomic);
        }
        if m > 0 {
            let mut multipliers = vec![0.0; m];
            let emitted = system.multipliers(t, &q, &v, &u, &mut multipliers);
            let interpreted = f64::run(Interpreted {
                interpreter: &mut Interpreter::new(&program, &parameters),
                role: Role::Multipliers,
                len: m,
                arguments,
            });
            assert_eq!(emitted.is_ok(), interpreted.is_ok());
            if let Ok(expected) = interpreted {
                assert_eq!(
                    bits(&multipliers),
                    bits(&expected),
                    "{}",
                    place("multipliers")
                );
            }
            let layout = ProjectionLayout {
                coordinates: n,
                constraints: m,
            };
            let mut projection = vec![0.0; layout.len()];
            let emitted = system.projection(t, &q, &v, &mut projection);
            let has_projection = program.function(Role::Projection).is_some();
            let interpreted = f64::run(Interpreted {
                interpreter: &mut Interpreter::new(&program, &parameters),
                role: Role::Projection,
                len: layout.len(),
                arguments,
            });
            assert_eq!(emitted.is_ok(), interpreted.is_ok() || !has_projection);
            if let Ok(expected) = interpreted {
                assert_eq!(emitted, Ok(has_projection));
                assert_eq!(
                    bits(&projection),
                    bits(&expected),
                    "{}",
                    place("projection")
                );
            }
        }

        let c = program.unilateral.len();
        assert_eq!(system.unilateral_contacts().len(), c);
        for (contact, expected) in system.unilateral_contacts().zip(&program.unilateral) {
            assert_eq!(contact.name, expected.name);
            assert_eq!(
                (
                    contact.has_friction,
                    contact.is_rolling_resistance,
                    contact.is_second_tangent
                ),
                (
                    expected.has_friction,
                    expected.is_rolling_resistance,
                    expected.is_second_tangent
                )
            );
        }
    }
}

/// The lower triangle of a square matrix, which is symmetric to the last bit.
fn lower(square: &[f64], n: usize) -> Vec<f64> {
    let entry = |i: usize, j: usize| square[i * n + j];
    let places = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let entries = places.map(|(i, j)| {
        assert_eq!(entry(i, j).to_bits(), entry(j, i).to_bits());
        entry(i, j)
    });
    entries.collect()
}

/// The results over `S` of generic code, and of the interpreter.
type Pair<S> = (Option<Vec<S>>, Option<Vec<S>>);

/// The accelerations of one state over `S`: those of the emitted code, and those of the interpreter.
fn accelerations<S: Scalar<Stored = S>, const N: usize>(
    program: &Program,
    parameters: &[f64],
    state: &(f64, [f64; N], [f64; N]),
    emitted: impl Fn(S, &[S; N], &[S; N]) -> Result<[S; N], lagrangian::Singular>,
) -> Pair<S> {
    let exact = |x: &f64| S::from_f64(*x);
    let parameters: Vec<S> = parameters.iter().map(exact).collect();
    let mut interpreter = Interpreter::new(program, &parameters);
    let (t, q, v) = (
        exact(&state.0),
        state.1.map(|x| exact(&x)),
        state.2.map(|x| exact(&x)),
    );
    let u: Vec<S> = program.inputs.iter().map(|_| S::ONE).collect();
    let mut results = vec![S::ZERO; N];
    let arguments = Arguments {
        t,
        q: &q,
        v: &v,
        u: &u,
        a: &[],
    };
    let interpreted = interpreter.call(Role::Accelerations, arguments, &mut results);
    (
        emitted(t, &q, &v).ok().map(Vec::from),
        interpreted.ok().map(|()| results),
    )
}

/// Compares one machine over one kind of number; the call expression receives the arguments of its functions.
macro_rules! over {
    ($scalar:ty, $machine:ident, $state:expr, $program:expr, |$p:ident, $t:ident, $q:ident, $v:ident| $call:expr) => {{
        let machine = machines::$machine::default();
        let parameters: Vec<f64> = machine.parameters().map(|(_, value)| value).collect();
        let prepared = machine.map(<$scalar>::from_f64).prepare();
        let $p = &prepared;
        let run = |$t: $scalar, $q: &[$scalar; _], $v: &[$scalar; _]| $call;
        accelerations::<$scalar, _>($program, &parameters, $state, run)
    }};
}

/// Double-double, `f32` and intervals give the interpreter's results, and the interval contains the other results.
macro_rules! agrees_over_every_number {
    ($machine:ident, $file:literal, |$p:ident, $t:ident, $q:ident, $v:ident| $call:expr) => {{
        let program = program($file);
        let mut certain = 0;
        for seed in 1..=STATES {
            let mut numbers = Numbers(seed);
            let state = (
                numbers.next(),
                std::array::from_fn(|_| numbers.next()),
                std::array::from_fn(|_| numbers.next()),
            );
            let exact = over!(
                DoubleDouble,
                $machine,
                &state,
                &program,
                |$p, $t, $q, $v| $call
            );
            let enclosed = over!(Interval, $machine, &state, &program, |$p, $t, $q, $v| $call);
            let double = over!(f64, $machine, &state, &program, |$p, $t, $q, $v| $call);
            let single = over!(f32, $machine, &state, &program, |$p, $t, $q, $v| $call);
            assert_eq!(
                format!("{:?}", exact.0),
                format!("{:?}", exact.1),
                "double-double, seed {seed}"
            );
            assert_eq!(
                format!("{:?}", enclosed.0),
                format!("{:?}", enclosed.1),
                "interval, seed {seed}"
            );
            assert_eq!(
                format!("{:?}", single.0),
                format!("{:?}", single.1),
                "f32, seed {seed}"
            );
            let (Some(exact), Some(double), Some(enclosed)) = (exact.0, double.0, enclosed.0)
            else {
                continue;
            };
            for ((exact, double), enclosed) in exact.iter().zip(double).zip(enclosed) {
                certain += usize::from(enclosed.width() < 1.0);
                let lies_in =
                    |x: f64| enclosed.lo().next_down() <= x && x <= enclosed.hi().next_up();
                assert!(
                    lies_in(exact.hi()) && lies_in(double),
                    "seed {seed}: {exact:?} {double} {enclosed:?}"
                );
            }
        }
        assert!(certain > 0, "the enclosures say nothing");
    }};
}

#[test]
fn the_double_pendulum_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::DoublePendulum>("double_pendulum", |_| Default::default());
    agrees_over_every_number!(DoublePendulum, "double_pendulum", |p, _t, q, v| {
        machines::double_pendulum::accelerations(p, q, v)
    });
}

#[test]
fn the_crusher_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::VibratingCrusher>("vibrating_crusher", |_| Default::default());
    agrees_over_every_number!(VibratingCrusher, "vibrating_crusher", |p, t, q, v| {
        machines::vibrating_crusher::accelerations(p, t, q, v)
    });
}

#[test]
fn the_cushioned_crusher_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::CushionedCrusher>("cushioned_crusher", |_| Default::default());
    agrees_over_every_number!(CushionedCrusher, "cushioned_crusher", |p, t, q, v| {
        machines::cushioned_crusher::accelerations(p, t, q, v)
    });
}

#[test]
fn the_cart_and_pole_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::CartPole>("cart_pole", |u| machines::cart_pole::Inputs {
        push: u[0],
    });
}

#[test]
fn the_chains_are_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::Chain>("chain", |_| Default::default());
    agrees_in_f64::<machines::ChainRelative>("chain_relative", |_| Default::default());
    agrees_over_every_number!(
        Chain,
        "chain",
        |p, _t, q, v| machines::chain::accelerations(p, q, v)
    );
}

#[test]
fn the_top_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::HeavyTop>("heavy_top", |_| Default::default());
    agrees_over_every_number!(HeavyTop, "heavy_top", |p, _t, q, v| {
        machines::heavy_top::accelerations(p, q, v)
    });
}

#[test]
fn the_arm_is_the_program_to_the_last_bit() {
    let inputs = |u: &[f64]| machines::six_joint_arm::Inputs {
        tau: std::array::from_fn(|i| u[i]),
    };
    agrees_in_f64::<machines::SixJointArm>("six_joint_arm", inputs);
}

#[test]
fn the_crusher_of_the_paper_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::Crusher9>("crusher9", |_| Default::default());
}

#[test]
fn the_pendulums_are_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::SimplePendulum>("simple_pendulum", |_| Default::default());
    agrees_in_f64::<machines::ElasticPendulum>("elastic_pendulum", |_| Default::default());
    agrees_in_f64::<machines::SphericalPendulum>("spherical_pendulum", |_| Default::default());
    agrees_in_f64::<machines::KapitzaPendulum>("kapitza_pendulum", |_| Default::default());
    agrees_over_every_number!(KapitzaPendulum, "kapitza_pendulum", |p, t, q, _v| {
        machines::kapitza_pendulum::accelerations(p, t, q)
    });
}

#[test]
fn the_train_is_the_program_to_the_last_bit() {
    let inputs = |u: &[f64]| machines::spring_mass_train::Inputs { pull: u[0] };
    agrees_in_f64::<machines::SpringMassTrain>("spring_mass_train", inputs);
}

#[test]
fn the_orbit_is_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::TwoBodyOrbit>("two_body_orbit", |_| Default::default());
}

#[test]
fn free_top_and_gyroscope_are_the_program_to_the_last_bit() {
    agrees_in_f64::<machines::AsymmetricTop>("asymmetric_top", |_| Default::default());
    let gyroscope = "gyroscope_in_gimbals";
    agrees_in_f64::<machines::GyroscopeInGimbals>(gyroscope, |_| Default::default());
    agrees_in_f64::<machines::UprightTop>("upright_top", |_| Default::default());
    agrees_over_every_number!(AsymmetricTop, "asymmetric_top", |p, _t, q, v| {
        machines::asymmetric_top::accelerations(p, q, v)
    });
}

#[test]
fn the_two_joint_arm_is_the_program_to_the_last_bit() {
    let inputs = |u: &[f64]| machines::two_joint_arm::Inputs {
        tau1: u[0],
        tau2: u[1],
    };
    agrees_in_f64::<machines::TwoJointArm>("two_joint_arm", inputs);
}

#[test]
fn machines_whose_parts_collide_are_the_programs_to_the_last_bit() {
    agrees_in_f64::<machines::BowlingBall>("contacts/bowling_ball", |_| Default::default());
    agrees_in_f64::<machines::CueBall>("contacts/cue_ball", |_| Default::default());
    let crusher = "contacts/colliding_crusher";
    agrees_in_f64::<machines::CollidingCrusher>(crusher, |_| Default::default());
}

#[test]
fn the_mechanisms_are_the_programs_to_the_last_bit() {
    agrees_in_f64::<machines::SliderCrank>("slider_crank", |_| Default::default());
    agrees_in_f64::<machines::FourBar>("four_bar", |_| Default::default());
    agrees_in_f64::<machines::FourBars>("four_bars", |_| Default::default());
    agrees_in_f64::<machines::ClosedPendulum>("closed_pendulum", |_| Default::default());
    agrees_in_f64::<machines::AndrewsSqueezer>("andrews_squeezer", |_| Default::default());
    agrees_in_f64::<machines::ParticlePendulum>("particle_pendulum", |_| Default::default());
    let inputs = |u: &[f64]| machines::flyball_governor::Inputs { drive: u[0] };
    agrees_in_f64::<machines::FlyballGovernor>("flyball_governor", inputs);
    agrees_in_f64::<machines::ChaplyginSleigh>("chaplygin_sleigh", |_| Default::default());
    agrees_in_f64::<machines::RollingCoin>("rolling_coin", |_| Default::default());
    agrees_in_f64::<machines::RollingCylinder>("rolling_cylinder", |_| Default::default());
    agrees_in_f64::<machines::BallInBowl>("ball_in_bowl", |_| Default::default());
    agrees_in_f64::<machines::Bricard>("bricard", |_| Default::default());
    agrees_in_f64::<machines::Rattleback>("rattleback", |_| Default::default());
    agrees_in_f64::<machines::CrushingCrusher>("crushing_crusher", |_| Default::default());
    agrees_in_f64::<machines::CakedCrusher>("caked_crusher", |_| Default::default());
    agrees_in_f64::<machines::GrainCrusher>("grain_crusher", |_| Default::default());
}

#[test]
fn machines_that_stick_and_slide_agree() {
    agrees_in_f64::<machines::BlockOnIncline>("block_on_incline", |_| Default::default());
    agrees_in_f64::<machines::BeadOnHelix>("bead_on_helix", |_| Default::default());
    agrees_in_f64::<machines::BeadOnHoop>("bead_on_hoop", |_| Default::default());
    agrees_in_f64::<machines::BeadInShell>("bead_in_shell", |_| Default::default());
    agrees_in_f64::<machines::PuckInSlot>("puck_in_slot", |_| Default::default());
    agrees_in_f64::<machines::Prisms>("prisms", |_| Default::default());
    agrees_in_f64::<machines::StickSlip>("stick_slip", |_| Default::default());
    agrees_in_f64::<machines::WedgeAndBlock>("wedge_and_block", |_| Default::default());
}
