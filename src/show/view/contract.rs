//! JSON that says which contract it keeps.

use serde::Serialize;

/// The number of the contract of all JSON that the commands print. It is raised when a key goes or means something else; keys that
/// come are no new contract.
pub const FORMAT: u32 = 1;

/// A value as JSON for people to read and programs to parse; an object with `format`, the number of the contract, first.
///
/// # Errors
/// Where a key is no text.
///
/// # Examples
/// ```
/// #[derive(serde::Serialize)]
/// struct Rank {
///     rank: usize,
/// }
/// let text = ozols::view::contract::pretty(&Rank { rank: 12 }).unwrap();
/// assert_eq!(text, "{\n  \"format\": 1,\n  \"rank\": 12\n}");
/// ```
pub fn pretty(value: &impl Serialize) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(value)?;
    Ok(match text.strip_prefix("{\n") {
        Some(rest) => format!("{{\n  \"format\": {FORMAT},\n{rest}"),
        None => text,
    })
}
