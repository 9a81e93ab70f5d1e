//! Checks that a text is well-formed XML, or that LaTeX can read it, by their grammars
//! and without external programs.

/// The elements that a chapter may contain: some of HTML, and those of MathML Core.
const ELEMENTS: [&str; 46] = [
    "html", "head", "meta", "title", "style", "body", "article", "section", "h1", "h2", "h3", "p",
    "ul", "li", "div", "table", "thead", "tbody", "tr", "th", "td", "code", "math", "mrow", "mi",
    "mn", "mo", "mtext", "mspace", "mfrac", "msup", "msub", "msubsup", "munder", "mover", "msqrt",
    "mtable", "mtr", "mtd", "span", "em", "strong", "b", "i", "br", "hr",
];

/// Checks that elements nest and close, attributes are quoted, and `&` and `<` are used only as markup.
pub fn check_xml(text: &str) -> Result<(), String> {
    walk_xml(text, |_| {})
}

/// The text between tags, with entities resolved.
pub fn text_of_xml(text: &str) -> String {
    let mut words = String::new();
    walk_xml(text, |text| words.push_str(text)).expect("well-formed");
    let words = words
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"");
    words.replace("&amp;", "&")
}

fn walk_xml(text: &str, mut look: impl FnMut(&str)) -> Result<(), String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('<') {
        check_words(before)?;
        look(before);
        let (tag, after) = after.split_once('>').ok_or("a tag does not end")?;
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            match open.pop() {
                Some(opened) if opened == name => {}
                opened => return Err(format!("{opened:?} is closed by {name}")),
            }
            continue;
        }
        let (tag, is_empty) = match tag.strip_suffix('/') {
            Some(tag) => (tag, true),
            None => (tag, false),
        };
        let (name, attributes) = tag.split_once(' ').unwrap_or((tag, ""));
        if !ELEMENTS.contains(&name) {
            return Err(format!("unknown element {name}"));
        }
        check_attributes(attributes)?;
        if !is_empty {
            open.push(name);
        }
    }
    look(rest);
    match open.last() {
        Some(name) => Err(format!("{name} is not closed")),
        None => check_words(rest),
    }
}

fn check_words(words: &str) -> Result<(), String> {
    if words.contains('>') {
        return Err(format!("a bare > in {words}"));
    }
    for (index, _) in words.match_indices('&') {
        let entity = words[index + 1..].split(';').next().unwrap_or("");
        let known = ["amp", "lt", "gt", "quot"].contains(&entity)
            || entity
                .strip_prefix("#x")
                .is_some_and(|hex| u32::from_str_radix(hex, 16).is_ok());
        if !known {
            return Err(format!("a bare & in {words}"));
        }
    }
    Ok(())
}

fn check_attributes(attributes: &str) -> Result<(), String> {
    let mut rest = attributes.trim();
    while !rest.is_empty() {
        let (name, after) = rest
            .split_once("=\"")
            .ok_or(format!("attributes {attributes}"))?;
        let named = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic() || c == '-');
        let (value, after) = after
            .split_once('"')
            .ok_or(format!("attributes {attributes}"))?;
        if !named || value.contains('<') {
            return Err(format!("attributes {attributes}"));
        }
        rest = after.trim_start();
    }
    Ok(())
}

/// The commands that a chapter may use, from LaTeX, textcomp and amsmath.
const COMMANDS: &[&str] = &[
    "AtBeginDocument",
    "DeclareUnicodeCharacter",
    "Delta",
    "Gamma",
    "LTleft",
    "Lambda",
    "Leftrightarrow",
    "Omega",
    "Phi",
    "Pi",
    "Psi",
    "Sigma",
    "Theta",
    "Upsilon",
    "Xi",
    "abovedisplayshortskip",
    "abovedisplayskip",
    "allowdisplaybreaks",
    "alpha",
    "approx",
    "arccos",
    "arcsin",
    "arctan",
    "baselineskip",
    "begin",
    "belowdisplayshortskip",
    "belowdisplayskip",
    "beta",
    "bigl",
    "bigr",
    "boldsymbol",
    "cdot",
    "chi",
    "cos",
    "cosh",
    "dddot",
    "ddot",
    "delta",
    "documentclass",
    "dot",
    "dots",
    "end",
    "endhead",
    "ensuremath",
    "epsilon",
    "eta",
    "fi",
    "footnotesize",
    "frac",
    "gamma",
    "ge",
    "gg",
    "hline",
    "ifdefined",
    "infty",
    "int",
    "iota",
    "item",
    "kappa",
    "lambda",
    "le",
    "leavevmode",
    "left",
    "leftrightarrow",
    "ll",
    "ln",
    "mathbf",
    "mathindent",
    "mathrm",
    "max",
    "min",
    "mu",
    "ne",
    "nu",
    "omega",
    "operatorname",
    "parindent",
    "parskip",
    "partial",
    "phi",
    "pi",
    "pm",
    "propto",
    "psi",
    "quad",
    "raggedright",
    "rho",
    "right",
    "section",
    "setlength",
    "sigma",
    "sin",
    "sinh",
    "sqrt",
    "subsection",
    "subsubsection",
    "sum",
    "surd",
    "tag",
    "tan",
    "tanh",
    "tau",
    "text",
    "textasciicircum",
    "textasciigrave",
    "textasciitilde",
    "textbackslash",
    "textbar",
    "textdegree",
    "textgreater",
    "textless",
    "textperiodcentered",
    "textquotedbl",
    "textquotesingle",
    "textsuperscript",
    "texttt",
    "emph",
    "theta",
    "times",
    "to",
    "upsilon",
    "usepackage",
    "varepsilon",
    "varphi",
    "vert",
    "vspace",
    "xi",
    "zeta",
];

