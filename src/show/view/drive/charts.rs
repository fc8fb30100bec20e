//! Charts of a drive's programme: angles and energies over time.

use crate::chart::{Axis, Chart, Outline, Series, Style};
use crate::drive::driving::PROFILE_POINTS;
use crate::drive::programme::RunMoment;
use crate::format::csv;
use crate::view::drive::{Drive, feed_moments};

/// Points drawn of a swing.
const PER_SWING: u32 = 48;

/// Returns the cam's profile in the file's unit, if the radii of cam and roller are stated.
pub fn cam(d: &Drive<'_>) -> Option<Outline> {
    let cam = d.design?.cam.as_ref()?;
    let (profile, unit) = (cam.profile.as_ref()?, d.file.length_unit);
    let (_, roller) = d.file.spec.cam?.profile?;
    let own = |p: [f64; 2]| p.map(|x| x / unit.metres);
    let pitch = profile.points.iter().map(|p| p.pitch);
    let mut curves = vec![
        (
            "profile".to_owned(),
            profile.outline.iter().copied().map(own).collect(),
        ),
        (
            "path of the roller".to_owned(),
            pitch.clone().map(own).collect(),
        ),
    ];
    // The first point of each swing is in a groove.
    let at = pitch.step_by(PROFILE_POINTS as usize);
    for (i, [x, y]) in at.enumerate() {
        let round = (0..48).map(|k| {
            let (s, c) = (std::f64::consts::TAU * f64::from(k) / 48.0).sin_cos();
            own([x + roller * c, y + roller * s])
        });
        curves.push((format!("roller in groove {}", i + 1), round.collect()));
    }
    Some(Outline {
        title: format!("{}: profile of the cam", d.file.name),
        subtitle: format!(
            "{} on the flanks; grooves as the roller is round, to be cut as deep as the latch wants them.",
            match feed_moments(d.design?).len() {
                0 | 1 => "An even moment",
                _ => "The moments that the file states",
            }
        ),
        unit: unit.symbol.to_owned(),
        curves,
    })
}

/// The payload's acceleration on the first disc over the programme, as `ozols grip --motion` takes it: a gripper that reaches
/// outwards from the axis (its x), the part along the axis (its z).
pub fn motion(d: &Drive<'_>) -> Option<String> {
    let (found, payload) = (d.design?, d.file.spec.payload?);
    let rows = found
        .module
        .samples(&found.run, PER_SWING)
        .into_iter()
        .map(|s| {
            let inwards = -s.speeds[0] * s.speeds[0] * payload.radius;
            let across = s.accelerations[0] * payload.radius;
            [s.time, inwards, across, 0.0]
                .map(|x| format!("{x:?}"))
                .to_vec()
        });
    Some(csv::table(&["time", "ax", "ay", "az"], rows))
}

/// Returns both charts with the names of their files. Empty without a bar.
pub fn charts(d: &Drive<'_>) -> Vec<(String, Chart)> {
    let Some(found) = d.design else {
        return Vec::new();
    };
    let samples = found.module.samples(&found.run, PER_SWING);
    let series = |name: &str, style, y: &dyn Fn(&RunMoment) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.time, y(s))).collect(),
        style,
    };
    let chart = |title: &str, y: &str, series| Chart {
        title: format!("{}: {title}", d.file.name),
        subtitle: String::new(),
        x: Axis::linear("time, s"),
        y: Axis::linear(y),
        series,
    };
    let angles = vec![
        series("disc 1", Style::Line, &|s| s.angles[0].to_degrees()),
        series("disc 2", Style::Dashed, &|s| s.angles[1].to_degrees()),
    ];
    let energies = vec![
        series("in the bar", Style::Line, &|s| s.potential),
        series("of the disc", Style::Dashed, &|s| s.kinetic),
        series("both", Style::Line, &|s| s.potential + s.kinetic),
    ];
    vec![
        (
            "angles".to_owned(),
            chart("angles of the discs", "angle, degrees", angles),
        ),
        ("energy".to_owned(), chart("energy", "energy, J", energies)),
    ]
}
