//! The kernel against intersections that are written another way: in numbers
//! twice as long, from the implicit functions of the shapes, by brute force. No
//! formula is shared.
//!
//! A soak asks any number of random rays, of random scenes of each kind of shape.
//! All ways on which the kernel can be asked have to give the same bits, and these
//! have to be right to within stated bounds. An [`Id`] makes a ray again.

mod case;
mod class;
pub mod closed;
mod cone;
mod convex;
mod dd;
mod facets;
mod figure;
mod id;
mod judge;
mod kind;
mod leaks;
mod mesh;
mod oracle;
mod paths;
mod quartic;
mod report;
mod run;
mod sample;
mod sheets;
mod space;
mod subject;
mod tally;
mod torus;

pub use id::{Id, NotAnId};
pub use kind::Kind;
pub use leaks::{Leaks, leaks};
pub use report::{Report, band_in_ulps};
pub use run::{replay, soak};
pub use tally::Failure;
