//! Pictures from odd input.

use proptest::prelude::*;

use super::*;

fn chart(x: Scale, y: Scale, series: Vec<Series>) -> Chart {
    let axis = |label: &str, scale| Axis {
        label: label.to_owned(),
        scale,
    };
    Chart {
        title: "A <title> & more".to_owned(),
        subtitle: "One \"sentence\" \u{0} with ]]> in it.".to_owned(),
        x: axis("time, s", x),
        y: axis("error, mm", y),
        series,
    }
}

fn series(name: &str, style: Style, points: &[(f64, f64)]) -> Series {
    Series {
        name: name.to_owned(),
        points: points.to_vec(),
        style,
    }
}

/// Returns the texts of a class with their horizontal positions.
fn texts(svg: &str, class: &str) -> Vec<(f64, String)> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let nodes = document.descendants().filter(|n| n.has_tag_name("text"));
    nodes
        .filter(|n| {
            n.attribute("class")
                .unwrap_or("")
                .split(' ')
                .any(|c| c == class)
        })
        .map(|n| {
            let text = n
                .descendants()
                .filter(|n| n.is_text())
                .filter_map(|n| n.text())
                .collect();
            (n.attribute("x").unwrap().parse().unwrap(), text)
        })
        .collect()
}

#[test]
fn an_empty_chart_has_axes() {
    for scale in [Scale::Linear, Scale::Log] {
        let svg = chart(scale, scale, vec![series("none", Style::Line, &[])]).svg();
        assert!(texts(&svg, "xt").len() >= 2, "{svg}");
        assert!(svg.contains("Nothing to show: none."), "{svg}");
    }
}

#[test]
fn log_ticks_are_decades() {
    let points = [(1e-6, 0.02), (2.0, 700.0)];
    let svg = chart(
        Scale::Log,
        Scale::Log,
        vec![series("a", Style::Line, &points)],
    )
    .svg();
    let labels = |class| {
        texts(&svg, class)
            .into_iter()
            .map(|t| t.1)
            .collect::<Vec<_>>()
    };
    let powers = ["10−6", "10−5", "10−4", "10−3", "10−2", "10−1", "100"];
    assert_eq!(labels("xt"), powers);
    assert_eq!(labels("yt"), ["0.1", "1", "10", "100", "1000"]);
}

#[test]
fn linear_ticks_are_round() {
    let points = [(0.0, 3.0), (47.0, 19_400.0)];
    let svg = chart(
        Scale::Linear,
        Scale::Linear,
        vec![series("a", Style::Line, &points)],
    )
    .svg();
    let labels = |class| {
        texts(&svg, class)
            .into_iter()
            .map(|t| t.1)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        labels("xt"),
        ["0", "5", "10", "15", "20", "25", "30", "35", "40", "45"]
    );
    assert_eq!(
        labels("yt"),
        [
            "0",
            "5000",
            "10\u{202f}000",
            "15\u{202f}000",
            "20\u{202f}000"
        ]
    );
}

#[test]
fn what_cannot_be_shown_breaks_the_line() {
    let points = [
        (1.0, 1.0),
        (2.0, 2.0),
        (3.0, f64::NAN),
        (4.0, 2.0),
        (5.0, 0.0),
        (6.0, 3.0),
    ];
    let of = |scale| {
        chart(
            Scale::Linear,
            scale,
            vec![series("a", Style::Line, &points)],
        )
        .svg()
    };
    let starts = |svg: &str| {
        let path = svg
            .split(" d=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap();
        path.matches('M').count()
    };
    assert_eq!(starts(&of(Scale::Linear)), 2);
    assert_eq!(starts(&of(Scale::Log)), 1);
    assert!(of(Scale::Log).contains("2 of 6 points cannot be shown"));
}

#[test]
fn csv_keeps_every_point() {
    let points = [(1.0, 0.1), (2.5, f64::NAN), (1e300, -0.0)];
    let csv = chart(
        Scale::Log,
        Scale::Log,
        vec![series("a, \"b\"", Style::Line, &points)],
    )
    .csv();
    let name = "\"a, \"\"b\"\"\"";
    assert_eq!(
        csv,
        format!("series,x,y\n{name},1.0,0.1\n{name},2.5,NaN\n{name},1e300,-0.0\n")
    );
}

#[test]
fn a_page_escapes_all_but_the_pictures() {
    let part = |n: u8| {
        (
            format!("<{n}>"),
            "a & b".to_owned(),
            "<svg></svg>".to_owned(),
        )
    };
    let html = page("<t>", &[part(1), part(2), part(3)]);
    assert!(html.contains("<title>&lt;t&gt;</title>") && html.contains("<h2>&lt;3&gt;</h2>"));
    assert!(html.contains("<p>a &amp; b</p>") && html.contains("<svg></svg>"));
    assert!(!html.contains("<nav"));
    assert!(page("t", &[part(1), part(2), part(3), part(4)]).contains("<a href=\"#part-4\">"));
}

fn any_value() -> impl Strategy<Value = f64> {
    let odd = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        f64::MAX,
        f64::MIN,
        5e-324,
    ];
    prop_oneof![
        3 => any::<f64>(),
        3 => -1e3..1e3,
        2 => (-300.0..300.0).prop_map(|e| 10_f64.powf(e)),
        2 => prop::sample::select(odd.to_vec()),
        1 => (0..3).prop_map(|n| 1e9 + f64::from(n) * 1e-3),
    ]
}

