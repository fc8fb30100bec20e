//! `ozols statics` of a mechanism that grips: the part is cut free, and its contact forces act on the jaws.

use crate::cli::command::statics::args::{Statics, StaticsFormat, StaticsMethod};
use crate::cli::prelude::*;
use crate::grip::clamped::clamped_reactions;
use crate::grip::clamping::DiameterRow;
use crate::grip::jaw_loads::Gripping;
use crate::view::grip::clamped::NotHeld;
use crate::view::statics::told::ToldStatics;

/// Returns the diameter asked for, or the hardest one to hold. `None` if that part cannot be held.
fn chosen_diameter<'g>(g: &'g Gripping, a: &Statics) -> anyhow::Result<Option<&'g DiameterRow>> {
    let Some(diameter) = a.diameter else {
        return Ok(g.study.hardest_row());
    };
    let unit = g.mechanism.length_unit;
    let near =
        |r: &&DiameterRow| (r.diameter / unit.metres - diameter).abs() < 1e-6 * diameter.abs();
    let found = g.study.rows.iter().find(near);
    let known = || {
        let all = g.study.rows.iter().take(30);
        let all = all.map(|r| four_digits(r.diameter / unit.metres));
        all.collect::<Vec<_>>().join(", ")
    };
    let row = found.with_context(|| {
        format!(
            "--diameter {diameter} {} is not one of the diameters of [workload.grip]: {}",
            unit.symbol,
            known()
        )
    })?;
    Ok(Some(row).filter(|r| r.is_held()))
}

/// Refuses what makes no sense round a part.
fn check_options(a: &Statics) -> anyhow::Result<()> {
    for (given, flag) in [
        (a.stroke.is_some(), "--stroke"),
        (a.svg.is_some(), "--svg"),
        (a.stability, "--stability"),
    ] {
        ensure!(
            !given,
            "{flag} needs a motion, but the levers do not move around this part; choose another part with --diameter"
        );
    }
    ensure!(
        !matches!(a.method, StaticsMethod::Delta | StaticsMethod::Projective),
        "joints around a part are solved by equilibrium only; use --method equilibrium"
    );
    Ok(())
}

pub(crate) fn run_clamped(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    check_options(a)?;
    let Some(row) = chosen_diameter(g, a)? else {
        return not_held(g, a);
    };
    let Some(found) = clamped_reactions(g, row, a.spatial)? else {
        return not_held(g, a);
    };
    let shown = ToldStatics::round_a_part(g, row, &found);
    a.put_reactions(&shown, &[])
}

/// Says why there are no forces: exit code 1.
fn not_held(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    let shown = NotHeld::new(g);
    a.write_text(match a.format {
        StaticsFormat::Json => output::json_text(&shown)?,
        StaticsFormat::Csv | StaticsFormat::Text => shown.text(),
    })?;
    Ok(Done::Nothing)
}
