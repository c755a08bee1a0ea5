use crate::lanes::Width;

/// How rays are followed. None of it changes a bit of what they meet: it is
/// for tests that show this, and for measuring what each part gains.
#[derive(Debug, Clone, Copy, Default)]
pub struct KernelSettings {
    /// How many lanes; the widest by default.
    pub lanes: Width,
    /// What is left out because it cannot matter.
    pub culling: Culling,
}

/// Work that is left out because it provably changes nothing. All of it is on by
/// default.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Culling {
    /// The rays of a tile, from the eye or from mirrors, are held only against what some
    /// ray of the tile may meet, and not against what is behind something else.
    pub tile_candidates: bool,
    /// Shadow rays of a batch are held only against what stands between the ball
    /// around their origins and the light, and rays that leave a ball not against it.
    pub shadow_candidates: bool,
    /// Planes that hide no light from anything are not asked.
    pub idle_planes: bool,
    /// Where a mirror takes all light, none of its own is gathered.
    pub full_mirrors: bool,
    /// The glow of a mirrored ray is found with the shadows of the point that it
    /// leaves.
    pub shared_glow: bool,
    /// Rays of large batches are sorted before they are followed.
    pub sorted_rays: bool,
    /// Where products alone show that a ray meets a sphere, or misses it, or reaches a plane
    /// too late, the quotients and roots that say where are not formed.
    pub plain_cases: bool,
}

impl Culling {
    /// Everything is done.
    pub const NONE: Self = Self {
        tile_candidates: false,
        shadow_candidates: false,
        idle_planes: false,
        full_mirrors: false,
        shared_glow: false,
        sorted_rays: false,
        plain_cases: false,
    };

    /// What cannot matter is left out.
    pub const ALL: Self = Self {
        tile_candidates: true,
        shadow_candidates: true,
        idle_planes: true,
        full_mirrors: true,
        shared_glow: true,
        sorted_rays: true,
        plain_cases: true,
    };

    /// The switches by name, each with everything on but this one.
    #[must_use]
    pub fn without_each() -> Vec<(&'static str, Self)> {
        type Switch = fn(&mut Culling) -> &mut bool;
        let switches: [(&str, Switch); 7] = [
            ("tile_candidates", |c| &mut c.tile_candidates),
            ("shadow_candidates", |c| &mut c.shadow_candidates),
            ("idle_planes", |c| &mut c.idle_planes),
            ("full_mirrors", |c| &mut c.full_mirrors),
            ("shared_glow", |c| &mut c.shared_glow),
            ("sorted_rays", |c| &mut c.sorted_rays),
            ("plain_cases", |c| &mut c.plain_cases),
        ];
        let without = |(name, switch): (&'static str, Switch)| {
            let mut culling = Self::ALL;
            *switch(&mut culling) = false;
            (name, culling)
        };
        switches.into_iter().map(without).collect()
    }
}

impl Default for Culling {
    fn default() -> Self {
        Self::ALL
    }
}