fn any_scale() -> impl Strategy<Value = Scale> {
    prop_oneof![Just(Scale::Linear), Just(Scale::Log)]
}

fn any_style() -> impl Strategy<Value = Style> {
    let all = [Style::Line, Style::Dashed, Style::Points, Style::Steps];
    prop::sample::select(all.to_vec())
}

fn any_text() -> impl Strategy<Value = String> {
    prop::collection::vec(any::<char>(), 0..30).prop_map(String::from_iter)
}

prop_compose! {
    fn any_chart()(
        texts in prop::collection::vec(any_text(), 4),
        scales in (any_scale(), any_scale()),
        series in prop::collection::vec(
            (any_text(), any_style(), prop::collection::vec((any_value(), any_value()), 0..12)),
            0..18,
        ),
    ) -> Chart {
        let axis = |n: usize, scale| Axis { label: texts[n].clone(), scale };
        Chart {
            title: texts[0].clone(),
            subtitle: texts[1].clone(),
            x: axis(2, scales.0),
            y: axis(3, scales.1),
            series: series
                .into_iter()
                .map(|(name, style, points)| Series { name, points, style })
                .collect(),
        }
    }
}

/// Checks that the SVG parses, that all numbers are regular, and that no positioned element leaves the picture.
fn sound(svg: &str) {
    let document = roxmltree::Document::parse(svg).unwrap_or_else(|e| panic!("{e}: {svg}"));
    let root = document.root_element();
    let size = |name| root.attribute(name).unwrap().parse::<f64>().unwrap();
    let (width, height) = (size("width"), size("height"));
    for node in document.descendants() {
        for (names, most) in [
            (["x", "x1", "x2", "cx"], width),
            (["y", "y1", "y2", "cy"], height),
        ] {
            for value in names.iter().filter_map(|n| node.attribute(*n)) {
                let value: f64 = value.parse().unwrap();
                assert!((-1e-9..=most).contains(&value), "{value}: {svg}");
            }
        }
        let path = node.attribute("d").unwrap_or("");
        assert!(!path.contains("NaN") && !path.contains("inf"), "{svg}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_chart_is_sound_xml_with_labels_apart(chart in any_chart()) {
        let svg = chart.svg();
        sound(&svg);
        prop_assert_eq!(&svg, &chart.svg());
        let mut end = f64::NEG_INFINITY;
        for (x, text) in texts(&svg, "xt") {
            let half = text.chars().count() as f64 * 0.6 * 12.0 / 2.0;
            prop_assert!(x - half > end, "{} at {}: {}", text, x, svg);
            end = x + half;
        }
    }
}

/// Returns the labels of both axes.
fn labels(svg: &str) -> [Vec<String>; 2] {
    ["xt", "yt"].map(|class| texts(svg, class).into_iter().map(|t| t.1).collect())
}

/// Checks labels of eleven digits: there is space for two of them only if one between them is omitted.
#[test]
fn a_narrow_axis_far_from_zero_has_two_labels() {
    let (middle, far) = (-206061.6901393063, 0.0007319360059975914);
    let points = [0.0006494192858009572, far].map(|x| (middle + x, middle));
    for style in [Style::Line, Style::Points] {
        let svg = chart(
            Scale::Linear,
            Scale::Linear,
            vec![series("a", style, &points)],
        )
        .svg();
        let [x, _] = labels(&svg);
        assert!(x.len() >= 2 && x[0] != x[1], "{x:?}");
    }
}

proptest! {
    #[test]
    fn each_axis_has_two_labels_or_more(
        points in prop::collection::vec((any::<f64>(), any::<f64>()), 1..6),
        narrow in prop::collection::vec((0.0..1e-3f64, 0.0..1e-6f64), 1..4),
        middle in -1e6..1e6f64,
        scales in (0..3u8, 0..3u8),
    ) {
        let scale = |n| [Scale::Linear, Scale::Log, Scale::LogAndZero(-17)][usize::from(n)];
        let close: Vec<_> = narrow.iter().map(|(x, y)| (middle + x, middle * (1.0 + y))).collect();
        for points in [points, close] {
            for style in [Style::Line, Style::Points] {
                let svg = chart(scale(scales.0), scale(scales.1), vec![series("a", style, &points)]).svg();
                let [x, y] = labels(&svg);
                prop_assert!(x.len() >= 2 && y.len() >= 2, "{x:?} {y:?} of {points:?}");
                prop_assert!(x.windows(2).all(|w| w[0] != w[1]) && y.windows(2).all(|w| w[0] != w[1]), "{x:?} {y:?}");
            }
        }
    }
}
