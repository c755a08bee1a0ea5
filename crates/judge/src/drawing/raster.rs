//! Drawings as pixels, two for each unit of length.
//!
//! A pixel is covered by as much as its centre is inside of a shape's edge, from half a pixel
//! outside to half a pixel inside; so edges are smooth.

use super::{Anchor, At, Colour, Drawing, Hand, Shape};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Pixels for each unit.
const SCALE: f64 = 2.0;

/// A drawing's pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    /// How many columns.
    pub width: u32,
    /// How many rows.
    pub height: u32,
    /// Red, green and blue of each pixel, row by row from the top.
    pub bytes: Vec<u8>,
}

impl Drawing {
    /// The drawing in pixels. The same drawing has the same ones on every machine.
    #[must_use]
    pub fn raster(&self) -> Raster {
        let (width, height) = (self.width * SCALE as u32, self.height * SCALE as u32);
        let bytes = vec![255; 3 * width as usize * height as usize];
        let mut raster = Raster { width, height, bytes };
        for shape in &self.shapes {
            raster.draw(shape);
        }
        raster
    }
}

impl Raster {
    fn draw(&mut self, shape: &Shape) {
        let scaled = |[x, y]: At| [SCALE * x, SCALE * y];
        match shape {
            Shape::Line { points, width, colour, dash } => {
                let points: Vec<At> = points.iter().copied().map(scaled).collect();
                let radius = 0.5 * SCALE * width;
                for ends in pieces(&points, SCALE * dash) {
                    self.fill(&ends, radius, *colour, |at| from_piece(at, ends) - radius);
                }
            }
            Shape::Disc { centre, radius, colour } => {
                let (centre, radius) = (scaled(*centre), SCALE * radius);
                self.fill(&[centre], radius, *colour, |at| length(at, centre) - radius);
            }
            Shape::Ring { centre, radius, width, colour } => {
                let (centre, radius, half) = (scaled(*centre), SCALE * radius, 0.5 * SCALE * width);
                self.fill(&[centre], radius + half, *colour, |at| {
                    (length(at, centre) - radius).abs() - half
                });
            }
            Shape::Polygon { corners, colour } => {
                let corners: Vec<At> = corners.iter().copied().map(scaled).collect();
                self.fill(&corners, 0.0, *colour, |at| outside(at, &corners));
            }
            Shape::Words { at, text, hand, anchor, colour, upward } => {
                self.write(scaled(*at), text, *hand, *anchor, *colour, *upward);
            }
        }
    }

    /// Covers what is inside: where the distance from the edge is negative. No inside
    /// is further than `around` from all of the points' box.
    fn fill(&mut self, points: &[At], around: f64, colour: Colour, distance: impl Fn(At) -> f64) {
        let range = |axis: usize, end: u32| {
            let values = points.iter().map(|point| point[axis]);
            let least = values.clone().fold(f64::INFINITY, f64::min) - around - 1.0;
            let most = values.fold(f64::NEG_INFINITY, f64::max) + around + 1.0;
            // Below 0 and above the type's range, `as` takes what is nearest.
            (least as u32).min(end)..(most as u32 + 1).min(end)
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let at = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                self.cover(x, y, 0.5 - distance(at), colour);
            }
        }
    }

    /// Mixes a colour into a pixel.
    fn cover(&mut self, x: u32, y: u32, share: f64, colour: Colour) {
        let start = 3 * (y as usize * self.width as usize + x as usize);
        let share = share.clamp(0.0, 1.0);
        for (byte, colour) in self.bytes[start..start + 3].iter_mut().zip(colour) {
            let mixed = f64::from(*byte) * (1.0 - share) + f64::from(colour) * share;
            *byte = libm::rint(mixed) as u8;
        }
    }

    fn write(
        &mut self,
        [x, y]: At,
        text: &str,
        hand: Hand,
        anchor: Anchor,
        colour: Colour,
        upward: bool,
    ) {
        let (weight, height) = match hand {
            Hand::Small => (FontWeight::Regular, RasterHeight::Size24),
            Hand::Plain => (FontWeight::Regular, RasterHeight::Size32),
            Hand::Title => (FontWeight::Bold, RasterHeight::Size32),
        };
        let advance = get_raster_width(weight, height) as i64;
        let length = advance * text.chars().count() as i64;
        let mut along = match anchor {
            Anchor::Start => 0,
            Anchor::Middle => -length / 2,
            Anchor::End => -length,
        };
        // The line that letters stand on is a fifth of their box above its lower end.
        let above = (height.val() * 4 / 5) as i64;
        for c in text.chars() {
            let known = get_raster(c, weight, height).or_else(|| get_raster('?', weight, height));
            let rows = known.iter().flat_map(|letter| letter.rows().enumerate());
            let dots = rows.flat_map(|(down, row)| {
                row.iter().enumerate().map(move |(right, dot)| (right as i64, down as i64, *dot))
            });
            for (right, down, dot) in dots {
                let (right, down) = (along + right, down - above);
                let (right, down) = if upward { (down, -right) } else { (right, down) };
                let place = (x as i64 + right, y as i64 + down);
                if let (Ok(x), Ok(y)) = (u32::try_from(place.0), u32::try_from(place.1))
                    && x < self.width
                    && y < self.height
                {
                    self.cover(x, y, f64::from(dot) / 255.0, colour);
                }
            }
            along += advance;
        }
    }
}

