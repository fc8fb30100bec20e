//! Every chart that the program writes: two labels or more on each axis.

use crate::common::*;
fn pictures(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => pictures(&path, out),
            false if path.extension().is_some_and(|e| e == "svg") => out.push(path),
            false => {}
        }
    }
}

/// How many labels a chart has on its axes across and up; nothing for a picture without axes.
fn labels(svg: &str) -> Option<[usize; 2]> {
    let doc = roxmltree::Document::parse(svg).unwrap();
    let kind = doc.root_element().attribute("class")?;
    let count = |class: &str| {
        let all = doc.descendants().filter(|n| n.has_tag_name("text"));
        let of = |n: &roxmltree::Node<'_, '_>| {
            n.attribute("class")
                .unwrap_or_default()
                .split(' ')
                .any(|c| c == class)
        };
        all.filter(of).count()
    };
    let (x, y) = (count("xt"), count("yt"));
    match kind.split(' ').nth(1)? {
        "oz-chart" => Some([x, y]),
        _ => None,
    }
}

#[test]
fn each_axis_of_each_chart_has_two_labels_or_more() {
    let folder = Folder::new();
    for line in [
        "statics parallel-shears --stroke 0:360deg:24 --svg shears",
        "statics four-bar --stroke 0:360deg:24 --svg bar",
        "statics parallelogram --stroke 10:80deg:12 --svg parallelogram",
        "statics four-bar-planar --stroke 0:360deg:24 --svg planar",
        "grip lever-gripper --svg grip",
        "drive torsion-module --svg drive",
    ] {
        let (code, _, told) = folder.run(line);
        assert!(matches!(code, Some(0 | 1)), "{line}: {told}");
    }
    let mut all = Vec::new();
    pictures(folder.as_ref(), &mut all);
    pictures(quick_accuracy().1, &mut all);
    let (mut charts, mut wrong) = (0, Vec::new());
    for path in all {
        let Some(found) = labels(&fs::read_to_string(&path).unwrap()) else {
            continue;
        };
        charts += 1;
        if found.iter().any(|n| *n < 2) {
            wrong.push((path, found));
        }
    }
    assert!(charts > 25, "{charts}");
    assert!(wrong.is_empty(), "{wrong:?}");
}
