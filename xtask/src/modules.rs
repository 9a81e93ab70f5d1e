//! The imports between the modules of a crate, read from the sources, and their cycles.
//!
//! Crates form no cycle, or cargo would refuse them. The same is required of modules within a crate: among the children of
//! any module, each taken together with everything below it, imports form no cycle. A module and its descendants may name
//! each other freely.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Returns the contents of a file.
pub(crate) type Source<'a> = dyn Fn(&Path) -> std::io::Result<String> + 'a;

/// The path of a module or an item within its crate; the path of the crate's root is empty.
pub type Names = Vec<String>;

/// The modules of a crate, and the paths that each of them names.
#[derive(Default)]
pub struct Modules {
    modules: BTreeMap<Names, Contents>,
}

#[derive(Default)]
struct Contents {
    /// The paths in its text, from the root of the crate.
    named: BTreeSet<Names>,
    /// What `use` imports, by its local name. Paths of this module go through it, and those of other modules if
    /// it is exported.
    imported: BTreeMap<String, Names>,
    /// The targets of `use …::*`.
    globs: Vec<Names>,
}

/// Sibling modules each of which, with its descendants, imports from the next.
pub struct Circle {
    /// Their parent.
    pub parent: Names,
    /// Their names within the parent.
    pub members: Vec<String>,
    /// The imports between them, from module to module.
    pub imports: Vec<(Names, Names)>,
}

/// What an attribute says about the item that follows.
#[derive(Default)]
struct Attributes {
    /// Compiled for tests or docs only.
    is_left_out: bool,
    path: Option<String>,
}

impl Modules {
    /// Reads a crate from its root file (`src/lib.rs`, `src/main.rs`), without the parts that are compiled only for tests or docs.
    ///
    /// # Errors
    ///
    /// A file that is missing, or that is not valid Rust.
    pub fn read(root: &Path) -> Result<Self, String> {
        Self::read_from(root, &|path| fs::read_to_string(path))
    }

    /// Reads a crate whose files `source` provides.
    fn read_from(root: &Path, source: &Source<'_>) -> Result<Self, String> {
        let mut modules = Self::default();
        let folder = root.parent().unwrap_or(Path::new("."));
        modules.read_file(source, root, folder, &Vec::new())?;
        Ok(modules)
    }

    fn read_file(
        &mut self,
        source: &Source<'_>,
        path: &Path,
        children: &Path,
        module: &Names,
    ) -> Result<(), String> {
        let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = source(path).map_err(|error| wrong(&error))?;
        let tokens: TokenStream = text.parse().map_err(|error| wrong(&error))?;
        self.modules.entry(module.clone()).or_default();
        self.read_tokens(source, tokens, children, module)
    }

    /// Reads the tokens of a module; the files of its children are in the folder `children`.
    fn read_tokens(
        &mut self,
        source: &Source<'_>,
        tokens: TokenStream,
        children: &Path,
        module: &Names,
    ) -> Result<(), String> {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut attributes = Attributes::default();
        let mut at = 0;
        while let Some(token) = tokens.get(at) {
            at = match token {
                TokenTree::Punct(mark) if mark.as_char() == '#' => {
                    if let Some(TokenTree::Group(group)) = tokens.get(at + 1) {
                        attributes.read(&group.stream());
                    }
                    at + 2
                }
                TokenTree::Ident(word) if *word == "mod" => {
                    self.read_child(source, &tokens[at + 1..], children, module, &attributes)?;
                    attributes = Attributes::default();
                    at + 3
                }
                TokenTree::Ident(word) if *word == "use" => {
                    let end = end_of_statement(&tokens, at);
                    if !attributes.is_left_out {
                        let mut leaves = Vec::new();
                        leaves_of_use(&tokens[at + 1..end], &[], &mut leaves);
                        for (path, name) in leaves {
                            self.import(path, name, module);
                        }
                    }
                    attributes = Attributes::default();
                    end + 1
                }
                TokenTree::Ident(_) => {
                    let (path, next) = path_at(&tokens, at);
                    if path.len() > 1 {
                        self.contents(module).named.insert(absolute(path, module));
                    }
                    next
                }
                TokenTree::Group(group) => {
                    let is_body = group.delimiter() == Delimiter::Brace;
                    if !(is_body && attributes.is_left_out) {
                        self.read_tokens(source, group.stream(), children, module)?;
                    }
                    if is_body {
                        attributes = Attributes::default();
                    }
                    at + 1
                }
                TokenTree::Punct(mark) => {
                    if mark.as_char() == ';' {
                        attributes = Attributes::default();
                    }
                    at + 1
                }
                TokenTree::Literal(_) => at + 1,
            };
        }
        Ok(())
    }

