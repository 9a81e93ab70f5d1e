//! The chapter on a machine: its groups add up, the quantities that it calls conserved are conserved,
//! and its texts are well formed.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod docs;
mod facts;
#[allow(dead_code, reason = "shared with the tests of the equations")]
#[path = "../../../mechanics/tests/mechanics/harness.rs"]
mod harness;
mod hostile;
mod markup;

use harness::{all_machines, residues, resolved};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::equations::groups::{self, TermKind};
use lagrangian_print::document::{Block, Document, columns};
use lagrangian_print::{html, latex, markdown};
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::diagnostic::Report;

/// Compiles a machine whose files are in the library.
fn compiled<R>(text: &str, look: impl for<'d> FnOnce(&Compiled<'d>) -> R) -> R {
    resolved(text, |model| {
        let mut report = Report::new();
        let compiled = Compiled::new(model.clone(), &mut report);
        look(&compiled.unwrap_or_else(|| panic!("{:?}", report.diagnostics())))
    })
}

/// Visits every machine of the library and of the tests.
fn every_machine(mut look: impl for<'d> FnMut(&str, &Compiled<'d>)) {
    for (name, text) in all_machines() {
        compiled(&text, |compiled| look(&name, compiled));
    }
}

#[test]
fn groups_add_up_to_the_equations() {
    every_machine(
        |name,
         Compiled {
             model, equations, ..
         }| {
            let shares = groups::force_shares(model);
            let mut differences = Vec::new();
            for i in 0..model.coordinates.len() {
                let inertia = model.coordinates.iter().enumerate();
                let inertia = inertia.map(|(j, c)| *equations.mass_matrix.get(i, j) * c.a);
                let others = [equations.bias[i], -equations.applied[i]];
                let whole = model.dag.sum(inertia.chain(others));
                let groups = groups::equation(model, equations, &shares, i);
                let terms = groups.iter().flat_map(|group| {
                    let sign = if group.kind == TermKind::Applied {
                        -1
                    } else {
                        1
                    };
                    group.terms.iter().map(move |term| sign * term.value())
                });
                differences.push(model.dag.sum(terms) - whole);
            }
            for values in residues(model, equations, &differences, false) {
                assert!(
                    values.iter().all(|&value| value == Residue::ZERO),
                    "{name}: {values:?}"
                );
            }
        },
    );
}

#[test]
fn sources_add_up_to_energies_and_forces() {
    every_machine(
        |name,
         Compiled {
             model, equations, ..
         }| {
            let shares = groups::force_shares(model);
            let dag = model.dag;
            let energy = |is_part: &dyn Fn(TermKind) -> bool| {
                let parts = shares.iter().filter(|part| is_part(part.kind));
                dag.sum(parts.filter_map(|part| part.energy))
            };
            let damps = |kind| kind == TermKind::Dissipation;
            // The equation of the integral of a state has its rate, which is no force.
            let is_integral = |i: usize| {
                model.coordinates[i]
                    .name
                    .to_string()
                    .starts_with("integral(")
            };
            // The terms that keep quaternions at unit length belong to no element.
            let on_lengths = groups::length_forces(model);
            let mut differences = vec![
                energy(&|kind| !damps(kind)) - equations.potential_energy,
                energy(&damps) - equations.dissipation,
            ];
            differences.extend(
                (0..model.coordinates.len())
                    .filter(|&i| !is_integral(i))
                    .map(|i| {
                        let forces = shares.iter().map(|part| part.forces[i]);
                        dag.sum(forces.chain([on_lengths[i]])) - equations.applied[i]
                    }),
            );
            for values in residues(model, equations, &differences, false) {
                assert!(
                    values.iter().all(|&value| value == Residue::ZERO),
                    "{name}: {values:?}"
                );
            }
        },
    );
}

