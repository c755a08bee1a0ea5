//! Other renderers on the same chart, each judged against its own converged picture.

use super::interrupted;
use crate::Failure;
use crate::peers::{Peer, PeerError, PeerPicture, Setting, find};
use lancer_export::{Exported, Format, export};
use lancer_film::Size;
use lancer_judge::{Picture, Point, Series};
use lancer_scene::Scene;
use std::num::NonZeroUsize;
use std::time::Duration;

/// What peers are run on.
pub(super) struct Setup<'a> {
    /// The scene, with an exposure in stops.
    pub(super) scene: &'a Scene,
    pub(super) size: Size,
    pub(super) threads: NonZeroUsize,
    /// Is told what is done next.
    pub(super) step: &'a dyn Fn(&str),
}

/// A picture may take so long, and a converged one.
const LONGEST: Duration = Duration::from_secs(120);
const LONGEST_CONVERGED: Duration = Duration::from_secs(900);

/// POV-Ray's settings, the fastest first: those that are on the front of its own.
const POV_RAY: &[Setting] = &[
    Setting::Centres,
    Setting::Antialiased { threshold: 0.3, method: 2, depth: 3 },
    Setting::Antialiased { threshold: 0.03, method: 2, depth: 4 },
    Setting::Antialiased { threshold: 0.01, method: 2, depth: 5 },
    Setting::Antialiased { threshold: 0.0, method: 1, depth: 9 },
];

/// How many samples Mitsuba takes in each pixel.
const MITSUBA: &[u32] = &[1, 4, 16, 64, 256];

/// The series of those that are installed, and what is to be said of them.
pub(super) fn series(setup: &Setup<'_>) -> Result<(Vec<Series>, Vec<String>), Failure> {
    let (mut series, mut notes) = (Vec::new(), Vec::new());
    for format in Format::ALL {
        match find(*format) {
            Err(missing) => notes.push(format!("{} is left out: {missing}.", format.program())),
            Ok(peer) => match of(&peer, setup) {
                Ok((own, note)) => {
                    series.push(own);
                    notes.push(note);
                }
                Err(PeerError::Interrupted) => return Err(interrupted()),
                Err(failed) => notes.push(format!("{} is left out: {failed}.", peer.version())),
            },
        }
    }
    Ok((series, notes))
}

fn of(peer: &Peer, setup: &Setup<'_>) -> Result<(Series, String), PeerError> {
    let exported = export(setup.scene, peer.format(), "scene");
    (setup.step)(&format!("{}, converged", peer.version()));
    let Converged { picture, error, how } = converged(peer, &exported, setup)?;
    let mut points = Vec::new();
    for setting in settings(peer.format()) {
        (setup.step)(&format!("{} {setting}", peer.version()));
        let made = peer.render(&exported, setup.size, setup.threads, setting, LONGEST);
        let made = match made {
            // Those that follow take longer still.
            Err(PeerError::TimedOut { .. }) => break,
            made => made?,
        };
        let off = judged(peer, &made)?.error(&picture).unwrap_or(f64::NAN);
        points.push(Point::new(setting.to_string(), made.seconds, off));
    }
    let mut note = format!(
        "{} is held against {how} of its own, which are off by about {}; its times are its own.",
        peer.version(),
        lancer_judge::error(error),
    );
    if let Some(most) = exported.omissions.first() {
        note += &format!(" It cannot be told everything: {most}");
        note += if exported.omissions.len() > 1 { ", and more." } else { "." };
    }
    Ok((Series::peer(peer.version(), points), note))
}

fn settings(format: Format) -> Vec<Setting> {
    match format {
        Format::PovRay => POV_RAY.to_vec(),
        Format::Mitsuba => {
            MITSUBA.iter().map(|count| Setting::Samples { count: *count, seed: 1 }).collect()
        }
    }
}

/// What a peer's pictures are held against.
struct Converged {
    picture: Picture,
    /// About how far it is from what the peer would make with endless patience.
    error: f64,
    how: String,
}

/// A converged picture has about so many samples for each pixel, along each side.
const SIDE: u32 = 16;

/// And no more samples in all, since they are held in memory.
const MOST_SAMPLES: u64 = 160_000_000;

