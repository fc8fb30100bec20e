//! Finished values as JSON and as text for people.

pub mod accuracy;
pub mod analysis;
pub mod clamped;
pub mod drive_charts;
pub mod drive_json;
pub mod drive_text;
pub mod grip_charts;
pub mod grip_json;
pub mod grip_text;
pub mod idle;
pub mod layout;
pub mod mechanism;
pub mod mobility;
pub mod next;
pub mod ranking;
pub mod reactions_cycle;
pub mod reactions_data;
pub mod reactions_text;
pub mod search_json;
pub mod search_text;
pub mod statics_charts;
pub mod statics_data;
pub mod statics_text;
pub mod statics_words;
pub mod stroke;
pub mod suggestions;
