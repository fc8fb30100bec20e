//! `ozols report`.