    /// Reads `name;` or `name { … }` after `mod`.
    fn read_child(
        &mut self,
        source: &Source<'_>,
        tokens: &[TokenTree],
        children: &Path,
        module: &Names,
        attributes: &Attributes,
    ) -> Result<(), String> {
        let Some(TokenTree::Ident(name)) = tokens.first() else {
            return Ok(());
        };
        if attributes.is_left_out {
            return Ok(());
        }
        let name = plain(name);
        let child: Names = module.iter().cloned().chain([name.clone()]).collect();
        if let Some(TokenTree::Group(group)) = tokens.get(1) {
            self.modules.entry(child.clone()).or_default();
            return self.read_tokens(source, group.stream(), &children.join(&name), &child);
        }
        let (file, below) = place(source, children, &name, attributes.path.as_deref());
        self.read_file(source, &file, &below, &child)
    }

    fn contents(&mut self, module: &Names) -> &mut Contents {
        self.modules.entry(module.clone()).or_default()
    }

    /// Records what `use` imports into a module, under the new name if there is one.
    fn import(&mut self, path: Names, name: Option<String>, module: &Names) {
        let mut path = absolute(path, module);
        let contents = self.contents(module);
        let Some(last) = path.last().cloned() else {
            return;
        };
        if last == "*" {
            path.pop();
            contents.globs.push(path.clone());
        } else {
            contents.imported.insert(name.unwrap_or(last), path.clone());
        }
        contents.named.insert(path);
    }

    /// The module in which a path ends, after its imports are resolved; none if it leads to another crate.
    fn target(&self, path: &[String], depth: usize) -> Option<Names> {
        /// The maximum number of imports of imports; larger than any real chain, so that a cycle of them ends.
        const DEEPEST: usize = 16;
        if depth > DEEPEST {
            return None;
        }
        let mut module = Names::new();
        for (i, word) in path.iter().enumerate() {
            let child: Names = module.iter().chain([word]).cloned().collect();
            if self.modules.contains_key(&child) {
                module = child;
                continue;
            }
            let contents = &self.modules[&module];
            let behind = contents.imported.get(word);
            if let Some(behind) = behind.filter(|behind| behind[..] != path[..=i]) {
                let path: Names = behind.iter().chain(&path[i + 1..]).cloned().collect();
                return self
                    .target(&path, depth + 1)
                    .filter(|found| !found.is_empty());
            }
            for glob in &contents.globs {
                let path: Names = glob.iter().chain(&path[i..]).cloned().collect();
                let found = self.target(&path, depth + 1);
                if let Some(found) = found.filter(|found| found.len() > glob.len()) {
                    return Some(found);
                }
            }
            return Some(module);
        }
        Some(module)
    }

    /// Pairs of modules, of which the first imports from the second.
    pub fn imports(&self) -> BTreeSet<(Names, Names)> {
        let of_module = |(module, contents)| {
            let targets = Contents::named(contents).filter_map(|path| self.target(path, 0));
            targets
                .filter(move |found| found != module)
                .map(move |found| (Names::clone(module), found))
        };
        self.modules.iter().flat_map(of_module).collect()
    }

