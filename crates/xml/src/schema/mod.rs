//! The elements of the language and what each may hold. The front-end reads
//! by these tables and the reference manual is made from them, so that the two
//! cannot differ.

mod groups;
mod lights;
mod shapes;
mod surface;
mod world;

pub use groups::{DEFINE, GROUP, MATRIX, ROTATE, SCALE, SHAPES, TRANSFORMS, TRANSLATE, USE};
pub use lights::{LAMP, LIGHTS, SPOT, SUN};
pub use shapes::{
    A, ACROSS, AXIS, B, BASE, BOX, C, CONE, CUBE, CYLINDER, D, DISC, FROM, FRUSTUM, MESH, NORMAL,
    PLANE, RECTANGLE, SPHERE, TETRAHEDRON, TO, TOP, TORUS, TRIANGLE, UPWARD,
};
pub use surface::{Cells, MATERIAL, SURFACE};
pub use world::{BACKGROUND, CAMERA, ORIGIN, POINT, TARGET, UP, WORLD};

/// An element of the language.
#[derive(Debug, Clone, Copy)]
pub struct Element {
    /// Its name.
    pub name: &'static str,
    /// What it is, in a few lines.
    pub summary: &'static str,
    /// What attributes it may have, apart from those of a surface.
    pub attributes: &'static [Attribute],
    /// The attributes of a surface, where it has one.
    pub surface: &'static [Attribute],
    /// Sets of attributes of which it must have exactly one; may be empty.
    pub one_of: &'static [&'static [&'static str]],
    /// What the numbers of its `chess-size` are, where it has that.
    pub cells: Option<Cells>,
    /// How its checker lies on it, where it has one.
    pub checker: &'static str,
    /// What elements it may hold, apart from transforms.
    pub children: &'static [Child],
    /// The transforms, where it is moved by them.
    pub transforms: &'static [Child],
    /// Names of attributes and elements that it does not have but might well
    /// be thought to.
    pub slips: &'static [(&'static str, Slip)],
}

impl Element {
    /// With no attributes and nothing in it.
    const BARE: Self = Self {
        name: "",
        summary: "",
        attributes: &[],
        surface: &[],
        one_of: &[],
        cells: None,
        checker: "",
        children: &[],
        transforms: &[],
        slips: &[],
    };

    /// All attributes it may have.
    pub fn all_attributes(&self) -> impl Iterator<Item = &'static Attribute> + Clone {
        self.attributes.iter().chain(self.surface)
    }

    /// All elements it may hold.
    pub fn all_children(&self) -> impl Iterator<Item = &'static Child> + Clone {
        self.children.iter().chain(self.transforms)
    }
}

/// What is to be said of a name that an element does not know.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slip {
    /// That this attribute was probably meant.
    Meant(&'static str),
    /// What to do instead.
    Instead(&'static str),
}

/// An attribute of an element.
#[derive(Debug, Clone, Copy)]
pub struct Attribute {
    /// Its name.
    pub name: &'static str,
    /// Whether the element must have it.
    pub need: Need,
    /// What its value may be.
    pub values: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

/// Whether an element must have an attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It must.
    Required,
    /// It need not.
    Optional,
    /// It must, unless it has others; see [`Element::one_of`].
    OneOf,
}

/// An element inside another one.
#[derive(Debug, Clone, Copy)]
pub struct Child {
    /// What it is.
    pub element: &'static Element,
    /// How often it may stand there.
    pub times: Times,
    /// What it means there, where that is more than its own summary.
    pub meaning: &'static str,
}

/// How often an element may stand inside another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Times {
    /// Exactly once.
    Once,
    /// Once or not at all.
    Optional,
    /// Any number of times.
    Any,
}

const fn required(name: &'static str, values: &'static str, meaning: &'static str) -> Attribute {
    Attribute { name, need: Need::Required, values, meaning }
}

const fn optional(name: &'static str, values: &'static str, meaning: &'static str) -> Attribute {
    Attribute { name, need: Need::Optional, values, meaning }
}

const fn one_of(name: &'static str, values: &'static str, meaning: &'static str) -> Attribute {
    Attribute { name, need: Need::OneOf, values, meaning }
}

