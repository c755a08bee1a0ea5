//! Triangles as Mitsuba reads them: a binary PLY file in single precision.

use lancer_math::{Point, Vector};

/// Triangles with what their corners have.
#[derive(Debug, Clone, Default)]
pub(super) struct Triangles {
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<[u32; 3]>,
    /// Whether the normals are those of the corners.
    pub(super) is_smooth: bool,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) point: Point,
    pub(super) normal: Vector,
    /// In pairs of a checker's cells.
    pub(super) uv: [f64; 2],
}

impl Triangles {
    pub(super) fn add(&mut self, corner: Corner) -> u32 {
        self.corners.push(corner);
        self.corners.len() as u32 - 1
    }

    /// A row after row of corners, of so many each, joined by triangles.
    pub(super) fn grid(&mut self, rows: u32, columns: u32, at: impl Fn(u32, u32) -> Corner) {
        let first = self.corners.len() as u32;
        for row in 0..rows {
            for column in 0..columns {
                self.add(at(row, column));
            }
        }
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let a = first + row * columns + column;
                let (b, c, d) = (a + 1, a + columns, a + columns + 1);
                self.faces.extend([[a, b, d], [a, d, c]]);
            }
        }
    }

    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let normals = if self.is_smooth {
            "property float nx\nproperty float ny\nproperty float nz\n"
        } else {
            ""
        };
        let head = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n\
             property float y\nproperty float z\n{normals}property float u\nproperty float v\n\
             element face {}\nproperty list uchar int vertex_indices\nend_header\n",
            self.corners.len(),
            self.faces.len()
        );
        let mut bytes = head.into_bytes();
        let mut put = |number: f64| bytes.extend((number as f32).to_le_bytes());
        for Corner { point, normal, uv } in &self.corners {
            point.iter().for_each(|c| put(*c));
            if self.is_smooth {
                normal.iter().for_each(|c| put(*c));
            }
            uv.iter().for_each(|c| put(*c));
        }
        for face in &self.faces {
            bytes.push(3);
            face.iter().for_each(|index| bytes.extend(index.to_le_bytes()));
        }
        bytes
    }
}
