//! `ozols studio`: who is let in, what is kept of a file, and that nothing is lost.
#![cfg(unix)]

mod anything;
mod desk;
mod door;
mod edits;
mod served;
mod work;
