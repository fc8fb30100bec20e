//! `ozols verify`, and the certificates that `ozols analyze` writes for it.

use crate::cli::prelude::*;
use crate::rank::exact::certificate::{certify_state, closure_matrix, number_field};
use crate::verify::certificate::{CertificateFile, FORMAT, Without};
use crate::verify::check_certificate;
use std::io::Write;

#[derive(Debug, ClapArgs)]
pub(crate) struct Verify {
    #[command(flatten)]
    file: File,
    /// Certificates, as written by `ozols analyze FILE --certificate CERTIFICATES`.
    #[arg(value_name = "CERTIFICATES")]
    certificates: PathBuf,
    /// The certificates were made with `analyze --planar`.
    #[arg(long)]
    planar: bool,
}

/// Maximum size of a file of certificates, in bytes.
const MOST: usize = 64 << 20;

/// Writes a certificate for each state that has one. A certificate proves the rank as written, so there is none if another
/// geometry was analysed.
pub(crate) fn write_certificates(
    path: &Path,
    m: &Mechanism,
    states: &[StateId],
    found: &[StateAnalysis],
) -> anyhow::Result<()> {
    let mut file = CertificateFile {
        format: FORMAT.to_owned(),
        mechanism: m.name.clone(),
        certificates: Vec::new(),
        without: Vec::new(),
    };
    for (&state, s) in states.iter().zip(found) {
        let certificate = if s.as_written.is_some() || s.at_most().is_some() {
            Err("a certificate needs the geometry as written, and rounded coordinates represent another; write roots or expressions".to_owned())
        } else if m.has_pi() {
            Err("a certificate needs exact numbers, and a pitch contains digits of pi".to_owned())
        } else {
            certify_state(m, state).map_err(|reason| reason.to_string())
        };
        match certificate {
            Ok(c) if c.rank != s.rank => bail!(
                "the rank of state {} is {}, but a checked certificate proves {}; report this with the file",
                c.state,
                s.rank,
                c.rank
            ),
            Ok(certificate) => file.certificates.push(certificate),
            Err(reason) => {
                let state = m.states[state].clone();
                let _ = writeln!(
                    std::io::stderr().lock(),
                    "note: no certificate of state {state}: {reason}"
                );
                file.without.push(Without { state, reason });
            }
        }
    }
    output::write_bytes(Some(path), serde_json::to_string(&file)? + "\n")?;
    Ok(())
}

pub(crate) fn run_verify(_: &Global, a: &Verify) -> anyhow::Result<Done> {
    let mut m = load::load_mechanism(&a.file)?;
    if a.planar {
        load::put_in_plane(&mut m)?;
    }
    let name = a.certificates.display();
    let bytes =
        disk::at_most(&a.certificates, MOST).with_context(|| format!("cannot read {name}"))?;
    let file = CertificateFile::read(&bytes).with_context(|| format!("cannot read {name}"))?;
    let mut lines = Vec::new();
    let mut done = Done::found_or_nothing(!file.certificates.is_empty());
    for certificate in &file.certificates {
        let Some(state) = m.state_named(&certificate.state) else {
            bail!(
                "{name} is about a state {}; {} has: {}",
                certificate.state,
                m.name,
                m.states.join(", ")
            )
        };
        let field = number_field(&m, state)?;
        let (rows, columns) = (certificate.rows, certificate.columns);
        lines.push(
            match check_certificate(&closure_matrix(&field, &m, state)?, certificate) {
                Ok(rank) => format!(
                    "{}, state {}: rank {rank} of the {rows} x {columns} closure matrix is proven",
                    m.name, certificate.state
                ),
                Err(flaw) => {
                    done = Done::Nothing;
                    format!(
                        "{}, state {}: certificate rejected: {flaw}",
                        m.name, certificate.state
                    )
                }
            },
        );
    }
    for Without { state, reason } in &file.without {
        lines.push(format!(
            "{}, state {state}: no certificate: {reason}",
            m.name
        ));
    }
    let lines: String = lines.iter().map(|l| format!("{l}\n")).collect();
    output::write_bytes(None, lines)?;
    Ok(done)
}
