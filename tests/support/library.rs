//! The machines of `machines/`, and machines that tests write themselves, compiled to
//! programs for the interpreter.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Equations;
use lagrangian_mechanics::Proved;
use lagrangian_program::Candidate;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// The file names of all machines without constraints.
pub const MACHINES: [&str; 26] = [
    "asymmetric_top",
    "cart_pole",
    "chain",
    "chain_relative",
    "crusher9",
    "cushioned_crusher",
    "dc_motor",
    "double_pendulum",
    "elastic_pendulum",
    "frozen_crusher",
    "gyroscope_in_gimbals",
    "heavy_top",
    "kapitza_pendulum",
    "motor_crusher",
    "paper_crusher",
    "position_servo",
    "simple_pendulum",
    "six_joint_arm",
    "small_angle_crusher",
    "spherical_pendulum",
    "spring_mass_train",
    "two_body_orbit",
    "two_debalance_crusher",
    "two_joint_arm",
    "upright_top",
    "vibrating_crusher",
];

/// The file names of the machines with constraints.
pub const CONSTRAINED: [&str; 16] = [
    "andrews_squeezer",
    "ball_in_bowl",
    "bricard",
    "caked_crusher",
    "chaplygin_sleigh",
    "closed_pendulum",
    "crushing_crusher",
    "flyball_governor",
    "four_bar",
    "four_bars",
    "grain_crusher",
    "particle_pendulum",
    "rattleback",
    "rolling_coin",
    "rolling_cylinder",
    "slider_crank",
];

/// The file names of the machines with Coulomb friction.
pub const SLIDING: [&str; 8] = [
    "bead_in_shell",
    "bead_on_helix",
    "bead_on_hoop",
    "block_on_incline",
    "prisms",
    "puck_in_slot",
    "stick_slip",
    "wedge_and_block",
];

/// Invokes a macro for every machine without constraints, as compiled into `lagrangian-machines`:
/// `$do!(CartPole, "cart_pole")`.
#[macro_export]
macro_rules! for_each_machine {
    ($do:ident) => {
        $do!(AsymmetricTop, "asymmetric_top");
        $do!(CartPole, "cart_pole");
        $do!(Chain, "chain");
        $do!(ChainRelative, "chain_relative");
        $do!(Crusher9, "crusher9");
        $do!(CushionedCrusher, "cushioned_crusher");
        $do!(DcMotor, "dc_motor");
        $do!(DoublePendulum, "double_pendulum");
        $do!(ElasticPendulum, "elastic_pendulum");
        $do!(FrozenCrusher, "frozen_crusher");
        $do!(GyroscopeInGimbals, "gyroscope_in_gimbals");
        $do!(HeavyTop, "heavy_top");
        $do!(KapitzaPendulum, "kapitza_pendulum");
        $do!(MotorCrusher, "motor_crusher");
        $do!(PaperCrusher, "paper_crusher");
        $do!(PositionServo, "position_servo");
        $do!(SimplePendulum, "simple_pendulum");
        $do!(SixJointArm, "six_joint_arm");
        $do!(SmallAngleCrusher, "small_angle_crusher");
        $do!(SphericalPendulum, "spherical_pendulum");
        $do!(SpringMassTrain, "spring_mass_train");
        $do!(TwoBodyOrbit, "two_body_orbit");
        $do!(TwoDebalanceCrusher, "two_debalance_crusher");
        $do!(TwoJointArm, "two_joint_arm");
        $do!(UprightTop, "upright_top");
        $do!(VibratingCrusher, "vibrating_crusher");
    };
}

/// Invokes a macro for every machine whose accelerations are determined at any state,
/// including those with constraints.
#[macro_export]
macro_rules! for_each_constrained_machine {
    ($do:ident) => {
        $do!(AndrewsSqueezer, "andrews_squeezer");
        $do!(BallInBowl, "ball_in_bowl");
        $do!(CakedCrusher, "caked_crusher");
        $do!(ChaplyginSleigh, "chaplygin_sleigh");
        $do!(ClosedPendulum, "closed_pendulum");
        $do!(CrushingCrusher, "crushing_crusher");
        $do!(FlyballGovernor, "flyball_governor");
        $do!(FourBar, "four_bar");
        $do!(FourBars, "four_bars");
        $do!(GrainCrusher, "grain_crusher");
        $do!(ParticlePendulum, "particle_pendulum");
        $do!(Rattleback, "rattleback");
        $do!(RollingCoin, "rolling_coin");
        $do!(RollingCylinder, "rolling_cylinder");
        $do!(SliderCrank, "slider_crank");
    };
}

/// The source text of a machine of the library.
pub fn text(machine: &str) -> String {
    let path = path(machine);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The program of a machine of the library, with the given constants overridden.
pub fn program(machine: &str, constants: &[(&str, i64)]) -> Proved {
    compile(&path(machine), &text(machine), constants)
}

/// The program of a machine, with the caller's choice among the ways to compute each function.
pub fn program_by(
    machine: &str,
    constants: &[(&str, i64)],
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> Proved {
    compile_by(&path(machine), &text(machine), constants, &|compiled| {
        let model = &compiled.model;
        // The equations in `compiled` may have been multiplied out already.
        let equations = Equations::derive(model, &mut Report::new()).expect("derived before");
        let expanded = equations.expanded();
        let program = lagrangian_mechanics::lower_by(model, &equations, expanded.as_ref(), choose);
        Proved::new(program, model, &equations).expect("a proof")
    })
}

/// A machine of the library, interpreted.
pub fn interpreted(machine: &str) -> InterpretedMachine {
    InterpretedMachine::new(program(machine, &[]))
}

/// An interpreted machine from a text in which `extends` is relative to `machines/`.
pub fn machine(text: &str) -> InterpretedMachine {
    InterpretedMachine::new(compile(&path("test"), text, &[]))
}

/// Compiles a text to a program.
pub fn compile(path: &str, text: &str, constants: &[(&str, i64)]) -> Proved {
    compile_by(path, text, constants, &|compiled| compiled.program.clone())
}

fn compile_by(
    path: &str,
    text: &str,
    constants: &[(&str, i64)],
    program: &dyn Fn(&Compiled<'_>) -> Proved,
) -> Proved {
    let constants: Vec<(String, Rational)> = constants
        .iter()
        .map(|&(name, value)| (name.to_owned(), Rational::from(value)))
        .collect();
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        path,
        text,
        &constants,
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::for_runs(model, &mut report));
    match compiled {
        Some(compiled) => program(&compiled),
        None => panic!("{}", report.render_short(&sources)),
    }
}

/// The path of a machine's file in the library.
pub fn path(machine: &str) -> String {
    let root = super::root();
    format!("{}/machines/{machine}.machine", root.display())
}
