//! The scenes that are calibrated with.

use crate::{Failure, fail};
use lancer_scene::Scene;
use lancer_tests::paths::{self, Beside};
use lancer_xml::Options;

/// Files in scenes: mirrors in mirrors, glass in water, a checker to the horizon, soft shadows and a
/// lens, meshes, edges and smooth things; and by how much their pictures are narrower than is asked
/// for, where a sample takes some fifty times as long as elsewhere.
pub(super) const SCENES: &[(&str, u32)] = &[
    ("bench/readme-pareto.xml", 1),
    ("readme.xml", 1),
    ("first.xml", 1),
    ("facing_mirrors.xml", 1),
    ("mirror_corridor.xml", 1),
    ("water_glass.xml", 6),
    ("underwater.xml", 1),
    ("glass.xml", 1),
    ("absorption.xml", 1),
    ("checkers.xml", 1),
    ("all_shapes.xml", 1),
    ("meshes.xml", 1),
    ("instances.xml", 1),
    ("cornell.xml", 1),
    ("spots.xml", 1),
    ("orthographic.xml", 1),
    ("soft_shadow.xml", 1),
    ("depth_of_field.xml", 1),
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
        for (name, _) in super::SCENES {
            super::load(name).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}
