//! The public interface of a crate as text, read from its sources: everything that a user can name, with its signature.
//!
//! `docs/api/` holds it for the library; a test reports what has been removed or changed. Items that macros generate are not seen,
//! and implementations of traits are listed only by their headers.

use std::collections::BTreeSet;
use std::fs;
use std::iter::Peekable;
use std::path::{Path, PathBuf};
use std::vec::IntoIter;

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

use crate::modules::{Names, absolute, leaves_of_use, place, plain};

/// A module as written in the sources.
struct Module {
    path: Names,
    items: Vec<Item>,
    /// What `pub use` re-exports: a path from the root of the crate, and the name here.
    exports: Vec<(Names, String, String)>,
}

/// An item of a module, or of a trait or an implementation.
struct Item {
    /// `struct`, `fn`, `impl`, …
    kind: String,
    /// Its name; for an implementation, the name of the type.
    name: String,
    is_public: bool,
    is_hidden: bool,
    /// `cfg(feature = "std")` and the like, and the derived traits.
    conditions: String,
    derived: Vec<String>,
    /// All tokens before its body.
    head: Vec<TokenTree>,
    /// The tokens between its braces or parentheses, if users see them.
    body: Option<(Delimiter, Vec<TokenTree>)>,
}

/// The interface of the crate with this root file: a sorted list with one line for each public item.
///
/// # Errors
/// A file that is missing, or that is not valid Rust.
pub fn public(root: &Path, name: &str) -> Result<Vec<String>, String> {
    let mut modules = Vec::new();
    let folder = root.parent().unwrap_or(Path::new("."));
    read_file(root, folder, &Vec::new(), &mut modules)?;
    let mut reader = Reader {
        modules: &modules,
        lines: BTreeSet::new(),
        types: BTreeSet::new(),
    };
    reader.module(&Vec::new(), name);
    reader.implementations();
    Ok(reader.lines.into_iter().collect())
}

/// The items that an interface has lost or changed: the lines of `before` that are not in `now`.
pub fn lost_items<'a>(before: &'a str, now: &[String]) -> Vec<&'a str> {
    let now: BTreeSet<&str> = now.iter().map(String::as_str).collect();
    let lines = before.lines().filter(|line| !line.is_empty());
    lines.filter(|line| !now.contains(line)).collect()
}

fn read_file(
    path: &Path,
    children: &Path,
    module: &Names,
    modules: &mut Vec<Module>,
) -> Result<(), String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = fs::read_to_string(path).map_err(|error| wrong(&error))?;
    let tokens: TokenStream = text.parse().map_err(|error| wrong(&error))?;
    read_module(tokens, children, module, modules)
}

/// Reads the tokens of a module, and the files of its children in the folder `children`.
fn read_module(
    tokens: TokenStream,
    children: &Path,
    path: &Names,
    modules: &mut Vec<Module>,
) -> Result<(), String> {
    let mut exports = Vec::new();
    let mut items = Vec::new();
    for item in items_of(tokens.into_iter().collect()) {
        match item.kind.as_str() {
            "use" if item.is_public && !item.is_hidden => {
                let mut leaves = Vec::new();
                leaves_of_use(&item.head[1..], &[], &mut leaves);
                for (leaf, name) in leaves {
                    let name = name.or_else(|| leaf.last().cloned()).unwrap_or_default();
                    exports.push((absolute(leaf, path), name, item.conditions.clone()));
                }
            }
            "mod" => {
                let child: Names = path.iter().cloned().chain([item.name.clone()]).collect();
                match &item.body {
                    Some((_, body)) => {
                        let body = body.iter().cloned().collect();
                        read_module(body, &children.join(&item.name), &child, modules)?;
                    }
                    None => {
                        let (file, below): (PathBuf, PathBuf) =
                            place(&|path| fs::read_to_string(path), children, &item.name, None);
                        read_file(&file, &below, &child, modules)?;
                    }
                }
                items.push(item);
            }
            _ => items.push(item),
        }
    }
    modules.push(Module {
        path: path.clone(),
        items,
        exports,
    });
    Ok(())
}

