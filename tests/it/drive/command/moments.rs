//! Cams that push with several moments.

use super::{run_file, small_json, small_with};
use crate::common::*;

/// Moments by piece: their work by hand, told in the text and in JSON, and fed to every swing that comes to its latch.
#[test]
fn a_cam_of_several_moments_feeds_their_work() {
    let text = small_with(
        "swings = 5",
        "feed_moments = [[-9, 0.3], [\"pi/20\", 1], [27, 0.1]]",
    );
    let (code, said, errors) = run_file(&text, &[]);
    assert_eq!(code, Some(0), "{errors}");
    has(
        &said,
        "pushes with 0.3 N·m from -9°, 1 N·m from 9°, 0.1 N·m from 27°, up to the latch",
    );
    has(&said, "to arrive the cam must give");
    let value = small_json(&text, 0);
    let design = &value["design"];
    // 18° of 0.3 and of 1 N·m, and 18° of 0.1 up to the latch at 45°.
    let work = 1.4 * 18f64.to_radians();
    near(design["feed"].real(), work, 1e-12);
    let pieces = design["feed_moments"].list();
    for (piece, (from, moment)) in pieces.iter().zip([(-9f64, 0.3), (9.0, 1.0), (27.0, 0.1)]) {
        near(piece["from"].real(), from.to_radians(), 1e-12);
        near(piece["moment"].real(), moment, 1e-12);
    }
    let steps = design["programme"].list();
    for step in steps.iter().filter(|s| s["swing"]["end"] == "latched") {
        near(step["swing"]["energy"]["fed"].real(), work, 1e-12);
    }
    // An even push has one piece.
    let even = small_json(&small_with("swings = 5", "feed_energy = 0.4"), 0);
    let pieces = even["design"]["feed_moments"].list();
    assert_eq!(pieces.len(), 1);
    near(
        pieces[0]["moment"].real(),
        0.4 / std::f64::consts::FRAC_PI_4,
        1e-12,
    );
}
