use lancer_kernel::Prepared;
use lancer_scene::Medium;

/// The transparent solids that a point is in.
#[derive(Debug, Clone, Default)]
pub(super) struct Media {
    inside: Vec<u32>,
}

impl Media {
    pub(super) const fn is_empty(&self) -> bool {
        self.inside.is_empty()
    }

    pub(super) const fn new(inside: Vec<u32>) -> Self {
        Self { inside }
    }

    /// The solid whose medium is there: of all the one that outranks the others;
    /// `None` in the air.
    pub(super) fn top(&self, prepared: &Prepared) -> Option<u32> {
        self.inside.iter().copied().max_by(|&a, &b| prepared.rank(a, b))
    }

    pub(super) fn has(&self, item: u32) -> bool {
        self.inside.contains(&item)
    }

    /// Goes into a solid, or out of it. False where that makes no sense: it was
    /// in already, or never. Afterwards it is where the crossing says.
    pub(super) fn cross(&mut self, item: u32, entering: bool) -> bool {
        match (entering, self.inside.iter().position(|&other| other == item)) {
            (true, None) => self.inside.push(item),
            (false, Some(at)) => drop(self.inside.remove(at)),
            _ => return false,
        }
        true
    }
}

/// The medium of a solid, or the air.
pub(super) fn medium(solid: Option<u32>, prepared: &Prepared) -> Medium {
    solid.map_or(Medium::AIR, |item| prepared.surface(item).medium)
}

/// What a medium leaves of red, green and blue light after a length (Beer and
/// Lambert); nothing of what it takes away after an infinite one.
pub(super) fn transmittance(medium: &Medium, length: f64) -> [f64; 3] {
    let absorption = medium.absorption.get();
    if absorption == [0.0; 3] {
        return [1.0; 3];
    }
    absorption.map(
        |sigma| {
            if sigma == 0.0 { 1.0 } else { lancer_math::elementary::exp(-sigma * length) }
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_scene::{Camera, Scene, Shape, Surface};

    fn balls(surfaces: [Surface; 3]) -> Prepared {
        let camera = Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]);
        let mut builder = Scene::builder().camera(camera);
        for (surface, radius) in surfaces.into_iter().zip([3.0, 1.0, 2.0]) {
            builder = builder.shape(Shape::sphere([0.0; 3], radius, surface));
        }
        Prepared::new(&builder.build().expect("valid"))
    }

    #[test]
    fn the_smaller_solid_outranks_the_larger_and_priority_both() {
        let glass = Surface::glass(1.5).expect("in range");
        let all = Media::new(vec![0, 1, 2]);
        assert_eq!(all.top(&balls([glass, glass, glass])), Some(1));
        assert_eq!(all.top(&balls([glass, glass, glass.priority(1)])), Some(2));
        assert_eq!(all.top(&balls([glass.priority(2), glass, glass.priority(1)])), Some(0));
        assert_eq!(all.top(&balls([glass, glass.priority(-1), glass])), Some(2));
        assert_eq!(Media::default().top(&balls([glass; 3])), None);
    }

    #[test]
    fn nonsense_is_noticed() {
        let mut media = Media::default();
        assert!(media.cross(7, true));
        assert!(!media.cross(7, true));
        assert!(media.has(7));
        assert!(media.cross(7, false));
        assert!(!media.cross(7, false));
        assert!(!media.has(7));
    }

    #[test]
    fn d7_a_medium_takes_away_by_the_length() {
        let glass = Surface::glass(1.5).and_then(|glass| glass.absorption([0.0, 0.5, 2.0]));
        let medium = glass.expect("in range").medium;
        let [red, green, blue] = transmittance(&medium, 3.0);
        assert_eq!(red, 1.0);
        assert!((green - libm::exp(-1.5)).abs() < 1e-16);
        assert!((blue - libm::exp(-6.0)).abs() < 1e-17);
        assert_eq!(transmittance(&medium, f64::INFINITY), [1.0, 0.0, 0.0]);
        // Along chords 2 r cos t of a ball: exp(-sigma 2 r cos t) to 1e-14.
        for k in 0..100 {
            let chord = 2.0 * f64::from(k) / 100.0;
            let [_, green, blue] = transmittance(&medium, chord);
            assert!((green - libm::exp(-0.5 * chord)).abs() < 1e-14, "{chord}");
            assert!((blue - libm::exp(-2.0 * chord)).abs() < 1e-14, "{chord}");
        }
        // Two halves of the way leave the product.
        let halves = transmittance(&medium, 1.5).map(|t| t * t);
        assert!((halves[2] - blue).abs() < 1e-17);
    }
}
