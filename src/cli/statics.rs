//! `ozols statics`.

use super::args::{Args, Statics, StaticsFormat, StaticsMethod};
use super::{Done, clamped, load, output, reactions};
use crate::chart::page;
use crate::file::read::loads::{MAX_STEPS, position};
use crate::geom::expr::Expr;
use crate::grip::jaw_loads::{Gripping, JawError};
use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::statics::contour_group::GroupPose;
use crate::statics::cycle::{statics, structures};
use crate::statics::kinetostatics::Source;
use crate::statics::stability::{Failure, Sample, distances, samples};
use crate::view::next::{self, Step};
use crate::view::statics_charts::{self, Named};
use crate::view::statics_words::GroupMethod;
use crate::view::words::table;
use crate::view::{statics_data, statics_text};
use anyhow::{Context, bail};
use rayon::prelude::*;
use std::path::Path;

/// Groups tried at each distance of a stability chart.
const GROUPS: usize = 9;

pub(super) fn run(args: &Args, a: &Statics) -> anyhow::Result<Done> {
    let mut m = load::mechanism(a.file.as_deref().unwrap_or("parallel-shears"))?;
    if a.planar {
        m.mode = Mode::Planar {
            normal: [0, 0, 1].map(Expr::from),
        };
    }
    let Some(state) = m.state(&a.state) else {
        bail!(
            "{} has no state {}; it has: {}",
            m.name,
            a.state,
            m.states.join(", ")
        )
    };
    match Gripping::new(&m, state) {
        // The nominal part is out of reach, so nothing is held.
        Err(JawError::Nominal(why)) => {
            return output::to(a.output.as_deref(), |out| {
                writeln!(out, "{}: the part cannot be held: {why}", m.name)?;
                Ok(Done::Nothing)
            });
        }
        found => match found? {
            Some(gripping) if a.groups => return groups(&gripping.mechanism, state, a),
            Some(gripping) => return clamped::run(&gripping, a),
            None => {}
        },
    }
    if let Some(diameter) = a.diameter {
        bail!(
            "--diameter {diameter}: no grip loads state {} of {}; give [workload.grip] contacts, and --state one that has them",
            a.state,
            m.name
        );
    }
    if a.groups {
        return groups(&m, state, a);
    }
    let stroke = match &a.stroke {
        Some(text) => Some(stroke(text)?),
        None => m.loads.stroke,
    };
    if let (true, Some(folder)) = (a.stability, &a.output) {
        return stability(&m, state, stroke, folder, args.seed);
    }
    if a.spatial {
        return reactions::run(&m, state, stroke, a);
    }
    let found = match statics(&m, state, stroke) {
        Err(e) if reactions::takes(&e, a) => return reactions::run(&m, state, stroke, a),
        found => found?,
    };
    let methods: &[GroupMethod] = match a.method {
        StaticsMethod::Delta => &[GroupMethod::Delta],
        StaticsMethod::Projective => &[GroupMethod::Projective],
        StaticsMethod::Equilibrium => &[GroupMethod::Equilibrium],
        StaticsMethod::All => &GroupMethod::ALL,
    };
    let own = matches!(a.method, StaticsMethod::Delta | StaticsMethod::Projective);
    if own && found.contour_groups.is_empty() {
        bail!(
            "{} has no four-link group with a closed contour, which --method delta and projective are for; use --method equilibrium",
            m.name
        );
    }
    if let Some(folder) = &a.svg {
        write_charts(
            folder,
            &m.name,
            &statics_charts::cycle(&m.name, &found, methods),
        )?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            StaticsFormat::Json => {
                writeln!(out, "{:#}", statics_data::json(&m.name, &found, methods))?;
            }
            StaticsFormat::Csv => write!(out, "{}", statics_data::csv(&found, methods))?,
            StaticsFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(
                    out,
                    "{}",
                    statics_text::statics(&m.name, &found, methods, width)
                )?;
                let loaded = found.moments.iter().any(|x| !x.loads.is_empty());
                let file = a.file.as_deref().unwrap_or(&m.name);
                let mut steps = Vec::new();
                if loaded && a.svg.is_none() {
                    let gives = "charts of the reactions over the cycle";
                    steps.push(Step::new("statics", file, "--svg charts", gives));
                }
                if loaded {
                    let more = "--format csv -o reactions.csv";
                    let gives = "every joint's reaction at every position";
                    steps.push(Step::new("statics", file, more, gives));
                }
                write!(out, "{}", next::text(&steps, width))?;
            }
        }
        // A cycle that could not be finished is no success.
        Ok(if found.dead.is_some() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}

