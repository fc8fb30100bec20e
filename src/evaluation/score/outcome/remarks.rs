//! Remarks on an outcome: why there are no variants, and which redesigns are symmetric.

use crate::score::outcome::Outcome;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::score::request::{Inserts, JointOptions, Request};
use crate::search::answer::why_none::{Hopeless, Relaxation, find_obstacles, find_relaxations};
use crate::search::diagram::ShouldCancel;
use crate::search::question::conditions::SearchError;
use crate::search::question::kept::Drives;
use num_bigint::BigUint;
use num_traits::{One, Zero};

/// Remarks on the variants of a search.
#[derive(Debug, Default)]
pub struct Remarks {
    /// What easing one condition would leave.
    pub eased: Vec<(Relaxation, BigUint)>,
    /// The request with more joint types at some joints that finds something.
    pub offered: Option<Request>,
    /// The reasons that exclude every variant.
    pub hopeless: Hopeless,
    /// The cheapest symmetric redesigns of a symmetric mechanism.
    pub symmetric: Option<SymmetricBest>,
}

impl Remarks {
    /// Returns the joint types that another request offers besides those of the one that found nothing.
    pub fn offered_options<'r>(&'r self, asked: &Request) -> &'r [JointOptions] {
        let allow = self.offered.as_ref().map(|r| &r.allow[..]);
        allow.map_or(&[], |all| &all[asked.allow.len()..])
    }

    /// Returns the joints in series that it offers besides those.
    pub fn offered_unloading<'r>(&'r self, asked: &Request) -> &'r [Inserts] {
        let inserts = self.offered.as_ref().map(|r| &r.unloading[..]);
        inserts.map_or(&[], |all| &all[asked.unloading.len()..])
    }
}

/// Returns a request with one condition eased.
///
/// # Examples
/// ```
/// use ozols::{score::outcome::remarks::ease_request, search::answer::why_none::Relaxation};
/// let eased = ease_request(&ozols::Request::default(), Relaxation::Redundant(1));
/// assert_eq!(eased.max_redundant, 1);
/// ```
pub fn ease_request(request: &Request, how: Relaxation) -> Request {
    let mut out = request.clone();
    match how {
        Relaxation::Redundant(n) => out.max_redundant = n,
        Relaxation::External(n) => out.max_external = Some(n),
        Relaxation::Harmful(n) => out.max_harmful = Some(n),
        Relaxation::Mobility(n) => out.max_mobility = Some(n),
        Relaxation::Changes(n) => out.max_changes = Some(n),
        Relaxation::OutputChange => out.allow_output_change = true,
        Relaxation::FreeDrives => out.drives = Some(Drives::Free),
        Relaxation::LooseObject => out.allow_loose_object = true,
        Relaxation::PoseOnly => out.pose_only = true,
    }
    out
}

impl Outcome {
    /// Returns the remarks on the variants. If all that were found keep the motion in the drawn pose only, one remark gives
    /// their number. If `cancelled` returns true, the searches for remarks end early.
    ///
    /// # Errors
    /// Returns an error if the geometry has no exact image.
    ///
    /// # Complexity
    /// If nothing was found, a search for each condition and each step of relaxing it. None has more than some thousand nodes.
    ///
    /// # Examples
    /// ```
    /// let few = ozols::Request { max_changes: Some(1), ..Default::default() };
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &few)?;
    /// assert_eq!(outcome.admissible.to_string(), "0");
    /// assert!(!outcome.make_remarks(&|| false)?.eased.is_empty()); // More changes would do.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn make_remarks(&self, cancelled: ShouldCancel<'_>) -> Result<Remarks, SearchError> {
        let (search, in_pose) = (&self.search, &self.admissible.total);
        let none = in_pose.is_zero() && !self.admissible_may_be_more();
        let (mut eased, mut hopeless) = (Vec::new(), Hopeless::default());
        if self.numeric.is_none() && self.listed_counts().total.is_zero() {
            if !in_pose.is_zero() {
                eased.push((Relaxation::PoseOnly, in_pose.clone()));
            } else if !search.size().is_one() {
                let nodes = self.diagrams.as_ref().map_or(0, |d| d.admissible.nodes);
                eased = find_relaxations(search, nodes, cancelled)?;
            }
            if in_pose.is_zero() {
                hopeless = find_obstacles(search)?;
            }
        }
        Ok(Remarks {
            eased,
            offered: none.then(|| self.would_help()).flatten(),
            hopeless,
            symmetric: self.symmetric_best(cancelled)?,
        })
    }
}
