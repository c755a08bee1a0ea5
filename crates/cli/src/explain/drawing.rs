//! The rays of a pixel as a drawing, seen from where they spread most.

use super::Explained;
use super::lines::{Kind, Line, Place, lines};
use super::text::{name, short, triple};
use lancer_integrator::RayKind;
use std::fmt::Write;

/// Of the drawing, in pixels.
const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 720.0;

/// What the caption, the legend and words beside the outermost points take.
const ABOVE: f64 = 72.0;
const BELOW: f64 = 56.0;
const ASIDE: f64 = 80.0;

/// More lines than these are a blot, and more points with words cannot be read.
const MOST_LINES: usize = 4000;
const MOST_POINTS: usize = 60;

/// The room of words: how wide a letter is, and how high.
const LETTER: f64 = 7.0;
const LINE: f64 = 14.0;

type At = [f64; 2];

const fn colour(kind: Kind) -> &'static str {
    match kind {
        Kind::Ray(RayKind::Primary) => "#202020",
        Kind::Ray(RayKind::Reflected) => "#c0362c",
        Kind::Ray(RayKind::Transmitted) => "#1f6fb4",
        Kind::Shadow => "#c08a00",
    }
}

/// The drawing as SVG. The same rays have the same bytes.
pub(super) fn svg(explained: &Explained) -> String {
    let mut lines = lines(&explained.tree);
    // The most important ones are on top, and are kept.
    lines.sort_by(|a, b| a.size.total_cmp(&b.size));
    let left_out = lines.len().saturating_sub(MOST_LINES);
    lines.drain(..left_out);
    let view = View::new(&lines);

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" \
         font-size=\"12\" role=\"img\">\n<title>Rays of {0}</title>\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n\
         <text x=\"20\" y=\"28\" font-size=\"16\">Rays of {0}</text>\n",
        escaped(&explained.title())
    );
    let seen =
        if left_out > 0 { format!("; {left_out} lines more are left out") } else { String::new() };
    // Writing to a string does not fail.
    let _ = writeln!(
        svg,
        "<text x=\"20\" y=\"48\" fill=\"#606060\">radiance {}; {}{seen}</text>",
        triple(explained.tree.radiance.map(f64::from)),
        view.words()
    );
    for shadows in [true, false] {
        for line in lines.iter().filter(|line| (line.kind == Kind::Shadow) == shadows) {
            draw_line(&mut svg, line, &view);
        }
    }
    points(&mut svg, explained, &lines, &view);
    legend(&mut svg);
    svg.push_str("</svg>\n");
    svg
}

fn draw_line(svg: &mut String, line: &Line, view: &View) {
    let ([x1, y1], [x2, y2]) = (view.at(line.from), view.at(line.to));
    let weight = line.size.clamp(0.0, 1.0).sqrt();
    let (width, dash) = match line.kind {
        Kind::Shadow => (0.9, " stroke-dasharray=\"4 4\""),
        Kind::Ray(_) => (0.6 + 2.4 * weight, ""),
    };
    let _ = writeln!(
        svg,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{}\" \
         stroke-width=\"{width:.2}\" stroke-opacity=\"{:.2}\" stroke-linecap=\"round\"{dash}/>",
        colour(line.kind),
        0.3 + 0.7 * weight
    );
}

