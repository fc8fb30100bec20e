//! All kinematic chains of a number of links and a mobility, each once.
//!
//! A chain is a contracted graph whose edges are strings of joints. The distributions of joints over each contracted graph are
//! found once up to its symmetries. So no two chains are isomorphic, and none needs to be compared.

pub(in crate::chains) mod contracted;
mod strings;

use crate::chains::chain::Chain;
use crate::chains::enumerate::contracted::contracted_graphs;
use crate::chains::enumerate::strings::Strings;
use crate::chains::graph6;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use thiserror::Error;

/// Reason why no chains are listed for some links and mobility.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ChainsError {
    /// The number of joints would not be whole.
    #[error(
        "no chain of {links} links has the mobility {mobility}: 3(n - 1) - 2e is {} then",
        if links % 2 == 0 { "odd" } else { "even" }
    )]
    Parity {
        /// Links.
        links: usize,
        /// Mobility.
        mobility: usize,
    },
    /// Beyond the supported range.
    #[error(
        "chains of {links} links and mobility {mobility} are not listed: take 4 to 18 links and a mobility of 1 to 6"
    )]
    Range {
        /// Links.
        links: usize,
        /// Mobility.
        mobility: usize,
    },
}

/// Calls `visit` with every chain of this number of links and mobility, in no particular order and from several threads.
///
/// Chains have no multiple joints and no rigid part. They stay connected without any one link, so that their mobility is not
/// the sum of two parts' (with a mobility of 1 this always holds).
///
/// # Errors
/// Returns an error if the chains do not exist or are too many.
///
/// # Complexity
/// Some microseconds per chain. Memory only for the contracted graphs.
///
/// # Examples
/// ```
/// use ozols::chains::enumerate::visit_chains;
/// use std::sync::atomic::{AtomicUsize, Ordering};
/// let count = AtomicUsize::new(0);
/// visit_chains(8, 1, &|chain| {
///     count.fetch_add(usize::from(chain.mobility() == 1), Ordering::Relaxed);
/// })?;
/// assert_eq!(count.into_inner(), 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn visit_chains(
    links: usize,
    mobility: usize,
    visit: &(impl Fn(&Chain) + Sync),
) -> Result<(), ChainsError> {
    if !(4..=18).contains(&links) || !(1..=6).contains(&mobility) {
        return Err(ChainsError::Range { links, mobility });
    }
    if (3 * (links - 1)) % 2 != mobility % 2 {
        return Err(ChainsError::Parity { links, mobility });
    }
    let Some(twice) = (3 * (links - 1)).checked_sub(mobility) else {
        return Ok(());
    };
    let joints = twice / 2;
    // A chain is connected, and a string has at most three joints more than the mobility it takes away.
    let Some(loops) = (joints + 1).checked_sub(links).filter(|l| *l > 0) else {
        return Ok(());
    };
    if loops == 1 {
        let ring = (0..links).map(|v| (v, (v + 1) % links));
        visit(&Chain::with_hinges(links, ring));
        return Ok(());
    }
    let most = u8::try_from(mobility + 2).unwrap_or(u8::MAX);
    contracted_graphs(loops).par_iter().for_each(|graph| {
        let strings = Strings::new(graph);
        strings.share_joints(joints, most, &mut |shared| {
            visit(&Chain::of_strings(graph.vertices(), &strings.ends, shared));
        });
    });
    Ok(())
}

/// Returns every chain in canonical numbering, in the order of their codes.
///
/// # Errors
/// Returns an error in the same cases as [`visit_chains`].
///
/// # Examples
/// ```
/// use ozols::chains::enumerate::list_chains;
/// let all = list_chains(6, 1)?; // Watt's and Stephenson's.
/// assert_eq!(all.len(), 2);
/// assert!(all.iter().all(|c| c.joints().len() == 7));
/// assert!(list_chains(5, 1).is_err()); // The joints would not be whole.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn list_chains(links: usize, mobility: usize) -> Result<Vec<Chain>, ChainsError> {
    let all = Mutex::new(Vec::new());
    visit_chains(links, mobility, &|chain| {
        let chain = chain.canonical_form().0;
        all.lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(chain);
    })?;
    let mut all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    all.par_sort_by_cached_key(graph6::write_graph);
    Ok(all)
}

/// Returns the number of chains.
///
/// # Errors
/// Returns an error in the same cases as [`visit_chains`].
///
/// # Examples
/// ```
/// // The chains of Watt and Stephenson.
/// assert_eq!(ozols::chains::enumerate::count_chains(6, 1).unwrap(), 2);
/// assert_eq!(ozols::chains::enumerate::count_chains(8, 1).unwrap(), 16);
/// ```
pub fn count_chains(links: usize, mobility: usize) -> Result<u64, ChainsError> {
    let count = AtomicU64::new(0);
    visit_chains(links, mobility, &|_| {
        count.fetch_add(1, Ordering::Relaxed);
    })?;
    Ok(count.into_inner())
}
