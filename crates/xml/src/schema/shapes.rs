//! What there is to be seen.

use super::surface::MATERIAL_OF_SHAPE;
use super::{
    Attribute, Cells, DIRECTION_SUMMARY, Element, ORIGIN, POINT, POINT_SUMMARY, SIDE_SUMMARY,
    SURFACE, Slip, once, optional, required, xyz,
};

const LENGTH: Attribute = Cells::Length.attribute();
const ANGLE: Attribute = Cells::Angle.attribute();
const LENGTH_AND_ANGLE: Attribute = Cells::LengthAndAngle.attribute();

const OPEN: Attribute = optional(
    "open",
    "`true` or `false`",
    "whether it has no lids, and so no inside. `false` where it is missing",
);

/// Names that others have for a `size`.
const RADIUS: &[(&str, Slip)] = &[("radius", Slip::Meant("size")), ("r", Slip::Meant("size"))];

/// `<normal>`
pub static NORMAL: Element = xyz("normal", DIRECTION_SUMMARY);

/// `<axis>`
pub static AXIS: Element = xyz("axis", DIRECTION_SUMMARY);

/// `<across>`
pub static ACROSS: Element = xyz("across", SIDE_SUMMARY);

/// `<upward>`
pub static UPWARD: Element = xyz("upward", SIDE_SUMMARY);

/// `<from>`
pub static FROM: Element = xyz("from", POINT_SUMMARY);

/// `<to>`
pub static TO: Element = xyz("to", POINT_SUMMARY);

/// `<base>`
pub static BASE: Element = xyz("base", POINT_SUMMARY);

/// `<top>`
pub static TOP: Element = xyz("top", POINT_SUMMARY);

/// `<a>`
pub static A: Element = xyz("a", POINT_SUMMARY);

/// `<b>`
pub static B: Element = xyz("b", POINT_SUMMARY);

/// `<c>`
pub static C: Element = xyz("c", POINT_SUMMARY);

/// `<d>`
pub static D: Element = xyz("d", POINT_SUMMARY);

/// `<sphere>`
pub static SPHERE: Element = Element {
    name: "sphere",
    summary: "A sphere.",
    attributes: &[
        required("size", "number above 0", "the radius, a length"),
        ANGLE,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::Angle),
    checker: "latitude from its equator and longitude from the x axis, towards y",
    children: &[once(&POINT, "the centre")],
    slips: RADIUS,
    ..Element::BARE
};

/// `<plane>`
pub static PLANE: Element = Element {
    name: "plane",
    summary: "An infinite plane. What is behind it, seen against its normal, is its inside. The \
              engines `classic` and `direct` show and light it only from the side that its normal \
              points to.",
    attributes: &[LENGTH, MATERIAL_OF_SHAPE],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares along both axes across its normal, from `origin`",
    children: &[once(&ORIGIN, "a point of the plane"), once(&NORMAL, "which way it faces")],
    ..Element::BARE
};