/// The straight pieces of a line, or its dashes, which are as long as the gaps.
fn pieces(points: &[At], dash: f64) -> Vec<[At; 2]> {
    let whole = points.windows(2).map(|pair| [pair[0], pair[1]]);
    if dash <= 0.0 {
        return whole.collect();
    }
    let mut dashes = Vec::new();
    // How far along the line a piece begins.
    let mut before = 0.0;
    for [a, b] in whole {
        let piece = length(a, b);
        let at = |along: f64| {
            let part = ((along - before) / piece).clamp(0.0, 1.0);
            [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]
        };
        let mut start = 2.0 * dash * libm::floor(before / (2.0 * dash));
        while start < before + piece {
            if start + dash > before {
                dashes.push([at(start), at(start + dash)]);
            }
            start += 2.0 * dash;
        }
        before += piece;
    }
    dashes
}

fn length(a: At, b: At) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// How far a place is from the straight way between two.
fn from_piece(at: At, [a, b]: [At; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let along = (at[0] - a[0]) * way[0] + (at[1] - a[1]) * way[1];
    let part = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    length(at, [a[0] + part * way[0], a[1] + part * way[1]])
}

/// How far a place is outside of the edge that it is furthest outside of.
fn outside(at: At, corners: &[At]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let distance = |(a, b): (&At, &At)| {
        let way = [b[0] - a[0], b[1] - a[1]];
        (way[1] * (at[0] - a[0]) - way[0] * (at[1] - a[1])) / length(*a, *b)
    };
    corners.iter().zip(next).map(distance).fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(shape: Shape) -> Raster {
        Drawing { width: 30, height: 20, shapes: vec![shape], title: String::new() }.raster()
    }

    /// How many pixels' worth of black there is.
    fn ink(raster: &Raster) -> f64 {
        let dark: u64 = raster.bytes.iter().map(|byte| u64::from(255 - byte)).sum();
        dark as f64 / (3.0 * 255.0)
    }

    const BLACK: Colour = [0; 3];

    #[test]
    fn areas_are_right() {
        let disc = drawn(Shape::Disc { centre: [12.3, 9.1], radius: 5.0, colour: BLACK });
        assert!((ink(&disc) - 100.0 * std::f64::consts::PI).abs() < 2.0, "{}", ink(&disc));
        let ring = Shape::Ring { centre: [12.3, 9.1], radius: 5.0, width: 1.0, colour: BLACK };
        let right = 4.0 * std::f64::consts::PI * (5.5 * 5.5 - 4.5 * 4.5);
        assert!((ink(&drawn(ring.clone())) - right).abs() < 2.0, "{}", ink(&drawn(ring)));
        let corners = vec![[5.0, 2.0], [25.0, 8.0], [9.0, 18.0]];
        let triangle = drawn(Shape::Polygon { corners, colour: BLACK });
        let right = 4.0 * 0.5 * (20.0 * 16.0 - 6.0 * 4.0);
        assert!((ink(&triangle) - right).abs() < 0.01 * right, "{} {right}", ink(&triangle));
        let line = |dash| Shape::Line {
            points: vec![[2.0, 3.0], [26.0, 3.0], [26.0, 15.0]],
            width: 2.0,
            colour: BLACK,
            dash,
        };
        assert!((ink(&drawn(line(0.0))) - 300.0).abs() < 6.0, "{}", ink(&drawn(line(0.0))));
        // Half of it, and round ends.
        let dashed = ink(&drawn(line(4.0)));
        assert!((dashed - 215.0).abs() < 20.0, "{dashed}");
    }

    #[test]
    fn words_are_where_they_should_be() {
        let words = |anchor, upward, text: &str| {
            drawn(Shape::Words {
                at: [15.0, 10.0],
                text: text.to_owned(),
                hand: Hand::Small,
                anchor,
                colour: BLACK,
                upward,
            })
        };
        // The box of what is not white.
        let extent = |raster: &Raster| {
            let dark = raster.bytes.chunks_exact(3).zip(0..).filter(|(p, _)| p[0] < 128);
            let places = dark.map(|(_, i)| (i % raster.width, i / raster.width));
            places.fold((u32::MAX, 0, u32::MAX, 0), |(l, r, t, b), (x, y)| {
                (l.min(x), r.max(x), t.min(y), b.max(y))
            })
        };
        let (left, right, top, bottom) = extent(&words(Anchor::Start, false, "HH"));
        assert!(
            left >= 30 && right > 40 && top > 4 && bottom <= 20,
            "{left} {right} {top} {bottom}"
        );
        let (left, right, ..) = extent(&words(Anchor::End, false, "HH"));
        assert!(left < 20 && right <= 30, "{left} {right}");
        let (left, right, top, bottom) = extent(&words(Anchor::Start, true, "HH"));
        assert!(
            left > 14 && right <= 30 && top < 10 && bottom <= 20,
            "{left} {right} {top} {bottom}"
        );
        // What has no letter is not left out, and what is outside is cut off.
        assert!(ink(&words(Anchor::Start, false, "\u{4e00}")) > 5.0);
        words(Anchor::Middle, false, "a very long text, much longer than the drawing is wide");
    }

    #[test]
    fn what_is_outside_is_cut_off() {
        for centre in [[-100.0, 5.0], [1e9, 1e9], [f64::NAN, 0.0]] {
            assert_eq!(ink(&drawn(Shape::Disc { centre, radius: 5.0, colour: BLACK })), 0.0);
        }
    }
}