#[test]
fn velocity_terms_are_what_their_notes_say() {
    every_machine(
        |name,
         Compiled {
             model, equations, ..
         }| {
            let shares = groups::force_shares(model);
            // Squares grow fourfold when all rates double and keep their sign when one rate changes its sign. Products of
            // two rates also grow fourfold, but change their sign. Terms of drives do neither.
            for i in 0..model.coordinates.len() {
                for group in groups::equation(model, equations, &shares, i) {
                    let degree = |term: &groups::Term<'_>| -> Vec<usize> {
                        let rates = model.coordinates.iter().filter_map(|c| c.v.as_symbol());
                        let powers = rates.map(|v| {
                            let once = term.value().diff(v);
                            usize::from(!once.is_zero()) + usize::from(!once.diff(v).is_zero())
                        });
                        powers.collect()
                    };
                    for term in &group.terms {
                        let powers = degree(term);
                        let total: usize = powers.iter().sum();
                        match group.kind {
                            TermKind::Centrifugal => {
                                assert!(total == 2 && powers.contains(&2), "{name}")
                            }
                            TermKind::Coriolis => {
                                assert!(total == 2 && !powers.contains(&2), "{name}")
                            }
                            TermKind::Drive => assert!(total < 2, "{name}"),
                            _ => {}
                        }
                    }
                }
            }
        },
    );
}

#[test]
fn every_chapter_is_well_formed() {
    every_machine(|name, compiled| {
        let document = Document::new(compiled);
        markup::check_latex(&latex::text(&document)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let page = html::text(&document);
        let page = page
            .strip_prefix("<!DOCTYPE html>\n")
            .expect("a document type");
        markup::check_xml(page).unwrap_or_else(|e| panic!("{name}: {e}"));
        markup::check_xml(&html::article(&document)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let text = markdown::text(&document);
        assert_eq!(text.matches("\n$$\n").count() % 2, 0, "{name}");
        assert_eq!(
            text.matches("$$").count(),
            text.matches("\n$$\n").count(),
            "{name}"
        );
    });
}

#[test]
fn what_friction_changes_is_not_called_conserved() {
    let mut rubbing = 0;
    every_machine(|name, compiled| {
        let mut sliding = compiled.equations.sliding.iter();
        if sliding.any(|one| !one.friction.is_zero()) {
            let text = markdown::text(&Document::new(compiled));
            assert!(!text.contains("Energy is conserved"), "{name}");
            rubbing += 1;
        }
    });
    assert!(rubbing >= 6, "{rubbing}");
    // The momentum of two prisms on a rough floor.
    compiled(&harness::text_of("prisms"), |compiled| {
        let text = markdown::text(&Document::new(compiled));
        assert!(!text.contains("momentum is conserved"), "{text}");
        assert!(text.contains("alone acts on it"), "{text}");
    });
}

#[test]
fn every_formula_fits_the_page() {
    let mut wide = Vec::new();
    every_machine(|name, compiled| {
        for section in Document::new(compiled).sections {
            for block in section.blocks {
                let Block::Formula(rows) = block else {
                    continue;
                };
                for row in rows {
                    // 17 cm of paper in a 10 point font, less the indent.
                    let width = row.math.width() + row.indent as f32;
                    if width > 46.0 {
                        wide.push(format!("{name}: {width} em: {}", row.math.latex()));
                    }
                }
            }
        }
    });
    assert!(wide.is_empty(), "{}", wide.join("\n"));
}

#[test]
fn every_table_fits_the_page() {
    let mut wide = Vec::new();
    every_machine(|name, compiled| {
        for section in Document::new(compiled).sections {
            for block in section.blocks {
                let Block::Table(head, rows) = block else {
                    continue;
                };
                // 17 cm of paper in a 10 point font.
                let columns = columns(&head, &rows);
                let width: f32 = columns.iter().map(|column| column.width()).sum();
                if width > 48.3 {
                    wide.push(format!("{name}: {width} em: {head:?}"));
                }
            }
        }
    });
    assert!(wide.is_empty(), "{}", wide.join("\n"));
}

#[test]
#[ignore = "needs pdflatex"]
fn every_chapter_compiles_without_an_overfull_line() {
    let folder = std::env::temp_dir().join(format!("lagrangian-chapters-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    every_machine(|name, compiled| {
        let text = latex::text(&Document::new(compiled));
        std::fs::write(folder.join(format!("{name}.tex")), text).expect("a file");
        let run = std::process::Command::new("pdflatex")
            .args(["-interaction=nonstopmode", "-halt-on-error"])
            .arg(format!("{name}.tex"))
            .current_dir(&folder)
            .output()
            .expect("pdflatex runs");
        let log = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{name}: {log}");
        assert!(!log.contains("Overfull"), "{name}: {log}");
    });
    std::fs::remove_dir_all(&folder).expect("the folder goes");
}
