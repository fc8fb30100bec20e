//! Reduction of the closure equations to the rows in which the joints move.
//!
//! Joints connected by contours or couplings form a block. If all joints of a block move in a group of fewer than six
//! dimensions, as in a plane, that many rows per contour are enough.
//!
//! A plane can also split the freedoms of each joint. Those in the plane are a turn about its normal and slides along
//! it. Those out of it are tilts about lines of the plane and a slide along the normal. Then the equations of the block
//! split into those in the plane and those out of it. Of both, only the rows with any motion count.
//!
//! Ranks add up over parts and blocks. The omitted rows are zero or combinations of the others, for any rest of the
//! mechanism, so they are redundant.
//!
//! The result holds for the given pose and geometry. Rows without motion here may have motion in another pose.

use crate::closure::Closure;
use crate::format::count_noun;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, Mode};
use crate::rank::exact::modular;
use crate::rank::finite::displacement_group::{DisplacementGroup, group_of};
use crate::rank::finite::independent_parts::independent_parts;
use crate::rank::reduce::axis_names::Direction;
use crate::rank::reduce::plane::{Rows, planes_of_joints, twist_in_rows};
use itertools::Itertools;

/// Motions that rows describe.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Motions {
    /// Any.
    All,
    /// Motions of a group, named with its dimension.
    Group(String),
    /// Motions in a plane with this normal, if it has a name.
    InPlane(Option<Direction>),
    /// Motions out of the plane.
    OutOfPlane(Option<Direction>),
}

/// Rows of a block that are independent of its other rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BlockRows {
    /// Motions that they describe.
    pub motions: Motions,
    /// Rows per contour.
    pub per_contour: usize,
    /// Number of all rows, including one for each coupling.
    pub rows: usize,
    /// Number of rows of J for these motions.
    pub of: usize,
    /// Their rank.
    pub rank: usize,
}

/// Contours with connected joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Indices of the contours.
    pub contours: Vec<usize>,
    /// A single part, or the part in the plane and the part out of it.
    pub parts: Vec<BlockRows>,
}

/// The rows that are enough for the rank of J.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeastRows {
    /// The blocks, in the order of their first joints.
    pub blocks: Vec<Block>,
    /// Number of rows of J.
    pub of: usize,
    /// Rows of J per contour.
    dim: usize,
    /// Whether there are joints in no contour.
    outside: bool,
}

