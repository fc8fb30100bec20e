//! tmp
use ozols::geom::{exact::ExactField, expr::Expr};
use ozols::model::{joint_type::*, mechanism::*};
use ozols::search::request::*;
fn e(x: f64) -> Expr { Expr(num_rational::BigRational::new(((x * 2.0) as i64).into(), 2.into())) }
fn v(a: [f64; 3]) -> [Expr; 3] { a.map(e) }
fn main() {
    let names = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    let links = names.iter().map(|n| Link { id: n.to_string(), role: match *n { "0" => Role::Frame, "4" | "8" => Role::Output, _ => Role::Inner } }).collect();
    let half = [("1-2", 1, 2, 0., 1.), ("2-3", 2, 3, 3., 2.5), ("3-0", 3, 0, 3.5, 0.5), ("2-4", 2, 4, 6., 4.), ("4-5", 4, 5, 5., 5.), ("5-1", 5, 1, -1., 2.)];
    let mut joints = vec![];
    let frame = |x: f64, y: f64, a: [f64; 3], r: [f64; 3]| Frame { point: v([x, y, 0.]), axis: v(a), reference: v(r), pitch: e(0.) };
    let opt = |n: &str, t: JointType, f: Frame| JointOption { name: n.into(), joint_type: t, frame: f, cost_milli: None };
    let which = std::env::args().nth(1).unwrap();
    for s in [1., -1.] {
        for (id, a, b, x, y) in half {
            let m = |l: usize| if s < 0. && l >= 2 { l + 4 } else { l };
            let f = frame(x, s * y, [0., 0., 1.], [1., 0., 0.]);
            use Freedom::*;
            let mut options = vec![opt("R", JointType::Revolute, f.clone())];
            for c in which.chars() { options.push(match c {
                'C' => opt("C", JointType::Cylindrical, f.clone()), 'U' => opt("U", JointType::Universal, f.clone()),
                'V' => opt("V", JointType::Custom(vec![Rz, Ry]), f.clone()), 'S' => opt("S", JointType::Spherical, f.clone()),
                'H' => opt("H", JointType::CylindricalUniversal, f.clone()), 'N' => opt("N", JointType::SphereInCylinder, f.clone()),
                '1' => opt("1", JointType::Custom(vec![Rz, Tx]), f.clone()), '2' => opt("2", JointType::Custom(vec![Rz, Ty]), f.clone()),
                '3' => opt("3", JointType::Custom(vec![Rz, Rx, Tx]), f.clone()), '4' => opt("4", JointType::Custom(vec![Rz, Rx, Ty]), f.clone()),
                '5' => opt("5", JointType::Custom(vec![Rz, Ry, Tz]), f.clone()), _ => opt("6", JointType::Custom(vec![Rx, Ry, Rz, Tx]), f.clone()) }) }
            joints.push(Joint { id: id.into(), links: [m(a), m(b)], joint_type: JointType::Revolute, frame: f, drive: false, states: None, options, unloading: vec![] });
        }
    }
    let f = frame(0., 0., [1., 0., 0.], [0., 1., 0.]);
    joints.push(Joint { id: "0-1".into(), links: [0, 1], joint_type: JointType::Cylindrical, frame: f.clone(), drive: true, states: None, options: vec![opt("C", JointType::Cylindrical, f)], unloading: vec![] });
    let mech = Mechanism { name: "g".into(), description: String::new(), sources: vec![], length_unit: LengthUnit { symbol: "m", metres: 1. }, mode: Mode::Spatial, links, joints, states: vec!["free".into()], contours: vec![], search: SearchSpec::default(), expected: vec![] };
    let t = std::time::Instant::now();
    let exact = ExactField::for_expressions([], 0).unwrap();
    let s = Search::new(exact, &mech, Request::default()).unwrap();
    eprintln!("ready {:?}", t.elapsed());
    let d = s.build(&|| false, &mut |_| {});
    eprintln!("built {:?} nodes {} {} largest {} {}", t.elapsed(), d.determinate.nodes, d.admissible.nodes, d.determinate.largest_layer, d.admissible.largest_layer);
    eprintln!("{:?}", d.determinate.layers.iter().map(|l| (s.mechanism.joints[s.space.variables[l.variable].joints[0]].id.clone(), l.nodes)).collect::<Vec<_>>());
    eprintln!("{:?}", d.admissible.layers.iter().map(|l| (s.mechanism.joints[s.space.variables[l.variable].joints[0]].id.clone(), l.nodes)).collect::<Vec<_>>());
    let c = s.counts(&d.determinate, false);
    eprintln!("counted {:?} total {} {:?}", t.elapsed(), c.total, c.by_mobility);
    let c = s.counts(&d.admissible, true);
    eprintln!("counted {:?} total {} {:?}", t.elapsed(), c.total, c.by_mobility);
    let mut n = 0;
    s.cheapest(&d, 100, |v| { n += 1; if n < 4 { eprintln!("{:?} W{} cost {} ch {}", v.choices, s.mobility(v.key), s.steps.milli(v.key.cost()), v.key.changes()); } std::ops::ControlFlow::Continue(()) });
    eprintln!("best {:?}", t.elapsed());
    if which.len() < 2 { let b = s.brute(); eprintln!("brute {:?} {:?}\n{:?}", t.elapsed(), b.0.by_mobility, b.1.by_mobility); }
}
