//! `ozols export`.

use super::args::{Args, Export};
use super::{Done, load, output, variant};
use crate::robots::formats;

pub(super) fn run(_: &Args, a: &Export) -> anyhow::Result<Done> {
    let mut m = load::mechanism(&a.file.file)?;
    if let Some(k) = a.variant {
        m = variant::kth(&mut m, &a.question, a.state.as_deref(), k, |search, v| {
            variant::mechanism(search, v, k)
        })?;
    }
    let text = formats::write(&m, &a.to)?;
    output::to(a.output.as_deref(), |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })
}
