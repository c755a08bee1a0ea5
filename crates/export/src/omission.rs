use std::fmt;

/// What a language cannot say, or only nearly.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omission {
    /// Where it is in the scene, as "shape 3, a sphere"; the first place of several.
    pub place: String,
    /// In how many other places it is too.
    pub more: usize,
    /// What is left out, and what is there instead.
    pub what: String,
    /// What to do about it; empty where nothing can be done.
    pub remedy: String,
}

impl fmt::Display for Omission {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.place)?;
        if self.more > 0 {
            write!(f, " (and {} more)", self.more)?;
        }
        write!(f, ": {}", self.what)?;
        if self.remedy.is_empty() { Ok(()) } else { write!(f, ": {}", self.remedy) }
    }
}

/// Those of a scene, each kind once.
#[derive(Debug, Default)]
pub(crate) struct Omissions {
    list: Vec<Omission>,
}

impl Omissions {
    pub(crate) fn add(&mut self, place: &str, what: &str, remedy: &str) {
        let same = self.list.iter_mut().find(|known| known.what == what && known.remedy == remedy);
        match same {
            Some(known) => known.more += 1,
            None => self.list.push(Omission {
                place: place.to_owned(),
                more: 0,
                what: what.to_owned(),
                remedy: remedy.to_owned(),
            }),
        }
    }

    pub(crate) fn finish(self) -> Vec<Omission> {
        self.list
    }
}
