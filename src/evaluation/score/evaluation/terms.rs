//! The scores of one variant, and lower bounds on the terms of a ranking.

use crate::model::mechanism::{JointId, LinkId, Mechanism, Role};
use crate::model::ranking::{ClearanceSum, Ranking, Term};
use crate::score::evaluation::load_cases::Cases;

/// A joint that bears the greatest part of its capacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Reaction over capacity.
    pub utilisation: f64,
    /// The reaction there `[N]` or `[N·m]`.
    pub value: f64,
    /// The joint of the mechanism; an unloading joint counts as the one it is in series with.
    pub joint: JointId,
}

impl Peak {
    pub(in crate::score) const NONE: Peak = Peak {
        utilisation: 0.0,
        value: 0.0,
        joint: JointId::new(0),
    };

    /// Raises the peak to a value, unless it is as large already.
    pub(in crate::score) fn raise_peak(&mut self, value: f64, capacity: f64, joint: JointId) {
        let utilisation = value / capacity;
        if utilisation > self.utilisation {
            *self = Peak {
                utilisation,
                value,
                joint,
            };
        }
    }
}

/// The scores of a variant, the worst over the examined poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scores {
    /// Greatest force over capacity.
    pub force: Peak,
    /// Greatest moment over capacity.
    pub moment: Peak,
    /// Smallest over greatest singular value, drives held.
    pub conditioning: f64,
    /// Position error of the outputs `[m]`.
    pub output_error: f64,
    /// Changes.
    pub changes: u32,
    /// Cost in thousandths.
    pub cost_milli: i64,
    /// Mobility beyond the working one.
    pub idle: i64,
    /// Harmful redundant constraints that the searched state adds.
    pub harmful: u32,
    /// Root mean square of the assembly force at the most loaded joint `[N]`; 0 without redundant constraints.
    pub misfit: f64,
    /// Whether redundant constraints are left, so that reactions are those of minimum norm.
    pub minimum_norm: bool,
}

impl Scores {
    /// Returns the figure of a term as it is reported: utilisations, a ratio, metres, counts.
    pub fn term_value(&self, term: Term) -> f64 {
        match term {
            Term::PeakForce => self.force.utilisation,
            Term::PeakMoment => self.moment.utilisation,
            Term::Conditioning => self.conditioning,
            Term::OutputError => self.output_error,
            Term::Changes => f64::from(self.changes),
            Term::Cost => self.cost_milli as f64 / 1000.0,
            Term::Idle => self.idle as f64,
            Term::Harmful => f64::from(self.harmful),
            Term::Misfit => self.misfit,
        }
    }

    /// Returns the joint with the largest share of its capacity, if the term is a peak.
    pub fn term_peak(&self, term: Term) -> Option<&Peak> {
        match term {
            Term::PeakForce => Some(&self.force),
            Term::PeakMoment => Some(&self.moment),
            _ => None,
        }
    }

    /// Returns the figure as text for a list: measured ones with four decimals, lengths in millimetres.
    pub fn term_cell(&self, term: Term) -> String {
        let (about, value) = (term.about(), self.term_value(term));
        if about.is_count {
            value.to_string()
        } else {
            format!("{:.4}", about.scale * value)
        }
    }

    /// Returns the contribution of a term to a weighted sum; smaller is better. It is the figure, for conditioning minus its decimal
    /// logarithm, and for the output error millimetres. Measured figures count to eleven digits, because rounding must not sort
    /// mirror images.
    pub fn term_loss(&self, term: Term) -> f64 {
        let coarse = |x: f64| f64::from_bits((x.to_bits() + 0x8000) & !0xffff);
        let about = term.about();
        match term {
            Term::Conditioning => coarse(-self.conditioning.max(1e-300).log10()),
            Term::Cost => self.term_value(term),
            _ if about.is_count => self.term_value(term),
            _ => coarse(about.scale * self.term_value(term)),
        }
    }

    /// Returns Σ weight · loss.
    pub fn weighted_sum(&self, ranking: &Ranking) -> f64 {
        let terms = ranking.terms.iter();
        terms
            .map(|&(term, weight)| weight * self.term_loss(term))
            .sum()
    }

