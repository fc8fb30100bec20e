//! Finished values as JSON and as text for people.

pub mod analysis_json;
pub mod analysis_text;
pub mod ranking;
pub mod reactions_data;
pub mod reactions_text;
pub mod search_json;
pub mod search_text;
pub mod statics_charts;
pub mod statics_data;
pub mod statics_text;
pub mod statics_words;
pub mod words;
