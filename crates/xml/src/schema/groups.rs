//! How shapes are put together and where they stand.

use super::{
    BOX, CONE, CUBE, CYLINDER, Child, DISC, Element, FRUSTUM, MESH, PLANE, RECTANGLE, SPHERE, Slip,
    TETRAHEDRON, TORUS, TRIANGLE, any, one_of, required,
};

const ON_THE_USE: Slip = Slip::Instead(
    "put it on the <use> of the definition, or on a <group> around what it is to move",
);

/// `<translate>`
pub static TRANSLATE: Element = Element {
    name: "translate",
    summary: "Moves.",
    attributes: &[
        required("x", "number", "how far along x, a length"),
        required("y", "number", "how far along y"),
        required("z", "number", "how far along z"),
    ],
    ..Element::BARE
};

/// `<rotate>`
pub static ROTATE: Element = Element {
    name: "rotate",
    summary: "Turns about an axis through the origin, that of the group and not of the shapes in \
              it.",
    attributes: &[
        required("x", "number", "first coordinate of the axis, which is not zero"),
        required("y", "number", "second coordinate of the axis"),
        required("z", "number", "third coordinate of the axis"),
        required(
            "angle",
            "angle in degrees",
            "how far, counterclockwise where the axis points at the viewer",
        ),
    ],
    ..Element::BARE
};

/// `<scale>`
pub static SCALE: Element = Element {
    name: "scale",
    summary: "Stretches away from the origin, by one factor or one for each axis.",
    attributes: &[
        one_of("by", "number other than 0", "the factor for all axes"),
        one_of("x", "number other than 0", "the factor along x; a negative one mirrors"),
        one_of("y", "number other than 0", "the factor along y"),
        one_of("z", "number other than 0", "the factor along z"),
    ],
    one_of: &[&["by"], &["x", "y", "z"]],
    ..Element::BARE
};

/// `<matrix>`
pub static MATRIX: Element = Element {
    name: "matrix",
    summary: "Any map that keeps straight lines straight and does not flatten space.",
    attributes: &[required(
        "rows",
        "list of twelve numbers",
        "three rows of four, row by row: the point (x, y, z) goes to where each coordinate is the \
         sum of x, y and z, times the first three numbers of its row, and the fourth",
    )],
    ..Element::BARE
};

/// What moves a group.
pub static TRANSFORMS: &[Child] = &[any(&TRANSLATE), any(&ROTATE), any(&SCALE), any(&MATRIX)];

/// What there may be to be seen.
static THINGS: [Child; 15] = [
    any(&SPHERE),
    any(&PLANE),
    any(&DISC),
    any(&RECTANGLE),
    any(&TRIANGLE),
    any(&BOX),
    any(&CUBE),
    any(&TETRAHEDRON),
    any(&CYLINDER),
    any(&CONE),
    any(&FRUSTUM),
    any(&TORUS),
    any(&MESH),
    any(&GROUP),
    any(&USE),
];

/// `<shapes>`
pub static SHAPES: Element = Element {
    name: "shapes",
    summary: "What is there to be seen.",
    children: &THINGS,
    ..Element::BARE
};

/// `<define>`
pub static DEFINE: Element = Element {
    name: "define",
    summary: "Shapes under a name, which each `<use>` of it shows once more. It shows nothing by \
              itself, is kept in memory once, and must not use itself.",
    attributes: &[required("name", "name", "what uses call it; no two definitions share one")],
    children: &THINGS,
    slips: &[
        ("translate", ON_THE_USE),
        ("rotate", ON_THE_USE),
        ("scale", ON_THE_USE),
        ("matrix", ON_THE_USE),
    ],
    ..Element::BARE
};

/// `<group>`
pub static GROUP: Element = Element {
    name: "group",
    summary: "Shapes that are moved together. Its transforms apply to all that is in it, wherever \
              among the shapes they stand: what is inside is moved by the first, then by the \
              second, and so on.",
    children: &THINGS,
    transforms: TRANSFORMS,
    slips: &[
        ("name", Slip::Instead("a group with a name is a <define>, shown by a <use>")),
        ("material", Slip::Instead("give `material` on the shapes")),
        ("color", Slip::Instead("give `color` on the shapes, or on a <material> that they name")),
    ],
    ..Element::BARE
};

/// `<use>`
pub static USE: Element = Element {
    name: "use",
    summary: "The shapes of a definition once more, moved by its transforms in the order written.",
    attributes: &[required("name", "name of a <define>", "what to show")],
    transforms: TRANSFORMS,
    slips: &[
        ("material", Slip::Instead("give `material` on the shapes of the definition")),
        (
            "color",
            Slip::Instead(
                "give `color` on the shapes of the definition, or on a <material> of theirs",
            ),
        ),
    ],
    ..Element::BARE
};
