//! Conditions on the grippers that are listed, as options of `ozols catalog query`.

use crate::catalog::store::{Store, StoreError};
use crate::cli::prelude::*;
use serde_json::Value;

#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Filters")]
pub(super) struct WantedGrippers {
    /// Only grippers that fulfil the task: range of opening, force and room.
    #[arg(long)]
    does_task: bool,
    /// Only Pareto-optimal grippers: the view `front`.
    #[arg(long)]
    front: bool,
    /// Minimum jaw force over the stroke, for 1 N of a sliding or 1 N·m of a rotary drive. Sliding drives are listed first.
    #[arg(long, value_name = "N", value_parser = parse_finite)]
    least_force: Option<f64>,
    /// Maximum ratio of the greatest jaw force to the least.
    #[arg(long, value_name = "X", value_parser = parse_finite)]
    force_ratio: Option<f64>,
    /// Maximum rotation of the jaws over the stroke, in degrees.
    #[arg(long, value_name = "DEGREES", value_parser = parse_finite)]
    turn: Option<f64>,
    /// Minimum transmission angle over the stroke, in degrees.
    #[arg(long, value_name = "DEGREES", value_parser = parse_finite)]
    transmission: Option<f64>,
    /// Maximum price of all parts with the cheapest redesign, in units of one revolute joint.
    #[arg(long, value_name = "X", value_parser = parse_finite)]
    price: Option<f64>,
    /// Maximum cost of its cheapest redesign.
    #[arg(long, value_name = "X", value_parser = parse_finite)]
    cost: Option<f64>,
}

/// The columns of a gripper. The forces per newton and per newton metre of the drive have a column each.
const COLUMNS: &str = "SELECT id, links, input, symmetry AS layout, jaws, iif(reached AND shortfall IS NULL, 'yes', 'no') AS does_task, \
     iif(input = 'slide', least_force, NULL) AS force_per_newton, iif(input = 'turn', least_force, NULL) AS force_per_newton_metre, \
     force_ratio, turn, transmission, pin_force, price, cost, \
     (SELECT group_concat(c.id, ', ') FROM classics c WHERE c.structure = grippers.id) AS known_as FROM grippers";

/// Number of grippers that are listed if nothing is asked.
pub(super) const LISTED: usize = 25;

fn parse_finite(word: &str) -> Result<f64, String> {
    let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
    number.ok_or_else(|| "give a number, such as 0.5".to_owned())
}

/// One of the given bounds.
struct Filter {
    /// The option as typed.
    option: String,
    /// The condition in SQL.
    holds: String,
    /// The best existing values, each in SQL and in words. None if the bound is not a number.
    best: Vec<[String; 2]>,
    /// The order of answers with the best first.
    order: String,
}

impl Filter {
    /// Returns the filter for a column that must be `>=` or `<=` a number.
    fn with_bound(option: &str, column: &str, sign: &str, x: f64) -> Filter {
        let (function, word, way) = match sign {
            ">=" => ("max", "greatest", "DESC"),
            _ => ("min", "smallest", "ASC"),
        };
        let name = option.trim_start_matches('-').replace('-', " ");
        let best_of = |rows: &str, of: &str| {
            let sql = format!("{function}({column}) FILTER (WHERE {rows})");
            [sql, format!("the {word} {name}{of}")]
        };
        // Forces for 1 N and for 1 N·m do not compare.
        let (best, first) = match column {
            "least_force" => {
                let slides = best_of("input = 'slide'", " for 1 N of a sliding drive");
                let turns = best_of("input = 'turn'", " for 1 Nm of a turning drive");
                (vec![slides, turns], "input, ")
            }
            _ => (vec![best_of("1", "")], ""),
        };
        Filter {
            option: format!("{option} {x}"),
            holds: format!("{column} {sign} {x}"),
            order: format!("{first}{column} {way}, "),
            best,
        }
    }
}

impl WantedGrippers {
    fn given_bounds(&self) -> Vec<Filter> {
        let reached = "reached = 1 AND shortfall IS NULL";
        let words = [
            (self.does_task, "--does-task", reached),
            (self.front, "--front", "id IN (SELECT id FROM front)"),
        ];
        let numbers = [
            ("--least-force", "least_force", ">=", self.least_force),
            ("--transmission", "transmission", ">=", self.transmission),
            ("--force-ratio", "force_ratio", "<=", self.force_ratio),
            ("--turn", "turn", "<=", self.turn),
            ("--price", "price", "<=", self.price),
            ("--cost", "cost", "<=", self.cost),
        ];
        let words = words.iter().filter(|(asked, ..)| *asked);
        let words = words.map(|(_, option, sql)| Filter {
            option: (*option).to_owned(),
            holds: (*sql).to_owned(),
            best: Vec::new(),
            order: String::new(),
        });
        let numbers = numbers
            .iter()
            .filter_map(|(o, column, sign, x)| Some(Filter::with_bound(o, column, sign, (*x)?)));
        words.chain(numbers).collect()
    }

    /// Returns whether any filter is set.
    pub(super) fn is_any(&self) -> bool {
        !self.given_bounds().is_empty()
    }

    /// Returns the SQL that answers: the grippers within the bounds, what does the task first, then sorted by what is asked. Without
    /// bounds the first [`LISTED`] of all.
    pub(super) fn sql_question(&self) -> String {
        let bounds = self.given_bounds();
        let sorted: String = bounds.iter().map(|b| b.order.as_str()).collect();
        let order = format!(
            "ORDER BY coalesce(does_task = 'no', 0), {sorted}links, layout = 'generic', cost, transmission DESC, id"
        );
        if bounds.is_empty() {
            format!("{COLUMNS} {order} LIMIT {LISTED}")
        } else {
            let all = bounds.iter().map(|b| b.holds.as_str()).join(" AND ");
            format!("{COLUMNS} WHERE {all} {order}")
        }
    }

    /// Lists the bounds that exclude every gripper: the number of grippers without each bound, and how near they come to it.
    pub(super) fn in_the_way(&self, store: &Store) -> Result<String, StoreError> {
        let bounds = self.given_bounds();
        let mut out = String::from("No gripper meets all of these.\n");
        let mut found = false;
        for (i, bound) in bounds.iter().enumerate() {
            let others = bounds.iter().enumerate().filter(|(k, _)| *k != i);
            let others = others.map(|(_, b)| b.holds.as_str()).join(" AND ");
            let others = if others.is_empty() { "1" } else { &others };
            let best = bound.best.iter().map(|[sql, _]| format!(", {sql}"));
            let best = best.collect::<String>();
            let sql = format!("SELECT count(*){best} FROM grippers WHERE {others}");
            let (_, rows) = store.query_rows(&sql, None)?;
            let row = rows.first().map_or(&[][..], Vec::as_slice);
            let count = row.first().and_then(Value::as_u64).unwrap_or(0);
            if count == 0 {
                continue;
            }
            found = true;
            out += &format!("  without {}: {count}", bound.option);
            for (value, [_, name]) in row[1..].iter().zip(&bound.best) {
                if let Some(best) = value.as_f64() {
                    out += &format!("; {name} is {}", four_digits(best));
                }
            }
            out += "\n";
        }
        if !found {
            out += "  Omitting one of the bounds gives none either: two or more of them exclude every gripper.\n";
        }
        Ok(out)
    }
}
