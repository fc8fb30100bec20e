//! Class, order and kind of an Assur group.

use crate::closure::contour::shortest_cycle_basis;
use crate::statics::planar::{BodyId, PairId, PairKind, PlanarMechanism};
use std::fmt;

/// The structural kind of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One body with only rigid or doubled pairs.
    Single,
    /// Two bodies, with its species 1 to 5 (RRR, RRP, RPR, PRP, RPP), 6 for PPP, which is not determinate.
    Dyad(u8),
    /// A body with three pairs and a leash on each.
    Triad,
    /// Two bodies with three pairs and two with two between them, in a closed contour: `[Bychkov, Dvornikov & Zhukov
    /// 2018]`.
    FourLinkContour,
    /// Any other group.
    Other,
}

/// Class, order and kind of a group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AssurClass {
    /// The largest number of pairs around one contour of the group, at least 2. A body with k pairs is a rigid contour of k pairs; bodies
    /// joined in a ring are a changeable contour.
    pub class: usize,
    /// Number of outer pairs.
    pub order: usize,
    /// Numbers of bodies with two, three, four, ... pairs.
    pub composition: Vec<usize>,
    /// Independent closed contours of the group.
    pub contours: usize,
    /// The structural kind.
    pub kind: Kind,
}

/// Returns a class in Roman numerals, as is usual in the field.
///
/// # Examples
/// ```
/// use ozols::statics::assur_class::roman_numeral;
/// assert_eq!(roman_numeral(4), "IV");
/// ```
#[must_use]
pub fn roman_numeral(class: usize) -> String {
    const ROMAN: [&str; 13] = [
        "0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII",
    ];
    ROMAN
        .get(class)
        .map_or_else(|| class.to_string(), |r| (*r).to_owned())
}

impl fmt::Display for AssurClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "class {}, order {}",
            roman_numeral(self.class),
            self.order
        )?;
        match self.kind {
            Kind::Dyad(species) => {
                const NAMES: [&str; 6] = ["RRR", "RRP", "RPR", "PRP", "RPP", "PPP"];
                let name = NAMES.get(usize::from(species).wrapping_sub(1));
                write!(f, ", dyad {}", name.unwrap_or(&"?"))
            }
            Kind::Triad => f.write_str(", triad"),
            Kind::FourLinkContour => f.write_str(", four links in a closed contour"),
            Kind::Single | Kind::Other => Ok(()),
        }
    }
}

/// Classifies a group by Assur and Artobolevsky: the class is that of its highest contour, the order its number of
/// outer pairs. Changeable contours are those of a shortest basis.
///
/// # Complexity
/// O(n·p²) for n bodies and p pairs of the group.
///
/// # Sources
/// I. I. Artobolevsky, "Theory of Mechanisms and Machines", 4th ed., 1988.
#[must_use]
pub(crate) fn classify_group(
    m: &PlanarMechanism,
    blocks: &[Vec<BodyId>],
    inner: &[PairId],
    outer: &[PairId],
) -> AssurClass {
    let block = |body: BodyId| blocks.iter().position(|b| b.contains(&body));
    let mut degree = vec![0usize; blocks.len()];
    let mut edges = Vec::new();
    for &p in inner.iter().chain(outer) {
        let ends = m.pairs[p].bodies.map(block);
        for b in ends.into_iter().flatten() {
            degree[b] += 1;
        }
        if let [Some(a), Some(b)] = ends {
            edges.push([a, b]);
        }
    }
    let contours = shortest_cycle_basis(blocks.len(), &edges);
    let changeable = contours.iter().map(Vec::len).max().unwrap_or(0);
    let rigid = degree.iter().copied().max().unwrap_or(0);
    let mut composition: Vec<usize> = Vec::new();
    for &d in &degree {
        let place = d.saturating_sub(2);
        composition.resize(composition.len().max(place + 1), 0);
        composition[place] += 1;
    }
    AssurClass {
        class: rigid.max(changeable).max(2),
        order: outer.len(),
        composition,
        contours: (edges.len() + 1).saturating_sub(blocks.len()),
        kind: group_kind(m, blocks, inner, outer, &degree, &edges),
    }
}

fn group_kind(
    m: &PlanarMechanism,
    blocks: &[Vec<BodyId>],
    inner: &[PairId],
    outer: &[PairId],
    degree: &[usize],
    edges: &[[usize; 2]],
) -> Kind {
    let with = |d: usize| degree.iter().filter(|&&x| x == d).count();
    match (blocks.len(), inner.len(), outer.len()) {
        (1, _, _) => Kind::Single,
        (2, 1, 2) => {
            let slides = |p: &PairId| m.pairs[*p].kind == PairKind::Sliding;
            let species = match (
                outer.iter().filter(|p| slides(p)).count(),
                slides(&inner[0]),
            ) {
                (0, false) => 1,
                (1, false) => 2,
                (0, true) => 3,
                (2, false) => 4,
                (1, true) => 5,
                _ => 6,
            };
            Kind::Dyad(species)
        }
        (4, 3, 3) if with(3) == 1 && with(2) == 3 => Kind::Triad,
        (4, 4, 2) if with(3) == 2 && with(2) == 2 => {
            // Each inner pair joins a body of three to a body of two, and no two bodies are joined twice.
            let mixed = edges.iter().all(|&[a, b]| degree[a] != degree[b]);
            let key = |&[a, b]: &[usize; 2]| (a.min(b), a.max(b));
            let mut sorted: Vec<_> = edges.iter().map(key).collect();
            sorted.sort_unstable();
            sorted.dedup();
            if mixed && sorted.len() == 4 {
                Kind::FourLinkContour
            } else {
                Kind::Other
            }
        }
        _ => Kind::Other,
    }
}
