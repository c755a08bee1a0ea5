//! What shines.

use super::{AXIS, Attribute, Element, POINT, Slip, any, once, optional, required};

const FALLOFF: Attribute = optional(
    "falloff",
    "`square` or `none`",
    "how light weakens with distance: with its square, as where it is missing, or not at all. \
     The engines `classic` and `direct` take it not to weaken whatever is said",
);

/// `<lamp>`
pub static LAMP: Element = Element {
    name: "lamp",
    summary: "A light that shines from a point in all directions; it cannot be seen itself.",
    attributes: &[
        required(
            "brightness",
            "number of at least 0",
            "how strong the light is: the radiance that a white matte surface shows when it \
             faces the lamp squarely from distance 1",
        ),
        FALLOFF,
    ],
    children: &[once(&POINT, "where the lamp is")],
    ..Element::BARE
};

/// `<sun>`
pub static SUN: Element = Element {
    name: "sun",
    summary: "A light infinitely far away.",
    attributes: &[required(
        "brightness",
        "number of at least 0",
        "how strong the light is: the radiance that a white matte surface shows when it faces \
         the sun squarely",
    )],
    children: &[once(&POINT, "the direction in which the light travels; other than zero")],
    slips: &[("falloff", Slip::Instead("leave it out: the light of a sun does not weaken"))],
    ..Element::BARE
};

/// `<spot>`
pub static SPOT: Element = Element {
    name: "spot",
    summary: "A light that shines from a point into a cone; it cannot be seen itself. Between the \
              two angles its light fades.",
    attributes: &[
        required(
            "brightness",
            "number of at least 0",
            "how strong the light is: the radiance that a white matte surface on its axis shows \
             when it faces the lamp squarely from distance 1",
        ),
        required(
            "inner",
            "angle from 0 to 180 degrees",
            "the angle from its axis up to which there is full light; at most `outer`",
        ),
        required(
            "outer",
            "angle from 0 to 180 degrees",
            "the angle from its axis from which on there is none",
        ),
        FALLOFF,
    ],
    children: &[once(&POINT, "where the lamp is"), once(&AXIS, "where the middle of it shines")],
    slips: &[
        ("angle", Slip::Instead("give `inner` and `outer`, in degrees from the axis")),
        ("target", Slip::Instead("give the direction of its light as <axis>")),
    ],
    ..Element::BARE
};

/// `<lights>`
pub static LIGHTS: Element = Element {
    name: "lights",
    summary: "What shines.",
    attributes: &[optional(
        "shadows",
        "`tinted` or `opaque`",
        "what transparent things do to light on its way to a surface. `tinted`, also where it is \
         missing: they let it through unbent, less what their faces mirror and their media \
         absorb. `opaque`: they let none through. Both are approximations: light that is bent, \
         and so gathers in bright lines, is not followed",
    )],
    children: &[any(&LAMP), any(&SUN), any(&SPOT)],
    ..Element::BARE
};