impl LeastRows {
    /// Finds the rows and their rank by one prime.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    ///
    /// # Complexity
    /// That of [`modular::rank_modulo`]. For each joint and plane examined, a few eliminations of six by six numbers.
    pub fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        closure: &Closure<Residue>,
    ) -> Result<LeastRows, ExactError> {
        let all = |part| Block {
            contours: (0..closure.contours.len()).collect(),
            parts: vec![part],
        };
        let tied = independent_parts(closure);
        let mut blocks = Vec::new();
        let mut spoken_for = 0;
        if let Mode::Planar { .. } = mechanism.mode {
            blocks.push(all(BlockRows::all_rows(exact, closure)));
        } else {
            for part in closure.split_parts(&tied) {
                let (joints, contours) = (part.joints, part.contours);
                spoken_for += if contours.is_empty() { 0 } else { joints.len() };
                let parts = least_of_block(exact, mechanism, &joints, &part.closure)?;
                blocks.push(Block { contours, parts });
            }
            // Blocks with the same group are reported as one.
            let dimension = |b: &Block| match b.parts.as_slice() {
                [part] => matches!(part.motions, Motions::Group(_)).then_some(part.per_contour),
                _ => None,
            };
            if blocks.len() > 1
                && let Ok(Some(one)) = blocks.iter().map(dimension).all_equal_value()
            {
                let group = group_of(exact, mechanism, tied.into_iter().flatten())?;
                if group.dimension() == one {
                    blocks = vec![all(BlockRows::of_group(exact, &group, closure))];
                }
            }
        }
        Ok(LeastRows {
            blocks,
            of: closure.rows(),
            dim: closure.dim,
            outside: mechanism.joints_in(closure.state).count() > spoken_for,
        })
    }

    /// Returns the rank of J, by one prime.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.all_parts().map(|p| p.rank).sum()
    }

    /// Returns the number of rows that are enough.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.all_parts().map(|p| p.rows).sum()
    }

    /// Returns true if these are all rows, with a single part per block.
    #[must_use]
    pub fn is_all(&self) -> bool {
        self.all_parts().all(|p| p.motions == Motions::All)
    }

    fn all_parts(&self) -> impl Iterator<Item = &BlockRows> {
        self.blocks.iter().flat_map(|b| &b.parts)
    }

    /// Describes the rows used, the rows omitted, and the reason. Empty if all rows are used unchanged.
    #[must_use]
    pub fn describe_rows(&self, mechanism: &Mechanism, name: impl Fn(usize) -> String) -> String {
        if self.is_all() {
            return String::new();
        }
        let what = |b: &Block| b.describe_block(mechanism, self.dim);
        let left_out = |rows, of: String| match rows {
            0 => String::new(),
            rows => format!("; omitted: {rows} of {of}, redundant in any case"),
        };
        let of_all = left_out(self.of - self.rows(), format!("{} rows", self.of));
        let blocks = self
            .blocks
            .iter()
            .filter(|b| !b.contours.is_empty())
            .collect_vec();
        if let [block] = blocks.as_slice() {
            let left_out = match &block.parts[0] {
                BlockRows {
                    motions: Motions::Group(_),
                    per_contour,
                    ..
                } => left_out(self.dim - per_contour, self.dim.to_string()),
                _ => of_all,
            };
            let who = if self.outside {
                "all joints of contours"
            } else {
                "all joints"
            };
            return format!("; {who} {}{left_out}", what(block));
        }
        let told = blocks.iter().map(|b| (what(b), *b)).into_group_map();
        let contours = |blocks: &[&Block]| {
            let all = blocks.iter().flat_map(|b| &b.contours).copied();
            all.sorted_unstable().collect_vec()
        };
        let who = |blocks: &[&Block]| match (contours(blocks).as_slice(), blocks.len()) {
            (&[one], _) => format!("the joints of contour {}", name(one)),
            (all, 1) => format!("the joints of {} contours", all.len()),
            (all, n) => format!("the joints of each of {n} blocks, {} contours,", all.len()),
        };
        let each = told.iter().sorted_by_key(|(_, blocks)| contours(blocks));
        let each = each.map(|(what, blocks)| format!("; {} {what}", who(blocks)));
        each.chain([of_all]).join("")
    }
}

impl Block {
    fn describe_block(&self, mechanism: &Mechanism, dim: usize) -> String {
        match self.parts.as_slice() {
            [inside, outside] => {
                let normal = match inside.motions {
                    Motions::InPlane(Some(d)) => {
                        format!(" with normal {}", d.describe_direction(mechanism))
                    }
                    _ => String::new(),
                };
                if inside.rows == 0 {
                    return format!(
                        "move only out of a plane{normal}, so {} per contour {}",
                        count_noun(outside.per_contour, "row"),
                        is_enough(outside.per_contour)
                    );
                }
                format!(
                    "move in a plane{normal} {} or out of it {}",
                    inside.describe_counts(),
                    outside.describe_counts()
                )
            }
            [
                BlockRows {
                    motions: Motions::Group(name),
                    per_contour,
                    ..
                },
            ] => {
                format!(
                    "move in {name}, so {} per contour {}",
                    count_noun(*per_contour, "row"),
                    is_enough(*per_contour)
                )
            }
            _ => format!("need all {dim} rows per contour"),
        }
    }
}

