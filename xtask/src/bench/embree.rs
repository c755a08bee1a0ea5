//! Embree, where its Python package is installed: the same triangles and rays
//! through files of little-endian numbers.

use super::python::Script;
use crate::{Failure, fail};
use lancer_math::Ray;
use lancer_scene::Mesh;
use std::fs;
use tempfile::TempDir;

pub(super) struct Embree {
    script: Script,
    folder: TempDir,
}

/// What Embree found: how far, and which triangle.
pub(super) type Found = Option<(f32, u32)>;

impl Embree {
    /// Starts it, or tells what is missing.
    pub(super) fn start() -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        let script = Script::start("embree_rays.py", folder.path(), "pip install embreex numpy")?;
        Ok(Self { script, folder })
    }

    /// Builds for a mesh; how long it took on all threads, in seconds.
    pub(super) fn mesh(&mut self, mesh: &Mesh) -> Result<f64, Failure> {
        let corners = (0..mesh.triangle_count()).flat_map(|triangle| mesh.corners(triangle));
        let numbers = corners.flat_map(|corner| [corner.x, corner.y, corner.z]);
        self.write("mesh", numbers)?;
        self.script.seconds("mesh")
    }

    /// Gives it rays under a name.
    pub(super) fn rays(&mut self, name: &str, rays: &[Ray]) -> Result<(), Failure> {
        let numbers = rays.iter().flat_map(|ray| {
            let Ray { origin, direction } = ray;
            [origin.x, origin.y, origin.z, direction.x, direction.y, direction.z]
        });
        self.write(name, numbers)?;
        self.script.ask(&format!("rays {name}")).map(drop)
    }

    /// How long its rays of that name take on one thread, in seconds: `mode` is
    /// fast or robust, `query` nearest or any.
    pub(super) fn seconds(&mut self, mode: &str, query: &str, name: &str) -> Result<f64, Failure> {
        self.script.seconds(&format!("time {mode} {query} {name}"))
    }

    /// The nearest hits of its rays of that name.
    pub(super) fn hits(&mut self, mode: &str, name: &str) -> Result<Vec<Found>, Failure> {
        self.script.ask(&format!("hits {mode} {name}"))?;
        let read = |what: &str| {
            let bytes =
                fs::read(self.folder.path().join(format!("{name}.{what}"))).map_err(fail)?;
            let words = bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
            Ok(words.collect::<Vec<_>>())
        };
        let (distances, triangles) = (read("t.f32")?, read("id.i32")?);
        let hits = distances.into_iter().zip(triangles).map(|(t, id)| {
            let id = u32::try_from(i32::from_le_bytes(id)).ok()?;
            Some((f32::from_le_bytes(t), id))
        });
        Ok(hits.collect())
    }

    fn write(&self, name: &str, numbers: impl Iterator<Item = f64>) -> Result<(), Failure> {
        let bytes: Vec<u8> = numbers.flat_map(|x| (x as f32).to_le_bytes()).collect();
        fs::write(self.folder.path().join(format!("{name}.f32")), bytes).map_err(fail)
    }
}
