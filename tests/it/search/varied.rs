//! Random mechanisms of more kinds than `twin` draws, against its oracle: planar mode, held links, helical and custom
//! joints, mirror images, limits on W and on changes; and the two checks of the search on all of them.

use crate::common::*;
use crate::fuzz::readers::differential::assert_as_the_twins;
use crate::search::twin::{Twin, all_variants, look_at_variant};
use ozols::search::answer::search_counts::orbit_counts;
use ozols::search::check::second_prime::{build_both, compare_primes};

/// Joint types with the options that contain them.
const KINDS: [(&str, &str); 9] = [
    ("type = \"revolute\"", ""),
    (
        "type = \"revolute\"",
        "options = [\"cylindrical\", \"spherical\"]",
    ),
    (
        "type = \"revolute\"",
        "options = [{ freedoms = [\"rz\", \"ty\"], name = \"slot\" }, { type = \"universal\", reference = REFERENCE }]",
    ),
    (
        "type = \"helical\"\npitch = PITCH",
        "options = [\"cylindrical\"]",
    ),
    (
        "type = \"helical\"\npitch = PITCH",
        "options = [{ freedoms = [\"screw\", \"rx\"], name = \"loose nut\" }]",
    ),
    (
        "type = \"prismatic\"",
        "options = [\"cylindrical\", { freedoms = [\"tx\", \"tz\"], name = \"slide\" }]",
    ),
    (
        "type = \"custom\"\nfreedoms = [\"rz\", \"tx\"]",
        "options = [{ freedoms = [\"ty\", \"tx\", \"rz\"], name = \"table\" }]",
    ),
    (
        "type = \"custom\"\nfreedoms = [\"ry\"]",
        "options = [\"spherical\"]",
    ),
    ("type = \"planar\"", "unloading = [\"revolute\"]"),
];
const AXES: [[i32; 3]; 5] = [[0, 0, 1], [0, 0, 1], [1, 0, 0], [0, 1, 0], [1, 2, -1]];

type Draw = (usize, [i32; 3], usize, i32);

fn joint() -> impl Strategy<Value = Draw> + Clone {
    let point = prop::array::uniform3(-3i32..4);
    (0..KINDS.len(), point, 0..AXES.len(), 1i32..3)
}

fn entry(id: &str, links: [&str; 2], (kind, point, axis, pitch): Draw, turned: bool) -> String {
    let (what, options) = KINDS[kind];
    let (mut point, mut axis, mut pitch) = (point, AXES[axis], pitch);
    if turned {
        // The mirror image in y: points and directions are reflected, a right-hand thread becomes a left-hand one.
        (point[1], axis[1], pitch) = (-point[1], -axis[1], -pitch);
    }
    let what = what.replace("PITCH", &pitch.to_string());
    let reference = if turned { "[1, -1, 1]" } else { "[1, 1, 1]" };
    let options = options.replace("REFERENCE", reference);
    format!(
        "[[joint]]\nid = \"{id}\"\nlinks = {links:?}\n{what}\npoint = {point:?}\naxis = {axis:?}\n{options}\n"
    )
}

/// So many links: the frame first, the output last.
pub(crate) fn links_of(links: usize) -> String {
    let role = |l| match l {
        0 => "role = \"frame\"",
        _ if l == links - 1 => "role = \"output\"",
        _ => "",
    };
    let entry = |l| format!("[[link]]\nid = \"{l}\"\n{}\n", role(l));
    (0..links).map(entry).collect()
}

