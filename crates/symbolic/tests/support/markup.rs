//! The visible content of a formula in each markup language: letters, numbers, names and signs, in order.

/// The visible content of MathML; panics if elements do not close or browsers do not draw them.
pub fn atoms_of_mathml(text: &str) -> Vec<String> {
    const ELEMENTS: [&str; 16] = [
        "math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msup", "msub", "msubsup",
        "munder", "mover", "msqrt", "mtable", "mtr",
    ];
    let mut atoms = Vec::new();
    let mut open: Vec<(&str, usize)> = Vec::new();
    let mut accents = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('<') {
        let (tag, after) = after.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            let (opened, children) = open.pop().expect("something is open");
            assert_eq!(opened, name, "{text}");
            let wanted = match name {
                "mfrac" | "msup" | "msub" | "munder" | "mover" => Some(2),
                "msubsup" => Some(3),
                "mi" | "mn" | "mo" | "mtext" | "mspace" => Some(0),
                _ => None,
            };
            assert!(
                wanted.is_none_or(|wanted| wanted == children),
                "{name}: {text}"
            );
            match name {
                "mi" | "mn" | "mo" if open.last() == Some(&("mover", 2)) => {
                    // The accent follows its letter here, and precedes it in LaTeX.
                    atoms.insert(
                        accents.pop().expect("a letter to put it on"),
                        before.to_owned(),
                    );
                }
                "mi" | "mn" | "mo" | "mtext" => atoms.push(before.to_owned()),
                _ => assert_eq!(before, "", "{text}"),
            }
        } else {
            assert_eq!(before, "", "{text}");
            let name = tag.split(' ').next().expect("a name");
            assert!(ELEMENTS.contains(&name), "{name}");
            if let Some((_, children)) = open.last_mut() {
                *children += 1;
            }
            if name == "mover" {
                accents.push(atoms.len());
            }
            open.push((name, 0));
        }
        rest = after;
    }
    assert!(open.is_empty() && rest.is_empty(), "{text}");
    let seen = atoms.into_iter().map(|atom| match atom.as_str() {
        "&#x2061;" | "&#x2062;" => String::new(),
        "\u{2212}" => "-".to_owned(),
        "\u{22c5}" => "·".to_owned(),
        _ => atom,
    });
    seen.filter(|atom| !atom.is_empty()).collect()
}

/// The visible content of LaTeX; panics if its brackets do not close or a command is unknown.
pub fn atoms_of_latex(text: &str) -> Vec<String> {
    let mut atoms = Vec::new();
    let mut open = Vec::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        match letter {
            ' ' => {}
            '{' => open.push('{'),
            '}' => assert_eq!(open.pop(), Some('{'), "{text}"),
            '_' | '^' => assert!(rest.starts_with('{'), "{text}"),
            '\\' => {
                let length = rest
                    .find(|c: char| !c.is_ascii_alphabetic())
                    .unwrap_or(rest.len());
                let (command, after) = rest.split_at(length);
                rest = after;
                match command {
                    "left" | "bigl" => {
                        if command == "left" {
                            open.push('l');
                        }
                        rest = rest.strip_prefix(r"\vert").map_or(&rest[1..], |rest| rest);
                        atoms.push(if after.starts_with('(') { "(" } else { "|" }.to_owned());
                    }
                    "right" | "bigr" => {
                        if command == "right" {
                            assert_eq!(open.pop(), Some('l'), "{text}");
                        }
                        rest = rest.strip_prefix(r"\vert").map_or(&rest[1..], |rest| rest);
                        atoms.push(if after.starts_with(')') { ")" } else { "|" }.to_owned());
                    }
                    "frac" | "sqrt" => assert!(rest.starts_with('{'), "{text}"),
                    "dot" => atoms.push("˙".into()),
                    "ddot" => atoms.push("¨".into()),
                    "operatorname" | "mathrm" => {
                        let (name, after) = rest[1..].split_once('}').expect("a name ends");
                        atoms.push(name.to_owned());
                        rest = after;
                    }
                    "pi" => atoms.push("π".into()),
                    "cdot" => atoms.push("·".into()),
                    "sin" | "cos" | "tan" | "arcsin" | "arccos" | "arctan" | "sinh" | "cosh"
                    | "tanh" | "ln" | "min" | "max" => atoms.push(command.to_owned()),
                    _ => panic!("unknown command {command}: {text}"),
                }
            }
            '0'..='9' => {
                let length = rest
                    .find(|c: char| !c.is_ascii_digit() && c != '.')
                    .unwrap_or(rest.len());
                atoms.push(format!("{letter}{}", &rest[..length]));
                rest = &rest[length..];
            }
            letter => atoms.push(letter.to_string()),
        }
    }
    assert!(open.is_empty(), "{text}");
    atoms
}
