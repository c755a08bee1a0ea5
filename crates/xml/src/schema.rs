//! The elements of the language and what each may hold. The front-end reads
//! by these tables and the reference manual is made from them, so that the two
//! cannot differ.

/// An element of the language.
#[derive(Debug)]
pub struct Element {
    /// Its name.
    pub name: &'static str,
    /// What it is, in a line or two.
    pub summary: &'static str,
    /// What attributes it may have.
    pub attributes: &'static [Attribute],
    /// What elements it may hold.
    pub children: &'static [Child],
}

/// An attribute of an element.
#[derive(Debug)]
pub struct Attribute {
    /// Its name.
    pub name: &'static str,
    /// Whether the element must have it.
    pub required: bool,
    /// What its value may be.
    pub values: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

/// An element inside another one.
#[derive(Debug)]
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
    /// Any number of times.
    Any,
}

const fn required(name: &'static str, values: &'static str, meaning: &'static str) -> Attribute {
    Attribute { name, required: true, values, meaning }
}

const fn optional(name: &'static str, values: &'static str, meaning: &'static str) -> Attribute {
    Attribute { name, required: false, values, meaning }
}

const fn once(element: &'static Element, meaning: &'static str) -> Child {
    Child { element, times: Times::Once, meaning }
}

const fn any(element: &'static Element) -> Child {
    Child { element, times: Times::Any, meaning: "" }
}

const XYZ: &[Attribute] = &[
    required("x", "number", "first coordinate"),
    required("y", "number", "second coordinate"),
    required("z", "number", "third coordinate; up"),
];

const COLOR: Attribute = required("color", "colour name", "the colour of the surface");
const GLOSS: Attribute = required(
    "gloss",
    "number from 0 to 1",
    "the fraction of light that the surface mirrors; the rest is matte",
);
const CHESS: Attribute = optional(
    "chess",
    "colour name or `default`",
    "the second colour of a checker pattern; `default` is the complement of `color`, \
     (255 - r, 255 - g, 255 - b)",
);
const BRIGHTNESS: Attribute = required(
    "brightness",
    "number of at least 0",
    "how strong the light is: a white surface that a light of 1 strikes squarely is white",
);

/// `<origin>`
pub static ORIGIN: Element =
    Element { name: "origin", summary: "A point.", attributes: XYZ, children: &[] };

/// `<target>`
pub static TARGET: Element =
    Element { name: "target", summary: "A point.", attributes: XYZ, children: &[] };

/// `<point>`
pub static POINT: Element = Element {
    name: "point",
    summary: "A point, or for a sun a direction.",
    attributes: XYZ,
    children: &[],
};

/// `<normal>`
pub static NORMAL: Element = Element {
    name: "normal",
    summary: "A direction other than zero, of any length.",
    attributes: XYZ,
    children: &[],
};

/// `<camera>`
pub static CAMERA: Element = Element {
    name: "camera",
    summary: "A pinhole camera with z up. The image plane is `width` wide and \
              `width * pxheight / pxwidth` high, has `target` at its centre, and its lower edge \
              is horizontal.",
    attributes: &[
        required("pxwidth", "whole number from 1", "the width of the picture in pixels"),
        required("pxheight", "whole number from 1", "the height of the picture in pixels"),
        required("width", "number above 0", "the width of the image plane, a length"),
    ],
    children: &[
        once(&ORIGIN, "where the eye is"),
        once(&TARGET, "the centre of the image plane; not where the eye is"),
    ],
};

/// `<lamp>`
pub static LAMP: Element = Element {
    name: "lamp",
    summary: "A light that shines from a point in all directions, as strongly far away as near.",
    attributes: &[BRIGHTNESS],
    children: &[once(&POINT, "where the lamp is")],
};

/// `<sun>`
pub static SUN: Element = Element {
    name: "sun",
    summary: "A light infinitely far away.",
    attributes: &[BRIGHTNESS],
    children: &[once(&POINT, "the direction in which the light travels; other than zero")],
};

/// `<lights>`
pub static LIGHTS: Element = Element {
    name: "lights",
    summary: "What shines.",
    attributes: &[],
    children: &[any(&LAMP), any(&SUN)],
};

/// `<sphere>`
pub static SPHERE: Element = Element {
    name: "sphere",
    summary: "A sphere. The cells of its checker are half a radian high and wide, counted from \
              its equator and from its x axis.",
    attributes: &[COLOR, GLOSS, required("size", "number above 0", "the radius, a length"), CHESS],
    children: &[once(&POINT, "the centre")],
};

/// `<plane>`
pub static PLANE: Element = Element {
    name: "plane",
    summary: "An infinite plane, seen and lit from the side that its normal points to. The cells \
              of its checker are squares of side 1, counted from its origin.",
    attributes: &[COLOR, GLOSS, CHESS],
    children: &[once(&ORIGIN, "a point of the plane"), once(&NORMAL, "which way it faces")],
};

/// `<shapes>`
pub static SHAPES: Element = Element {
    name: "shapes",
    summary: "What is there to be seen.",
    attributes: &[],
    children: &[any(&SPHERE), any(&PLANE)],
};

/// `<world>`
pub static WORLD: Element = Element {
    name: "world",
    summary: "The whole scene; the root of the file.",
    attributes: &[],
    children: &[once(&CAMERA, ""), once(&LIGHTS, ""), once(&SHAPES, "")],
};

/// All elements, each before those that it holds.
pub static ELEMENTS: &[&Element] = &[
    &WORLD, &CAMERA, &LIGHTS, &LAMP, &SUN, &SHAPES, &SPHERE, &PLANE, &ORIGIN, &TARGET, &POINT,
    &NORMAL,
];

/// The elements that may hold one of that name.
pub(crate) fn parents_of(name: &str) -> impl Iterator<Item = &'static Element> {
    ELEMENTS
        .iter()
        .copied()
        .filter(move |parent| parent.children.iter().any(|child| child.element.name == name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_child_is_listed_after_its_parents() {
        for (i, element) in ELEMENTS.iter().enumerate() {
            for child in element.children {
                let place = ELEMENTS.iter().position(|e| std::ptr::eq(*e, child.element));
                assert!(place.is_some_and(|place| place > i), "{}", child.element.name);
            }
        }
    }
}