/// A random mechanism: links, joints, whether planar and in which plane, and a held link.
pub(crate) fn random() -> impl Strategy<Value = String> {
    let index = any::<prop::sample::Index>;
    (
        3usize..6,
        prop::collection::vec((index(), joint()), 5),
        prop::collection::vec((index(), index(), joint()), 1..4),
        prop::option::of(prop::sample::select(vec![[0, 0, 1], [1, 2, -1]])),
        prop::option::of(index()),
    )
        .prop_map(|(links, tree, more, plane, hold)| {
            let mut out = String::from("name = \"varied\"\n");
            if let Some(normal) = plane {
                out += &format!("mode = \"planar\"\nplane_normal = {normal:?}\n");
            }
            if let Some(hold) = hold {
                out += &format!("[search]\nhold = [\"{}\"]\n", 1 + hold.index(links - 1));
            }
            out += &links_of(links);
            let tree = (1..links).map(|l| (tree[l - 1].0.index(l), l, tree[l - 1].1));
            let more = more
                .iter()
                .map(|(a, b, j)| (a.index(links), b.index(links), *j));
            for (i, (a, b, mut j)) in tree.chain(more).filter(|(a, b, _)| a != b).enumerate() {
                // In a plane most joints should move in it.
                if plane == Some([1, 2, -1]) && j.2 < 3 {
                    j.2 = 4;
                }
                out += &entry(&format!("j{i}"), [&a.to_string(), &b.to_string()], j, false);
            }
            out
        })
}

/// A random mechanism that is its own mirror image in y: a slider on the x axis, and two mirrored chains from it to the
/// frame.
fn mirrored() -> impl Strategy<Value = String> {
    (prop::collection::vec(joint(), 2..4), any::<bool>()).prop_map(|(chain, drive)| {
        let mut out = String::from("name = \"mirrored\"\n[search]\nmirror = [");
        for i in 0..chain.len() {
            out += &format!("[\"u{i}\", \"l{i}\"],");
        }
        out += "]\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"s\"\n";
        let middle: Draw = (if drive { 5 } else { 0 }, [0, 0, 0], 2, 1);
        let mut joints = entry("middle", ["0", "s"], middle, false);
        for side in ["u", "l"] {
            for i in 1..chain.len() {
                let role = if i == 1 { "role = \"output\"" } else { "" };
                out += &format!("[[link]]\nid = \"{side}{i}\"\n{role}\n");
            }
            for (i, j) in chain.iter().enumerate() {
                let name = |i: usize| match i {
                    0 => "s".to_owned(),
                    i if i == chain.len() => "0".to_owned(),
                    i => format!("{side}{i}"),
                };
                let (a, b) = (name(i), name(i + 1));
                joints += &entry(&format!("{side}{i}"), [&a, &b], *j, side == "l");
            }
        }
        out + &joints
    })
}

/// A vector after so many of two equal parts of a turn about z, or of three of one about the diagonal, which change the axes round.
fn turned([x, y, z]: [i32; 3], part: usize, parts: usize) -> [i32; 3] {
    match (parts, part) {
        (_, 0) => [x, y, z],
        (2, _) => [-x, -y, z],
        (_, 1) => [z, x, y],
        _ => [y, z, x],
    }
}

/// A random mechanism that two or three equal parts of a turn carry over to itself: a crank on its axis, and as many
/// chains alike from it to the frame.
fn carried_round() -> impl Strategy<Value = String> {
    let joint = ([-4..5, -4..5, -2..3], 0usize..3, 0usize..3);
    let drawn = (2usize..4, prop::collection::vec(joint, 2..3));
    // Three joints at one place say no axis.
    let off = |[x, y, z]: &[i32; 3]| x != y || y != z;
    let drawn = drawn.prop_filter("on the axis", move |(_, c)| c.iter().any(|j| off(&j.0)));
    drawn.prop_map(|(parts, chain)| {
        let alike = |i: usize| (0..parts).map(|k| format!("\"p{k}j{i}\"")).join(", ");
        let groups = (0..chain.len())
            .map(|i| format!("[{}]", alike(i)))
            .join(", ");
        let axis = commas([[0, 0, 1], [1, 1, 1]][parts - 2]);
        let mut links = "0 s".to_owned();
        let mut joints = format!("middle | 0 s | revolute | 0, 0, 0 | {axis}\n");
        for k in 0..parts {
            let name = |i: usize| match i {
                0 => "s".to_owned(),
                i if i == chain.len() => "0".to_owned(),
                i => format!("p{k}l{i}"),
            };
            (1..chain.len()).for_each(|i| links += &format!(" {}*", name(i)));
            for (i, &(point, axis, option)) in chain.iter().enumerate() {
                let axis = [[0, 0, 1], [1, 0, 0], [1, 0, 1]][axis];
                let option = ["cylindrical", "universal", "spherical"][option];
                let [point, axis, reference] =
                    [point, axis, [0, 1, 0]].map(|v| commas(turned(v, k, parts)));
                let (from, to) = (name(i), name(i + 1));
                joints += &format!("p{k}j{i} | {from} {to} | revolute | {point} | {axis}");
                joints += &format!(
                    " | reference = [{reference}]\\noptions = [\"revolute\", \"{option}\"]\n"
                );
            }
        }
        let head = format!("name = \"round\"\n[search]\nturn = [{groups}]");
        write_mechanism(&head, &links, &joints)
    })
}

