//! Which line a pixel looks along.

use crate::{Line, Number, Triple};
use lancer_math::Vector;
use lancer_scene::{Camera, Projection};

/// Sine up to which the view counts as along the camera's upward direction.
const ALONG: i32 = -50;

/// The line through the centre of pixel (`x`, `y`), counted from the top left one,
/// with a direction of length 1. It begins at the eye, or in the plane through the
/// camera's origin where the rays are parallel.
#[must_use]
pub fn pixel_line(camera: &Camera, x: u32, y: u32, bits: usize) -> Line {
    let more = bits + 32;
    let origin = Triple::from(camera.origin().get());
    let ahead = &Triple::from(camera.target().get()) - &origin;
    let (right, up) = frame(camera, &ahead, more);
    let (px_width, px_height) = (camera.px_width.get(), camera.px_height.get());
    // Half the side of a pixel, so many of them to the right of the middle, and
    // upward.
    let twice_across = Number::from(2.0 * f64::from(px_width));
    let half = plane_width(camera, &ahead, more).over(&twice_across, more);
    let to_right = 2.0 * f64::from(x) + 1.0 - f64::from(px_width);
    let upward = f64::from(px_height) - 2.0 * f64::from(y) - 1.0;
    let sideward = right.times(&(&half * Number::from(to_right)));
    let upward = up.times(&(&half * Number::from(upward)));
    let aside = &sideward + &upward;
    if matches!(camera.projection, Projection::Orthographic(_)) {
        Line { origin: (&origin + &aside).rounded(bits), direction: ahead.unit(bits) }
    } else {
        Line { origin, direction: (&ahead + &aside).unit(bits) }
    }
}

fn plane_width(camera: &Camera, ahead: &Triple, bits: usize) -> Number {
    match camera.projection {
        Projection::Pinhole(width) | Projection::Orthographic(width) => width.get().into(),
        Projection::FieldOfView(angle) => {
            let half_angle = Number::from(angle.get()) * Number::power_of_two(-1);
            let (sine, cosine) = half_angle.sin_cos_degrees(bits);
            Number::from(2) * ahead.norm(bits) * sine.over(&cosine, bits)
        }
    }
}

/// The directions to the right and to the top of the picture, of length 1.
fn frame(camera: &Camera, ahead: &Triple, bits: usize) -> (Triple, Triple) {
    let axis = ahead.unit(bits);
    let mut across = axis.cross(&Triple::from(camera.up.get()).unit(bits));
    let along = Number::power_of_two(ALONG);
    if across.0.iter().all(|c| c.abs() <= along) {
        // Of the coordinate axes the one least along the view; of equal ones y,
        // then x, then z.
        let mut least = Triple::from(Vector::y());
        for other in [Vector::x(), Vector::z()].map(Triple::from) {
            if axis.dot(&other).abs() + &along < axis.dot(&least).abs() {
                least = other;
            }
        }
        across = axis.cross(&least);
    }
    let right = across.unit(bits);
    let up = right.cross(&axis);
    // Turned clockwise as seen from behind: what was right goes down.
    let (sine, cosine) = Number::from(camera.roll.get()).sin_cos_degrees(bits);
    let turned_right = &right.times(&cosine) - &up.times(&sine);
    let turned_up = &up.times(&cosine) + &right.times(&sine);
    (turned_right.rounded(bits), turned_up.rounded(bits))
}