impl Item {
    /// Everything before its body, as one line, without the names of a function's arguments, which are not part of the interface.
    fn text(&self) -> String {
        let mut head = self.head.clone();
        let arguments = head.iter_mut().find_map(|token| match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis => Some(token),
            _ => None,
        });
        if let (Some(token), "fn") = (arguments, self.kind.as_str())
            && let TokenTree::Group(group) = &*token
        {
            let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
            let mut types = TokenStream::new();
            for argument in parts(&tokens) {
                let is_mark = |i: usize, mark: char| matches!(argument.get(i), Some(TokenTree::Punct(found)) if found.as_char() == mark);
                let is_named = is_mark(1, ':') && !is_mark(2, ':');
                let skipped = match argument.first() {
                    Some(TokenTree::Ident(word)) if *word == "mut" && is_mark(2, ':') => 3,
                    Some(TokenTree::Ident(word)) if *word == "mut" => 1,
                    _ if is_named => 2,
                    _ => 0,
                };
                types.extend(argument.into_iter().skip(skipped));
                types.extend([TokenTree::Punct(proc_macro2::Punct::new(
                    ',',
                    Spacing::Alone,
                ))]);
            }
            *token = TokenTree::Group(proc_macro2::Group::new(Delimiter::Parenthesis, types));
        }
        tidy(head.into_iter().collect())
    }
}

/// The tokens of a file that are still to be read.
type Rest = Peekable<IntoIter<TokenTree>>;

/// The items in a token stream.
fn items_of(tokens: Vec<TokenTree>) -> Vec<Item> {
    let mut items = Vec::new();
    let mut rest = tokens.into_iter().peekable();
    while rest.peek().is_some() {
        let mut item = Item {
            kind: String::new(),
            name: String::new(),
            is_public: false,
            is_hidden: false,
            conditions: String::new(),
            derived: Vec::new(),
            head: Vec::new(),
            body: None,
        };
        let is_left_out = item.take_attributes(&mut rest);
        item.take_visibility(&mut rest);
        item.take_head(&mut rest);
        if item.kind == "impl" {
            item.name = type_of(&item.head);
        }
        if !item.kind.is_empty() && !is_left_out {
            items.push(item);
        }
    }
    items
}

/// The words that begin an item, besides `const`, which may also begin a function.
const KINDS: [&str; 11] = [
    "struct",
    "enum",
    "union",
    "trait",
    "impl",
    "mod",
    "use",
    "type",
    "static",
    "macro_rules",
    "fn",
];

impl Item {
    /// Takes the attributes, of the item or of the file; returns whether the item belongs to tests only.
    fn take_attributes(&mut self, rest: &mut Rest) -> bool {
        let mut is_left_out = false;
        while let Some(TokenTree::Punct(mark)) = rest.peek()
            && mark.as_char() == '#'
        {
            rest.next();
            if let Some(TokenTree::Punct(mark)) = rest.peek()
                && mark.as_char() == '!'
            {
                rest.next();
            }
            if let Some(TokenTree::Group(group)) = rest.next() {
                let text = tidy(group.stream());
                is_left_out |= ["cfg(test", "cfg(doctest", "cfg(all(doctest"]
                    .iter()
                    .any(|start| text.starts_with(start));
                self.is_hidden |= text == "doc(hidden)";
                if text.starts_with("cfg(") || text == "non_exhaustive" {
                    self.conditions += &format!("#[{text}] ");
                }
                if let Some(list) = text.strip_prefix("derive(") {
                    let list = list.trim_end_matches(')').split(", ");
                    self.derived.extend(list.map(str::to_owned));
                }
            }
        }
        is_left_out
    }

    /// Takes `pub`. What is public only within a crate or a module is not.
    fn take_visibility(&mut self, rest: &mut Rest) {
        if !matches!(rest.peek(), Some(TokenTree::Ident(word)) if *word == "pub") {
            return;
        }
        rest.next();
        self.is_public = true;
        if let Some(TokenTree::Group(group)) = rest.peek()
            && group.delimiter() == Delimiter::Parenthesis
        {
            rest.next();
            self.is_public = false;
        }
    }