/// `<disc>`
pub static DISC: Element = Element {
    name: "disc",
    summary: "The inside of a circle. It has no thickness.",
    attributes: &[
        required("size", "number above 0", "the radius, a length"),
        LENGTH,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares along both axes across its normal, from its centre",
    children: &[once(&POINT, "the centre"), once(&NORMAL, "which way it faces")],
    slips: RADIUS,
    ..Element::BARE
};

/// `<rectangle>`
pub static RECTANGLE: Element = Element {
    name: "rectangle",
    summary: "A rectangle, from a corner and the two sides there. It has no thickness. Sides that \
              are not perpendicular make a parallelogram.",
    attributes: &[LENGTH, MATERIAL_OF_SHAPE],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares along <across>, and perpendicular to it in the plane, from the corner",
    children: &[
        once(&POINT, "a corner"),
        once(&ACROSS, "the side from that corner to the next"),
        once(&UPWARD, "the other side there; not parallel to the first"),
    ],
    slips: &[(
        "size",
        Slip::Instead("the lengths of <across> and <upward> are those of its sides"),
    )],
    ..Element::BARE
};

/// `<triangle>`
pub static TRIANGLE: Element = Element {
    name: "triangle",
    summary: "A triangle. It has no thickness. Its corners are not on one line.",
    attributes: &[LENGTH, MATERIAL_OF_SHAPE],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares along the side from <a> to <b>, and perpendicular to it in the plane, \
              from <a>",
    children: &[once(&A, "the first corner"), once(&B, "the second"), once(&C, "the third")],
    ..Element::BARE
};

/// `<box>`
pub static BOX: Element = Element {
    name: "box",
    summary: "A box with its sides along the axes, from two opposite corners.",
    attributes: &[LENGTH, MATERIAL_OF_SHAPE],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares on each face along the axes, from the corner with the smallest \
              coordinates",
    children: &[
        once(&FROM, "a corner"),
        once(&TO, "the opposite corner; different in all three coordinates"),
    ],
    slips: &[(
        "size",
        Slip::Instead("the corners <from> and <to> say how large it is; <cube> has a size"),
    )],
    ..Element::BARE
};

/// `<cube>`
pub static CUBE: Element = Element {
    name: "cube",
    summary: "A cube with its sides along the axes.",
    attributes: &[
        required("size", "number above 0", "the length of a side"),
        LENGTH,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares on each face along the axes, from the corner with the smallest \
              coordinates",
    children: &[once(&POINT, "its middle")],
    ..Element::BARE
};

/// `<tetrahedron>`
pub static TETRAHEDRON: Element = Element {
    name: "tetrahedron",
    summary: "A tetrahedron: four corners, in any order, that are not in one plane.",
    attributes: &[LENGTH, MATERIAL_OF_SHAPE],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares on each face along one of its sides and perpendicular to it, from where \
              that begins: seen from outside, the one that goes anticlockwise from <a>, and where \
              <d> is a corner, the one that goes anticlockwise to <d>",
    children: &[
        once(&A, "the first corner"),
        once(&B, "the second"),
        once(&C, "the third"),
        once(&D, "the fourth"),
    ],
    ..Element::BARE
};

/// `<cylinder>`
pub static CYLINDER: Element = Element {
    name: "cylinder",
    summary: "A cylinder, with lids unless it is open.",
    attributes: &[
        required("size", "number above 0", "the radius, a length"),
        OPEN,
        LENGTH_AND_ANGLE,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::LengthAndAngle),
    checker: "the length along its axis from <base>, and the angle around it; on lids the \
              length outward from the middle, and the same angle",
    children: &[
        once(&BASE, "the middle of one end"),
        once(&TOP, "the middle of the other end; not the same point"),
    ],
    slips: RADIUS,
    ..Element::BARE
};

/// `<cone>`
pub static CONE: Element = Element {
    name: "cone",
    summary: "A cone, with a lid at its base unless it is open.",
    attributes: &[
        required("size", "number above 0", "the radius at the base, a length"),
        OPEN,
        LENGTH_AND_ANGLE,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::LengthAndAngle),
    checker: "as on a cylinder",
    children: &[once(&BASE, "the middle of its base"), once(&TOP, "its apex; not the same point")],
    slips: RADIUS,
    ..Element::BARE
};

/// `<frustum>`
pub static FRUSTUM: Element = Element {
    name: "frustum",
    summary: "A cone that is cut off, with lids unless it is open.",
    attributes: &[
        required("size", "number of at least 0", "the radius at the base, a length"),
        required(
            "top-size",
            "number of at least 0",
            "the radius at the top, a length; one of the two may be 0",
        ),
        OPEN,
        LENGTH_AND_ANGLE,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::LengthAndAngle),
    checker: "as on a cylinder",
    children: &[
        once(&BASE, "the middle of its base"),
        once(&TOP, "the middle of the other end; not the same point"),
    ],
    slips: RADIUS,
    ..Element::BARE
};

/// `<torus>`
pub static TORUS: Element = Element {
    name: "torus",
    summary: "A ring: a tube around a circle.",
    attributes: &[
        required("size", "number above 0", "the radius of the circle in the middle of the tube"),
        required("tube", "number above 0", "the radius of the tube; at most `size`"),
        ANGLE,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::Angle),
    checker: "the angle around its axis, and around the tube from the outermost circle upward",
    children: &[once(&POINT, "the centre"), once(&AXIS, "the axis that the ring lies around")],
    slips: RADIUS,
    ..Element::BARE
};

/// `<mesh>`
pub static MESH: Element = Element {
    name: "mesh",
    summary: "Triangles from a file: Wavefront OBJ, PLY (text or binary) or STL (text or binary). \
              It has an inside where it has no holes. Faces with more than three corners are cut \
              into triangles, and triangles with no area are left out. Colours and textures in \
              the file are ignored.",
    attributes: &[
        required(
            "file",
            "name of a file that ends in `.obj`, `.ply` or `.stl`",
            "the file; a path that is not absolute begins at the scene file's folder",
        ),
        optional(
            "normals",
            "`flat` or `smooth`",
            "whether its triangles look flat, as where it is missing, or smooth: by the normals \
             in the file, or where it has none by the mean of those around each corner, weighted \
             by angles",
        ),
        optional(
            "part",
            "name of a material, group or object in an OBJ file",
            "the faces that are used; all where it is missing",
        ),
        LENGTH,
        MATERIAL_OF_SHAPE,
    ],
    surface: SURFACE,
    cells: Some(Cells::Length),
    checker: "squares along the two coordinate axes that the normal of a triangle points along \
              least, from the origin of the file",
    slips: &[
        ("size", Slip::Instead("put it in a <group> with a <scale>")),
        ("point", Slip::Instead("put it in a <group> with a <translate>")),
    ],
    ..Element::BARE
};
