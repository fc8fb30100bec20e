//! The objects of a FreeCAD document and their properties.

use crate::robots::prelude::*;

/// An object.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Object<'a> {
    pub(crate) name: &'a str,
    /// Its type: `Assembly::AssemblyObject`, `App::Link`.
    pub(crate) kind: &'a str,
    /// The element that lists it.
    pub(crate) listed: Element<'a>,
    /// The element of its properties.
    data: Option<Element<'a>>,
}

/// The objects of a document, in its order.
pub(crate) struct Objects<'a> {
    list: Vec<Object<'a>>,
    by_name: BTreeMap<&'a str, usize>,
    /// The object that has another in its group.
    above: BTreeMap<&'a str, &'a str>,
}

impl<'a> Objects<'a> {
    /// Returns the objects below the root element of `Document.xml`.
    pub(crate) fn read_objects(root: Element<'a>) -> Read<Objects<'a>> {
        let data = root.first_child("ObjectData");
        let data = data.iter().flat_map(|d| d.children_named("Object"));
        let data = data.filter_map(|e| Some((e.attribute("name")?, e)));
        let data: BTreeMap<&str, Element<'a>> = data.collect();
        let mut out = Objects {
            list: Vec::new(),
            by_name: BTreeMap::new(),
            above: BTreeMap::new(),
        };
        let listed = root.first_child("Objects");
        for e in listed.iter().flat_map(|l| l.children_named("Object")) {
            let name = e.required_attribute("name")?;
            let kind = e.attribute("type").unwrap_or("");
            let object = Object {
                name,
                kind,
                listed: e,
                data: data.get(name).copied(),
            };
            if out.by_name.insert(name, out.list.len()).is_some() {
                return Err(e.duplicate_error());
            }
            out.list.push(object);
        }
        for object in &out.list {
            for child in object.linked_names("Group") {
                out.above.entry(child).or_insert(object.name);
            }
        }
        Ok(out)
    }

    pub(crate) fn all_objects(&self) -> impl Iterator<Item = &Object<'a>> {
        self.list.iter()
    }

    pub(crate) fn get(&self, name: &str) -> Option<&Object<'a>> {
        self.by_name.get(name).map(|&i| &self.list[i])
    }

    /// Returns the object whose group contains another.
    pub(crate) fn group_of(&self, name: &str) -> Option<&Object<'a>> {
        self.get(self.above.get(name)?)
    }
}

