//! Whatever is sent: it is refused without a trace, or can be undone to the byte, and the next request is answered.

use super::served::Served;
use crate::common::*;

/// Values that fit a key of a file now and then, and mostly do not.
fn value() -> impl Strategy<Value = Value> {
    let long = "9".repeat(400);
    select(vec![
        Value::Null,
        json!(true),
        json!(0),
        json!(-1),
        json!(1e308),
        json!(u64::MAX),
        json!("spherical"),
        json!("sqrt(-1)"),
        json!("1/0"),
        json!("sqrt(2)*"),
        json!(long),
        json!(""),
        json!("\u{202e}\0\n\"'''"),
        json!([]),
        json!([0, 0, 1]),
        json!([0, 0, 0]),
        json!(["1", "2"]),
        json!([[[[]]]]),
        json!({ "x": [1, 2, "sqrt(3)"] }),
    ])
}

fn word() -> impl Strategy<Value = &'static str> {
    select(vec![
        "0-1", "1-2", "2-3", "1", "0", "", "nope", "a b", "type", "links", "point", "axis", "id",
        "options", "drive", "drawing",
    ])
}

fn change() -> impl Strategy<Value = Value> {
    let what = || select(vec!["joint", "link", "point", "body"]);
    prop_oneof![
        (what(), word(), word(), value()).prop_map(
            |(w, id, key, v)| json!({ "do": "set", "what": w, "id": id, "key": key, "value": v })
        ),
        (prop::collection::vec(word(), 0..4), value())
            .prop_map(|(path, v)| json!({ "do": "put", "path": path, "value": v })),
        (what(), word(), word(), value()).prop_map(
            |(w, id, key, v)| json!({ "do": "add", "what": w, "entry": { "id": id, key: v } })
        ),
        (what(), word(), word())
            .prop_map(|(w, id, to)| json!({ "do": "rename", "what": w, "id": id, "to": to })),
        (what(), word()).prop_map(|(w, id)| json!({ "do": "remove", "items": [[w, id]] })),
        value(),
    ]
}

/// A request by its path and body; or bytes that are none.
#[derive(Debug, Clone)]
enum Sent {
    Changes(Vec<Value>),
    Other(&'static str, Value),
    Bytes(Vec<u8>),
}

fn sent() -> impl Strategy<Value = Sent> {
    let path = select(vec![
        "take", "settle", "restore", "draft", "edit", "nowhere",
    ]);
    prop_oneof![
        4 => prop::collection::vec(change(), 1..4).prop_map(Sent::Changes),
        1 => (path, value()).prop_map(|(p, v)| Sent::Other(p, v)),
        1 => prop::collection::vec(any::<u8>(), 0..200).prop_map(|mut bytes| {
            bytes.extend_from_slice(b"\r\n\r\n");
            Sent::Bytes(bytes)
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn is_refused_or_can_be_undone(all in prop::collection::vec(sent(), 40)) {
        let folder = tempdir().unwrap();
        let own = run_quiet("show gripper-10");
        fs::write(folder.path().join("mine.toml"), &own).unwrap();
        let s = Served::new(folder.path(), &["mine.toml"]);
        let now = || s.status()["revision"].clone();
        let mut changed = 0;
        for one in all {
            let before = now();
            let status = match &one {
                Sent::Changes(edits) => s.post("edit", &json!({ "edits": edits, "revision": null })).0,
                Sent::Other(path, body) => s.post(path, body).0,
                Sent::Bytes(bytes) => s.raw(bytes).0,
            };
            let is_changed = now() != before;
            prop_assert!(!is_changed || status == 200, "{status}: {one:?}");
            prop_assert!(matches!(status, 200 | 400..=499 | 501), "{status}: {one:?}");
            changed += usize::from(is_changed);
        }
        for _ in 0..changed {
            s.done("undo", &json!({}));
        }
        prop_assert_eq!(&s.status()["desk"]["saved"], &json!(true));
        prop_assert_eq!(fs::read_to_string(folder.path().join("mine.toml")).unwrap(), own);
    }
}