impl BlockRows {
    fn new(exact: &ExactField, motions: Motions, least: &Closure<Residue>, of: usize) -> BlockRows {
        BlockRows {
            motions,
            per_contour: least.dim,
            rows: least.rows(),
            of,
            rank: match least.rows() {
                0 => 0,
                _ => modular::rank_modulo(exact, least),
            },
        }
    }

    fn all_rows(exact: &ExactField, closure: &Closure<Residue>) -> BlockRows {
        BlockRows::new(exact, Motions::All, closure, closure.rows())
    }

    fn of_group(
        exact: &ExactField,
        group: &DisplacementGroup,
        closure: &Closure<Residue>,
    ) -> BlockRows {
        let name = Motions::Group(group.name());
        BlockRows::new(exact, name, &group.rows_of(closure), closure.rows())
    }

    /// Returns the number of redundant constraints of such motions, including the omitted rows.
    #[must_use]
    pub fn count_redundant(&self) -> usize {
        self.of - self.rank
    }

    fn describe_counts(&self) -> String {
        let (rows, of, rank, redundant) = (self.rows, self.of, self.rank, self.count_redundant());
        format!("({rows} of {of} rows, rank {rank}, σ = {redundant})")
    }
}

fn is_enough(n: usize) -> &'static str {
    if n == 1 { "is enough" } else { "are enough" }
}

/// Returns the smallest set of rows of a block in space.
fn least_of_block(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: &[JointId],
    closure: &Closure<Residue>,
) -> Result<Vec<BlockRows>, ExactError> {
    if closure.contours.is_empty() {
        return Ok(vec![BlockRows::all_rows(exact, closure)]);
    }
    let group = group_of(exact, mechanism, joints.iter().copied())?;
    // A coupling may connect motions in the plane with motions out of it.
    if closure.couplings.is_empty() && group.dimension() > 3 {
        for plane in planes_of_joints(exact, mechanism, joints.iter().copied())? {
            let Some(rows) = plane.split_rows(exact) else {
                continue;
            };
            let Some([inside, outside]) = fallen_apart(exact, closure, rows) else {
                continue;
            };
            if inside.dim + outside.dim > group.dimension() {
                break;
            }
            let normal = Direction::name_direction(exact, mechanism, plane.normal);
            let half = closure.rows() / 2;
            return Ok(vec![
                BlockRows::new(exact, Motions::InPlane(normal), &inside, half),
                BlockRows::new(exact, Motions::OutOfPlane(normal), &outside, half),
            ]);
        }
    }
    Ok(vec![if group.dimension() < closure.dim {
        BlockRows::of_group(exact, &group, closure)
    } else {
        BlockRows::all_rows(exact, closure)
    }])
}

/// Returns J in the rows in a plane and in those out of it, without rows that have no motion. Returns `None` unless
/// each joint's freedoms are those of the two together.
fn fallen_apart(
    exact: &ExactField,
    closure: &Closure<Residue>,
    rows: [Rows; 2],
) -> Option<[Closure<Residue>; 2]> {
    let f = exact.field();
    let mut all = [Echelon::new(f), Echelon::new(f)];
    for (_, columns) in &closure.columns.iter().chunk_by(|c| c.joint) {
        let mut whole = Echelon::new(f);
        let mut parts = [Echelon::new(f), Echelon::new(f)];
        for column in columns {
            whole.insert(&column.twist);
            for ((part, all), rows) in parts.iter_mut().zip(&mut all).zip(&rows) {
                let t = twist_in_rows(f, rows, &column.twist);
                part.insert(&t);
                all.insert(&t);
            }
        }
        if whole.rank() < parts[0].rank() + parts[1].rank() {
            return None;
        }
    }
    let part = |i: usize| {
        let used = all[i].pivots();
        closure.with_twists(used.len(), |c| {
            let t = twist_in_rows(f, &rows[i], &closure.columns[c].twist);
            used.iter().map(|&r| t[r]).collect()
        })
    };
    Some([part(0), part(1)])
}
