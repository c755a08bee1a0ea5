//! The rays of a pixel in words.

use super::{Explained, Shown};
use crate::report::count;
use lancer_integrator::{
    InMedium, LightAnswer, LightFate, MetSurface, NamedShape, RayFate, TracedRay,
};
use std::fmt::Write;

/// Nobody reads more rays at once.
pub(super) const MOST_LINES: usize = 200;

/// Deeper rays are not further to the right.
const DEEPEST_INDENT: u32 = 20;

/// The pixel, and a line for each ray below the one that it leaves from, those first that matter
/// more; of more rays than `most` only those with the largest shares.
pub(super) fn text(explained: &Explained, most: usize) -> String {
    let tree = &explained.tree;
    let mut text = format!("{}: ", explained.title());
    let radiance = tree.radiance.map(f64::from);
    // Writing to a string does not fail.
    let _ = write!(text, "radiance {}", triple(radiance));
    if tree.sum().iter().any(|sum| !(*sum as f32).is_finite()) {
        text.push_str(", since what is seen there is no finite number");
    }
    if let Some(Shown { stops, codes: [r, g, b] }) = explained.shown {
        let _ = write!(text, ", shown as rgb({r}, {g}, {b}) at an exposure of {stops} stops");
    }
    text.push('\n');
    let is_chosen = chosen(&tree.rays, most);
    // Trees may be deep: the rays that are still to be told are on a stack of our own.
    let mut open: Vec<usize> = (0..tree.rays.len().min(1)).collect();
    while let Some(place) = open.pop() {
        let ray = &tree.rays[place];
        line(&mut text, explained, ray);
        let mut children: Vec<_> =
            ray.children.iter().copied().filter(|child| is_chosen[*child]).collect();
        // The last one on the stack comes first.
        children
            .sort_by(|a, b| tree.rays[*a].size().total_cmp(&tree.rays[*b].size()).then(b.cmp(a)));
        open.append(&mut children);
    }
    let others = || tree.rays.iter().zip(&is_chosen).filter(|(_, is_chosen)| !**is_chosen);
    if others().next().is_some() {
        let mut sum = [0.0; 3];
        for (ray, _) in others() {
            let part = ray.contribution();
            (0..3).for_each(|i| sum[i] += part[i]);
        }
        let _ = writeln!(
            text,
            "and {} with smaller shares, which together add {}: --all shows them",
            count(others().count(), "more ray"),
            triple(sum)
        );
    }
    text
}

/// Which rays are among those with the largest shares. What leaves from a ray has no larger one, so
/// those that lead to a chosen one are chosen too.
fn chosen(rays: &[TracedRay], most: usize) -> Vec<bool> {
    let mut order: Vec<usize> = (0..rays.len()).collect();
    order.sort_by(|a, b| rays[*b].size().total_cmp(&rays[*a].size()).then(a.cmp(b)));
    let mut chosen = vec![false; rays.len()];
    order.iter().take(most).for_each(|place| chosen[*place] = true);
    chosen
}

fn line(text: &mut String, explained: &Explained, ray: &TracedRay) {
    for _ in 0..ray.depth.min(DEEPEST_INDENT) {
        text.push_str("  ");
    }
    if ray.depth > DEEPEST_INDENT {
        let _ = write!(text, "(after {} surfaces) ", ray.depth);
    }
    let _ = write!(text, "{}, {} of the pixel", ray.kind.name(), percent(ray.share));
    inside(text, &ray.medium);
    if ray.left != ray.share {
        let _ = write!(text, ", {} at its end", percent(ray.left));
    }
    text.push_str(": ");
    match ray.fate {
        RayFate::Followed => sight(text, explained, ray),
        RayFate::CutOff => text.push_str("not followed, it matters too little"),
        RayFate::GivenUp => text.push_str("given up, although it matters"),
        RayFate::NotFinite => text.push_str("its share is no finite number"),
    }
    text.push('\n');
}

