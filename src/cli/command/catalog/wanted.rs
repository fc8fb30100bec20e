//! What a designer wants of the grippers that are listed, as options of `ozols catalog query`.

use crate::catalog::store::{Store, StoreError};
use crate::format::significant;
use clap::Args as ClapArgs;
use itertools::Itertools;
use serde_json::Value;

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
    #[arg(long, value_name = "N", value_parser = finite)]
    least_force: Option<f64>,
    /// The greatest force of a jaw over the least at most.
    #[arg(long, value_name = "X", value_parser = finite)]
    force_ratio: Option<f64>,
    /// The turn of the jaws over the stroke at most, in degrees.
    #[arg(long, value_name = "DEGREES", value_parser = finite)]
    turn: Option<f64>,
    /// The transmission angle over the stroke from, in degrees.
    #[arg(long, value_name = "DEGREES", value_parser = finite)]
    transmission: Option<f64>,
    /// The price of all its parts with the cheapest redesign at most, in revolute joints.
    #[arg(long, value_name = "X", value_parser = finite)]
    price: Option<f64>,
    /// The cost of its cheapest redesign at most.
    #[arg(long, value_name = "X", value_parser = finite)]
    cost: Option<f64>,
}

fn finite(word: &str) -> Result<f64, String> {
    let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
    number.ok_or_else(|| "give a number, such as 0.5".to_owned())
}

/// One of the bounds that are asked.
struct Filter {
    /// As it is typed.
    option: String,
    /// In SQL.
    holds: String,
    /// The best value that there is, in SQL and in words; nothing where it is no number.
    best: Option<(String, String)>,
}

impl Filter {
    fn word(option: &str, holds: &str) -> Filter {
        Filter {
            option: option.to_owned(),
            holds: holds.to_owned(),
            best: None,
        }
    }

    /// Of a column that is to be `>=` or `<=` a number.
    fn number(option: &str, column: &str, sign: &str, x: f64) -> Filter {
        let (function, word) = match sign {
            ">=" => ("max", "greatest"),
            _ => ("min", "smallest"),
        };
        let name = option.trim_start_matches('-').replace('-', " ");
        Filter {
            option: format!("{option} {x}"),
            holds: format!("{column} {sign} {x}"),
            best: Some((
                format!("{function}({column})"),
                format!("the {word} {name}"),
            )),
        }
    }
}

impl WantedGrippers {
    fn bounds(&self) -> Vec<Filter> {
        let words = [
            (
                self.does_task,
                "--does-task",
                "reached = 1 AND shortfall IS NULL",
            ),
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
        let numbers = numbers
            .iter()
            .filter_map(|(o, column, sign, x)| Some(Filter::number(o, column, sign, (*x)?)));
        let words = words.map(|(_, o, sql)| Filter::word(o, sql));
        words.chain(numbers).collect()
    }

    /// The question that asks for it; nothing where nothing is wanted.
    pub(super) fn question(&self) -> Option<String> {
        let all = self.bounds().iter().map(|b| b.holds.as_str()).join(" AND ");
        (!all.is_empty()).then(|| {
            format!(
                "SELECT id, links, input, symmetry AS layout, jaws, least_force, force_ratio, turn, transmission, pin_force, efficiency, \
                 travel, width, height, planes, actuator, price, cost FROM grippers WHERE {all} ORDER BY links, least_force DESC, id"
            )
        })
    }

    /// Which bounds are in the way where nothing holds them all: how many grippers there are without each, and how near they come
    /// to it.
    pub(super) fn in_the_way(&self, store: &Store) -> Result<String, StoreError> {
        let bounds = self.bounds();
        let mut out = String::from("No gripper holds all of this.\n");
        let mut found = false;
        for (i, bound) in bounds.iter().enumerate() {
            let others = bounds.iter().enumerate().filter(|(k, _)| *k != i);
            let others = others.map(|(_, b)| b.holds.as_str()).join(" AND ");
            let others = if others.is_empty() { "1" } else { &others };
            let best = bound.best.as_ref().map_or("NULL", |(sql, _)| sql);
            let sql = format!("SELECT count(*), {best} FROM grippers WHERE {others}");
            let (_, rows) = store.query(&sql, None)?;
            let row = rows.first().map_or(&[][..], Vec::as_slice);
            let count = row.first().and_then(Value::as_u64).unwrap_or(0);
            if count == 0 {
                continue;
            }
            found = true;
            out += &format!("  without {}: {count}", bound.option);
            let best = row.get(1).and_then(Value::as_f64);
            if let (Some((_, name)), Some(best)) = (&bound.best, best) {
                out += &format!("; {name} is {}", significant(best));
            }
            out += "\n";
        }
        if !found {
            out += "  Nor does any where one of the bounds is left out: two of them or more are in the way.\n";
        }
        Ok(out)
    }
}
