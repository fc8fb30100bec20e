//! Loop closure: the contours of a mechanism, and the matrix of conditions on joint speeds around them.
//!
//! The loop-closure matrix J has the rows of the closed contours, then one row per coupling. It has one column per
//! joint freedom.

pub mod contour;
pub mod coupling;
pub mod drive;
pub mod isometry;
pub mod tree;
pub mod twist;

use crate::closure::contour::{Contour, contour_basis};
use crate::closure::coupling::coupling_coefficient;
use crate::closure::tree::{path_from_frame, path_in, spanning_tree};
use crate::closure::twist::{MotionSpace, joint_twists};
use crate::geom::Scalars;
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::geom::extent::Extent;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use std::collections::HashMap;

/// One column of J: a freedom of a joint.
#[derive(Debug, Clone)]
pub struct Column<N> {
    /// The joint.
    pub joint: JointId,
    /// The freedom, in the joint's frame.
    pub freedom: Freedom,
    /// Its unit twist, 6 or 3 components.
    pub twist: Vec<N>,
}

/// The row of a coupling: entries at the columns of the two freedoms.
#[derive(Debug, Clone)]
pub struct CouplingRow<N> {
    /// The two columns with their entries.
    pub entries: [(usize, N); 2],
}

/// J of some of the joints of a state.
#[derive(Debug, Clone)]
pub struct Part<N> {
    /// The joints.
    pub joints: Vec<JointId>,
    /// Their J.
    pub closure: Closure<N>,
    /// Indices of the contours of the state that belong to these joints.
    pub contours: Vec<usize>,
    /// Indices of the couplings of the state that belong to these joints.
    pub couplings: Vec<usize>,
}

/// J of a state, stored as its columns, contours and couplings. An entry block is ± the twist if the contour passes the
/// joint.
#[derive(Debug, Clone)]
pub struct Closure<N> {
    /// The state.
    pub state: StateId,
    /// Rows per contour.
    pub dim: usize,
    /// The contours, in order; those of the free state first.
    pub contours: Vec<Contour>,
    /// The columns, grouped by joint in file order.
    pub columns: Vec<Column<N>>,
    /// The couplings of the state, in file order.
    pub couplings: Vec<CouplingRow<N>>,
    /// Positions of the joints and their distances, in real numbers.
    pub extent: Option<Extent>,
    /// Joints with omitted freedoms out of the plane, and the number of these (planar mode only).
    pub left_out: Vec<(JointId, usize)>,
}

impl<N: Clone + Default + PartialEq> Closure<N> {
    /// Builds J of a state in a number system.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the number system.
    ///
    /// # Examples
    /// ```
    /// use ozols::closure::Closure;
    /// use ozols::geom::Reals;
    /// use ozols::model::mechanism::StateId;
    /// let j = Closure::new(&Reals, &ozols::built_in("gripper-10")?, StateId::FREE)?;
    /// assert_eq!((j.rows(), j.columns.len()), (24, 14)); // 6k and f
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new<S: Scalars<Number = N>>(
        s: &S,
        mechanism: &Mechanism,
        state: StateId,
    ) -> Result<Self, ExactError> {
        Self::with_contours(s, mechanism, state, contour_basis(mechanism, state))
    }

    /// Builds J for given contours, such as those of a mechanism with the same links and joints.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the number system.
    pub fn with_contours<S: Scalars<Number = N>>(
        s: &S,
        mechanism: &Mechanism,
        state: StateId,
        contours: Vec<Contour>,
    ) -> Result<Self, ExactError> {
        let space = MotionSpace::new(s, &mechanism.mode)?;
        let (mut columns, mut left_out) = (Vec::new(), Vec::new());
        for j in mechanism.joints_in(state) {
            let joint = &mechanism.joints[j];
            let twists = joint_twists(s, &space, &joint.frame, &joint.joint_type)?;
            let missing = joint.joint_type.freedoms().len() - twists.len();
            if missing > 0 {
                left_out.push((j, missing));
            }
            columns.extend(twists.into_iter().map(|(freedom, twist)| Column {
                joint: j,
                freedom,
                twist,
            }));
        }
        let couplings = coupling_rows(s, mechanism, state, &columns)?;
        let points: Vec<&[Expr; 3]> = mechanism
            .joints_in(state)
            .map(|j| &mechanism.joints[j].frame.point)
            .collect();
        Ok(Closure {
            extent: s.extent(&points),
            state,
            dim: space.dim(),
            contours,
            columns,
            couplings,
            left_out,
        })
    }

    /// Returns J of each of some sets of joints, which share contours and couplings with no others.
    ///
    /// # Complexity
    /// One pass over J.
    #[must_use]
    pub fn split_parts(&self, sets: &[Vec<JointId>]) -> Vec<Part<N>> {
        let part = |joints: &Vec<JointId>| Part {
            joints: joints.clone(),
            closure: Closure {
                state: self.state,
                dim: self.dim,
                contours: Vec::new(),
                columns: Vec::new(),
                couplings: Vec::new(),
                extent: self.extent,
                left_out: Vec::new(),
            },
            contours: Vec::new(),
            couplings: Vec::new(),
        };
        let mut out: Vec<Part<N>> = sets.iter().map(part).collect();
        let numbered = sets.iter().enumerate();
        let of: HashMap<JointId, usize> = numbered
            .flat_map(|(i, joints)| joints.iter().map(move |&j| (j, i)))
            .collect();
        for (k, contour) in self.contours.iter().enumerate() {
            let first = contour.joints.first();
            if let Some(&i) = first.and_then(|(j, _)| of.get(j)) {
                out[i].contours.push(k);
                out[i].closure.contours.push(contour.clone());
            }
        }
        let mut place = vec![0; self.columns.len()];
        for (c, column) in self.columns.iter().enumerate() {
            if let Some(&i) = of.get(&column.joint) {
                place[c] = out[i].closure.columns.len();
                out[i].closure.columns.push(column.clone());
            }
        }
        for (q, coupling) in self.couplings.iter().enumerate() {
            let at = self.columns[coupling.entries[0].0].joint;
            if let Some(&i) = of.get(&at) {
                let entries = coupling.entries.clone().map(|(c, x)| (place[c], x));
                out[i].couplings.push(q);
                out[i].closure.couplings.push(CouplingRow { entries });
            }
        }
        out
    }

