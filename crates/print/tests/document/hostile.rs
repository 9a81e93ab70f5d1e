//! Names and docs with special characters of each language appear as they were written.

use lagrangian_print::document::Document;
use lagrangian_print::{html, latex, markdown};

use crate::compiled;
use crate::markup;

/// Special characters of Markdown, LaTeX and HTML, and letters that fonts lack.
const DOCS: &str = r#"50 % of $x_1$ & y < z > w | a\b {c} ~d^e # "f" 'g' -- [h](i) *j* <b>k</b> &lt; Ж 日 é – ² α ≤ 1. l"#;

fn hostile() -> String {
    format!(
        "/// {DOCS}
        machine Hostile in plane {{
            parameters {{
                /// {DOCS}
                m_a_b1: kg = 1, Ж: N/m = 2, é1: m = 3, θ: rad = 0.5,
            }}
            coordinates {{
                /// {DOCS}
                x_: m, der_1: m, λ[1..8]: rad,
            }}
            inputs {{ /** {DOCS} */ ü: N = 0 }}
            bodies {{
                /// {DOCS}
                a_b {{ mass: m_a_b1, at: (x_, der_1) }},
                c[i in 1..8] {{ mass: m_a_b1, at: (λ[i]*é1, 0) }},
            }}
            springs {{ s_s {{ stiffness: Ж, stretch: x_ - é1*cos(θ) }} }}
            forces {{ f_f {{ on: x_, value: ü }} }}
            outputs {{ /** {DOCS} */ o_o: m = x_ }}
        }}"
    )
}

#[test]
fn latex_escapes_what_it_takes_for_its_own() {
    compiled(&hostile(), |compiled| {
        let text = latex::text(&Document::new(compiled));
        markup::check_latex(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert!(text.contains(r"50 \% of \$x\_1\$ \& y \textless{} z \textgreater{} w \textbar{}"));
        assert!(
            text.contains(r"a\textbackslash{}b \{c\} \textasciitilde{}d\textasciicircum{}e \# ")
        );
    });
}

#[test]
fn html_shows_what_was_written() {
    compiled(&hostile(), |compiled| {
        let page = html::article(&Document::new(compiled));
        markup::check_xml(&page).unwrap_or_else(|e| panic!("{e}\n{page}"));
        // Once for each of the machine, a parameter, a coordinate, the
        // input, the body and the output.
        let shown = markup::text_of_xml(&page);
        let docs = DOCS.replace("*j*", "j");
        assert_eq!(shown.matches(&docs).count(), 6, "{shown}");
        assert_eq!(page.matches("<em>j</em>").count(), 6, "{page}");
    });
}

#[test]
fn markdown_shows_what_was_written() {
    compiled(&hostile(), |compiled| {
        let text = markdown::text(&Document::new(compiled));
        // With the escapes removed, the words are those of the docs; with them,
        // no special construct begins.
        let plain = text
            .replace(r"\\", "\u{1}")
            .replace('\\', "")
            .replace('\u{1}', "\\");
        assert_eq!(plain.matches(DOCS).count(), 6, "{plain}");
        for (index, _) in text.match_indices("x\\_1") {
            let line = text[..index].rsplit('\n').next().unwrap_or("");
            for special in ['|', '$', '<', '*', '_', '&'] {
                let cells = line.trim_start_matches('|').replace(" | ", " ");
                let bare = cells.match_indices(special).filter(|(at, _)| {
                    !cells[..*at].ends_with('\\') && !cells[..*at].ends_with("$")
                });
                let math = cells.matches('$').count();
                assert!(
                    special == '$' || math > 0 || bare.count() == 0,
                    "{special}: {line}"
                );
            }
        }
    });
}
