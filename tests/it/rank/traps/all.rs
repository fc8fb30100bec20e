//! Mechanisms whose finite mobility is hard to tell, each with what it is in truth and where that comes from.

use crate::common::*;

/// A trap.
pub(crate) struct Trap {
    pub(crate) name: String,
    pub(crate) text: String,
    /// The dimension of the largest motion through the pose.
    pub(crate) truth: usize,
    pub(crate) source: &'static str,
}

type Point = [f64; 3];

/// Links and joints, written down as a file.
#[derive(Default)]
struct Sketch {
    links: Vec<String>,
    joints: String,
    count: usize,
    planar: bool,
}

impl Sketch {
    fn link(&mut self, id: &str) {
        if !self.links.iter().any(|l| l == id) {
            self.links.push(id.to_owned());
        }
    }

    fn joint(&mut self, kind: &str, [a, b]: [&str; 2], point: Point, axis: Point) -> &mut Self {
        self.link(a);
        self.link(b);
        self.count += 1;
        let (n, [point, axis]) = (self.count, [point, axis].map(commas));
        self.joints += &format!("j{n} | {a} {b} | {kind} | {point} | {axis}\n");
        self
    }

    /// A hinge across the plane of x and y.
    fn pin(&mut self, ends: [&str; 2], x: f64, y: f64) -> &mut Self {
        self.joint("revolute", ends, [x, y, 0.0], [0.0, 0.0, 1.0])
    }

    fn done(&self, name: &str, truth: usize, source: &'static str) -> Trap {
        let mode = if self.planar { "mode = \"planar\"" } else { "" };
        let links = self.links.join(" ") + "*";
        let text = write_mechanism(&format!("name = \"{name}\"\n{mode}"), &links, &self.joints);
        Trap {
            name: name.to_owned(),
            text,
            truth,
            source,
        }
    }
}

const TACHI: &str = "T. Tachi, J. IASS 50 (2009) 173-179: a degree-four vertex folds along one of two branches; along \
    straight creases the creases of one line fold alone";

/// A sheet of m by n panels with corners at `corner(i, j)`.
fn sheet(m: usize, n: usize, corner: impl Fn(usize, usize) -> Point) -> Sketch {
    let mut s = Sketch::default();
    let panel = |i: usize, j: usize| format!("f{i}x{j}");
    for (i, j) in (0..m).cartesian_product(0..n) {
        // The crease to the next panel begins at the corner of that panel's name.
        let next = [[i + 1, j], [i, j + 1]].into_iter();
        for [k, l] in next.filter(|&[k, l]| k < m && l < n) {
            let (p, q) = (corner(k, l), corner(i + 1, j + 1));
            let axis = [0, 1, 2].map(|x| q[x] - p[x]);
            s.joint("revolute", [&panel(i, j), &panel(k, l)], p, axis);
        }
    }
    s
}

fn odd(i: usize) -> f64 {
    (i % 2) as f64
}

/// Miura sheet, not folded: the creases along x are straight lines, those across zigzag.
fn miura_flat(i: usize, j: usize) -> Point {
    [40.0 * i as f64 + 15.0 * odd(j), 30.0 * j as f64, 0.0]
}

/// Miura sheet, half folded.
fn miura_folded(i: usize, j: usize) -> Point {
    [
        30.0 * i as f64,
        40.0 * j as f64 + 20.0 * odd(i),
        30.0 * odd(j),
    ]
}

fn map(i: usize, j: usize) -> Point {
    [40.0 * i as f64, 30.0 * j as f64, 0.0]
}

/// A row of toggles, each knee pushed by the one before by the square of its motion: order 2, 4, 8, ...
fn cascade(s: &mut Sketch, levels: usize, at: f64, prefix: &str) {
    let id = |k: usize, what: &str| format!("{prefix}{what}{k}");
    // The first knee lies between two bars along x; each further one between two bars across the last push.
    let (mut x, mut y, mut along) = (at, 0.0, true);
    let mut hung: Option<(String, [f64; 2])> = None;
    for k in 0..levels {
        let d = if along { [10.0, 0.0] } else { [0.0, 10.0] };
        let (a, b) = (id(k, "a"), id(k, "b"));
        let knee = [x, y];
        s.pin(["0", &a], x - d[0], y - d[1]);
        s.pin([&a, &b], x, y);
        if let Some((bar, _)) = &hung {
            s.pin([bar, &a], knee[0], knee[1]);
        }
        if k + 1 == levels {
            s.pin([&b, "0"], x + d[0], y + d[1]);
        }
        (x, y) = (x + d[0], y + d[1]);
        hung = Some((b, [x, y]));
        along = !along;
    }
}