    /// Takes everything up to the body or the semicolon, and the body. The value of a constant is not part of the interface.
    fn take_head(&mut self, rest: &mut Rest) {
        let mut is_value = false;
        for token in rest {
            match &token {
                TokenTree::Ident(word) if self.kind.is_empty() => {
                    let word = plain(word);
                    if word == "const" || KINDS.contains(&word.as_str()) {
                        self.kind = word;
                    }
                }
                // `const fn`
                TokenTree::Ident(word) if self.kind == "const" && *word == "fn" => {
                    self.kind = "fn".to_owned();
                }
                TokenTree::Ident(word) if self.name.is_empty() && self.kind != "impl" => {
                    self.name = plain(word);
                }
                TokenTree::Punct(mark) if mark.as_char() == '=' => {
                    is_value |= matches!(self.kind.as_str(), "const" | "static");
                }
                TokenTree::Punct(mark) if mark.as_char() == ';' => break,
                TokenTree::Group(group)
                    if group.delimiter() == Delimiter::Brace
                        && !matches!(self.kind.as_str(), "use" | "const" | "static") =>
                {
                    let body = group.stream().into_iter().collect();
                    self.body = Some((Delimiter::Brace, body));
                    break;
                }
                TokenTree::Group(group)
                    if group.delimiter() == Delimiter::Parenthesis && self.kind == "struct" =>
                {
                    let body = group.stream().into_iter().collect();
                    self.body = Some((Delimiter::Parenthesis, body));
                    continue;
                }
                _ => {}
            }
            if !is_value {
                self.head.push(token);
            }
        }
    }
}

/// The name of the type that is implemented for.
fn type_of(head: &[TokenTree]) -> String {
    let mut depth = 0_i32;
    let mut name = String::new();
    for (i, token) in head.iter().enumerate().skip(1) {
        match token {
            TokenTree::Punct(mark) if mark.as_char() == '<' => depth += 1,
            TokenTree::Punct(mark) if mark.as_char() == '>' => {
                let is_arrow = matches!(head.get(i.wrapping_sub(1)), Some(TokenTree::Punct(before)) if before.as_char() == '-');
                depth -= i32::from(!is_arrow);
            }
            TokenTree::Ident(word) if depth == 0 => match plain(word).as_str() {
                "for" => name.clear(),
                "where" => break,
                word => word.clone_into(&mut name),
            },
            _ => {}
        }
    }
    name
}

struct Reader<'m> {
    modules: &'m [Module],
    lines: BTreeSet<String>,
    /// The names of the public types.
    types: BTreeSet<String>,
}

