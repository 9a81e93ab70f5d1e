//! Variants: a machine and the specs that it extends, base first.

use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::{Files, Sources, Span};
use crate::syntax::{SectionKind, Spec};
use crate::token;

/// The longest chain of `extends`: real families of machines are a few variants deep.
const DEEPEST: usize = 32;

/// A machine and its bases.
pub(super) struct Layers {
    /// The specs, base first; the machine itself is the last.
    pub specs: Vec<Spec>,
    /// Whether a base is missing, so that unknown names need not be reported.
    pub incomplete: bool,
}

impl Layers {
    /// Reads the spec that a spec extends, and so on.
    pub fn load(
        spec: Spec,
        sections: &[SectionKind],
        files: &mut dyn Files,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Layers {
        let mut specs = vec![spec];
        let mut names: Vec<String> = Vec::new();
        let mut incomplete = false;
        while let Some(extends) = specs.last().and_then(|spec| spec.extends.clone()) {
            let from = sources.name(extends.span.source).to_owned();
            names.push(from.clone());
            let failure = match files.read(&extends.value, Some(&from)) {
                Err(reason) => Err(cannot_read(extends.span, &extends.value, &reason)),
                Ok((name, _)) if names.contains(&name) => {
                    Err(extends_itself(extends.span, &names, &name))
                }
                Ok(_) if specs.len() >= DEEPEST => Err(too_deep(extends.span)),
                Ok(found) => Ok(found),
            };
            match failure {
                Ok((name, text)) => {
                    let source = sources.add(&name, &text);
                    let tokens = token::lex(source, &text, report);
                    specs.push(Spec::read(&tokens, source, sections, report));
                }
                Err(diagnostic) => {
                    report.push(diagnostic);
                    incomplete = true;
                    break;
                }
            }
        }
        specs.reverse();
        Layers { specs, incomplete }
    }
}

fn cannot_read(span: Span, path: &str, reason: &str) -> Diagnostic {
    let message = format!("cannot read `{path}`: {reason}");
    Diagnostic::new(Code::UnreadableFile, span, message)
        .help("the path is relative to the file that contains it")
}

fn extends_itself(span: Span, names: &[String], name: &str) -> Diagnostic {
    let first = names.iter().position(|known| known == name).unwrap_or(0);
    let chain: Vec<&str> = names[first..].iter().map(String::as_str).collect();
    let chain = chain.join("` extends `");
    Diagnostic::new(
        Code::ExtendsItself,
        span,
        format!("a machine cannot extend itself: `{chain}` extends `{name}`"),
    )
}

fn too_deep(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::ExtendsTooDeep,
        span,
        format!("more than {DEEPEST} machines extend each other here"),
    )
}
