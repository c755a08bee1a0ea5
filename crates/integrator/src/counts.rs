use std::ops::AddAssign;

/// How many rays of each kind an engine has followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RayCounts {
    /// Rays from the eye.
    pub primary: u64,
    /// Rays that left a mirror.
    pub reflected: u64,
    /// Rays towards a light, to see whether it is hidden.
    pub shadow: u64,
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.reflected += other.reflected;
        self.shadow += other.shadow;
    }
}

impl RayCounts {
    /// Rays of all kinds.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.primary + self.reflected + self.shadow
    }
}
