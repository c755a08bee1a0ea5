//! What surfaces look like.

use super::{Attribute, Element, Slip, optional, required};

/// What the numbers of `chess-size` are for a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// The side of square cells, a length.
    Length,
    /// The side of cells in degrees both ways.
    Angle,
    /// Their side along the axis, a length, and around it, in degrees.
    LengthAndAngle,
}

impl Cells {
    /// What `chess-size` may be.
    #[must_use]
    pub const fn values(self) -> &'static str {
        match self {
            Self::Length => "number above 0",
            Self::Angle => "angle in degrees that divides 180",
            Self::LengthAndAngle => {
                "number above 0 and an angle in degrees that divides 180, like `1 30`"
            }
        }
    }

    /// The attribute `chess-size` of a shape with such cells.
    pub(super) const fn attribute(self) -> Attribute {
        let meaning = match self {
            Self::Length => "the side of the cells of its checker, a length. 1 where it is missing",
            Self::Angle => {
                "the side of the cells of its checker, both ways, in degrees. 30 where it is \
                 missing"
            }
            Self::LengthAndAngle => {
                "the sides of the cells of its checker: along the axis (on lids outward from the \
                 middle), a length, and around the axis, in degrees. `1 30` where it is missing"
            }
        };
        optional("chess-size", self.values(), meaning)
    }
}

/// The attribute of shapes that names a material.
pub(super) const MATERIAL_OF_SHAPE: Attribute = optional(
    "material",
    "name of a <material>",
    "whose attributes hold where the shape does not give its own",
);

/// The attributes of a surface.
pub static SURFACE: &[Attribute] = &[
    optional(
        "color",
        "colour",
        "the colour of its matte part. Must be given, by the shape or its material, unless \
         nothing of the surface is matte: with a `gloss` or a `transparency` of 1",
    ),
    optional(
        "gloss",
        "number from 0 to 1",
        "the fraction of light that the surface mirrors, whatever the angle; the rest is clear or \
         matte. 0 where it is missing",
    ),
    optional(
        "chess",
        "colour, `default` or `none`",
        "the second colour of a checker pattern; `default` is the complement of `color`: 255 \
         minus each code, or 1 minus each number of `linear`. `none`, or where it is missing: no \
         checker",
    ),
    optional(
        "transparency",
        "number from 0 to 1",
        "the fraction, of what is not mirrored by `gloss`, that is clear: as much of it as \
         Fresnel's equations say is mirrored, the rest refracted into what is behind. 0 where it \
         is missing",
    ),
    optional(
        "ior",
        "number above 0",
        "the index of refraction of what is behind a clear surface. 1.5, ordinary glass, where it \
         is missing; outside of everything it is 1",
    ),
    optional(
        "absorption",
        "three numbers of at least 0",
        "how much red, green and blue light what is behind a clear surface takes away: after a \
         length d the fraction exp(-absorption * d) is left. `0 0 0` where it is missing",
    ),
    optional(
        "thin",
        "`true` or `false`",
        "whether a clear surface is a sheet: two faces so near that light passes unbent, with \
         nothing between them. `false` where it is missing; but clear shapes with no inside, flat \
         ones and open ones, should be thin",
    ),
    optional(
        "emission",
        "three numbers of at least 0",
        "red, green and blue radiance that it shows by itself, in the unit of `brightness`; seen \
         directly and in mirrors, it lights nothing. `0 0 0` where it is missing",
    ),
    optional(
        "priority",
        "whole number",
        "where transparent solids overlap, what is there is that of the one with the highest \
         priority; of equal ones, the one that is smaller by volume. 0 where it is missing",
    ),
];

/// `<material>`
pub static MATERIAL: Element = Element {
    name: "material",
    summary: "Attributes of a surface under a name, for shapes to refer to.",
    attributes: &[required("name", "name", "what shapes call it; no two materials share one")],
    surface: SURFACE,
    slips: &[(
        "chess-size",
        Slip::Instead(
            "give `chess-size` on the shapes: what its numbers mean depends on the shape",
        ),
    )],
    ..Element::BARE
};
