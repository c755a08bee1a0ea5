//! The XML of Mitsuba 3.

use crate::Attachment;
use crate::omission::{Omission, Omissions};
use lancer_scene::Scene;

pub(crate) fn head(_: &[Omission]) -> String {
    String::new()
}
pub(crate) fn write(_: &Scene, _: f64, _: &str, _: &mut Omissions) -> (String, Vec<Attachment>) {
    (String::new(), Vec::new())
}
