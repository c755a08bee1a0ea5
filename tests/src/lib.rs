//! What the tests of the whole program share: golden pictures and an
//! independent transcription of the original's engines.
#![forbid(unsafe_code)]

pub mod generated;
pub mod golden;
pub mod html;
pub mod moved;
pub mod paths;
pub mod plain;
pub mod random;
pub mod room;
pub mod soak;