fn inside(text: &mut String, medium: &InMedium) {
    if let Some(shape) = &medium.shape {
        let _ = write!(text, ", in {} (ior {})", name(shape), short(medium.ior));
    }
}

/// What a ray sees.
fn sight(text: &mut String, explained: &Explained, ray: &TracedRay) {
    if let Some(added) = ray.background {
        let _ = write!(text, "sees the background, which adds {}", triple(added));
    }
    let Some((distance, end)) = ray.distance.zip(ray.end()) else { return };
    let Some(first) = ray.surfaces.first() else {
        let _ = write!(text, "goes on past {}, {} away", triple(end), short(distance));
        return;
    };
    let (place, away) = (triple(first.point), short(distance));
    let _ = write!(text, "meets {} at {place}, {away} away", described(first));
    surface(text, explained, first);
    for other in &ray.surfaces[1..] {
        let _ = write!(text, "; with it {}", described(other));
        surface(text, explained, other);
    }
}

fn described(met: &MetSurface) -> String {
    let mut words = name(&met.shape);
    if let Some([column, row]) = met.cell {
        let _ = write!(words, " (cell {column:.0},{row:.0})");
    }
    if met.from_behind {
        words.push_str(" from behind");
    }
    words
}

fn surface(text: &mut String, explained: &Explained, met: &MetSurface) {
    if met.glow != [0.0; 3] {
        let _ = write!(text, "; its glow adds {}", triple(met.glow));
    }
    for (index, answer) in met.lights.iter().enumerate() {
        text.push_str(if index == 0 { "; " } else { ", " });
        light(text, explained, answer);
    }
}

fn light(text: &mut String, explained: &Explained, answer: &LightAnswer) {
    let light = explained.light(answer.light);
    let _ = match &answer.fate {
        LightFate::Arrives([1.0, 1.0, 1.0]) => {
            write!(text, "{light} adds {}", triple(answer.contribution))
        }
        LightFate::Arrives(left) => {
            let added = triple(answer.contribution);
            write!(text, "{light} adds {added}, {} of its light arrives", percent(*left))
        }
        LightFate::Hidden(shape) => write!(text, "{light} is hidden by {}", name(shape)),
        LightFate::Absorbed => write!(text, "{light} is absorbed on its way"),
        LightFate::Behind => write!(text, "{light} is behind the surface"),
        LightFate::Elsewhere => write!(text, "{light} does not shine this way"),
    };
}

/// A shape's kind and number; which one it is where it is shown several times.
pub(super) fn name(shape: &NamedShape) -> String {
    let NamedShape { number, item, kind } = shape;
    if number == item { format!("{kind} {number}") } else { format!("{kind} {number} #{item}") }
}

/// A number with three digits.
pub(super) fn short(value: f64) -> String {
    // Also a negative zero.
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.2e}");
    let exponent = scientific.split_once('e').and_then(|(_, power)| power.parse::<i32>().ok());
    let text = match exponent {
        Some(power @ -4..=5) => format!("{value:.*}", (2 - power).max(0) as usize),
        _ => return scientific,
    };
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

pub(super) fn triple(values: [f64; 3]) -> String {
    format!("({})", values.map(short).join(", "))
}

/// Shares in percent: one number where all three are alike.
fn percent(shares: [f64; 3]) -> String {
    let [red, green, blue] = shares.map(|share| short(100.0 * share));
    if red == green && green == blue {
        format!("{red} %")
    } else {
        format!("({red}, {green}, {blue}) %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_few_digits() {
        for (value, expected) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.123_45, "0.123"),
            (-9.999, "-10"),
            (30.0, "30"),
            (1234.5, "1234"),
            (0.000_5, "0.0005"),
            (1.234e-7, "1.23e-7"),
            (1e300, "1.00e300"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(value), expected);
        }
        assert_eq!(percent([0.3; 3]), "30 %");
        assert_eq!(percent([0.3, 0.2, 0.001]), "(30, 20, 0.1) %");
    }
}
