//! The kernel against intersections that are written another way: in numbers
//! twice as long, from the implicit functions of the shapes, by brute force. No
//! formula is shared.

mod case;
mod cone;
mod convex;
mod dd;
mod facets;
mod figure;
mod judge;
mod mesh;
mod quartic;
mod sample;
mod sheets;
mod space;
mod subject;
mod tally;
mod torus;

pub use subject::Kind;

use case::Case;
use fastrand::Rng;
use judge::{Asked, judge};
use tally::Tally;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Chooses other scenes and rays.
    pub seed: u64,
    /// How many rays, for all kinds of shapes together.
    pub rays: u64,
}

/// Asks rays of scenes of that kind.
///
/// # Panics
/// Where something is wrong.
pub fn check(kind: Kind, cases: u64, rays: u64) {
    let mut tally = Tally::default();
    for number in 0..cases {
        let case = Case::new(kind, number);
        for ray in 0..rays {
            // Its own seed for each ray, whatever the ones before it have used.
            let mut rng = Rng::with_seed(number << 32 | ray);
            tally.at = format!("{kind:?}, case {number}, ray {ray}");
            let (ray, is_easy) = case.ray(&mut rng, ray);
            judge(&case, &Asked { ray, is_easy, left: None }, &mut rng, &mut tally);
        }
    }
    print!("{kind:?}: ");
    tally.finish();
}
