//! Whether the best redesigns of a sample are all that share the first place.

use crate::search::beyond_budget::ladder;
use crate::sweep::{asked, sweep};
use ozols::Request;
use ozols::file::text::mechanism_from_str;
use ozols::score::request::{Check, List};
use ozols::sweep::SweepRequest;
use ozols::sweep::redesigns::SampleRedesigns;
use ozols::sweep::space::Sampling;

/// A parameter that moves a mark and nothing else.
fn marked(text: &str) -> String {
    format!(
        "{text}[parameter]\nz = {{ range = [0, 1] }}\n[[point]]\nid = \"p\"\nlink = \"1\"\npoint = [0, 0, \"z\"]\n"
    )
}

fn redesigns(text: &str, request: Request) -> SampleRedesigns {
    let asked = SweepRequest {
        search: Some(request),
        ..asked()
    };
    let sweep = sweep(&marked(text), Sampling::Grid { points: 2 }, asked);
    let row = sweep.row(&sweep.space.sample(0));
    row.redesigns.unwrap().get().unwrap().clone()
}

/// By hand: a ring of parallel hinges holds the slide along them and two tilts twice, which a cylindrical joint and a ball at two of
/// them let go: n (n - 1) ways that cost the same. More than a hundred are not all told, and so not proven to be all.
#[test]
fn a_first_place_that_too_many_share_is_not_proven() {
    let ring = |n: usize| {
        let mut text = "name = \"ring\"\nsearch = { options = [\"revolute\", \"cylindrical\", \"spherical\"] }\n".to_owned();
        for i in 0..n {
            let role = ["role = \"frame\"", "role = \"output\"", ""][i.min(2)];
            text += &format!("[[link]]\nid = \"{i}\"\n{role}\n");
        }
        for i in 0..n {
            let (next, x, y) = ((i + 1) % n, i * i * 7 % 101, i * i * i * 3 % 97);
            text += &format!(
                "[[joint]]\nid = \"j{i}\"\nlinks = [\"{i}\", \"{next}\"]\ntype = \"revolute\"\npoint = [{x}, {y}, 0]\naxis = [0, 0, 1]\n"
            );
        }
        text
    };
    for (n, told, proven) in [(7, 42, true), (10, 90, true), (11, 100, false)] {
        let found = redesigns(&ring(n), Request::default());
        assert_eq!((found.best.len(), found.proven), (told, proven), "{n}");
        assert!(found.exact);
    }
}

/// In few nodes the cheapest are known up to some cost: the first is proven where it costs no more than that.
#[test]
fn the_first_is_proven_where_all_of_its_cost_are_known() {
    let mut at_the_limit = 0;
    for (contours, nodes) in [
        (4, 40),
        (4, 60),
        (4, 90),
        (5, 60),
        (5, 120),
        (5, 240),
        (5, 480),
        (6, 300),
    ] {
        let text = ladder(contours, 3, false);
        let request = Request {
            nodes,
            ..Request::default()
        };
        let found = redesigns(&text, request.clone());
        // As the sweep asks: more than all that share a first place may be.
        let asked = Request {
            list: List::Top(101),
            check: Check::Prime,
            ..request
        };
        let m = mechanism_from_str("ladder.toml", &marked(&text)).unwrap();
        let outcome = ozols::search(&m, &asked).unwrap();
        let costs: Vec<i64> = outcome.variants().map(|v| v.cost_milli()).collect();
        let Some(&first) = costs.first() else {
            continue;
        };
        let tied = costs.iter().filter(|c| **c == first).count();
        let known = outcome.known_up_to().is_some_and(|k| first <= k);
        assert_eq!(found.proven, known && tied <= 100, "{contours} {nodes}");
        at_the_limit += usize::from(outcome.known_up_to() == Some(first) && found.proven);
    }
    assert!(at_the_limit > 0);
}