impl<'m> Reader<'m> {
    fn find(&self, path: &[String]) -> Option<&'m Module> {
        self.modules.iter().find(|module| module.path == path)
    }

    /// Lists the public items of a module, under its public name.
    fn module(&mut self, path: &[String], name: &str) {
        let Some(module) = self.find(path) else {
            return;
        };
        for item in &module.items {
            if item.is_public && !item.is_hidden {
                self.item(item, path, name, &item.name, "");
            }
        }
        for (target, known_as, conditions) in &module.exports {
            if !self.exported(target, name, known_as, conditions, 0) {
                let target = target.join("::");
                let line = format!("{name}::{known_as} = {conditions}{target}");
                self.lines.insert(line);
            }
        }
    }

    /// Lists what `pub use` re-exports from this crate.
    fn exported(
        &mut self,
        target: &[String],
        name: &str,
        known_as: &str,
        conditions: &str,
        depth: usize,
    ) -> bool {
        let Some((last, parents)) = target.split_last() else {
            return false;
        };
        let Some(module) = self.find(parents) else {
            return false;
        };
        let mut found = false;
        for item in module
            .items
            .iter()
            .filter(|item| item.name == *last && item.kind != "impl")
        {
            self.item(item, parents, name, known_as, conditions);
            found = true;
        }
        /// The maximum length of a chain of re-exports.
        const DEEPEST: usize = 8;
        for (behind, other, more) in &module.exports {
            if other == last && !found && depth < DEEPEST {
                let conditions = format!("{conditions}{more}");
                found = self.exported(behind, name, known_as, &conditions, depth + 1);
            }
        }
        found
    }

    /// Lists an item under a public name, with its contents.
    fn item(&mut self, item: &Item, path: &[String], name: &str, known_as: &str, more: &str) {
        let full = format!("{name}::{known_as}");
        if item.kind == "mod" {
            let child: Names = path.iter().cloned().chain([item.name.clone()]).collect();
            self.lines
                .insert(format!("{full}: {more}{}mod", item.conditions));
            return self.module(&child, &full);
        }
        let head = item.text();
        let conditions = &item.conditions;
        self.lines
            .insert(format!("{full}: {more}{conditions}{head}"));
        if matches!(
            item.kind.as_str(),
            "struct" | "enum" | "trait" | "type" | "union"
        ) {
            self.types.insert(item.name.clone());
        }
        for derived in &item.derived {
            self.lines.insert(format!("{full}: derives {derived}"));
        }
        let Some((delimiter, body)) = &item.body else {
            return;
        };
        match item.kind.as_str() {
            "struct" => {
                for (i, field) in parts(body).into_iter().enumerate() {
                    if let [TokenTree::Ident(word), rest @ ..] = field.as_slice()
                        && *word == "pub"
                        && !matches!(rest.first(), Some(TokenTree::Group(_)))
                    {
                        let text = tidy(rest.iter().cloned().collect());
                        let text = match delimiter {
                            Delimiter::Parenthesis => format!("{i}: {text}"),
                            _ => text,
                        };
                        self.lines.insert(format!("{full}.{text}"));
                    }
                }
            }
            "enum" => {
                for variant in parts(body) {
                    let text = tidy(without_attributes(variant).into_iter().collect());
                    self.lines.insert(format!("{full}::{text}"));
                }
            }
            "trait" => {
                for member in items_of(body.clone()) {
                    if member.is_hidden {
                        continue;
                    }
                    let text = member.text();
                    let provided = if member.body.is_some() {
                        " { … }"
                    } else {
                        ""
                    };
                    let conditions = &member.conditions;
                    self.lines.insert(format!(
                        "{full}::{}: {conditions}{text}{provided}",
                        member.name
                    ));
                }
            }
            _ => {}
        }
    }

    /// Lists the implementations for the public types.
    fn implementations(&mut self) {
        let all = self.modules.iter().flat_map(|module| &module.items);
        for item in all.filter(|item| item.kind == "impl" && self.types.contains(&item.name)) {
            let head = tidy(item.head.iter().cloned().collect());
            let mut depth = 0_i32;
            let is_of_trait = item.head.iter().skip(1).any(|token| match token {
                TokenTree::Punct(mark) => {
                    depth += match mark.as_char() {
                        '<' => 1,
                        '>' => -1,
                        _ => 0,
                    };
                    false
                }
                TokenTree::Ident(word) => *word == "for" && depth == 0,
                _ => false,
            });
            let conditions = &item.conditions;
            if is_of_trait {
                self.lines.insert(format!("{conditions}{head}"));
                continue;
            }
            let Some((_, body)) = &item.body else {
                continue;
            };
            for member in items_of(body.clone()) {
                if member.is_public && !member.is_hidden {
                    let text = member.text();
                    let more = &member.conditions;
                    self.lines
                        .insert(format!("{conditions}{head}: {more}{text}"));
                }
            }
        }
    }
}

/// The tokens between commas, except commas within generics, without attributes.
fn parts(tokens: &[TokenTree]) -> Vec<Vec<TokenTree>> {
    let mut parts = vec![Vec::new()];
    let mut depth = 0_i32;
    let mut before = ' ';
    for token in tokens {
        let mark = match token {
            TokenTree::Punct(mark) => mark.as_char(),
            _ => ' ',
        };
        match mark {
            '<' => depth += 1,
            '>' if before != '-' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(Vec::new());
                before = mark;
                continue;
            }
            _ => {}
        }
        before = mark;
        if let Some(part) = parts.last_mut() {
            part.push(token.clone());
        }
    }
    let parts = parts.into_iter().map(without_attributes);
    parts.filter(|part| !part.is_empty()).collect()
}

