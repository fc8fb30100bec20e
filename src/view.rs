//! Finished values as JSON and as text for people.

pub mod accuracy;
pub mod analysis;
pub mod bench;
pub mod catalog;
pub mod conditions;
#[cfg(feature = "cli")]
pub mod costs;
pub mod drive;
pub mod early;
pub mod grip;
pub mod idle;
pub mod layout;
pub mod least_rows;
pub mod lint;
pub mod mechanism;
pub mod mobility;
pub mod next;
pub mod numeric;
mod prefix;
pub mod ranking;
pub mod reactions;
pub mod search_csv;
pub mod search_data;
pub mod search_json;
pub mod search_text;
pub mod second_opinion;
pub mod statics;
pub mod stroke;
#[cfg(feature = "cli")]
pub mod structures;
pub mod suggestions;
pub mod sweep;
pub mod variant_data;
mod variant_table;
