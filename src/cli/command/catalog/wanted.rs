//! What a designer wants of the grippers that are listed, as options of `ozols catalog query`.

use clap::Args as ClapArgs;
use itertools::Itertools;

#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Filters")]
pub(super) struct WantedGrippers {
    /// Those alone that do the task: open and close as far, with the force and the room asked.
    #[arg(long)]
    does_task: bool,
    /// Those alone that no other beats: the view `front`.
    #[arg(long)]
    front: bool,
    /// The least force of a jaw over the stroke from: N for 1 N of a sliding drive, or for 1 Nm of a turning one.
    #[arg(long, value_name = "N")]
    least_force: Option<f64>,
    /// The greatest force of a jaw over the least at most.
    #[arg(long, value_name = "X")]
    force_ratio: Option<f64>,
    /// The stroke of the jaws, from the narrowest part to the widest, from, in mm.
    #[arg(long, value_name = "MM")]
    stroke: Option<f64>,
    /// The turn of the jaws over the stroke at most, in degrees.
    #[arg(long, value_name = "DEGREES")]
    turn: Option<f64>,
    /// The transmission angle over the stroke from, in degrees.
    #[arg(long, value_name = "DEGREES")]
    transmission: Option<f64>,
    /// The greatest joint force at most, in N for 1 N of each jaw.
    #[arg(long, value_name = "N")]
    pin_force: Option<f64>,
    /// The efficiency over the stroke from.
    #[arg(long, value_name = "X")]
    efficiency: Option<f64>,
    /// The travel of the drive at most, in mm or rad.
    #[arg(long, value_name = "X")]
    travel: Option<f64>,
    /// The width of the box round it over the stroke at most, in mm.
    #[arg(long, value_name = "MM")]
    width: Option<f64>,
    /// Its height at most, in mm.
    #[arg(long, value_name = "MM")]
    height: Option<f64>,
    /// The cost of its cheapest redesign at most.
    #[arg(long, value_name = "X")]
    cost: Option<f64>,
}

impl WantedGrippers {
    /// The question that asks for it; nothing where nothing is wanted.
    pub(super) fn question(&self) -> Option<String> {
        let bounds = [
            ("least_force", ">=", self.least_force),
            ("force_ratio", "<=", self.force_ratio),
            ("widest - narrowest", ">=", self.stroke),
            ("turn", "<=", self.turn),
            ("transmission", ">=", self.transmission),
            ("pin_force", "<=", self.pin_force),
            ("efficiency", ">=", self.efficiency),
            ("travel", "<=", self.travel),
            ("width", "<=", self.width),
            ("height", "<=", self.height),
            ("cost", "<=", self.cost),
        ];
        let bounds = bounds
            .into_iter()
            .filter_map(|(what, sign, x)| Some(format!("{what} {sign} {}", x?)));
        let words = [
            (self.does_task, "reached = 1 AND shortfall IS NULL"),
            (self.front, "id IN (SELECT id FROM front)"),
        ];
        let words = words
            .into_iter()
            .filter(|(asked, _)| *asked)
            .map(|(_, sql)| sql.to_owned());
        let all = words.chain(bounds).join(" AND ");
        (!all.is_empty()).then(|| {
            format!(
                "SELECT id, links, input, symmetry AS layout, jaws, least_force, force_ratio, turn, transmission, pin_force, efficiency, \
                 travel, width, height, cost FROM grippers WHERE {all} ORDER BY links, least_force DESC, id"
            )
        })
    }
}