fn without_attributes(tokens: Vec<TokenTree>) -> Vec<TokenTree> {
    let mut remaining = Vec::new();
    let mut rest = tokens.into_iter();
    while let Some(token) = rest.next() {
        match &token {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                rest.next();
            }
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let fields = without_attributes(group.stream().into_iter().collect());
                let fields =
                    proc_macro2::Group::new(Delimiter::Brace, fields.into_iter().collect());
                remaining.push(TokenTree::Group(fields));
            }
            _ => remaining.push(token),
        }
    }
    remaining
}

/// The tokens as one line, with spaces as in formatted code.
fn tidy(tokens: TokenStream) -> String {
    let mut text = String::new();
    let mut is_joint = false;
    for token in tokens {
        let next = match &token {
            TokenTree::Group(group) => {
                let inner = tidy(group.stream());
                match group.delimiter() {
                    Delimiter::Parenthesis => format!("({})", inner.trim_end_matches(',')),
                    Delimiter::Bracket => format!("[{inner}]"),
                    Delimiter::Brace => format!("{{ {} }}", inner.trim_end_matches(',')),
                    Delimiter::None => inner,
                }
            }
            other => other.to_string(),
        };
        let last = text.chars().last().unwrap_or('(');
        let first = next.chars().next().unwrap_or(' ');
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '"';
        let needs_blank = match (last, first) {
            _ if is_joint => false,
            (',' | ';' | '=' | '+' | '|', _) => true,
            // An arrow, not the end of generics.
            ('>', _) if text.ends_with("->") => true,
            (_, '=' | '+' | '{' | '|') => true,
            (':', _) => !text.ends_with("::"),
            (_, '-') => true,
            ('>' | ')' | ']' | '}', c) => is_word(c),
            (a, '\'' | '&' | '*') if is_word(a) => true,
            (_, '[') if text.ends_with("mut") => true,
            ('&' | '*' | '\'' | '<' | '(' | '[' | '.' | '#' | '!' | '?', _) => false,
            (a, b) => is_word(a) && is_word(b),
        };
        if needs_blank && !text.is_empty() {
            text.push(' ');
        }
        text += &next;
        is_joint = matches!(&token, TokenTree::Punct(mark) if mark.spacing() == Spacing::Joint || mark.as_char() == '\'');
    }
    text
}

/// The libraries whose interface is committed: their root files, the name under which users reach what these export, and the file of
/// the text. `lagrangian` re-exports all of the runtime, and the macro.
pub const COMMITTED: [(&[&str], &str, &str); 1] = [(
    &["lagrangian/src/lib.rs", "src/lib.rs"],
    "lagrangian",
    "docs/api/lagrangian.txt",
)];

/// The interface that the crates with these root files have together.
fn public_of_all(project: &Path, roots: &[&str], name: &str) -> Result<Vec<String>, String> {
    let mut lines = BTreeSet::new();
    for root in roots {
        lines.extend(public(&project.join(root), name)?);
    }
    Ok(lines.into_iter().collect())
}