impl<'a> Object<'a> {
    pub(crate) fn find_property(&self, name: &str) -> Option<Element<'a>> {
        let all = self.data?.first_child("Properties")?;
        all.children_named("Property")
            .find(|p| p.attribute("name") == Some(name))
    }

    /// Returns the first element below a property: its value.
    fn property_value(&self, name: &str) -> Option<Element<'a>> {
        self.find_property(name)?.children().next()
    }

    pub(crate) fn property_text(&self, name: &str) -> Option<&'a str> {
        self.property_value(name)?.attribute("value")
    }

    /// Returns the name that users see.
    pub(crate) fn label(&self) -> &'a str {
        let label = self.property_text("Label").filter(|l| !l.trim().is_empty());
        label.unwrap_or(self.name)
    }

    pub(crate) fn is_true(&self, name: &str) -> Option<bool> {
        self.property_text(name).map(|v| v == "true")
    }

    pub(crate) fn property_number(&self, name: &str) -> Read<Option<f64>> {
        match self.property_value(name) {
            Some(e) => Ok(e.read_numbers::<1>("value")?.map(|[x]| x)),
            None => Ok(None),
        }
    }

    /// Returns the names of a list of links, or the name of a single link.
    pub(crate) fn linked_names(&self, name: &str) -> Vec<&'a str> {
        let Some(value) = self.property_value(name) else {
            return Vec::new();
        };
        let all = match value.name() {
            "LinkList" => value.children_named("Link").collect(),
            _ => vec![value],
        };
        let name = |e: &Element<'a>| e.attribute("value").or_else(|| e.attribute("name"));
        let all = all.iter().filter_map(name);
        all.filter(|n| !n.is_empty()).collect()
    }

    /// Returns its placement relative to its parent.
    ///
    /// # Errors
    /// Returns an error if a number or the quaternion is invalid.
    pub(crate) fn read_placement(&self, name: &str) -> Read<Option<RigidMotion>> {
        let Some(e) = self.property_value(name) else {
            return Ok(None);
        };
        let number = |k: &str| -> Read<f64> {
            e.required_attribute(k)?;
            Ok(e.read_numbers::<1>(k)?.map_or(0.0, |[x]| x))
        };
        let translation = [number("Px")?, number("Py")?, number("Pz")?];
        // The scalar part is last.
        let q = [number("Q3")?, number("Q0")?, number("Q1")?, number("Q2")?];
        if q.iter().map(|x| x * x).sum::<f64>() < 1e-6 {
            let (object, what) = (self.name_in_messages(), format!("{name} (Q0 to Q3)"));
            let want = "write a rotation, 0 0 0 1 for none";
            return Err(e.error_at(Some("Q0"), bad_value(&object, &what, "0 0 0 0", want)));
        }
        Ok(Some(RigidMotion::from_quaternion(translation, q)))
    }

    /// Returns the word of an enumeration, by the list next to its index.
    pub(crate) fn enumeration_word(&self, name: &str) -> Read<Option<&'a str>> {
        let Some(property) = self.find_property(name) else {
            return Ok(None);
        };
        let Some(index) = property.first_child("Integer") else {
            return Ok(None);
        };
        let found = index.required_attribute("value")?;
        let list = property.first_child("CustomEnumList");
        let words = list.iter().flat_map(|l| l.children_named("Enum"));
        let words: Vec<&str> = words.filter_map(|e| e.attribute("value")).collect();
        let at = found.parse::<usize>().ok();
        at.and_then(|i| words.get(i).copied())
            .map(Some)
            .ok_or_else(|| {
                let last = words.len().saturating_sub(1);
                let want = format!("write the position of a word in its list, from 0 to {last}");
                let problem = bad_value(&self.name_in_messages(), name, found, &want);
                index.error_at(Some("value"), problem)
            })
    }

    /// Returns its name in messages.
    fn name_in_messages(&self) -> String {
        format!("object \"{}\"", self.name)
    }

    /// Returns true if a type of object contains others in a group that move like it, each by itself.
    pub(crate) fn is_group(&self) -> bool {
        self.kind.starts_with("App::DocumentObjectGroup") || self.is_flexible()
    }

    /// Returns true for a link to an assembly whose parts move by themselves.
    pub(crate) fn is_flexible(&self) -> bool {
        self.kind == "Assembly::AssemblyLink" && self.is_true("Rigid") == Some(false)
    }

    /// Returns true for a link that represents several objects.
    pub(crate) fn is_array(&self) -> bool {
        let count = self
            .property_text("ElementCount")
            .and_then(|c| c.parse::<usize>().ok());
        self.kind == "App::Link" && count.is_some_and(|c| c > 0)
    }

    /// Returns true for a point, line, plane or frame without a body.
    pub(crate) fn is_datum(&self) -> bool {
        const DATUMS: &str = "App::Origin App::Line App::Plane App::Point \
            App::LocalCoordinateSystem Part::LocalCoordinateSystem Part::Datum PartDesign::Line \
            PartDesign::CoordinateSystem";
        DATUMS.split(' ').any(|d| self.kind.starts_with(d))
            || ["PartDesign::Plane", "PartDesign::Point"].contains(&self.kind)
    }

    /// Returns the file, relative to this one, and the name of the object that a link refers to.
    pub(crate) fn linked_object(&self) -> Option<(&'a str, &'a str)> {
        let e = self.property_value("LinkedObject")?;
        let name = e.attribute("name").or_else(|| e.attribute("value"))?;
        Some((e.attribute("file").unwrap_or(""), name))
    }

    /// Returns the member of the archive that contains its shape.
    pub(crate) fn shape_member(&self) -> Option<&'a str> {
        let shape = self.find_property("Shape")?.first_child("Part")?;
        shape.attribute("file").filter(|f| !f.is_empty())
    }
}