    /// Returns J with other twists of its columns, of `dim` components each.
    #[must_use]
    pub(crate) fn with_twists(&self, dim: usize, twist: impl Fn(usize) -> Vec<N>) -> Self {
        let columns = self.columns.iter().enumerate();
        let columns = columns.map(|(c, column)| Column {
            twist: twist(c),
            ..column.clone()
        });
        Closure {
            dim,
            columns: columns.collect(),
            ..self.clone()
        }
    }

    /// Returns the number of rows, 6k + c for c couplings (3k + c in a plane).
    #[must_use]
    pub fn rows(&self) -> usize {
        self.contour_rows() + self.couplings.len()
    }

    /// Returns the number of rows of the contours, 6k (3k in a plane).
    #[must_use]
    pub fn contour_rows(&self) -> usize {
        self.dim * self.contours.len()
    }

    /// Returns the dense contour rows of column `c`, for the chosen contours in the given order.
    pub fn dense_column<S: Scalars<Number = N>>(
        &self,
        s: &S,
        c: usize,
        contours: &[usize],
    ) -> Vec<N> {
        let column = &self.columns[c];
        let mut out = vec![N::default(); self.dim * contours.len()];
        for (row, &k) in contours.iter().enumerate() {
            if let Some(forward) = self.contours[k].direction_of(column.joint) {
                for (o, t) in out[row * self.dim..].iter_mut().zip(&column.twist) {
                    *o = if forward {
                        t.clone()
                    } else {
                        s.sub(N::default(), t.clone())
                    };
                }
            }
        }
        out
    }

    /// Returns the dense J, as a list of columns.
    pub fn dense_columns<S: Scalars<Number = N>>(&self, s: &S) -> Vec<Vec<N>> {
        let all: Vec<usize> = (0..self.contours.len()).collect();
        let mut columns: Vec<Vec<N>> = (0..self.columns.len())
            .map(|c| self.dense_column(s, c, &all))
            .collect();
        for coupling in &self.couplings {
            columns.iter_mut().for_each(|c| c.push(N::default()));
            for (c, entry) in &coupling.entries {
                if let Some(last) = columns[*c].last_mut() {
                    *last = entry.clone();
                }
            }
        }
        columns
    }

    /// Returns, for each column, the twist of a link when the joint moves at unit speed along the path from the frame.
    /// These are rows of "the motion of `link`", one list of `dim` numbers per column.
    pub fn link_motion<S: Scalars<Number = N>>(
        &self,
        s: &S,
        mechanism: &Mechanism,
        link: LinkId,
    ) -> Vec<Vec<N>> {
        self.motion_along(s, &path_from_frame(mechanism, self.state, link))
    }

    /// Returns the motions of several links, as `link_motion` does for one.
    pub(crate) fn link_motions<S: Scalars<Number = N>>(
        &self,
        s: &S,
        mechanism: &Mechanism,
        links: &[LinkId],
    ) -> Vec<Vec<Vec<N>>> {
        let tree = spanning_tree(mechanism, self.state);
        let each = links.iter();
        each.map(|&l| self.motion_along(s, &path_in(&tree, l)))
            .collect()
    }

    /// Returns the contribution of each column to the motion of the link at the end of a path.
    fn motion_along<S: Scalars<Number = N>>(&self, s: &S, path: &[(JointId, bool)]) -> Vec<Vec<N>> {
        self.columns
            .iter()
            .map(|c| match path.iter().find(|(j, _)| *j == c.joint) {
                Some((_, true)) => c.twist.clone(),
                Some((_, false)) => c
                    .twist
                    .iter()
                    .map(|t| s.sub(N::default(), t.clone()))
                    .collect(),
                None => vec![N::default(); self.dim],
            })
            .collect()
    }
}

/// Returns the rows of a state's couplings.
fn coupling_rows<N: Clone + Default + PartialEq, S: Scalars<Number = N>>(
    s: &S,
    mechanism: &Mechanism,
    state: StateId,
    columns: &[Column<N>],
) -> Result<Vec<CouplingRow<N>>, ExactError> {
    let mut rows = Vec::new();
    for coupling in mechanism.couplings_in(state) {
        let at = coupling.ends.map(|e| {
            columns
                .iter()
                .position(|c| (c.joint, c.freedom) == (e.joint, e.freedom))
        });
        // The importer ensures that coupled freedoms exist.
        if let [Some(a), Some(b)] = at {
            let first = s.eval(&coupling_coefficient(mechanism, coupling))?;
            rows.push(CouplingRow {
                entries: [(a, first), (b, s.eval(&Expr::from(1))?)],
            });
        }
    }
    Ok(rows)
}
