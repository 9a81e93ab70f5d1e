//! A MJCF file with all included files as one tree of elements, and the defaults of its classes.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use roxmltree::Node;

use crate::import::faults::Faults;
use crate::import::names::quoted;
use crate::import::xml;

/// The deepest nesting of elements that is accepted.
const DEEPEST: usize = 200;

/// The most files that may be included.
const MOST_FILES: usize = 100;

/// An element with its children.
#[derive(Debug)]
pub struct Element {
    pub name: String,
    pub attributes: Vec<Attribute>,
    pub children: Vec<Element>,
    /// The position of its beginning.
    pub at: usize,
}

/// A value of an element.
#[derive(Debug)]
pub struct Attribute {
    pub name: String,
    pub value: String,
    /// The position of its value.
    pub at: usize,
}

impl Element {
    /// An attribute of the element itself.
    pub fn own(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|known| known.name == name)
    }
}

/// Reads files, each at most once.
struct Reading<'f> {
    folder: &'f Path,
    read: &'f dyn Fn(&Path) -> Result<Vec<u8>, String>,
    seen: HashSet<String>,
    faults: &'f mut Faults,
}

/// Reads a file and all that it includes, by paths relative to `folder`.
pub fn read(
    text: &str,
    folder: &Path,
    read: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
    faults: &mut Faults,
) -> Option<Element> {
    let document = xml::open(text, 0, faults)?;
    let mut reading = Reading {
        folder,
        read,
        seen: HashSet::new(),
        faults,
    };
    reading.element(document.root_element(), 0, 0)
}

impl Reading<'_> {
    /// Converts an element of a text whose positions begin at `start`.
    fn element(&mut self, node: Node<'_, '_>, start: usize, depth: usize) -> Option<Element> {
        let at = start + node.range().start;
        if depth > DEEPEST {
            let message = format!("elements are nested more than {DEEPEST} deep");
            self.faults.add(at, message);
            return None;
        }
        let attributes = node.attributes().map(|attribute| Attribute {
            name: attribute.name().to_owned(),
            value: attribute.value().trim().to_owned(),
            at: start + attribute.range_value().start,
        });
        let mut element = Element {
            name: node.tag_name().name().to_owned(),
            attributes: attributes.collect(),
            children: Vec::new(),
            at,
        };
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "include" => self.include(child, start, depth, &mut element.children),
                _ => element
                    .children
                    .extend(self.element(child, start, depth + 1)),
            }
        }
        Some(element)
    }

    /// Replaces an `include` by the contents of its file.
    fn include(
        &mut self,
        node: Node<'_, '_>,
        start: usize,
        depth: usize,
        children: &mut Vec<Element>,
    ) {
        let at = start + node.range().start;
        let Some(name) = node.attribute("file") else {
            self.faults.add(at, "`include` lacks `file`");
            return;
        };
        if !self.seen.insert(name.to_owned()) {
            let message = format!("{} is included twice", quoted(name));
            self.faults.add(at, message);
            return;
        }
        if self.seen.len() > MOST_FILES {
            let message = format!("more than {MOST_FILES} files are included");
            self.faults.add(at, message);
            return;
        }
        let path = self.folder.join(name);
        let text = match (self.read)(&path) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(message) => return self.faults.add(at, message),
        };
        let begins = self.faults.include(&path.display().to_string(), &text);
        let Some(document) = xml::open(&text, begins, self.faults) else {
            return;
        };
        let root = self.element(document.root_element(), begins, depth + 1);
        children.extend(root.into_iter().flat_map(|root| root.children));
    }
}

/// The defaults of elements by class. The first class is that of elements without a class.
pub struct Classes<'e> {
    list: Vec<Class<'e>>,
    by_name: HashMap<&'e str, usize>,
}

struct Class<'e> {
    above: Option<usize>,
    elements: Vec<&'e Element>,
}

impl<'e> Classes<'e> {
    /// The classes in the `default` sections of a file.
    pub fn of(root: &'e Element, faults: &mut Faults) -> Classes<'e> {
        let mut classes = Classes {
            list: vec![Class {
                above: None,
                elements: Vec::new(),
            }],
            by_name: HashMap::new(),
        };
        let sections = root.children.iter().filter(|part| part.name == "default");
        for section in sections {
            classes.add(section, None, faults);
        }
        classes
    }

    fn add(&mut self, section: &'e Element, above: Option<usize>, faults: &mut Faults) {
        let name = section.own("class").map(|name| name.value.as_str());
        let class = match (above, name) {
            (None, name) => {
                self.by_name.insert(name.unwrap_or("main"), 0);
                0
            }
            (Some(_), None) => {
                faults.add(section.at, "a nested `default` lacks its `class`");
                return;
            }
            (Some(_), Some(name)) => {
                let class = self.list.len();
                if self.by_name.insert(name, class).is_some() {
                    let message = format!("there are two classes {}", quoted(name));
                    faults.add(section.at, message);
                }
                self.list.push(Class {
                    above,
                    elements: Vec::new(),
                });
                class
            }
        };
        for child in &section.children {
            match child.name.as_str() {
                "default" => self.add(child, Some(class), faults),
                _ => self.list[class].elements.push(child),
            }
        }
    }

    /// The class with this name.
    pub fn named(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// All elements of all classes.
    pub fn elements(&self) -> impl Iterator<Item = &'e Element> + use<'e, '_> {
        self.list
            .iter()
            .flat_map(|class| class.elements.iter().copied())
    }

    /// Which of these elements a class or its ancestors set attributes for.
    pub fn tags<'t>(&self, class: usize, among: &[&'t str]) -> Vec<&'t str> {
        let mut attributes = Vec::new();
        let mut at = Some(class);
        while let Some(class) = at {
            let class = &self.list[class];
            let is_there = |tag: &&&str| class.elements.iter().any(|element| element.name == **tag);
            attributes.extend(among.iter().filter(is_there));
            at = class.above;
        }
        attributes
    }

    /// Where the attributes of an element come from: the element itself, then the elements of its class with a name among
    /// `tags`, then those of the classes above; what is said at an earlier place applies.
    pub fn places<'t>(
        &self,
        element: &'e Element,
        class: usize,
        tags: Vec<&'t str>,
    ) -> impl Iterator<Item = &'e Element> + use<'_, 'e, 't> {
        let above = move |class: &usize| self.list[*class].above;
        let classes = std::iter::successors(Some(class), above);
        let of_classes = classes.flat_map(move |class| self.list[class].elements.iter().rev());
        let is_meant = move |place: &&'e Element| tags.contains(&place.name.as_str());
        std::iter::once(element).chain(of_classes.copied().filter(is_meant))
    }
}