type Choice = Vec<(usize, Option<usize>)>;

fn tally<'a>(list: impl Iterator<Item = &'a Twin>) -> BTreeMap<(i64, u32), BigUint> {
    let mut out = BTreeMap::new();
    for t in list {
        *out.entry((t.mobility, t.changes)).or_default() += 1u8;
    }
    out
}

/// Counts of a search over two primes, which must agree, and what its list says.
fn over_two_primes(
    m: &Mechanism,
    request: &Conditions,
) -> Result<(Counts, Counts, Vec<Choice>), TestCaseError> {
    let over = |nth| Search::new(exact_field(m, nth).unwrap(), m, request.clone()).unwrap();
    let (search, twin) = (over(0), over(1));
    let (diagrams, second) = build_both([&search, &twin], Control::NONE);
    let check = compare_primes([&search, &twin], [&diagrams, &second]);
    prop_assert!(check.unwrap().agree);
    let determinate = search.count_variants(&diagrams.determinate, false);
    let admissible = search.count_variants(&diagrams.admissible, true);
    let list: Vec<_> = search
        .cheapest_variants(&diagrams, usize::MAX / 4)
        .collect();
    let mut choices = Vec::new();
    for v in &list {
        let mut of_joints = vec![(0, None); m.joints.len()];
        for (variable, &c) in search.space.variables.iter().zip(&v.choices) {
            for &j in &variable.joints {
                of_joints[j] = (variable.choices[c].option, variable.choices[c].unloading);
            }
        }
        choices.push(of_joints);
    }
    for c in singular_values::certify_variants(&search, list, true, None, &|| false) {
        let agree = c.second.opinion().is_some_and(|o| o.agree);
        prop_assert!(agree, "{:?}", c);
    }
    Ok((determinate, admissible, choices))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: case_count(32), max_shrink_iters: 200, max_global_rejects: 1 << 20, ..ProptestConfig::default() })]
    #[test]
    fn planar_helical_custom_and_held(
        text in random(),
        allowed in 0u32..3,
        keep in any::<bool>(),
        most in prop::option::of(0i64..4),
        changes in prop::option::of(0u32..4),
    ) {
        let m = read(&text);
        let all = all_variants(&m, false);
        prop_assume!(all.len() <= 48);
        let request = Conditions {
            max_redundant: allowed,
            keep_output: keep,
            max_mobility: most,
            max_changes: changes,
            ..Conditions::default()
        };
        over_two_primes(&m, &request)?;
        let seen: Vec<Twin> = all.iter().map(|c| look_at_variant(&m, false, c)).collect();
        let search = Search::new(exact_field(&m, 0).unwrap(), &m, request).unwrap();
        assert_as_the_twins(&m, &search, &all, &seen, &text);
    }
}

