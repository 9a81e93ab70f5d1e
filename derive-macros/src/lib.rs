//! `machine!`: compiles the spec of a machine to the Rust code that simulates it.
//!
//! This crate only converts tokens; the compiler itself is in the crates below it.

mod arguments;
mod errors;
mod files;
mod tokens;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::thread;

use lagrangian_emit::rust;
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Files, SourceId, Sources};
use lagrangian_spec::syntax::{Ident, Spec};
use lagrangian_spec::token::Token;
use lagrangian_symbolic::{Dag, Rational};
use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};
use quote::quote;
use syn::LitStr;

use arguments::{Arguments, Attributes};
use files::Tracked;
use tokens::Flat;

/// The stack size of the thread that compiles. Recursion is never deep, but unoptimized code has large frames.
const STACK: usize = 64 << 20;

/// Compiles a machine into the Rust that simulates it.
///
/// ```ignore
/// // The machine itself:
/// lagrangian::machine! {
///     machine Oscillator in plane {
///         parameters { m: kg = 1, c: N/m = 40 }
///         coordinates { x: m = 0.1 }
///         bodies { block { mass: m, at: (x, 0) } }
///         springs { spring { stiffness: c, stretch: x } }
///     }
/// }
/// // Or the file that holds it, with another size:
/// lagrangian::machine!(file = "machines/chain.machine", N = 64);
/// ```
///
/// A file is searched for beside `Cargo.toml`, then beside the source file that invokes the macro; the path of an
/// `extends` is relative to the file that contains it. Cargo recompiles when one of these files is edited.
///
/// For `machine Oscillator` the macro generates a module `oscillator` and a type `Oscillator`, the struct of its
/// parameters. The module contains the functions of the machine (`oscillator::accelerations`, `mass_matrix`, …), generic
/// over the number type, and the structs `Coordinates`, `Inputs`, `Outputs` and `Prepared`, which implements `System`.
///
/// If the description names Cartesian coordinates for points in polar ones (`charts`), the module `oscillator::cartesian` holds the same
/// machine in these, and `Oscillator` implements `Charted`.
///
/// Attributes before `machine` or before `file` are applied by kind: `#[derive(serde::Serialize)]` and other attributes of
/// structs to the structs with fields named by the machine (parameters, coordinates, inputs, outputs), lints to the module,
/// `cfg` to everything. The structs are in the module, so attributes must refer to items imported beside the machine by
/// their full path.
///
/// A leading `crate = path,` gives the path of the runtime, if it is not `::lagrangian`.
#[proc_macro]
pub fn machine(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    match Arguments::parse(input.into()) {
        Ok(arguments) => expand(arguments).into(),
        Err(error) => error.to_compile_error().into(),
    }
}

/// The input of a compilation.
struct Job {
    sources: Sources,
    report: Report,
    input: Input,
    constants: Vec<(String, Rational)>,
    options: rust::Options,
}

enum Input {
    Tokens(Vec<Token>),
    File(PathBuf),
}

/// The result of a compilation.
struct Outcome {
    sources: Sources,
    report: Report,
    /// The generated Rust code.
    text: String,
    /// The name of the machine, with its span.
    name: Ident,
    /// The names of parameters, coordinates, inputs and outputs, with their spans; names in a file have none.
    fields: Vec<Ident>,
    read: Vec<PathBuf>,
}

fn expand(arguments: Arguments) -> TokenStream {
    let call = proc_macro::Span::call_site();
    let invoking = call.local_file();
    let mut sources = Sources::new();
    let mut report = Report::new();
    let mut flat = Flat::default();
    let input = match &arguments.file {
        Some(file) => match files::find(&file.value(), invoking.as_deref()) {
            Ok(path) => Input::File(path),
            Err(message) => return errors::compile_error(file.span(), file.span(), &message),
        },
        None => {
            let name =
                invoking.map_or_else(|| call.file(), |path| path.to_string_lossy().into_owned());
            flat = tokens::flatten(arguments.machine, SourceId::default(), &mut report);
            sources.add_tokens(name, positions(&flat));
            Input::Tokens(std::mem::take(&mut flat.tokens))
        }
    };
    let options = rust::Options {
        runtime: arguments.runtime + "::emitted",
        marks: true,
        ..rust::Options::default()
    };
    let job = Job {
        sources,
        report,
        input,
        constants: arguments.constants,
        options,
    };
    let outcome = match on_a_large_stack(move || compile(job)) {
        Ok(outcome) => outcome,
        Err(message) => {
            let place = arguments
                .file
                .as_ref()
                .map_or_else(Span::call_site, LitStr::span);
            return errors::compile_error(place, place, &message);
        }
    };

    let place = |span| match &arguments.file {
        Some(file) => (file.span(), file.span()),
        None => flat.ends(span),
    };
    let attributes = arguments.attributes;
    let rust = match outcome.text.parse() {
        Ok(tokens) => {
            let rust = named(tokens, &outcome.name.text, place(outcome.name.span).0);
            let fields = outcome.fields.iter();
            let fields = fields.map(|of| (lagrangian_emit::identifier(&of.text), place(of.span).0));
            opened(rust, &attributes, &fields.collect())
        }
        Err(error) => {
            let message =
                format!("the machine compiler produced invalid Rust ({error}); please report it");
            errors::compile_error(Span::call_site(), Span::call_site(), &message)
        }
    };
    let errors = errors::all(&outcome.report, &outcome.sources, place);
    // Cargo recompiles when one of these files changes.
    let read = outcome
        .read
        .iter()
        .map(|path| path.to_string_lossy().into_owned());
    quote! {
        #(const _: &[u8] = ::core::include_bytes!(#read);)*
        #errors
        #rust
    }
}

