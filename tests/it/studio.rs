//! `ozols studio`: who is let in, what is kept of a file, and that nothing is lost.
#![cfg(unix)]

mod desk;
mod door;
mod edits;
mod served;
mod work;