/// A construct that is open while LaTeX is read.
#[derive(Clone, Debug, PartialEq)]
enum Open {
    Brace,
    /// A brace around text, outside of mathematics: `\text{`.
    Words,
    Dollar,
    Left,
    Environment(String),
}

/// Checks braces, environments, `\left` and `\right`, `$` and `&`, and that every command is known.
pub fn check_latex(text: &str) -> Result<(), String> {
    let mut open: Vec<Open> = Vec::new();
    let mut rest = text;
    let mut words_follow = false;
    let in_math = |open: &[Open]| {
        let deciding = open.iter().rev().find_map(|open| match open {
            Open::Words => Some(false),
            Open::Dollar => Some(true),
            Open::Environment(name) => Some(name == "align*" || name == "pmatrix"),
            Open::Brace | Open::Left => None,
        });
        deciding.unwrap_or(false)
    };
    while let Some(letter) = rest.chars().next() {
        let here = rest;
        rest = &rest[letter.len_utf8()..];
        let place = || here.lines().next().unwrap_or("").to_owned();
        let is_words = std::mem::take(&mut words_follow);
        match letter {
            '{' => open.push(if is_words { Open::Words } else { Open::Brace }),
            '}' => match open.pop() {
                Some(Open::Brace | Open::Words) => {}
                other => return Err(format!("{other:?} is closed by a brace: {}", place())),
            },
            '$' => match open.last() {
                Some(Open::Dollar) => {
                    open.pop();
                }
                _ if in_math(&open) => return Err(format!("$ in mathematics: {}", place())),
                _ => open.push(Open::Dollar),
            },
            '_' | '^' if !in_math(&open) => return Err(format!("{letter} in words: {}", place())),
            '_' | '^' if !rest.starts_with('{') => {
                return Err(format!("a bare {letter}: {}", place()));
            }
            '#' | '%' | '~' => return Err(format!("a bare {letter}: {}", place())),
            '&' => {
                let table = open.iter().rev().find(|open| !matches!(open, Open::Left));
                if !matches!(table, Some(Open::Environment(name)) if name != "document") {
                    return Err(format!("& outside of a table: {}", place()));
                }
            }
            '\n' if rest.starts_with('\n') && in_math(&open) => {
                return Err(format!("an empty line in mathematics: {}", place()));
            }
            '\\' => {
                let length = rest
                    .find(|c: char| !c.is_ascii_alphabetic())
                    .unwrap_or(rest.len());
                let (command, after) = rest.split_at(length);
                rest = after;
                if command.is_empty() {
                    let escaped = rest.chars().next().unwrap_or(' ');
                    if !r"\&%#_{}$".contains(escaped) {
                        return Err(format!("\\{escaped}: {}", place()));
                    }
                    rest = &rest[escaped.len_utf8()..];
                    continue;
                }
                if !COMMANDS.contains(&command) {
                    return Err(format!("unknown command {command}: {}", place()));
                }
                match command {
                    "begin" | "end" => {
                        let name = rest.strip_prefix('{').and_then(|rest| rest.split_once('}'));
                        let (name, after) = name.ok_or(place())?;
                        rest = after;
                        let environment = Open::Environment(name.to_owned());
                        if command == "begin" {
                            if name == "align*" && in_math(&open) {
                                return Err(format!("a display in mathematics: {}", place()));
                            }
                            open.push(environment);
                        } else if open.pop() != Some(environment) {
                            return Err(format!("{name} is not what is open: {}", place()));
                        }
                    }
                    "left" => open.push(Open::Left),
                    "right" if open.pop() != Some(Open::Left) => {
                        return Err(format!("nothing to the left: {}", place()));
                    }
                    "text" | "texttt" | "emph" | "tag" | "section" | "subsection"
                    | "subsubsection" => {
                        rest = rest.strip_prefix('*').unwrap_or(rest);
                        words_follow = true;
                    }
                    _ => {}
                }
            }
            _ => {}
        }
    }
    match open.last() {
        Some(open) => Err(format!("{open:?} is not closed")),
        None => Ok(()),
    }
}

#[test]
fn the_checks_find_what_is_wrong() {
    for right in [r"\begin{align*}", ""] {
        let end = if right.is_empty() {
            ""
        } else {
            r"\end{align*}"
        };
        assert_eq!(check_latex(&format!("{right}{end}")), Ok(()));
    }
    for wrong in [
        r"$a",
        r"{",
        r"}",
        r"$\left( a$",
        r"a_b",
        r"$a_b$",
        r"50 %",
        r"a & b",
        r"\unknown",
        r"\begin{align*}\end{document}",
        r"\begin{align*}$a$\end{align*}",
        "$a\n\nb$",
        r"\right)",
    ] {
        assert!(check_latex(wrong).is_err(), "{wrong}");
    }
    assert_eq!(check_xml("<p>a &lt; b <math><mi>x</mi></math></p>"), Ok(()));
    for wrong in [
        "<p>",
        "</p>",
        "<p></i>",
        "a & b",
        "a > b",
        "<p class=a></p>",
        "<blink></blink>",
        "<p",
    ] {
        assert!(check_xml(wrong).is_err(), "{wrong}");
    }
}