/// Watt's linkage with its middle point guided along y as well.
fn watt_guided(s: &mut Sketch, at: f64, arms: [f64; 2], prefix: &str) {
    let [p, c, q, g] = ["p", "c", "q", "g"].map(|w| format!("{prefix}{w}"));
    s.pin(["0", &p], at - arms[0], 20.0)
        .pin([&p, &c], at, 20.0)
        .pin([&c, &q], at, -20.0)
        .pin([&q, "0"], at + arms[1], -20.0)
        .pin([&c, &g], at, 0.0)
        .joint("prismatic", [&g, "0"], [at, 0.0, 0.0], [0.0, 1.0, 0.0]);
}

/// Two Watt linkages whose middle points a bar joins.
fn double_watt(s: &mut Sketch, at: f64, prefix: &str) {
    let id = |w: &str| format!("{prefix}{w}");
    for (k, x, sign) in [(0, at, 1.0), (1, at + 100.0, -1.0)] {
        let [p, c, q] = ["p", "c", "q"].map(|w| format!("{prefix}{w}{k}"));
        s.pin(["0", &p], x - 40.0 * sign, 20.0)
            .pin([&p, &c], x, 20.0)
            .pin([&c, &q], x, -20.0)
            .pin([&q, "0"], x + 40.0 * sign, -20.0);
    }
    s.pin([&id("c0"), &id("bar")], at, 0.0)
        .pin([&id("bar"), &id("c1")], at + 100.0, 0.0);
}

/// A taut chain of bars between two fixed pins.
fn taut(s: &mut Sketch, bars: usize, at: f64, prefix: &str) {
    let id = |k: usize| match k {
        0 => "0".to_owned(),
        k if k > bars => "0".to_owned(),
        k => format!("{prefix}{k}"),
    };
    for k in 0..=bars {
        let (a, b) = (id(k), id(k + 1));
        s.pin([&a, &b], at + 10.0 * k as f64, 0.0);
    }
}

fn with(planar: bool, build: impl FnOnce(&mut Sketch)) -> Sketch {
    let mut s = default_with(|s: &mut Sketch| s.planar = planar);
    s.link("0");
    build(&mut s);
    s
}

const SERVATIUS: &str = "R. Connelly, H. Servatius, Discrete Comput. Geom. 11 (1994) 193-200";
const WATT: &str = "the middle of Watt's rod leaves its tangent with the fifth power of the angle: x = r sin t sin u, \
    u = -r t^4 / 8h; a coupler curve is no line";
const CASCADE: &str = "R. Connelly, H. Servatius 1994, and C. R. Calladine, S. Pellegrino, Int. J. Solids Struct. 27 \
    (1991) 505-515: each knee moves by the square of the one before; the last one is held";
const MAXWELL: &str =
    "J. C. Maxwell, Phil. Mag. 27 (1864) 294-299: a straight chain at full length does not move";
const HUNT: &str = "K. H. Hunt, Kinematic Geometry of Mechanisms (1978): parallelogram and antiparallelogram meet in the \
    flat pose, each with one freedom";

/// A row of toggles of order 2^levels alone.
pub(crate) fn toggles(levels: usize, planar: bool) -> Trap {
    let name = format!("cascade-order-{}", 1u64 << levels);
    with(planar, |s| cascade(s, levels, 0.0, "k")).done(&name, 0, CASCADE)
}

/// Two rows of toggles whose first knees a bar joins.
pub(crate) fn toggles_joined(levels: usize) -> Trap {
    let two = |s: &mut Sketch| {
        cascade(s, levels, 0.0, "k");
        cascade(s, levels, 300.0, "m");
        s.pin(["ka0", "bar"], 0.0, -1.0)
            .pin(["bar", "bend"], 150.0, -20.0);
        s.pin(["bend", "ma0"], 300.0, -1.0);
    };
    with(true, two).done("cascades-joined", 0, CASCADE)
}

