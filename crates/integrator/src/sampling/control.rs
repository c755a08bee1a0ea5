//! When the sequence of samples ends.

use std::fmt;
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A place in the sequence of samples of a picture: so many pieces of work of that round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StopAt {
    /// The round, from 0.
    pub round: u32,
    /// How many pieces of its work are done.
    pub pieces: u32,
}

impl fmt::Display for StopAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.round, self.pieces)
    }
}

impl FromStr for StopAt {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |text: &str| {
            text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse().ok()).flatten()
        };
        text.split_once(':')
            .and_then(|(round, pieces)| {
                Some(Self { round: number(round)?, pieces: number(pieces)? })
            })
            .ok_or("expected a round and a number of pieces, such as 3:120")
    }
}

/// Why there were no more samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Why {
    /// Each pixel has as many as were asked for.
    Samples,
    /// The predicted error is what was asked for.
    Error,
    /// Time was up.
    Time,
    /// It was the place at which to stop.
    StopAt,
    /// It was interrupted.
    Interrupted,
    /// Pixels have as many as they may have.
    MostSamples,
}

impl Why {
    /// A word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Samples => "samples",
            Self::Error => "error",
            Self::Time => "time",
            Self::StopAt => "stop-at",
            Self::Interrupted => "interrupted",
            Self::MostSamples => "most-samples",
        }
    }
}

/// Gives out work in order, until it is time to stop. What has been given out is always done,
/// so that what is done is a beginning of the sequence.
pub(super) struct Control<'a> {
    pub(super) deadline: Option<Instant>,
    pub(super) cancel: Option<&'a AtomicBool>,
    pub(super) stop_at: Option<StopAt>,
    /// The place so far.
    at: Mutex<(StopAt, Option<Why>)>,
}

impl<'a> Control<'a> {
    pub(super) fn new(
        deadline: Option<Instant>,
        cancel: Option<&'a AtomicBool>,
        stop_at: Option<StopAt>,
    ) -> Self {
        let at = Mutex::new((StopAt { round: 0, pieces: 0 }, None));
        Self { deadline, cancel, stop_at, at }
    }

    /// Where it is, and why it has stopped.
    pub(super) fn state(&self) -> (StopAt, Option<Why>) {
        *self.at.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Why it should stop before the next piece.
    fn reason(&self, at: StopAt) -> Option<Why> {
        if self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
            return Some(Why::Interrupted);
        }
        if self.stop_at.is_some_and(|end| at >= end) {
            return Some(Why::StopAt);
        }
        self.deadline.is_some_and(|end| Instant::now() >= end).then_some(Why::Time)
    }

    /// Has `work` done to all pieces of the next round, on all threads of the pool, and
    /// gives what comes of it by thread. Afterwards it may have stopped.
    pub(super) fn round<P: Send, R: Send>(
        &self,
        pieces: impl Iterator<Item = P> + Send,
        work: impl Fn(&mut R, P) + Sync,
        begin: impl Fn() -> R + Sync,
    ) -> Vec<R> {
        let pieces = Mutex::new(pieces);
        let results = rayon::broadcast(|_| {
            let mut result = begin();
            while let Some(piece) = self.next(&pieces) {
                work(&mut result, piece);
            }
            result
        });
        let mut at = self.at.lock().unwrap_or_else(PoisonError::into_inner);
        if at.1.is_none() {
            at.0 = StopAt { round: at.0.round + 1, pieces: 0 };
        }
        drop(at);
        results
    }

    fn next<P>(&self, pieces: &Mutex<impl Iterator<Item = P>>) -> Option<P> {
        let mut pieces = pieces.lock().unwrap_or_else(PoisonError::into_inner);
        let mut at = self.at.lock().unwrap_or_else(PoisonError::into_inner);
        if at.1.is_some() {
            return None;
        }
        // Asked only where there is more, so that the end of a round is none.
        let piece = pieces.next()?;
        at.1 = self.reason(at.0);
        if at.1.is_some() {
            return None;
        }
        at.0.pieces += 1;
        Some(piece)
    }
}
