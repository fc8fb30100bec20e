//! Files of certificates: whatever is done to one, no wrong rank is accepted.

use super::readers::certificates::{NAMES, WORDS, look_at, seeds};
use super::{edits, runs, spoilt};
use crate::common::*;

/// The file of each mechanism.
static FILES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(seeds);

proptest! {
    #![proptest_config(runs(512))]
    #[test]
    fn spoilt_certificates(which in any::<Index>(), edits in edits(&WORDS)) {
        let which = which.index(NAMES.len());
        look_at(which, &spoilt(&FILES[which], &edits));
    }
}
