//! The arguments of the macro: settings, optionally followed by a machine.

use lagrangian_symbolic::Rational;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::parse::{ParseStream, Parser};
use syn::{Error, Ident, LitStr, Result, Token, ext::IdentExt};

/// Arguments such as `file = "chain.machine", N = 64`, or a machine with or without braces.
pub struct Arguments {
    /// The spec file.
    pub file: Option<LitStr>,
    /// Constants with values that override those of the spec.
    pub constants: Vec<(String, Rational)>,
    /// The path of the runtime.
    pub runtime: String,
    /// The tokens after the settings: a machine, unless it comes from a file.
    pub machine: TokenStream,
    /// Attributes before the machine.
    pub attributes: Attributes,
}

/// The attributes of a machine other than documentation, by target.
#[derive(Default)]
pub struct Attributes {
    /// `cfg`: for every item.
    pub items: TokenStream,
    /// Lints: for the module.
    pub module: TokenStream,
    /// All others, such as `derive`: for the structs with fields named by the machine.
    pub structs: TokenStream,
}

impl Arguments {
    /// Parses the arguments.
    pub fn parse(tokens: TokenStream) -> Result<Arguments> {
        arguments.parse2(tokens)
    }
}

fn arguments(input: ParseStream<'_>) -> Result<Arguments> {
    let mut arguments = Arguments {
        file: None,
        constants: Vec::new(),
        runtime: "::lagrangian".into(),
        machine: TokenStream::new(),
        attributes: Attributes::default(),
    };
    let mut docs = arguments.attributes.read(input)?;
    while is_setting(input) {
        let name = input.call(Ident::parse_any)?;
        input.parse::<Token![=]>()?;
        match name.to_string().as_str() {
            "file" if arguments.file.is_some() => {
                return Err(Error::new(name.span(), "one machine comes from one file"));
            }
            "file" => arguments.file = Some(input.parse()?),
            "crate" => arguments.runtime = path(input)?,
            constant => {
                let value = number(input, constant)?;
                arguments.constants.push((constant.to_owned(), value));
            }
        }
        if !input.is_empty() && input.parse::<Option<Token![;]>>()?.is_none() {
            input.parse::<Token![,]>()?;
        }
    }
    match &arguments.file {
        Some(_) if !input.is_empty() => Err(input
            .error("the machine comes from the file; only constants may follow, as in `N = 64`")),
        None if input.is_empty() => {
            let message = "write a machine here, or name its file: `machine!(file = \"machines/crusher.machine\")`";
            Err(Error::new(proc_macro2::Span::call_site(), message))
        }
        _ => {
            docs.extend(arguments.attributes.read(input)?);
            docs.extend(input.parse::<TokenStream>()?);
            arguments.machine = docs;
            Ok(arguments)
        }
    }
}

impl Attributes {
    /// Reads the attributes that follow; returns the documentation, which belongs to the machine.
    fn read(&mut self, input: ParseStream<'_>) -> Result<TokenStream> {
        let mut docs = TokenStream::new();
        while input.peek(Token![#]) && input.peek2(syn::token::Bracket) {
            let hash = input.parse::<Token![#]>()?;
            let group = input.parse::<Group>()?;
            let name = group.stream().into_iter().next();
            let name = name.map_or_else(String::new, |name| name.to_string());
            let to = match name.as_str() {
                "doc" => &mut docs,
                "cfg" => &mut self.items,
                "allow" | "expect" | "warn" | "deny" | "forbid" => &mut self.module,
                _ => &mut self.structs,
            };
            quote!(#hash #group).to_tokens(to);
        }
        Ok(docs)
    }
}

/// `name =`, but not `name ==`.
fn is_setting(input: ParseStream<'_>) -> bool {
    input.peek(Ident::peek_any) && input.peek2(Token![=]) && !input.peek2(Token![==])
}

/// The tokens up to the next comma, as a path: `::lagrangian`, `crate`, `my::re_export`.
fn path(input: ParseStream<'_>) -> Result<String> {
    let mut path = String::new();
    while !input.is_empty() && !input.peek(Token![,]) && !input.peek(Token![;]) {
        if input.peek(Token![::]) {
            input.parse::<Token![::]>()?;
            path.push_str("::");
        } else {
            path.push_str(&input.call(Ident::parse_any)?.to_string());
        }
    }
    if path.is_empty() {
        Err(input.error("the path of the runtime is missing, as in `crate = ::lagrangian`"))
    } else {
        Ok(path)
    }
}

/// A number, possibly negative.
fn number(input: ParseStream<'_>, constant: &str) -> Result<Rational> {
    let expected = || format!("a constant needs a number: `{constant} = 64`");
    let mut text = String::new();
    loop {
        match input
            .parse::<TokenTree>()
            .map_err(|_| input.error(expected()))?
        {
            TokenTree::Punct(punct) if punct.as_char() == '-' && text.is_empty() => text.push('-'),
            TokenTree::Literal(literal) => {
                text.push_str(&literal.to_string());
                return Rational::parse_decimal(&text)
                    .ok_or_else(|| Error::new(literal.span(), expected()));
            }
            // Tokens passed on by a `macro_rules!` are in invisible brackets.
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                let value =
                    (|input: ParseStream<'_>| number(input, constant)).parse2(group.stream())?;
                return Ok(if text.is_empty() { value } else { -value });
            }
            other => return Err(Error::new(other.span(), expected())),
        }
    }
}