    /// Returns true if the figures are within all limits of a ranking.
    pub fn within_limits(&self, ranking: &Ranking) -> bool {
        ranking.limits.iter().all(|l| {
            let x = self.term_value(l.term);
            l.min.is_none_or(|min| x >= min) && l.max.is_none_or(|max| x <= max)
        })
    }

    /// Takes the worse figures of two poses.
    pub(in crate::score) fn take_worse(&mut self, other: &Scores) {
        if other.force.utilisation > self.force.utilisation {
            self.force = other.force;
        }
        if other.moment.utilisation > self.moment.utilisation {
            self.moment = other.moment;
        }
        self.conditioning = self.conditioning.min(other.conditioning);
        self.output_error = self.output_error.max(other.output_error);
        self.minimum_norm |= other.minimum_norm;
    }
}

/// Returns a point of each output link, in the file's unit: the point of its first force, its mass centre if it has no force, or its
/// first joint.
pub fn output_points(m: &Mechanism, cases: &Cases) -> Vec<(LinkId, [f64; 3])> {
    let outputs = m.link_ids().filter(|&l| m.links[l].role == Role::Output);
    let each = outputs.filter_map(|l| {
        let mut forces = cases.list.iter().flat_map(|c| &c.loads.forces);
        let force = forces.find(|f| f.link == l).map(|f| &f.point);
        let mass = m.links[l].mass.as_ref().map(|x| &x.centre);
        let joint = m.joints.iter().find(|j| j.links.contains(&l));
        let p = force.or(mass).or(joint.map(|j| &j.frame.point))?;
        Some((l, [p[0].to_f64(), p[1].to_f64(), p[2].to_f64()]))
    });
    each.collect()
}

/// Adds up what clearances do to one output, from the joints' forces under a unit force on it along each axis: by virtual
/// work, a joint off by d moves the output by d·f along the axis.
///
/// The worst case is every joint off along its force, axis by axis, and the root of the sum of squares over the axes: an
/// upper bound. The mean square is for joints off by their clearance in independent random directions.
#[derive(Debug, Clone, Copy)]
pub(in crate::score) struct ErrorSum {
    how: ClearanceSum,
    square: f64,
    axis: f64,
}

impl ErrorSum {
    pub(in crate::score) fn new(how: ClearanceSum) -> ErrorSum {
        ErrorSum {
            how,
            square: 0.0,
            axis: 0.0,
        }
    }

    /// Adds a joint's clearance `[m]` with the square of its force.
    pub(in crate::score) fn add_joint(&mut self, clearance: f64, force_square: f64) {
        match self.how {
            ClearanceSum::Worst => self.axis += clearance * force_square.sqrt(),
            ClearanceSum::Rms => self.axis += clearance * clearance * force_square / 3.0,
        }
    }

    /// Finishes an axis.
    pub(in crate::score) fn end_axis(&mut self) {
        self.square += match self.how {
            ClearanceSum::Worst => self.axis * self.axis,
            ClearanceSum::Rms => self.axis,
        };
        self.axis = 0.0;
    }

    pub(in crate::score) fn output_error(&self) -> f64 {
        self.square.sqrt()
    }
}

/// Lower bounds on terms, for every variant of a search.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Floor {
    /// On the greatest force over capacity.
    pub force: f64,
    /// On the greatest moment over capacity.
    pub moment: f64,
    /// On the error of the outputs `[m]`.
    pub output_error: f64,
}

impl Floor {
    /// Returns Σ weight · bound over the terms except cost. Terms without a bound are at least 0.
    pub fn weighted_sum(&self, ranking: &Ranking) -> f64 {
        ranking.terms.iter().map(|&(t, w)| w * self.of(t)).sum()
    }

    /// Returns the bound on the contribution of a term to a sum.
    pub(in crate::score) fn of(&self, term: Term) -> f64 {
        match term {
            Term::PeakForce => self.force,
            Term::PeakMoment => self.moment,
            Term::OutputError => 1e3 * self.output_error,
            // A determinate variant assembles without force.
            Term::Conditioning
            | Term::Changes
            | Term::Cost
            | Term::Idle
            | Term::Harmful
            | Term::Misfit => 0.0,
        }
    }
}