const fn once(element: &'static Element, meaning: &'static str) -> Child {
    Child { element, times: Times::Once, meaning }
}

const fn at_most_once(element: &'static Element, meaning: &'static str) -> Child {
    Child { element, times: Times::Optional, meaning }
}

const fn any(element: &'static Element) -> Child {
    Child { element, times: Times::Any, meaning: "" }
}

const XYZ: &[Attribute] = &[
    required("x", "number", "first coordinate"),
    required("y", "number", "second coordinate"),
    required("z", "number", "third coordinate; up"),
];

/// An element with three coordinates.
const fn xyz(name: &'static str, summary: &'static str) -> Element {
    Element { name, summary, attributes: XYZ, ..Element::BARE }
}

const POINT_SUMMARY: &str = "A point.";
const DIRECTION_SUMMARY: &str = "A direction other than zero, of any length.";
const SIDE_SUMMARY: &str = "A direction other than zero, as long as the side that it stands for.";

/// All elements, each before those that it holds.
pub static ELEMENTS: &[&Element] = &[
    &WORLD,
    &CAMERA,
    &BACKGROUND,
    &LIGHTS,
    &LAMP,
    &SUN,
    &SPOT,
    &MATERIAL,
    &SHAPES,
    &DEFINE,
    &GROUP,
    &USE,
    &TRANSLATE,
    &ROTATE,
    &SCALE,
    &MATRIX,
    &SPHERE,
    &PLANE,
    &DISC,
    &RECTANGLE,
    &TRIANGLE,
    &BOX,
    &CUBE,
    &TETRAHEDRON,
    &CYLINDER,
    &CONE,
    &FRUSTUM,
    &TORUS,
    &MESH,
    &ORIGIN,
    &TARGET,
    &UP,
    &POINT,
    &NORMAL,
    &AXIS,
    &ACROSS,
    &UPWARD,
    &FROM,
    &TO,
    &BASE,
    &TOP,
    &A,
    &B,
    &C,
    &D,
];

/// The elements that may hold one of that name.
pub(crate) fn parents_of(name: &str) -> impl Iterator<Item = &'static Element> {
    ELEMENTS
        .iter()
        .copied()
        .filter(move |parent| parent.all_children().any(|child| child.element.name == name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_child_is_listed_after_its_parents() {
        for (i, element) in ELEMENTS.iter().enumerate() {
            for child in element.all_children() {
                let place = ELEMENTS.iter().position(|e| std::ptr::eq(*e, child.element));
                // Groups hold groups.
                assert!(place.is_some_and(|place| place >= i), "{}", child.element.name);
            }
        }
    }

    #[test]
    fn names_are_told_apart() {
        for (i, element) in ELEMENTS.iter().enumerate() {
            assert!(ELEMENTS[..i].iter().all(|e| e.name != element.name), "{}", element.name);
            let names: Vec<_> = element.all_attributes().map(|a| a.name).collect();
            for (k, name) in names.iter().enumerate() {
                assert!(!names[..k].contains(name), "{name} of {}", element.name);
            }
        }
    }

    #[test]
    fn what_is_said_of_attributes_is_said_of_those_that_there_are() {
        for element in ELEMENTS {
            let has = |name: &str| element.all_attributes().any(|a| a.name == name);
            assert_eq!(element.cells.is_some(), has("chess-size"), "{}", element.name);
            assert_eq!(element.cells.is_some(), has("material"), "{}", element.name);
            assert_eq!(element.cells.is_some(), !element.checker.is_empty(), "{}", element.name);
            for attribute in element.all_attributes() {
                let named = element.one_of.iter().flat_map(|set| set.iter());
                let count = named.filter(|name| **name == attribute.name).count();
                assert_eq!(count, usize::from(attribute.need == Need::OneOf));
            }
            assert!(element.one_of.iter().flat_map(|set| set.iter()).all(|name| has(name)));
            for (name, slip) in element.slips {
                assert!(!has(name), "{name} of {}", element.name);
                assert!(!matches!(slip, Slip::Meant(meant) if !has(meant)), "{}", element.name);
            }
        }
    }
}
