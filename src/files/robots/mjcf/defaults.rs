//! Default classes.

use crate::geom::vector::Vector;
use crate::robots::problem::{Read, known, syntax_problem};
use crate::robots::xml::element::Element;
use std::collections::BTreeMap;

/// The classes: for each the class around it and its `<default>` elements.
#[derive(Debug)]
pub(crate) struct Defaults<'a> {
    classes: BTreeMap<&'a str, (Option<&'a str>, Vec<Element<'a>>)>,
}

/// The places where an element's attributes are looked up: itself, then its classes from the innermost out.
#[derive(Debug)]
pub(crate) struct Lookup<'a> {
    places: Vec<Element<'a>>,
}

impl<'a> Defaults<'a> {
    pub(crate) fn read(root: Element<'a>) -> Read<Defaults<'a>> {
        let mut classes: BTreeMap<&str, (Option<&str>, Vec<Element<'_>>)> = BTreeMap::new();
        let mut stack: Vec<(Element<'_>, Option<&str>)> =
            root.named("default").map(|d| (d, None)).collect();
        stack.reverse();
        while let Some((d, outer)) = stack.pop() {
            let class = match (d.attribute("class"), outer) {
                (Some(c), _) => c,
                (None, None) => "main",
                (None, Some(_)) => return Err(d.missing("attribute class")),
            };
            let entry = classes.entry(class).or_insert((outer, Vec::new()));
            if entry.0 != outer {
                let message =
                    format!("default class \"{class}\" is defined twice; names must be unique");
                return Err(d.fail(Some("class"), syntax_problem(message)));
            }
            entry.1.push(d);
            stack.extend(d.named("default").map(|inner| (inner, Some(class))));
        }
        Ok(Defaults { classes })
    }

    /// Returns the elements that hold the attributes of an element: itself, then `tag` in its class, otherwise in that of the
    /// bodies around it, otherwise in the main one.
    pub(crate) fn of(
        &self,
        e: Element<'a>,
        tag: &str,
        childclass: Option<&'a str>,
    ) -> Read<Lookup<'a>> {
        let given = e.attribute("class").or(childclass);
        if let Some(c) = given
            && !self.classes.contains_key(c)
        {
            let known = known("classes", self.classes.keys());
            return Err(e.unknown_name("class", "default class", c, &known));
        }
        let mut places = vec![e];
        // A class is only ever within one that was read before, so that this ends; the bound is for repeated names.
        let outermost = || {
            self.classes
                .iter()
                .find(|(_, (outer, _))| outer.is_none())
                .map(|(c, _)| *c)
        };
        let mut next = given.or_else(outermost);
        for _ in 0..=self.classes.len() {
            let Some((outer, elements)) = next.and_then(|c| self.classes.get(c)) else {
                break;
            };
            places.extend(elements.iter().rev().filter_map(|d| d.child(tag)));
            next = *outer;
        }
        Ok(Lookup { places })
    }
}

impl<'a> Lookup<'a> {
    /// Returns an attribute and its element.
    pub(crate) fn attribute(&self, name: &str) -> Option<(Element<'a>, &'a str)> {
        self.places
            .iter()
            .find_map(|e| e.attribute(name).map(|v| (*e, v)))
    }

    pub(crate) fn numbers<const N: usize>(&self, name: &str) -> Read<Option<[f64; N]>> {
        match self.attribute(name) {
            Some((e, _)) => e.numbers::<N>(name),
            None => Ok(None),
        }
    }

    pub(crate) fn vector(&self, name: &str, default: Vector) -> Read<Vector> {
        Ok(self.numbers::<3>(name)?.unwrap_or(default))
    }
}