    /// The cycles among the children of each module.
    pub fn circles(&self) -> Vec<Circle> {
        // By parent, and by the names of two of its children.
        let mut between: BTreeMap<Names, Imports> = BTreeMap::new();
        for (from, to) in self.imports() {
            let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if common < from.len() && common < to.len() {
                let children = (from[common].clone(), to[common].clone());
                let of_parent = between.entry(from[..common].to_vec()).or_default();
                of_parent.entry(children).or_default().insert((from, to));
            }
        }
        let mut circles = Vec::new();
        for (parent, imports) in &between {
            let names: BTreeSet<&String> = imports.keys().map(|(from, _)| from).collect();
            let mut cycles = BTreeSet::new();
            for name in names {
                let members: Vec<String> = reached(name, imports)
                    .into_iter()
                    .filter(|other| reached(other, imports).contains(name))
                    .cloned()
                    .collect();
                if members.is_empty() || !cycles.insert(members.clone()) {
                    continue;
                }
                let within = |(a, b): &(String, String)| members.contains(a) && members.contains(b);
                let imports = imports.iter().filter(|(children, _)| within(children));
                circles.push(Circle {
                    parent: parent.clone(),
                    imports: imports.flat_map(|(_, all)| all.iter().cloned()).collect(),
                    members,
                });
            }
        }
        circles
    }
}

impl Contents {
    fn named(&self) -> impl Iterator<Item = &Names> {
        self.named.iter()
    }
}

/// The imports between two children of a module, by their names.
type Imports = BTreeMap<(String, String), BTreeSet<(Names, Names)>>;

impl Attributes {
    fn read(&mut self, tokens: &TokenStream) {
        let text = tokens.to_string().replace(' ', "");
        // Links in docs are unrestricted.
        let of = [
            "cfg(test)",
            "cfg(all(test",
            "cfg(doc)",
            "cfg(doctest)",
            "cfg(all(doctest",
        ];
        self.is_left_out |= of.iter().any(|start| text.starts_with(start));
        if let Some(path) = text.strip_prefix("path=") {
            self.path = Some(path.trim_matches('"').to_owned());
        }
    }
}

/// The siblings from which a child imports, directly or indirectly.
fn reached<'a>(name: &String, imports: &'a Imports) -> BTreeSet<&'a String> {
    let mut found = BTreeSet::new();
    let mut next = vec![name];
    while let Some(from) = next.pop() {
        for (_, to) in imports.keys().filter(|(child, _)| child == from) {
            if found.insert(to) {
                next.push(to);
            }
        }
    }
    found
}

/// The file of a child module, and the folder of its own children.
pub(crate) fn place(
    source: &Source<'_>,
    folder: &Path,
    name: &str,
    attribute: Option<&str>,
) -> (PathBuf, PathBuf) {
    if let Some(path) = attribute {
        let path = folder.join(path);
        return (path.clone(), path.with_extension(""));
    }
    let below = folder.join(name);
    let flat = folder.join(format!("{name}.rs"));
    if source(&flat).is_ok() {
        (flat, below)
    } else {
        (below.join("mod.rs"), below)
    }
}

/// The path from the root of the crate, for a path in the text of a module.
pub(crate) fn absolute(path: Names, module: &Names) -> Names {
    let mut base = module.clone();
    let mut words = path.into_iter().peekable();
    match words.peek().map(String::as_str) {
        Some("crate") => {
            base.clear();
            words.next();
        }
        Some("self") => {
            words.next();
        }
        _ => {
            while words.next_if(|word| word == "super").is_some() {
                base.pop();
            }
        }
    }
    base.extend(words);
    base
}

pub(crate) fn plain(word: &proc_macro2::Ident) -> String {
    word.to_string().trim_start_matches("r#").to_owned()
}

/// The index of the semicolon that ends the statement at `at`.
fn end_of_statement(tokens: &[TokenTree], at: usize) -> usize {
    let is_end =
        |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ';');
    tokens[at..]
        .iter()
        .position(is_end)
        .map_or(tokens.len(), |n| at + n)
}

/// The path `a::b::c` that begins with the word at this index, and the index after it.
fn path_at(tokens: &[TokenTree], mut at: usize) -> (Names, usize) {
    let is_colon =
        |i: usize| matches!(tokens.get(i), Some(TokenTree::Punct(mark)) if mark.as_char() == ':');
    let mut path = Names::new();
    while let Some(TokenTree::Ident(word)) = tokens.get(at) {
        path.push(plain(word));
        at += 1;
        let goes_on = matches!(tokens.get(at + 2), Some(TokenTree::Ident(_)));
        if !(is_colon(at) && is_colon(at + 1) && goes_on) {
            break;
        }
        at += 2;
    }
    (path, at)
}