/// A half folded Miura sheet of many panels.
pub(crate) fn large_sheet(side: usize) -> Trap {
    sheet(side, side, miura_folded).done(
        "large-sheet",
        1,
        "K. Miura, ISAS Report 618 (1985): one freedom",
    )
}

/// All of them.
pub(crate) fn all() -> Vec<Trap> {
    let mut out = Vec::new();
    for (m, n) in [(2, 2), (3, 3), (4, 3), (2, 5), (4, 4), (5, 5)] {
        out.push(sheet(m, n, miura_flat).done(&format!("miura-flat-{m}x{n}"), n - 1, TACHI));
    }
    for (m, n) in [(3, 3), (4, 3)] {
        let truth = (m - 1).max(n - 1);
        out.push(sheet(m, n, map).done(
            &format!("map-{m}x{n}"),
            truth,
            "J. Justin, T. Hull (map folding): at a square vertex only one of the two lines folds at a time",
        ));
    }
    for (m, n) in [(2, 2), (3, 4), (5, 5)] {
        out.push(sheet(m, n, miura_folded).done(
            &format!("miura-folded-{m}x{n}"),
            1,
            "K. Miura, ISAS Report 618 (1985): one freedom",
        ));
    }
    for planar in [false, true] {
        let p = if planar { "-planar" } else { "" };
        let mut put = |name: &str, truth: usize, source, build: &dyn Fn(&mut Sketch)| {
            out.push(with(planar, build).done(&format!("{name}{p}"), truth, source));
            let on = match name {
                n if n.starts_with("cascade") => "ka0",
                "watt-guided" => "wc",
                "double-watt" => "dbar",
                _ => return,
            };
            let hinged = |s: &mut Sketch| {
                build(s);
                s.pin([on, "flap"], 500.0, 7.0);
            };
            out.push(with(planar, hinged).done(&format!("{name}-hinge{p}"), truth + 1, source));
        };
        for levels in 1..=6 {
            let name = format!("cascade-order-{}", 1 << levels);
            put(&name, 0, CASCADE, &|s| cascade(s, levels, 0.0, "k"));
        }
        let even = [40.0, 40.0];
        put("watt-guided", 0, WATT, &|s| watt_guided(s, 0.0, even, "w"));
        put("watt-unequal-guided", 0, WATT, &|s| {
            watt_guided(s, 0.0, [40.0, 25.0], "w")
        });
        put("watt-guided-twice", 0, WATT, &|s| {
            watt_guided(s, 0.0, even, "w");
            watt_guided(s, 200.0, even, "v");
        });
        put("double-watt", 1, SERVATIUS, &|s| double_watt(s, 0.0, "d"));
        put("double-watt-twice", 2, SERVATIUS, &|s| {
            double_watt(s, 0.0, "d");
            double_watt(s, 400.0, "e");
        });
        for bars in [2, 3, 4, 5] {
            put(&format!("taut-chain-{bars}"), 0, MAXWELL, &|s| {
                taut(s, bars, 0.0, "t")
            });
        }
        put("taut-chain-and-watt-hinge", 1, MAXWELL, &|s| {
            taut(s, 3, 0.0, "t");
            watt_guided(s, 200.0, even, "w");
            s.pin(["wc", "flap"], 500.0, 7.0);
        });
        let flat = |s: &mut Sketch| {
            s.pin(["0", "a"], 0.0, 0.0).pin(["a", "c"], 10.0, 0.0);
            s.pin(["c", "b"], 35.0, 0.0).pin(["b", "0"], 25.0, 0.0);
        };
        put("parallelogram-collapsed", 1, HUNT, &flat);
        put("three-cranks-collapsed", 1, HUNT, &|s| {
            flat(s);
            s.pin(["0", "m"], 12.0, 0.0).pin(["m", "c"], 22.0, 0.0);
        });
        put("rhombus-folded", 1, HUNT, &|s| {
            s.pin(["0", "a"], 0.0, 0.0).pin(["a", "c"], 10.0, 0.0);
            s.pin(["c", "b"], 0.0, 0.0).pin(["b", "0"], 10.0, 0.0);
        });
    }
    out
}