fn converged(peer: &Peer, exported: &Exported, setup: &Setup<'_>) -> Result<Converged, PeerError> {
    let Size { width, height } = setup.size;
    match peer.format() {
        Format::PovRay => {
            let side = (1..=SIDE)
                .rev()
                .find(|side| u64::from(side * side) * setup.size.pixels() <= MOST_SAMPLES)
                .unwrap_or(1);
            let large = Size::new(side * width, side * height);
            let made =
                peer.render(exported, large, setup.threads, Setting::Centres, LONGEST_CONVERGED)?;
            let [whole, even, odd] = shrunk(&made.linear, setup.size, side);
            let [picture, even, odd] =
                [whole, even, odd].map(|pixels| picture(peer, setup.size, pixels));
            let (picture, difference) = (picture?, even?.error(&odd?));
            let error = 0.5 * difference.unwrap_or(f64::NAN);
            let how = format!("{side} x {side} samples a pixel");
            Ok(Converged { picture, error, how })
        }
        Format::Mitsuba => {
            // A draw that no point has, and another one.
            let count = 2 * SIDE * SIDE;
            let [a, b] = [101, 102].map(|seed| {
                let setting = Setting::Samples { count, seed };
                let made =
                    peer.render(exported, setup.size, setup.threads, setting, LONGEST_CONVERGED)?;
                Ok(made.linear)
            });
            let (a, b): (Vec<_>, Vec<_>) = (a?, b?);
            let pairs = a.iter().zip(&b);
            let mean = pairs
                .map(|(a, b)| std::array::from_fn(|i| 0.5 * (f64::from(a[i]) + f64::from(b[i]))));
            let whole = picture(peer, setup.size, mean.collect())?;
            let [a, b] = [a, b].map(|half| {
                picture(peer, setup.size, half.iter().map(|p| p.map(f64::from)).collect())
            });
            let error = 0.5 * a?.error(&b?).unwrap_or(f64::NAN);
            Ok(Converged { picture: whole, error, how: format!("{} samples a pixel", 2 * count) })
        }
    }
}

/// The means over squares of side x side pixels, and those of every other pixel of them, as
/// the black fields of a chessboard lie, and of the rest.
fn shrunk(large: &[[f32; 3]], size: Size, side: u32) -> [Vec<[f64; 3]>; 3] {
    let (width, side) = (size.width as usize, side as usize);
    let mut sums = [(); 2].map(|()| vec![[0.0; 3]; size.pixels() as usize]);
    for (y, row) in large.chunks_exact(width * side).enumerate() {
        for (x, value) in row.iter().enumerate() {
            let sum = &mut sums[(x + y) % 2][y / side * width + x / side];
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += f64::from(*value);
            }
        }
    }
    let [even, odd] = sums;
    let squares = (side * side) as f64;
    // Of an odd number one more is even.
    let counts = [(side * side).div_ceil(2), side * side / 2].map(|count| count.max(1) as f64);
    let whole =
        even.iter().zip(&odd).map(|(a, b)| std::array::from_fn(|i| (a[i] + b[i]) / squares));
    let whole = whole.collect();
    let mean = |sums: Vec<[f64; 3]>, count: f64| {
        sums.into_iter().map(|sum| sum.map(|value| value / count)).collect()
    };
    [whole, mean(even, counts[0]), mean(odd, counts[1])]
}

fn judged(peer: &Peer, made: &PeerPicture) -> Result<Picture, PeerError> {
    let linear = made.linear.iter().map(|pixel| pixel.map(f64::from)).collect();
    picture(peer, Size::new(made.width, made.height), linear)
}

/// Exported scenes have their exposure in their lights.
fn picture(peer: &Peer, size: Size, linear: Vec<[f64; 3]>) -> Result<Picture, PeerError> {
    Picture::new(size, linear.into_iter(), 1.0).ok_or_else(|| PeerError::Failed {
        name: peer.version().to_owned(),
        why: "its picture has another size".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_averaged() {
        // Columns 0 to 3 and 4 to 7 of a row of two pixels, with four samples a side.
        let value = |x: usize, y: usize| [x as f32, y as f32, ((x + y) % 2) as f32];
        let large: Vec<_> = (0..32).map(|i| value(i % 8, i / 8)).collect();
        let [whole, even, odd] = shrunk(&large, Size::new(2, 1), 4);
        assert_eq!(whole, [[1.5, 1.5, 0.5], [5.5, 1.5, 0.5]]);
        assert_eq!(even, [[1.5, 1.5, 0.0], [5.5, 1.5, 0.0]]);
        assert_eq!(odd, [[1.5, 1.5, 1.0], [5.5, 1.5, 1.0]]);
        let [whole, even, odd] = shrunk(&[[2.0; 3]; 9], Size::new(1, 1), 3);
        assert_eq!([whole, even, odd], [[[2.0; 3]], [[2.0; 3]], [[2.0; 3]]]);
    }

    #[test]
    fn each_peer_has_its_settings() {
        for format in Format::ALL {
            let settings = settings(*format);
            assert!(settings.len() >= 5);
            assert!(settings.iter().all(|setting| setting.format() == *format));
        }
    }
}