/// Where rays met shapes, with words where there is room; the eye and the lights.
fn points(svg: &mut String, explained: &Explained, lines: &[Line], view: &View) {
    let rays = &explained.tree.rays;
    let mut points: Vec<(At, &str, String, bool)> = Vec::new();
    if let Some(eye) = rays.first() {
        points.push((view.at(eye.origin), "#202020", "eye".to_owned(), false));
    }
    let mut lights: Vec<usize> = Vec::new();
    for line in lines {
        if let Some(light) = line.light
            && !lights.contains(&light)
        {
            lights.push(light);
            points.push((view.at(line.to), "#c08a00", explained.light(light), false));
        }
    }
    let mut order: Vec<_> = rays.iter().filter(|ray| !ray.surfaces.is_empty()).collect();
    order.sort_by(|a, b| b.size().total_cmp(&a.size()));
    for ray in order.into_iter().take(MOST_POINTS) {
        for surface in &ray.surfaces {
            points.push((
                view.at(surface.point),
                colour(Kind::Ray(ray.kind)),
                name(&surface.shape),
                true,
            ));
        }
    }
    points.retain(|([x, y], ..)| x.is_finite() && y.is_finite());
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for ([x, y], fill, ..) in &points {
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{fill}\"/>");
        taken.push([x - 3.5, y - 3.5, x + 3.5, y + 3.5]);
    }
    for ([x, y], _, words, is_met) in &points {
        // Most rays go up from what they meet, and down from the eye and lights.
        let foot = if *is_met { y + 5.0 + LINE } else { y - 8.0 };
        let half = 0.5 * LETTER * words.chars().count() as f64;
        let room = [x - half, foot - LINE, x + half, foot];
        let overlaps = |other: &[f64; 4]| {
            room[0] < other[2] && other[0] < room[2] && room[1] < other[3] && other[1] < room[3]
        };
        if taken.iter().any(overlaps) {
            continue;
        }
        taken.push(room);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{foot:.1}\" text-anchor=\"middle\" stroke=\"#ffffff\" \
             stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
            escaped(words)
        );
    }
}

fn legend(svg: &mut String) {
    for (i, kind) in Kind::ALL.into_iter().enumerate() {
        let x = 20.0 + 150.0 * i as f64;
        let y = HEIGHT - 20.0;
        let dash = if kind == Kind::Shadow { " stroke-dasharray=\"4 4\"" } else { "" };
        let words = if kind == Kind::Shadow { "to a light" } else { kind.name() };
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" y1=\"{y}\" x2=\"{}\" y2=\"{y}\" stroke=\"{}\" stroke-width=\"2\"{dash}/>\n\
             <text x=\"{}\" y=\"{}\">{words}</text>",
            x + 30.0,
            colour(kind),
            x + 38.0,
            y + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" fill=\"#606060\">the wider, the larger its share of the pixel</text>",
        20.0 + 150.0 * Kind::ALL.len() as f64,
        HEIGHT - 16.0
    );
}

/// Text as XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Place, b: Place) -> Place {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction of length 1; none where there is no direction.
fn unit(v: Place) -> Option<Place> {
    let most = v.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let scaled = v.map(|c| c / most);
    let length = dot(scaled, scaled).sqrt();
    (length.is_finite() && length > 0.0).then(|| scaled.map(|c| c / length))
}

/// From where the rays are seen: against the direction in which they spread least, with z upward as
/// far as that goes, and from the side from which z is.
struct View {
    /// Of length 1, away from who looks.
    along: Place,
    right: Place,
    up: Place,
    /// What is in the middle.
    centre: At,
    scale: f64,
}

impl View {
    fn new(lines: &[Line]) -> Self {
        let ends: Vec<Place> = lines.iter().flat_map(|line| [line.from, line.to]).collect();
        let mut along = thinnest(&ends);
        // From above rather than from below; of level views the one towards y or x.
        let down = [-along[2], along[1], along[0]];
        if down.into_iter().find(|c| c.abs() > 1e-9).is_some_and(|c| c < 0.0) {
            along = along.map(|c| -c);
        }
        let upward = if along[2].abs() > 0.999 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let right = unit(cross(along, upward)).unwrap_or([1.0, 0.0, 0.0]);
        let up = cross(right, along);

        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in &ends {
            for (i, axis) in [right, up].into_iter().enumerate() {
                let c = dot(*place, axis);
                (low[i], high[i]) = (low[i].min(c), high[i].max(c));
            }
        }
        let fits = |room: f64, i: usize| room / (high[i] - low[i]);
        let scale = fits(WIDTH - 2.0 * ASIDE, 0).min(fits(HEIGHT - ABOVE - BELOW - 40.0, 1));
        let scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        let centre = [0, 1].map(|i| low[i] / 2.0 + high[i] / 2.0);
        Self { along, right, up, centre, scale }
    }

