//! Crossings in arbitrary precision, which decide whether those in double-double
//! numbers are right.

use super::case::{Case, Entry};
use lancer_math::Ray;

/// Where the oracle sees the ray cross other things than these: what is wrong.
pub(crate) fn contradiction(_case: &Case, _ray: &Ray, _entries: &[Entry]) -> Option<String> {
    None
}
