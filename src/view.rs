//! Finished values as JSON and as text for people.

pub mod accuracy_text;
pub mod analysis_json;
pub mod analysis_text;
pub mod drive;
pub mod grip;
pub mod layout;
pub mod mechanism_text;
pub mod next;
mod prefix;
pub mod ranking;
pub mod reactions;
pub mod search_json;
pub mod search_text;
pub mod statics;
pub mod stroke;
pub mod suggestions;
pub mod words;
