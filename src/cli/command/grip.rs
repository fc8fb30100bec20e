//! `ozols grip`.

use crate::cli::option::parse_three;
use crate::cli::prelude::*;
use crate::drive::driving::design_drive;
use crate::file::read::workload::trajectory::read_trajectory;
use crate::file::read::workload::{WorkloadFile, drive_from_bytes, grip_from_bytes};
use crate::grip::analyse_grip;
use crate::grip::motion::clamp_along;
use crate::model::grip::{GripSpec, MotionStep, Toward};
use crate::view;
use crate::view::drive::{drive_charts, motion_csv, text};
use crate::view::grip::motion::GripMotion;
use crate::view::grip::{GripReport, grip_charts};

#[derive(Debug, ClapArgs)]
pub(crate) struct Grip {
    #[command(flatten)]
    file: File,
    /// Additional acceleration of the gripper in m/s², in its axes, such as 5,0,-2 (repeatable).
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    acceleration: Vec<[f64; 3]>,
    /// Additional acceleration of the gripper in m/s², in any direction; `ozols drive` prints one.
    #[arg(long, value_name = "A")]
    any_acceleration: Option<f64>,
    /// Motion as CSV, one step per line: columns ax, ay, az in m/s², and optionally gx, gy, gz (gravity in the gripper's axes),
    /// time, diameter. Computes the least clamping for every step.
    #[arg(long, value_name = "CSV", value_hint = clap::ValueHint::FilePath)]
    motion: Option<PathBuf>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextOrJson,
    /// Also write charts to this folder, each as SVG and CSV.
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

fn parse_vector(text: &str) -> Result<[f64; 3], String> {
    let small = |numbers: &[f64; 3]| numbers.iter().all(|x| x.abs() <= 1e6);
    let words = || "give three numbers such as 5,0,-2, none beyond 1e6".to_owned();
    parse_three(text).filter(small).ok_or_else(words)
}

pub(crate) fn run_grip(a: &Grip) -> anyhow::Result<Done> {
    let (name, bytes) = load::read_named(&a.file)?;
    let mut file = grip_from_bytes(&name, &bytes)?;
    add_accelerations(&mut file, a)?;
    let steps = match &a.motion {
        Some(path) => Some(steps_of(path, &mut file)?),
        None => None,
    };
    let found = analyse_grip(&file.spec, file.mechanism.as_ref())?;
    let motion = match steps {
        None => None,
        Some(steps) => Some(GripMotion {
            steps: clamp_along(&file.spec, &found, &steps)?,
            unit: file.length_unit,
        }),
    };
    let shown = GripReport {
        file: &file,
        found: &found,
        motion,
    };
    if let Some(folder) = &a.svg {
        output::write_charts(folder, None, grip_charts(&shown))?;
    }
    let gives = "charts of the arms and the drive moment";
    let charts = NextCommand::new("grip", &a.file.file, "--svg charts", gives);
    let next = if a.svg.is_none() { &[charts][..] } else { &[] };
    a.to.write_all_of(match a.format {
        TextOrJson::Json => output::json_text(&shown.json())?,
        TextOrJson::Text => shown.text(a.to.width()) + &a.file.next_steps(next, a.to.width()),
    })?;
    Ok(Done::found_or_nothing(shown.holds()))
}

/// Adds the accelerations of the command line to the load of the file.
fn add_accelerations(file: &mut WorkloadFile<GripSpec>, a: &Grip) -> anyhow::Result<()> {
    let mut further: Vec<Toward> = a.acceleration.iter().map(|v| Toward::Fixed(*v)).collect();
    if let Some(size) = a.any_acceleration {
        ensure!(
            (0.0..=1e6).contains(&size),
            "--any-acceleration must be a number from 0 to 1e6 m/s²"
        );
        further.push(Toward::Any(size));
    }
    match &mut file.spec.load {
        Some(load) => load.accelerations.extend(further),
        None if further.is_empty() => {}
        None => bail!(
            "{} states no load; give [workload.grip] a mass and friction before accelerations",
            file.name
        ),
    }
    Ok(())
}

/// Reads a motion, whose parts are studied along with the others.
fn steps_of(path: &Path, file: &mut WorkloadFile<GripSpec>) -> anyhow::Result<Vec<MotionStep>> {
    let bytes = disk::at_most(path, MAX_DESCRIPTION_BYTES)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let steps = read_trajectory(&path.display().to_string(), &bytes, file.length_unit.metres)?;
    let parts = steps
        .iter()
        .map(|s| s.diameter.unwrap_or(file.spec.diameter));
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a;
    for part in parts.collect::<Vec<f64>>() {
        if !file.spec.diameters.iter().any(|d| near(*d, part)) {
            file.spec.diameters.push(part);
        }
    }
    file.spec.diameters.sort_by(f64::total_cmp);
    Ok(steps)
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Drive {
    #[command(flatten)]
    pub(crate) file: File,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: TextOrJson,
    /// Also write to this folder: charts as SVG and CSV, and the payload's motion on the first disc for `ozols grip --motion`.
    #[arg(long, value_name = "DIR")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

pub(crate) fn run_drive(a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::read_named(&a.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = design_drive(&file.spec)?;
    let shown = view::drive::Drive::new(&file, &found);
    if let (Some(folder), true) = (&a.svg, shown.design.is_some()) {
        output::write_charts(folder, None, drive_charts(&shown))?;
        if let Some(motion) = motion_csv(&shown) {
            output::write_bytes(Some(&folder.join("motion.csv")), motion)?;
        }
    }
    let gives = "charts of the programme: angle and energy over time";
    let charts = NextCommand::new("drive", &a.file.file, "--svg charts", gives);
    let wanted = a.svg.is_none() && shown.design.is_some();
    let next = if wanted { &[charts][..] } else { &[] };
    let width = a.to.width();
    a.to.write_all_of(match a.format {
        TextOrJson::Json => output::json_text(&shown.json())?,
        TextOrJson::Text => text::drive_text(&shown, width) + &a.file.next_steps(next, width),
    })?;
    Ok(Done::found_or_nothing(shown.is_complete()))
}