/// Line and column of each token.
fn positions(flat: &Flat) -> Vec<(usize, usize)> {
    flat.places
        .iter()
        .map(|place| place.unwrap())
        .map(|place| (place.line(), place.column()))
        .collect()
}

fn compile(job: Job) -> Result<Outcome, String> {
    let Job {
        mut sources,
        mut report,
        input,
        constants,
        options,
    } = job;
    let mut files = Tracked::default();
    let is_here = matches!(input, Input::Tokens(_));
    let spec = match input {
        Input::Tokens(tokens) => Spec::parse(&tokens, SourceId::default(), &mut report),
        Input::File(path) => {
            let path = path.to_string_lossy();
            let (name, text) = files
                .read(&path, None)
                .map_err(|reason| format!("cannot read `{path}`: {reason}"))?;
            lagrangian_spec::parse(&mut sources, &name, &text, &mut report)
        }
    };
    let name = spec.name.clone();
    let sections = [
        &spec.parameters,
        &spec.coordinates,
        &spec.inputs,
        &spec.outputs,
    ];
    let items = sections.into_iter().flatten().filter(|_| is_here);
    let fields = items.map(|item| item.name.base.clone()).collect();
    let stub = rust::stub(&spec, &options);
    let dag = Dag::new();
    let model = Model::resolve(
        spec,
        &dag,
        &constants,
        &mut files,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::in_charts(model, &mut report));
    let text = match compiled {
        Some((compiled, cartesian)) => {
            let options = rust::Options {
                runtime: options.runtime,
                marks: options.marks,
                ..rust::Options::of(&compiled, cartesian.as_ref())
            };
            rust::expansion(&compiled.program, &options)
        }
        None => stub,
    };
    Ok(Outcome {
        sources,
        report,
        text,
        name,
        fields,
        read: files.read,
    })
}

/// Runs the compiler in a thread with a large stack; a panic there becomes an error here.
fn on_a_large_stack<T: Send + 'static>(
    job: impl FnOnce() -> Result<T, String> + Send + 'static,
) -> Result<T, String> {
    let thread = thread::Builder::new()
        .stack_size(STACK)
        .spawn(job)
        .map_err(|error| error.to_string())?;
    thread.join().unwrap_or_else(|panic| {
        let text = panic
            .downcast_ref::<String>()
            .map(String::as_str)
            .or(panic.downcast_ref::<&str>().copied());
        Err(format!(
            "the machine compiler has failed ({}); please report it",
            text.unwrap_or("no message")
        ))
    })
}

/// Gives the machine's name its span in the user's source, wherever it occurs outside of brackets.
fn named(tokens: TokenStream, name: &str, place: Span) -> TokenStream {
    let name = lagrangian_emit::identifier(name);
    let with_place = |mut tree: TokenTree| {
        if let TokenTree::Ident(ident) = &mut tree
            && *ident == name
        {
            ident.set_span(place.resolved_at(ident.span()));
        }
        tree
    };
    tokens.into_iter().map(with_place).collect()
}

/// Gives the marked structs the attributes of the user, and their fields the spans of the user's declarations, so that lints,
/// errors and an editor's search for definitions lead there.
fn opened(
    tokens: TokenStream,
    attributes: &Attributes,
    fields: &BTreeMap<String, Span>,
) -> TokenStream {
    let Attributes {
        items,
        module,
        structs,
    } = attributes;
    let mut opened = quote!(#items #module);
    for tree in tokens {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let inside = with_marks(group.stream(), structs, fields);
                opened.extend(regrouped(&group, inside));
                opened.extend(items.clone());
            }
            other => opened.extend([other]),
        }
    }
    opened
}

/// Processes the items of the module, and of the module of the machine in another chart within it.
fn with_marks(
    tokens: TokenStream,
    structs: &TokenStream,
    fields: &BTreeMap<String, Span>,
) -> TokenStream {
    let mut with_marks = TokenStream::new();
    let (mut is_marked, mut opens_module) = (false, false);
    let mut tokens = tokens.into_iter().peekable();
    while let Some(tree) = tokens.next() {
        match (tree, tokens.peek()) {
            (TokenTree::Punct(hash), Some(TokenTree::Group(group)))
                if hash.as_char() == '#' && group.stream().to_string() == rust::MARK =>
            {
                tokens.next();
                with_marks.extend(structs.clone());
                is_marked = true;
            }
            (TokenTree::Group(group), _) if is_marked && group.delimiter() == Delimiter::Brace => {
                is_marked = false;
                let mut is_name = false;
                let placed = group.stream().into_iter().map(|mut tree| {
                    if let TokenTree::Ident(ident) = &mut tree {
                        if let Some(place) = fields.get(&ident.to_string()).filter(|_| is_name) {
                            ident.set_span(place.resolved_at(ident.span()));
                        }
                        is_name = *ident == "pub";
                    }
                    tree
                });
                let placed = placed.collect();
                with_marks.extend(regrouped(&group, placed));
            }
            (TokenTree::Group(group), _)
                if opens_module && group.delimiter() == Delimiter::Brace =>
            {
                opens_module = false;
                let inside = self::with_marks(group.stream(), structs, fields);
                with_marks.extend(regrouped(&group, inside));
            }
            (other, _) => {
                // The name of a module comes between.
                if let TokenTree::Ident(ident) = &other {
                    opens_module = *ident == "mod" || opens_module;
                }
                with_marks.extend([other]);
            }
        }
    }
    with_marks
}

/// A group with the delimiters and the position of another one and with these tokens inside.
fn regrouped(group: &Group, inside: TokenStream) -> [TokenTree; 1] {
    let mut other = Group::new(group.delimiter(), inside);
    other.set_span(group.span());
    [other.into()]
}
