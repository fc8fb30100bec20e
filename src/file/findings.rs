//! Problems gathered on the way.

use crate::file::locate::Step;
use crate::file::problem::ProblemKind;

/// A problem and the path of the item it concerns.
pub type Finding = (Vec<Step>, ProblemKind);

/// Most problems that are told; a file of a few megabytes can hold a hundred thousand, and each is looked up and drawn.
pub const TOLD: usize = 100;

/// Problems found so far, with where they stand: the first of them, and how many more there are.
#[derive(Default)]
pub(crate) struct Findings {
    told: Vec<Finding>,
    more: usize,
}

impl Findings {
    pub(crate) fn add(&mut self, path: &[Step], kind: ProblemKind) {
        if self.told.len() < TOLD {
            self.told.push((path.to_vec(), kind));
        } else {
            self.more += 1;
        }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.told.len() + self.more
    }

    /// Those that are told.
    pub(crate) fn told(mut self) -> Vec<Finding> {
        if self.more > 0 {
            let count = self.more;
            self.told.push((Vec::new(), ProblemKind::More { count }));
        }
        self.told
    }

    /// What was made of the file, if nothing is wrong with it.
    pub(crate) fn unless<T>(self, made: T) -> Result<T, Vec<Finding>> {
        if self.count() == 0 {
            Ok(made)
        } else {
            Err(self.told())
        }
    }
}