    /// Where a place of space is in the drawing.
    fn at(&self, place: Place) -> At {
        let middle = (ABOVE + HEIGHT - BELOW) / 2.0;
        let x = dot(place, self.right) - self.centre[0];
        let y = dot(place, self.up) - self.centre[1];
        [WIDTH / 2.0 + x * self.scale, middle - y * self.scale]
    }

    fn words(&self) -> String {
        let along = self.along;
        if along[2] < -0.999 {
            return "seen from above".to_owned();
        }
        let [x, y, z] = along.map(|c| short((c * 100.0).round() / 100.0));
        format!("seen along ({x}, {y}, {z})")
    }
}

/// The direction in which places spread least: of the smallest eigenvalue of their covariance, by
/// power iteration on what is left of its trace.
fn thinnest(places: &[Place]) -> Place {
    let count = places.len().max(1) as f64;
    let most = places.iter().flatten().fold(0.0_f64, |most, c| most.max(c.abs()));
    let scaled = |place: &Place| place.map(|c| if most > 0.0 { c / most } else { 0.0 });
    let mut mean = [0.0; 3];
    for place in places {
        let place = scaled(place);
        (0..3).for_each(|i| mean[i] += place[i] / count);
    }
    let mut spread = [[0.0; 3]; 3];
    for place in places {
        let place = scaled(place);
        let off = [0, 1, 2].map(|i| place[i] - mean[i]);
        for i in 0..3 {
            for j in 0..3 {
                spread[i][j] += off[i] * off[j] / count;
            }
        }
    }
    let trace = spread[0][0] + spread[1][1] + spread[2][2];
    for (i, row) in spread.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value = if i == j { trace } else { 0.0 } - *value;
        }
    }
    // No axis of symmetry that scenes are likely to have; rather level than not.
    let mut along = [0.36, 0.9, -0.24];
    for _ in 0..500 {
        let next = spread.map(|row| dot(row, along));
        let Some(next) = unit(next) else { break };
        along = next;
    }
    unit(along).unwrap_or([0.0, 1.0, 0.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fan_of_rays_is_seen_square_on() {
        let line =
            |to| Line { kind: Kind::Shadow, from: [1.0, 5.0, 0.0], to, size: 1.0, light: None };
        let view = View::new(&[line([1.0, 9.0, 3.0]), line([1.0, 2.0, 7.0])]);
        assert!(view.along[0].abs() > 1.0 - 1e-9 && view.up[2] > 1.0 - 1e-9, "{:?}", view.along);
        let flat = View::new(&[line([9.0, 5.0, 0.0]), line([4.0, 2.0, 0.0])]);
        assert_eq!(flat.words(), "seen from above");
        assert!(flat.right[0] > 1.0 - 1e-9);
        // All of it has a place in the drawing.
        for place in [[1.0, 5.0, 0.0], [1.0, 9.0, 3.0], [1.0, 2.0, 7.0]] {
            let [x, y] = view.at(place);
            assert!(x > 0.0 && x < WIDTH && y > ABOVE && y < HEIGHT - BELOW, "{x} {y}");
        }
    }

    #[test]
    fn what_has_no_extent_is_somewhere() {
        for lines in [
            vec![],
            vec![Line { kind: Kind::Shadow, from: [3.0; 3], to: [3.0; 3], size: 1.0, light: None }],
        ] {
            let view = View::new(&lines);
            assert!(view.scale > 0.0 && view.along.iter().all(|c| c.is_finite()));
        }
    }
}
