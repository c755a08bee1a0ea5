//! A build of little, to measure what the rest costs those who do not use it.

/// Whether this is the build for opaque spheres and planes, which are few, under lamps without a
/// radius, seen through a pinhole by the engine `whitted`: the others are compiled out, and asking
/// for them panics. It is made with `RUSTFLAGS="--cfg lancer_lean"`, by `cargo xtask lean` and for
/// nothing else.
pub const LEAN: bool = cfg!(lancer_lean);

/// Says that what follows is not in a lean build.
///
/// # Panics
/// In a lean build.
#[inline(always)]
pub const fn not_lean() {
    if LEAN {
        panic!("a lean build is for opaque spheres and planes under lamps alone");
    }
}