/// Writes the committed interfaces.
///
/// # Errors
/// A file that cannot be read or written.
pub fn write(project: &Path) -> Result<String, String> {
    let mut differences = String::new();
    for (roots, name, path) in COMMITTED {
        let now = public_of_all(project, roots, name)?;
        let path = project.join(path);
        let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
        let before = fs::read_to_string(&path).unwrap_or_default();
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(wrong)?;
        }
        fs::write(&path, now.join("\n") + "\n").map_err(wrong)?;
        let lost = lost_items(&before, &now).len();
        differences += &format!("{name}: {} lines, {lost} removed or changed", now.len());
    }
    Ok(differences)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
    }

    #[test]
    fn the_public_interface_is_the_committed_one() {
        for (roots, name, path) in COMMITTED {
            let now = public_of_all(&project(), roots, name).expect("two crates");
            let committed = fs::read_to_string(project().join(path)).unwrap_or_default();
            let known: Vec<String> = committed.lines().map(str::to_owned).collect();
            let lost = lost_items(&committed, &now);
            let new: Vec<&String> = now.iter().filter(|line| !known.contains(line)).collect();
            assert!(
                lost.is_empty() && new.is_empty(),
                "{path} is written by `cargo xtask api`; removals and changes there break programs and are listed in \
                 CHANGELOG.md.\nremoved or changed: {lost:#?}\nnew: {new:#?}"
            );
        }
    }

    /// The interface of a crate with a single file.
    fn of(text: &str) -> Vec<String> {
        let mut modules = Vec::new();
        let tokens = text.parse().expect("it is Rust");
        read_module(tokens, Path::new(""), &Names::new(), &mut modules).expect("no other files");
        let mut reader = Reader {
            modules: &modules,
            lines: BTreeSet::new(),
            types: BTreeSet::new(),
        };
        reader.module(&[], "it");
        reader.implementations();
        reader.lines.into_iter().collect()
    }

    #[test]
    fn what_can_be_named_is_seen_through_private_modules() {
        let lines = of("
            mod hidden {
                /// Docs are no part of it.
                #[derive(Clone, Debug)]
                pub struct Seen<N = f64> { pub x: [N; 2], y: Vec<N, N>, pub(crate) z: u8, pub w: u8 }
                pub struct Unseen;
                impl<N: Copy> Seen<N> { pub const fn get(&self) -> Result<N, ()> { todo() } fn own() {} }
                impl<N> Iterator for Seen<N> { fn next(&mut self) {} }
                impl Unseen { pub fn get(&self) {} }
                mod deeper { pub enum Kind { A(u8), B { x: f64 } } }
                pub use deeper::Kind;
            }
            #[cfg(feature = \"std\")]
            pub use hidden::{Kind as Sort, Seen};
            pub use other_crate::Thing;
            pub trait Does: Copy { type Out; fn must(&self) -> Self::Out; fn may(&self) -> u8 { 0 } }
            #[doc(hidden)] pub mod emitted { pub fn of_code() {} }
            #[cfg(test)] pub mod tests { pub fn of_tests() {} }
            pub const LEAST: f64 = 1.0;
        ");
        let expected = [
            "impl<N: Copy> Seen<N>: fn get(&self) -> Result<N, ()>",
            "impl<N> Iterator for Seen<N>",
            "it::Does: trait Does: Copy",
            "it::Does::Out: type Out",
            "it::Does::may: fn may(&self) -> u8 { … }",
            "it::Does::must: fn must(&self) -> Self::Out",
            "it::LEAST: const LEAST: f64",
            "it::Seen.w: u8",
            "it::Seen.x: [N; 2]",
            "it::Seen: #[cfg(feature = \"std\")] struct Seen<N = f64>",
            "it::Seen: derives Clone",
            "it::Seen: derives Debug",
            "it::Sort: #[cfg(feature = \"std\")] enum Kind",
            "it::Sort::A(u8)",
            "it::Sort::B { x: f64 }",
            "it::Thing = other_crate::Thing",
        ];
        // A `const fn` that becomes an ordinary function is reported.
        let told: Vec<String> = lines
            .iter()
            .map(|line| line.replace("const fn get", "fn get"))
            .collect();
        assert_eq!(told, expected);
        assert!(lines[0].contains("const fn get"));
    }

    #[test]
    fn arguments_may_be_called_otherwise() {
        let one = of("pub fn f(mut a: &mut [u8], b: impl Fn(u8) -> Vec<u8, u8>) {}");
        let other = of("pub fn f(a: &mut [u8], _: impl Fn(u8) -> Vec<u8, u8>) {}");
        assert_eq!(
            other,
            ["it::f: fn f(&mut [u8], impl Fn(u8) -> Vec<u8, u8>)"]
        );
        assert_eq!(one, other);
    }

    #[test]
    fn what_is_gone_or_changed_is_lost_and_what_is_new_is_not() {
        let before = of("pub fn a(x: u8) {} pub fn b() {} pub struct C { pub x: u8 }").join("\n");
        let now = of("pub fn a(x: u16) {} pub fn d() {} pub struct C { pub x: u8, pub y: u8 }");
        let lost = lost_items(&before, &now);
        assert_eq!(lost, ["it::a: fn a(u8)", "it::b: fn b()"]);
    }
}
