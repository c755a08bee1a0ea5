//! The scenes that are calibrated with.

use crate::{Failure, fail};
use lancer_scene::Scene;
use lancer_tests::paths::{self, Beside};
use lancer_xml::Options;

/// Files in scenes: mirrors in mirrors, glass in water, a checker to the horizon, soft shadows and a
/// lens, meshes, edges and smooth things.
pub(super) const SCENES: &[&str] = &[
    "bench/readme-pareto.xml",
    "readme.xml",
    "first.xml",
    "facing_mirrors.xml",
    "mirror_corridor.xml",
    "water_glass.xml",
    "underwater.xml",
    "glass.xml",
    "absorption.xml",
    "checkers.xml",
    "all_shapes.xml",
    "meshes.xml",
    "instances.xml",
    "cornell.xml",
    "spots.xml",
    "orthographic.xml",
    "soft_shadow.xml",
    "depth_of_field.xml",
];

/// One of them.
pub(super) fn load(name: &str) -> Result<Scene, Failure> {
    let path = paths::scenes().join(name);
    let bytes = std::fs::read(&path).map_err(fail)?;
    let folder = path.parent().unwrap_or(&path);
    let parsed = lancer_xml::parse_with(&bytes, &Options::default(), &Beside(folder));
    parsed.into_result().map_err(fail)
}

#[cfg(test)]
mod tests {
    #[test]
    fn all_of_them_are_there() {
        for name in super::SCENES {
            super::load(name).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}
