//! The C code emitted for machines, compiled by the computer's C compiler and
//! compared with the interpreter.
//!
//! The C library's sine differs from ours, so the last digits differ: each result must be as close
//! to the double-double result as rounding permits. Without a C compiler, nothing is tested.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use lagrangian_emit as emit;
use lagrangian_languages as languages;
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::{Arguments, Interpreter, Program, Role};
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// The C code of a machine of the library with stages, and its program.
fn compiled(machine: &str, constants: &[(String, Rational)]) -> (String, Proved) {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = format!(
        "{}/../../machines/{machine}.machine",
        env!("CARGO_MANIFEST_DIR")
    );
    let (name, text) = Disk.read(&path, None).expect("the library is there");
    let end = text.rfind('}').expect("a machine ends");
    let text = format!("{} stages {{ time, coordinates }} }}", &text[..end]);
    let compiled = lagrangian_spec::model(
        &dag,
        &name,
        &text,
        constants,
        &mut Disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::new(model, &mut report))
    .unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let origin = ["@generated for a test */ that ends no comment".to_owned()];
    (
        languages::c::file(&compiled.program, &origin, &compiled.formulas()),
        compiled.program,
    )
}

/// A program in C that prints the accelerations, the kinetic energy and the accelerations in stages
/// at a state, one number per line.
fn main_of(program: &Program, prefix: &str, t: f64, q: &[f64], v: &[f64]) -> String {
    let list = |values: &[f64]| {
        values
            .iter()
            .map(|x| format!("{x:?}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let defaults: Vec<f64> = program
        .parameters
        .iter()
        .map(|slot| slot.default.as_ref().map_or(1.0, |default| default.value))
        .collect();
    let checks = !program.prepare.guards.is_empty();
    let arguments = |role: Role, to: &str| {
        let reads = program
            .function(role)
            .expect("every machine has it")
            .reads();
        let all = [
            (reads.prepared || (role.inverts() && checks), "&p"),
            (reads.at_time, "at_time"),
            (reads.at_position, "at_position"),
            (reads.time, "t"),
            (reads.coordinates, "q"),
            (reads.velocities, "v"),
            (reads.inputs, "&u"),
        ];
        let read: Vec<&str> = all
            .iter()
            .filter(|(is_read, _)| *is_read)
            .map(|(_, name)| *name)
            .chain((!to.is_empty()).then_some(to))
            .collect();
        read.join(", ")
    };
    let length = |role: Role| program.function(role).map_or(1, |f| f.results.len().max(1));
    let mut text = String::new();
    let n = q.len();
    let inputs = if program.inputs.is_empty() {
        String::new()
    } else {
        format!(
            "    const {prefix}_inputs u = {{{}}};\n",
            list(&vec![1.0; program.inputs.len()])
        )
    };
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "#include <stdio.h>\n#include \"machine.c\"\n\nint main(void) {{\n    \
         const {prefix}_parameters parameters = {{{}}};\n    {prefix}_prepared p;\n    \
         const double t = {t:?}, q[{n}] = {{{}}}, v[{n}] = {{{}}};\n    double a[{n}], at_time[{}], at_position[{}];\n{inputs}    (void)t, (void)v;\n    \
         {prefix}_prepare(&parameters, &p);\n    if ({prefix}_accelerations({})) return 1;\n    \
         for (int i = 0; i < {n}; i++) printf(\"%.17g\\n\", a[i]);\n    \
         printf(\"%.17g\\n\", {prefix}_kinetic_energy({}));\n    \
         {prefix}_at_time({});\n    if ({prefix}_at_position({})) return 1;\n    \
         if ({prefix}_accelerations_at({})) return 1;\n    \
         for (int i = 0; i < {n}; i++) printf(\"%.17g\\n\", a[i]);\n    return 0;\n}}\n",
        list(&defaults),
        list(q),
        list(v),
        length(Role::AtTime),
        length(Role::AtPosition),
        arguments(Role::Accelerations, "a"),
        arguments(Role::KineticEnergy, ""),
        arguments(Role::AtTime, "at_time"),
        arguments(Role::AtPosition, "at_position"),
        arguments(Role::AccelerationsAt, "a"),
    );
    text
}

fn check(machine: &str, size: Option<i64>) {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    if Command::new(&compiler).arg("--version").output().is_err() {
        eprintln!("there is no C compiler; nothing is tested");
        return;
    }
    let constants: Vec<_> = size
        .map(|size| ("N".to_owned(), Rational::from(size)))
        .into_iter()
        .collect();
    let (c, program) = compiled(machine, &constants);
    let prefix = emit::snake_case(&program.name);
    let n = program.dimension();
    let (t, q, v): (f64, Vec<f64>, Vec<f64>) = (
        0.3,
        (0..n).map(|i| 0.4 + 0.07 * i as f64).collect(),
        (0..n).map(|i| 0.5 - 0.1 * i as f64).collect(),
    );
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("c-{machine}-{n}"));
    fs::create_dir_all(&folder).expect("cargo made the folder above");
    fs::write(folder.join("machine.c"), c).expect("the folder can be written");
    fs::write(folder.join("main.c"), main_of(&program, &prefix, t, &q, &v))
        .expect("the folder can be written");
    let output = Command::new(&compiler)
        .args([
            "-std=c99",
            "-pedantic",
            "-Wall",
            "-Wextra",
            "-Wno-missing-braces",
            "-Werror",
            "-O1",
            "main.c",
            "-o",
            "main",
            "-lm",
        ])
        .current_dir(&folder)
        .output()
        .expect("it ran before");
    assert!(
        output.status.success(),
        "{machine}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let output = Command::new(folder.join("main"))
        .output()
        .expect("it was just linked");
    assert!(output.status.success(), "{machine} is not singular here");
    let printed: Vec<f64> = String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(|line| line.parse().expect("printf prints numbers"))
        .collect();

    let exact = |values: &[f64]| {
        values
            .iter()
            .map(|&x| DoubleDouble::from_f64(x))
            .collect::<Vec<_>>()
    };
    let parameters: Vec<f64> = program
        .parameters
        .iter()
        .map(|slot| slot.default.as_ref().map_or(1.0, |default| default.value))
        .collect();
    let mut interpreter = Interpreter::new(&program, &exact(&parameters));
    let (q, v, u) = (
        exact(&q),
        exact(&v),
        exact(&vec![1.0; program.inputs.len()]),
    );
    let arguments = Arguments {
        t: DoubleDouble::from_f64(t),
        q: &q,
        v: &v,
        u: &u,
        a: &[],
    };
    let mut expected = vec![DoubleDouble::ZERO; n + 1];
    let (accelerations, energy) = expected.split_at_mut(n);
    interpreter
        .call(Role::Accelerations, arguments, accelerations)
        .expect("it is not singular here");
    interpreter
        .call(Role::KineticEnergy, arguments, energy)
        .expect("nothing but accelerations can fail");
    let accelerations = expected[..n].to_vec();
    expected.extend(accelerations);
    assert_eq!(printed.len(), 2 * n + 1);
    // A rounding unit of 2⁻⁵³ for each operation, multiplied by the condition of
    // the mass matrix at this state.
    let entries = n * (n + 1) / 2;
    let mut matrix = vec![DoubleDouble::ZERO; entries];
    interpreter
        .call(Role::MassMatrix, arguments, &mut matrix)
        .expect("nothing but accelerations can fail");
    let condition = condition(n, &matrix);
    let operations = |roles: &[Role]| -> usize {
        let functions = roles.iter().filter_map(|role| program.function(*role));
        let counts = functions.map(|function| function.counts());
        counts
            .map(|c| c.multiplications + c.additions + c.divisions + 2 * c.sincos)
            .sum()
    };
    let operations = operations(&[Role::Accelerations]).max(operations(&program.staged_roles()));
    let share = operations as f64 * condition * f64::EPSILON / 2.0;
    let largest = expected
        .iter()
        .map(|x| x.to_f64().abs())
        .fold(1.0, f64::max);
    for (i, (x, exact)) in printed.iter().zip(expected).enumerate() {
        let error = (exact - DoubleDouble::from_f64(*x)).to_f64().abs();
        assert!(
            error <= share * largest,
            "{machine}, result {i}: {x:e} is off by {error:e}"
        );
    }
}

/// `‖M‖ ‖M⁻¹‖` in the Frobenius norm of a positive definite matrix, given as
/// its lower triangle row by row.
fn condition(n: usize, lower: &[DoubleDouble]) -> f64 {
    let entry = |i: usize, j: usize| lower[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
    let matrix: Vec<Vec<DoubleDouble>> = (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect();
    norm(&matrix) * norm(&inverse(matrix.clone()))
}

fn norm(matrix: &[Vec<DoubleDouble>]) -> f64 {
    let squares = matrix.iter().flatten().map(|x| x.to_f64().powi(2));
    squares.sum::<f64>().sqrt()
}

/// Gauss–Jordan elimination without pivoting, which a positive definite matrix does not need.
fn inverse(mut matrix: Vec<Vec<DoubleDouble>>) -> Vec<Vec<DoubleDouble>> {
    for k in 0..matrix.len() {
        let pivot = std::mem::replace(&mut matrix[k][k], DoubleDouble::ONE);
        matrix[k]
            .iter_mut()
            .for_each(|entry| *entry = *entry / pivot);
        let row = matrix[k].clone();
        for (_, other) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = std::mem::replace(&mut other[k], DoubleDouble::ZERO);
            for (entry, above) in other.iter_mut().zip(&row) {
                *entry = *entry - factor * *above;
            }
        }
    }
    matrix
}

#[test]
fn a_matrix_that_is_known_has_the_condition_that_is_known() {
    // [[4, 2], [2, 2]]: ‖M‖² = 28, M⁻¹ = [[2, −2], [−2, 4]]/4, ‖M⁻¹‖² = 28/16.
    let lower = [4.0, 2.0, 2.0].map(DoubleDouble::from_f64);
    assert!((condition(2, &lower) - 7.0).abs() < 1e-15 * 100.0);
}

#[test]
fn a_double_pendulum_in_c() {
    check("double_pendulum", None);
}

#[test]
fn a_crusher_in_c() {
    check("vibrating_crusher", None);
    check("cushioned_crusher", None);
}

#[test]
fn an_arm_with_inputs_in_c() {
    check("six_joint_arm", None);
    check("cart_pole", None);
}

#[test]
fn a_top_in_c() {
    check("heavy_top", None);
}

#[test]
fn a_chain_in_pieces_in_c() {
    check("chain", Some(16));
}

/// Names that are macros of <math.h>: the mass of the Earth is none of 2.718….
#[test]
fn names_of_macros_in_c() {
    let text = "machine Names in plane {
        parameters { M_E: kg = 5, M_PI: N/m = 3, HUGE_VAL: m = 1, NULL: 1 = 2, double: N = 1 }
        coordinates { M_SQRT2: m = 0.2, linux: m, errno: m }
        inputs { FP_ZERO: N = 1 }
        bodies {
            a { mass: M_E, at: (M_SQRT2, NULL*linux) },
            b { mass: M_E, at: (HUGE_VAL*sin(errno/HUGE_VAL), 0) },
        }
        springs { s { stiffness: M_PI, stretch: M_SQRT2 - HUGE_VAL } }
        forces { f { on: linux, value: FP_ZERO + double } }
        gravity none;
        outputs { M_LN2: N = M_PI*M_SQRT2 }
    }";
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "names.machine",
        text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model
        .and_then(|model| Compiled::new(model, &mut report))
        .unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let c = languages::c::file(&compiled.program, &[], &compiled.formulas());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c-names");
    fs::create_dir_all(&folder).expect("cargo made the folder above");
    fs::write(folder.join("names.c"), c).expect("the folder can be written");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let checked = Command::new(&compiler)
        .args(["-std=gnu99", "-fsyntax-only", "-include", "errno.h"])
        .arg(folder.join("names.c"))
        .output();
    let Ok(checked) = checked else {
        eprintln!("there is no C compiler; nothing is tested");
        return;
    };
    let said = String::from_utf8_lossy(&checked.stderr);
    assert!(checked.status.success(), "{said}");
}
