use std::ops::AddAssign;

/// How many rays of each kind an engine has followed, and what went wrong on
/// their way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RayCounts {
    /// Rays from the eye.
    pub primary: u64,
    /// Rays that left a mirror.
    pub reflected: u64,
    /// Rays that went through a transparent surface, bent or not.
    pub transmitted: u64,
    /// Rays towards a light, to see whether it is hidden.
    pub shadow: u64,
    /// What went wrong.
    pub troubles: Troubles,
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.reflected += other.reflected;
        self.transmitted += other.transmitted;
        self.shadow += other.shadow;
        self.troubles += other.troubles;
    }
}

impl RayCounts {
    /// Rays of all kinds.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.primary + self.reflected + self.transmitted + self.shadow
    }
}

/// What makes a picture wrong in places.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Troubles {
    /// Rays that left a medium in which they were not, or entered one in which
    /// they were: the transparent shapes do not enclose what they should.
    pub media: Trouble,
    /// Pixels with rays that were not followed any more, though together they
    /// mattered, because so many surfaces, or rays of the pixel, came before.
    pub given_up: Trouble,
    /// Pixels whose colour was not a finite number; they are black.
    pub not_finite: Trouble,
}

impl AddAssign for Troubles {
    fn add_assign(&mut self, other: Self) {
        self.media += other.media;
        self.given_up += other.given_up;
        self.not_finite += other.not_finite;
    }
}

/// How often something went wrong, and where first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Trouble {
    /// How often.
    pub count: u64,
    /// Column and row of the first pixel, row by row from the top, with it.
    pub first: Option<(u32, u32)>,
}

impl Trouble {
    /// It went wrong in the pixel at that column and row.
    pub fn at(&mut self, (x, y): (u32, u32)) {
        *self += Self { count: 1, first: Some((x, y)) };
    }
}

impl AddAssign for Trouble {
    fn add_assign(&mut self, other: Self) {
        self.count += other.count;
        // The first by row, then by column, whatever the order of the tiles.
        let both = self.first.into_iter().chain(other.first);
        self.first = both.min_by_key(|&(x, y)| (y, x));
    }
}