/// The paths of a `use` tree, each with its new name if it is renamed.
pub(crate) fn leaves_of_use(
    tokens: &[TokenTree],
    prefix: &[String],
    leaves: &mut Vec<(Names, Option<String>)>,
) {
    let is_comma =
        |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ',');
    for branch in tokens.split(is_comma) {
        let mut path = prefix.to_vec();
        let mut name = None;
        let mut words = branch.iter();
        let mut is_leaf = false;
        while let Some(token) = words.next() {
            match token {
                TokenTree::Ident(word) if *word == "as" => {
                    name = words.next().map(ToString::to_string);
                }
                // `a::{self, b}` names `a` itself.
                TokenTree::Ident(word) if *word == "self" && !prefix.is_empty() => is_leaf = true,
                TokenTree::Ident(word) => {
                    path.push(plain(word));
                    is_leaf = true;
                }
                TokenTree::Punct(mark) if mark.as_char() == '*' => path.push("*".to_owned()),
                TokenTree::Group(group) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    leaves_of_use(&inner, &path, leaves);
                    is_leaf = false;
                }
                _ => {}
            }
        }
        if is_leaf {
            leaves.push((path, name));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use super::*;

    /// The root files of the crates of the workspace.
    fn roots() -> Vec<PathBuf> {
        let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let crates = fs::read_dir(project.join("crates")).expect("a folder");
        let supporting = crates.map(|entry| entry.expect("an entry").path());
        let others = [
            ".",
            "cli",
            "derive-macros",
            "jit",
            "lagrangian",
            "model-spec",
            "xtask",
        ];
        supporting
            .chain(others.map(|name| project.join(name)))
            .flat_map(|folder| ["lib", "main"].map(|name| folder.join(format!("src/{name}.rs"))))
            .filter(|root| root.exists())
            .collect()
    }

    #[test]
    fn modules_import_in_no_circle() {
        let mut cycles = String::new();
        let mut imports = 0;
        for root in roots() {
            let modules = Modules::read(&root).expect("a crate");
            imports += modules.imports().len();
            for circle in modules.circles() {
                cycles += &format!("{}: {}\n", root.display(), circle.members.join(", "));
                for (from, to) in circle.imports {
                    cycles += &format!("    {} imports from {}\n", from.join("::"), to.join("::"));
                }
            }
        }
        assert!(imports > 1000, "{imports} imports were seen");
        assert!(cycles.is_empty(), "{cycles}");
    }

    /// A crate with these files.
    fn read(files: &[(&str, &str)]) -> Modules {
        let source = |path: &Path| {
            let found = files.iter().find(|(name, _)| path == Path::new(name));
            found
                .map(|(_, text)| (*text).to_owned())
                .ok_or_else(|| ErrorKind::NotFound.into())
        };
        Modules::read_from(Path::new("lib.rs"), &source).expect("a crate")
    }

    #[test]
    fn a_circle_is_seen_through_what_is_exported() {
        let files = [
            ("lib.rs", "mod a; mod b; pub use a::A;"),
            ("a.rs", "use crate::b::{self, B}; pub struct A(B);"),
            ("b.rs", "mod below; pub use below::B;"),
            ("b/below.rs", "use crate::A; pub struct B(Option<Box<A>>);"),
        ];
        let circles = read(&files).circles();
        assert_eq!(circles.len(), 1);
        assert_eq!(circles[0].members, ["a", "b"]);
    }

    #[test]
    fn parents_children_and_tests_are_free() {
        let files = [
            ("lib.rs", "mod a; mod b { use crate::a::A; }"),
            (
                "a.rs",
                "mod c; pub struct A; use c::C; #[cfg(test)] mod tests { use crate::b; fn f() { crate::b::g(); } }",
            ),
            ("a/c.rs", "use super::A; pub struct C(A);"),
        ];
        assert!(read(&files).circles().is_empty());
    }
}
