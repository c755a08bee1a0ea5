use super::kind::Kind;
use std::fmt;
use std::str::FromStr;

/// What makes a ray again: `KIND:SEED:CASE:RAY`, and `:left` for the one that leaves
/// what it hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Id {
    pub(crate) kind: Kind,
    pub(crate) seed: u64,
    pub(crate) case: u64,
    pub(crate) ray: u64,
    pub(crate) is_left: bool,
}

impl Id {
    /// Numbers in no order that differ wherever anything of the id does.
    pub(crate) fn case_seed(&self) -> u64 {
        mix(mix(mix(self.seed) ^ self.kind as u64) ^ self.case)
    }

    pub(crate) fn ray_seed(&self) -> u64 {
        mix(self.case_seed() ^ mix(2 * self.ray + u64::from(self.is_left)))
    }
}

/// A bijection (Steele, Lea and Flood, *Fast splittable pseudorandom number
/// generators*, 2014).
pub(crate) fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, seed, case, ray, is_left } = self;
        let left = if *is_left { ":left" } else { "" };
        write!(f, "{}:{seed}:{case}:{ray}{left}", kind.name())
    }
}

/// It is not the id of a ray.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not the id of a ray, like `torus:1:20:300` or `torus:1:20:300:left`")]
pub struct NotAnId(String);

impl FromStr for Id {
    type Err = NotAnId;

    fn from_str(text: &str) -> Result<Self, NotAnId> {
        let parse = || {
            let (numbers, is_left) = match text.strip_suffix(":left") {
                Some(numbers) => (numbers, true),
                None => (text, false),
            };
            let mut parts = numbers.split(':');
            let kind = Kind::by_name(parts.next()?)?;
            let mut number = || parts.next()?.parse().ok();
            let id = Self { kind, seed: number()?, case: number()?, ray: number()?, is_left };
            parts.next().is_none().then_some(id)
        };
        parse().ok_or_else(|| NotAnId(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_read_as_they_are_written() {
        for kind in Kind::all() {
            for is_left in [false, true] {
                let id = Id { kind, seed: 3, case: 0, ray: 12, is_left };
                assert_eq!(id.to_string().parse(), Ok(id));
            }
        }
        for text in ["", "torus", "torus:1:2", "ball:1:2:3", "torus:1:2:3:4", "torus:1:2:x"] {
            assert!(text.parse::<Id>().is_err(), "{text}");
        }
    }
}
