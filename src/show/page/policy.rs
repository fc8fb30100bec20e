//! How every page looks, and its content security policy: its own script and styles are allowed, each by its hash, and nothing else is.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use itertools::Itertools;
use sha2::{Digest, Sha256};

pub(super) const STYLE: &str = concat!(include_str!("look.css"), include_str!("page.css"));

/// The placeholder of the policy until everything that it allows is written.
pub(super) const POLICY: &str = "default-src 'none'";

/// Returns the page with the policy that allows its scripts and styles, in place of the first `stand_in`. Text of mechanisms
/// is already escaped, so that every element found here belongs to the page.
pub(super) fn with_policy(page: &str, stand_in: &str) -> String {
    let (styles, scripts) = (
        element_hashes(page, "style"),
        element_hashes(page, "script"),
    );
    let policy = format!("{stand_in}; style-src {styles}; script-src {scripts}");
    page.replacen(stand_in, &policy, 1)
}

/// Returns the hashes of all elements of a name, each one once.
fn element_hashes(page: &str, element: &str) -> String {
    let (begin, end) = (format!("<{element}"), format!("</{element}>"));
    let inside = page.split(&begin).skip(1).filter_map(|after| {
        let (tag, inside) = after.split_once('>')?;
        // Data is not run.
        let data = tag.contains("application/json");
        (!data).then(|| inside.split(&end).next().unwrap_or(inside))
    });
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    inside.map(hash).unique().join(" ")
}

#[cfg(test)]
mod tests {
    use super::with_policy;

    #[test]
    fn scripts_and_styles_are_allowed_by_their_hashes() {
        let page = "<meta content=\"P\"><style>a</style><script type=\"application/json\">1</script><script>a</script>";
        // printf a | openssl dgst -sha256 -binary | base64
        let a = "'sha256-ypeBEsobvcr6wjGzmiPcTaeG7/gUfE5yuYB3ha/uSLs='";
        assert!(with_policy(page, "P").starts_with(&format!(
            "<meta content=\"P; style-src {a}; script-src {a}\">"
        )));
    }
}