/// Searches of variants that are their own images and of one of each orbit, against all variants looked at: each joint of a group is
/// carried to the next one.
fn orbits_agree(
    m: &Mechanism,
    groups: &[Vec<JointId>],
    asked: &Conditions,
) -> Result<(), TestCaseError> {
    let image = |c: &Choice| {
        let mut out = c.clone();
        for group in groups {
            for (i, &j) in group.iter().enumerate() {
                out[group[(i + 1) % group.len()]] = c[j];
            }
        }
        out
    };
    let all = all_variants(m, false);
    prop_assume!(m.search.mirror.is_empty() || all.len() <= 40);
    let seen = all
        .iter()
        .map(|c| (c.clone(), look_at_variant(m, false, c)));
    let seen: BTreeMap<Choice, Twin> = seen.collect();
    for (c, t) in &seen {
        let i = &seen[&image(c)];
        prop_assert_eq!(
            (t.internal, t.mobility, t.motion),
            (i.internal, i.mobility, i.motion)
        );
    }
    let orbit = |c: &Choice| {
        let round = std::iter::successors(Some(c.clone()), |c| Some(image(c)));
        round.take(groups[0].len()).collect::<BTreeSet<_>>()
    };
    let own = |c: &Choice| orbit(c).len() == 1;
    let first = |c: &Choice| orbit(c).first() == Some(c);
    let present = &seen[&all[0]];
    let good = |t: &Twin| t.internal <= asked.max_redundant;
    let better = |t: &Twin| {
        let moves = !asked.keep_output || t.motion == present.motion;
        good(t) && moves && asked.max_mobility.is_none_or(|w| t.mobility <= w)
    };
    let of = |test: &dyn Fn(&Twin) -> bool, which: &dyn Fn(&Choice) -> bool| {
        tally(
            seen.iter()
                .filter(|(c, t)| which(c) && test(t))
                .map(|(_, t)| t),
        )
    };
    let symmetric = Conditions {
        symmetry: Symmetry::SymmetricOnly,
        ..asked.clone()
    };
    let (determinate, admissible, list) = over_two_primes(m, &symmetric)?;
    prop_assert_eq!(&determinate.by_mobility_and_changes, &of(&good, &own));
    prop_assert_eq!(&admissible.by_mobility_and_changes, &of(&better, &own));
    prop_assert!(list.iter().all(own));
    let one = Conditions {
        symmetry: Symmetry::OnePerOrbit,
        ..asked.clone()
    };
    let search = Search::new(exact_field(m, 0).unwrap(), m, one.clone()).unwrap();
    let (determinate, admissible, list) = over_two_primes(m, &one)?;
    let all = SearchCounts {
        determinate,
        admissible,
        ..SearchCounts::default()
    };
    let (counts, _) = orbit_counts(&search, all, &|| false).unwrap();
    prop_assert_eq!(
        &counts.determinate.by_mobility_and_changes,
        &of(&good, &first)
    );
    prop_assert_eq!(
        &counts.admissible.by_mobility_and_changes,
        &of(&better, &first)
    );
    let orbits: BTreeSet<BTreeSet<Choice>> = list.iter().map(orbit).collect();
    prop_assert_eq!(orbits.len(), list.len());
    prop_assert_eq!(counts.admissible.total, BigUint::from(list.len()));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: case_count(16), max_shrink_iters: 200, max_global_rejects: 1 << 20, ..ProptestConfig::default() })]

    #[test]
    fn mirror_images(text in mirrored(), max_redundant in 0u32..4, max_mobility in prop::option::of(1i64..4)) {
        let m = read(&text);
        let pairs = m.search.mirror.iter().map(|&(a, b)| vec![a, b]).collect_vec();
        orbits_agree(&m, &pairs, &Conditions { max_redundant, max_mobility, ..Conditions::default() })?;
    }

    #[test]
    fn parts_of_a_turn(text in carried_round(), max_redundant in 0u32..4) {
        let m = read(&text);
        orbits_agree(&m, &m.search.turn, &Conditions { max_redundant, keep_output: false, ..Conditions::default() })?;
    }
}
