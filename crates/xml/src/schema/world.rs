//! The whole, and who looks at it.

use super::{
    DEFINE, DIRECTION_SUMMARY, Element, LIGHTS, MATERIAL, POINT_SUMMARY, SHAPES, any, at_most_once,
    once, one_of, optional, required, xyz,
};

/// `<origin>`
pub static ORIGIN: Element = xyz("origin", POINT_SUMMARY);

/// `<target>`
pub static TARGET: Element = xyz("target", POINT_SUMMARY);

/// `<up>`
pub static UP: Element = xyz("up", DIRECTION_SUMMARY);

/// `<point>`
pub static POINT: Element = xyz("point", "A point, or for a sun a direction.");

/// `<camera>`
pub static CAMERA: Element = Element {
    name: "camera",
    summary: "A camera with z up, unless it says otherwise: the middle of the picture is in the \
              direction from `origin` to `target`, and `up` points to its top. Pixels are square. \
              Where `up` is along the view, which then has no upper side, the coordinate axis \
              least along the view is up; of axes that are equally so, y comes before x, and x \
              before z.",
    attributes: &[
        required("pxwidth", "whole number from 1", "the width of the picture in pixels"),
        required("pxheight", "whole number from 1", "the height of the picture in pixels"),
        one_of(
            "width",
            "number above 0",
            "the width of the image plane, a length; its height is `width * pxheight / pxwidth`. \
             In perspective the plane goes through `target`",
        ),
        one_of(
            "fov",
            "angle above 0 and below 180 degrees",
            "the angle between the left and the right edge of the picture, instead of `width`; in \
             perspective only",
        ),
        optional(
            "projection",
            "`perspective` or `orthographic`",
            "whether rays go through `origin`, or are parallel, from a plane through `origin`. \
             `perspective` where it is missing",
        ),
        optional(
            "roll",
            "angle in degrees",
            "how far the camera is turned about its axis, clockwise as seen from behind it, so \
             that the picture turns counterclockwise. 0 where it is missing",
        ),
        optional(
            "aperture",
            "number of at least 0",
            "the diameter of a thin lens around `origin`, as openings are measured, in the lengths \
             of the scene; 0, where it is missing: a pinhole, to which everything is sharp. What is \
             z away along the axis, and d away from the plane in focus, is a disc in that plane, \
             `aperture * d / z` wide. In `orthographic` every ray has such a lens around its start, \
             and the disc is `aperture * d / focus` wide",
        ),
        optional(
            "focus",
            "number above 0",
            "how far from `origin`, along the axis, the plane is that is seen sharply, with an \
             `aperture`; the distance of `target` where it is missing",
        ),
        optional(
            "exposure",
            "`auto` or a number of stops from -1000 to 1000",
            "what linear light is multiplied by before it is shown: 2 to so many stops; `auto`, \
             also where it is missing, goes by what is in the picture",
        ),
    ],
    one_of: &[&["width"], &["fov"]],
    children: &[
        once(&ORIGIN, "where the eye is"),
        once(&TARGET, "the centre of the image plane; not where the eye is"),
        at_most_once(&UP, "which way is up; 0 0 1 where it is missing"),
    ],
    ..Element::BARE
};

/// `<background>`
pub static BACKGROUND: Element = Element {
    name: "background",
    summary: "What is seen where there is nothing else, in mirrors too. It lights nothing. Black \
              where it is missing.",
    attributes: &[required(
        "color",
        "colour",
        "its radiance, in the unit of `brightness`; the numbers of `linear(r, g, b)` may exceed 1 \
         here",
    )],
    ..Element::BARE
};

/// `<world>`
pub static WORLD: Element = Element {
    name: "world",
    summary: "The whole scene; the root of the file. What it holds may stand in any order, and \
              names may be used before they are given.",
    children: &[
        once(&CAMERA, ""),
        once(&LIGHTS, ""),
        once(&SHAPES, ""),
        at_most_once(&BACKGROUND, ""),
        any(&MATERIAL),
        any(&DEFINE),
    ],
    ..Element::BARE
};
