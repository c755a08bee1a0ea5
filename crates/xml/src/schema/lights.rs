//! What shines.

use super::{AXIS, Attribute, Element, POINT, Slip, any, once, optional, required};

const FALLOFF: Attribute = optional(
    "falloff",
    "`square` or `none`",
    "how light weakens with distance: with its square, as where it is missing, or not at all. \
     The engines `classic` and `direct` take it not to weaken whatever is said",
);

const RADIUS: Attribute = optional(
    "radius",
    "number of at least 0",
    "the radius of a ball around the point, from whose whole surface the light comes, so that \
     shadows have soft edges. A surface that sees the whole ball is as bright as it would be by a \
     lamp without a radius; one that sees a part, as that part of the ball makes it. To what is \
     inside, the ball shines from all sides, with `falloff=\"none\"` with its full brightness. 0, \
     where it is missing: the point alone",
);

/// `<lamp>`
pub static LAMP: Element = Element {
    name: "lamp",
    summary: "A light that shines from a point, or a ball, in all directions; it cannot be seen itself.",
    attributes: &[
        required(
            "brightness",
            "number of at least 0",
            "how strong the light is: the radiance that a white matte surface shows when it \
             faces the lamp squarely from distance 1",
        ),
        RADIUS,
        FALLOFF,
    ],
    children: &[once(&POINT, "where the lamp is")],
    slips: &[("size", Slip::Instead("give the radius of its ball as `radius`"))],
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
    slips: &[
        ("falloff", Slip::Instead("leave it out: the light of a sun does not weaken")),
        ("radius", Slip::Instead("leave it out: a sun is a point infinitely far away")),
    ],
    ..Element::BARE
};

/// `<spot>`
pub static SPOT: Element = Element {
    name: "spot",
    summary: "A light that shines from a point, or a ball, into a cone; it cannot be seen itself. \
              Between the two angles, which are those to the direction from its point, its light \
              fades.",
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
        RADIUS,
        FALLOFF,
    ],
    children: &[once(&POINT, "where the lamp is"), once(&AXIS, "where the middle of it shines")],
    slips: &[
        ("size", Slip::Instead("give the radius of its ball as `radius`")),
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
