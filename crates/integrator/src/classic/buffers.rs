//! What travels through the stages: a number, or a vector, of each ray side by
//! side with those of the others.

use super::bundle::{Around, Cone};
use super::tile::MOST_MIRRORS;
use super::world::Candidates;
use crate::rows::{BATCH, Row, Triples, ZEROS};
use lancer_kernel::lanes::MOST;
use std::ops::Range;

/// Rays that are to be followed.
pub(super) struct Rays {
    pub(super) count: usize,
    pub(super) origins: Triples,
    pub(super) directions: Triples,
    /// 255 times how brightly lights glow along them.
    pub(super) glow: Row,
    /// Their shares of the pixel.
    pub(super) share: Row,
    /// The places of the surfaces that they leave in the level above; of rays from
    /// the eye those of the pixels in the tile.
    pub(super) parent: Row,
    pub(super) bundles: Vec<Bundle>,
}

/// Rays that have something in common.
pub(super) struct Bundle {
    pub(super) range: Range<usize>,
    /// They begin in this ball.
    pub(super) around: Around,
    /// They go along this cone, where that is known.
    pub(super) cone: Option<Cone>,
}

/// Points whose light is gathered together.
pub(super) struct Group {
    /// The shapes that they are of, by place in the list of parts.
    pub(super) parts: Range<usize>,
    pub(super) around: Around,
}

/// What they meet, sorted by shape.
pub(super) struct Met {
    pub(super) distance: Row,
    pub(super) index: Row,
    /// Shapes, none where nothing is met, and the ranges of their points.
    pub(super) parts: Vec<(Option<usize>, Range<usize>)>,
    pub(super) groups: Vec<Group>,
    pub(super) points: Triples,
    pub(super) directions: Triples,
    pub(super) normals: Triples,
    pub(super) mirrored: Triples,
    pub(super) glow: Row,
    pub(super) share: Row,
    /// 1 where the second colour shows, where there is a mirror, and where its own
    /// colour matters; else 0.
    pub(super) second: Row,
    pub(super) mirrors: Row,
    pub(super) wants: Row,
    /// The light that surfaces get, and that along the mirrored rays.
    pub(super) lit: Row,
    pub(super) gleam: Row,
}

/// The colours of some surfaces, and what the mirrors among them need.
pub(super) struct Level {
    pub(super) count: usize,
    pub(super) colour: [[f32; BATCH + MOST]; 3],
    pub(super) gloss: [f32; BATCH + MOST],
    pub(super) parent: Row,
}

/// All that a tile needs, used again for the next one.
pub(super) struct Buffers {
    pub(super) rays: Rays,
    pub(super) met: Met,
    pub(super) levels: [Level; MOST_MIRRORS + 1],
    pub(super) candidates: Candidates,
    /// Spheres that may hide lights, and for each light the end of its list.
    pub(super) suspects: Vec<u32>,
    pub(super) ends: Vec<usize>,
    /// 0, 1, 2 and so on.
    pub(super) numbers: Row,
}

impl Buffers {
    pub(super) fn new() -> Box<Self> {
        const LEVEL: Level = Level {
            count: 0,
            colour: [[0.0; BATCH + MOST]; 3],
            gloss: [0.0; BATCH + MOST],
            parent: ZEROS,
        };
        Box::new(Self {
            rays: Rays {
                count: 0,
                origins: Triples::ZEROS,
                directions: Triples::ZEROS,
                glow: ZEROS,
                share: ZEROS,
                parent: ZEROS,
                bundles: Vec::new(),
            },
            met: Met {
                distance: ZEROS,
                index: ZEROS,
                parts: Vec::new(),
                groups: Vec::new(),
                points: Triples::ZEROS,
                directions: Triples::ZEROS,
                normals: Triples::ZEROS,
                mirrored: Triples::ZEROS,
                glow: ZEROS,
                share: ZEROS,
                second: ZEROS,
                mirrors: ZEROS,
                wants: ZEROS,
                lit: ZEROS,
                gleam: ZEROS,
            },
            levels: [LEVEL; MOST_MIRRORS + 1],
            candidates: Candidates::default(),
            suspects: Vec::new(),
            ends: Vec::new(),
            numbers: std::array::from_fn(|k| k as f64),
        })
    }
}
