/// Where a ray goes through a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// How many directions away from the ray's origin; never NaN.
    pub(crate) t: f64,
    /// Which part of the surface: a side, a lid, a face, a triangle of a mesh;
    /// the shape that reports it knows what the number means.
    pub(crate) part: u32,
}

/// All crossings of a ray's line with a surface that no line crosses more than
/// four times, nearest first, those behind the ray's origin included.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossings {
    list: [Crossing; 4],
    count: usize,
}

impl Crossings {
    pub(crate) const NONE: Self = Self { list: [Crossing { t: 0.0, part: 0 }; 4], count: 0 };

    /// Adds one in its place. One whose `t` is not a finite number is none.
    ///
    /// # Panics
    /// Where there are four already.
    #[inline]
    pub(crate) fn add(&mut self, t: f64, part: u32) {
        if !t.is_finite() {
            return;
        }
        let mut at = self.count;
        while at > 0 && self.list[at - 1].t > t {
            self.list[at] = self.list[at - 1];
            at -= 1;
        }
        self.list[at] = Crossing { t, part };
        self.count += 1;
    }

    /// Nearest first.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Crossing> + '_ {
        self.list[..self.count].iter().copied()
    }
}