/// A range and its steps, such as "0:360deg:72".
pub(super) fn stroke(text: &str) -> anyhow::Result<Stroke> {
    let parts: Vec<&str> = text.split(':').collect();
    let parsed = match parts[..] {
        [from, to, steps] => position(from)
            .zip(position(to))
            .zip(steps.parse::<usize>().ok()),
        _ => None,
    };
    match parsed {
        Some(((from, to), steps)) if (1..=MAX_STEPS).contains(&steps) => {
            Ok(Stroke { from, to, steps })
        }
        _ => bail!(
            "--stroke {text:?} is not FROM:TO:STEPS, such as 0:360deg:72 with 1 to {MAX_STEPS} steps"
        ),
    }
}

fn groups(m: &Mechanism, state: StateId, a: &Statics) -> anyhow::Result<Done> {
    let (planar, found) = structures(m, state)?;
    let any = found.iter().any(|x| x.found.is_ok());
    output::to(a.output.as_deref(), |out| {
        match a.format {
            StaticsFormat::Json => {
                writeln!(
                    out,
                    "{:#}",
                    statics_data::structures(&m.name, &planar, &found)
                )?;
            }
            StaticsFormat::Csv => bail!("--groups has no CSV; use --format json"),
            StaticsFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(
                    out,
                    "{}",
                    statics_text::structures(&m.name, &planar, &found, width)
                )?;
            }
        }
        Ok(if any { Done::Found } else { Done::Nothing })
    })
}

/// Writes each chart as SVG and CSV, and a page of all.
fn write_charts(folder: &Path, title: &str, charts: &[Named]) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let write = |name: &str, text: &str| {
        output::to(Some(&folder.join(name)), |out| {
            write!(out, "{text}")?;
            Ok(Done::Found)
        })
    };
    let mut parts = Vec::new();
    for (name, chart) in charts {
        let svg = chart.svg();
        write(&format!("{name}.svg"), &svg)?;
        let mut table = chart.clone();
        for series in &mut table.series {
            series.points.retain(|p| p.1.is_finite());
        }
        write(&format!("{name}.csv"), &table.csv())?;
        parts.push((chart.title.clone(), chart.subtitle.clone(), svg));
    }
    write("index.html", &page(title, &parts))?;
    Ok(())
}

/// A group in a pose with its loads, the heaviest of the stroke where forces act from outside.
fn typical(m: &Mechanism, state: StateId, stroke: Option<Stroke>) -> anyhow::Result<GroupPose> {
    let found = statics(m, state, stroke)?;
    let heavy = |l: &crate::statics::kinetostatics::Load| {
        if l.source == Source::External {
            l.force[0].hypot(l.force[1])
        } else {
            0.0
        }
    };
    let weight = |g: &GroupPose| -> f64 { g.loads.iter().map(heavy).sum() };
    let first = found.moments.iter().filter_map(|x| x.groups.first());
    let best = first.max_by(|a, b| weight(&a.pose).total_cmp(&weight(&b.pose)));
    match best {
        Some(g) => Ok(g.pose.clone()),
        None => bail!(
            "{} has no four-link group with a closed contour to compare the methods on",
            m.name
        ),
    }
}

fn stability(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
    folder: &Path,
    seed: u64,
) -> anyhow::Result<Done> {
    let base = typical(m, state, stroke)?;
    let distances = distances();
    let found: Vec<(Failure, Vec<Sample>)> = Failure::ALL
        .par_iter()
        .map(|&f| (f, samples(&base, f, &distances, GROUPS, seed)))
        .collect();
    let charts: Vec<Named> = found
        .iter()
        .map(|(f, s)| statics_charts::stability(*f, s))
        .collect();
    write_charts(folder, "Stability of the δ-point method", &charts)?;
    let rows = found
        .iter()
        .flat_map(|(f, all)| statics_charts::stability_rows(*f, all))
        .collect();
    output::to(None, |out| {
        writeln!(
            out,
            "Relative error against exact arithmetic by distance from each failure, median of {GROUPS} groups\n"
        )?;
        let header = [
            "failure", "figure", "method", "1", "1e-3", "1e-6", "1e-9", "1e-12", "1e-15",
        ];
        writeln!(out, "{}\n", table(&header, rows, output::width(None)))?;
        writeln!(
            out,
            "Charts and tables: {}",
            folder.join("index.html").display()
        )?;
        Ok(Done::Found)
    })
}
