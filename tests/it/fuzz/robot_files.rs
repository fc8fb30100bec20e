//! Robot descriptions (URDF, MJCF, SDF) and the loops beside them.

use super::readers::robot_files::{FILES, WORDS, read};
use super::{edits, runs, spoilt};
use crate::common::*;

proptest! {
    #![proptest_config(runs(512))]
    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read("x.urdf", &bytes, None, 0);
        read("c.urdf", FILES[2].1.as_bytes(), Some(("s.yaml", &bytes)), 2);
    }

    #[test]
    fn spoilt_descriptions(which in any::<Index>(), edits in edits(&WORDS), bits in 0u8..8) {
        let (name, text, side) = FILES[which.index(FILES.len())];
        read(name, &spoilt(text, &edits), side.map(|(n, t)| (n, t.as_bytes())), bits);
    }

    #[test]
    fn spoilt_loops(edits in edits(&WORDS), bits in 0u8..8) {
        let (name, text, side) = FILES[2];
        let (beside, loops) = side.unwrap();
        read(name, text.as_bytes(), Some((beside, &spoilt(loops, &edits))), bits);
    }
}
