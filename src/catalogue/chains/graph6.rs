//! Chains in graph6, the usual text form of small graphs. It has the number of vertices and the columns of the upper half of the adjacency
//! matrix, six bits per character.

use crate::chains::chain::Chain;
use thiserror::Error;

/// Maximum number of links of a chain.
const MOST_LINKS: usize = 20;

/// Code of the character that represents 0.
const FIRST: u8 = 63;

/// Reason why a text is not a chain.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Graph6Error {
    /// A character outside graph6.
    #[error("{0:?} is not a character of graph6, which has those from ? to ~")]
    Character(char),
    /// Too many vertices, or none.
    #[error("chains have 1 to {MOST_LINKS} links, and this is a graph of {0}")]
    Links(usize),
    /// The wrong number of characters for the number of vertices.
    #[error(
        "a graph of {links} vertices has {wanted} characters in graph6, and this text has {found}"
    )]
    Length {
        /// Vertices.
        links: usize,
        /// Expected number of characters.
        wanted: usize,
        /// Number of characters found.
        found: usize,
    },
}

/// Returns the text of a chain in its current numbering.
///
/// # Examples
/// ```
/// use ozols::chains::{chain::Chain, graph6::write_graph};
/// let triangle = Chain::with_hinges(3, [(0, 1), (1, 2), (2, 0)]);
/// assert_eq!(write_graph(&triangle), "Bw");
/// ```
#[must_use]
pub fn write_graph(chain: &Chain) -> String {
    let n = chain.links();
    let bits: Vec<bool> = (0..n)
        .flat_map(|v| (0..v).map(move |u| chain.is_joined(u, v)))
        .collect();
    let six = |group: &[bool]| {
        let value = |at: usize| u8::from(group.get(at).copied().unwrap_or(false)) << (5 - at);
        char::from(FIRST + (0..6).map(value).sum::<u8>())
    };
    let head = char::from(FIRST + u8::try_from(n).unwrap_or(0));
    std::iter::once(head)
        .chain(bits.chunks(6).map(six))
        .collect()
}

/// Returns the chain of hinges that a text represents.
///
/// # Errors
/// Returns an error if the text is not graph6, or if its graph has another size than chains have.
///
/// # Examples
/// ```
/// use ozols::chains::enumerate::list_chains;
/// use ozols::chains::graph6;
/// let watt = &list_chains(6, 1).unwrap()[0];
/// let again = graph6::read_graph(&graph6::write_graph(watt)).unwrap();
/// assert_eq!(graph6::write_graph(&again), graph6::write_graph(watt));
/// ```
pub fn read_graph(text: &str) -> Result<Chain, Graph6Error> {
    let wrong = text.chars().find(|c| !('?'..='~').contains(c));
    if let Some(c) = wrong {
        return Err(Graph6Error::Character(c));
    }
    let mut values = text.bytes().map(|b| b - FIRST);
    let n = usize::from(values.next().unwrap_or(0));
    if n == 0 || n > MOST_LINKS {
        return Err(Graph6Error::Links(n));
    }
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|v| (0..v).map(move |u| (u, v))).collect();
    let wanted = 1 + pairs.len().div_ceil(6);
    if text.len() != wanted {
        let found = text.len();
        return Err(Graph6Error::Length {
            links: n,
            wanted,
            found,
        });
    }
    let bits = values.flat_map(|x| (0..6).map(move |at| x >> (5 - at) & 1 == 1));
    let joints = pairs.into_iter().zip(bits).filter(|(_, joined)| *joined);
    Ok(Chain::with_hinges(n, joints.map(|(pair, _)| pair)))
}
