//! The look: style sheet, text sizes, number formats.

/// The width of a chart, in pixels.
pub(super) const WIDTH: f64 = 760.0;
/// The space around everything.
pub(super) const PAD: f64 = 20.0;
/// The minimum space between neighbouring labels.
pub(super) const GAP: f64 = 10.0;
/// The size of ticks and names.
pub(super) const TICK: f64 = 12.0;
/// The size of a raised power.
pub(super) const RAISED: f64 = 9.0;
/// Number of colours. Further series repeat them with hollow marks.
pub(super) const COLOURS: usize = 7;

/// The style sheet of every picture. It states colours directly, because many file viewers do not support CSS
/// variables.
///
/// The colours of series lie at least 0.11 apart in Oklab, both unchanged and as simulated for protanopia, deuteranopia
/// and tritanopia.
pub(super) const STYLE: &str = "
.oz{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;font-size:12px}
.oz text{fill:#1c2126;font-variant-numeric:tabular-nums}
.oz .title{font-size:18px;font-weight:600}
.oz .sub{font-size:13px}
.oz .small{font-size:11px}
.oz .raised{font-size:9px}
.oz .sub,.oz .soft{fill:#59636e}
.oz .halo{paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round}
.oz .bg{fill:#fff}
.oz .grid,.oz .fine,.oz .axis,.oz .lead{fill:none;stroke:#e3e7eb}
.oz .fine{stroke:#f0f2f4}
.oz .axis{stroke:#8b949e}
.oz .lead{stroke:#b4bcc4}
.oz .line{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}
.oz .dash{stroke-dasharray:7 5;stroke-linecap:butt}
.oz .hit{fill:#000;fill-opacity:0;stroke:none}
.oz .hollow{fill:#fff;stroke-width:1.6}
.oz .full{stroke:#fff;stroke-width:1}
.oz .c0{stroke:#072faa}.oz .f0{fill:#072faa}
.oz .c1{stroke:#e4539b}.oz .f1{fill:#e4539b}
.oz .c2{stroke:#3f753f}.oz .f2{fill:#3f753f}
.oz .c3{stroke:#009be4}.oz .f3{fill:#009be4}
.oz .c4{stroke:#a99300}.oz .f4{fill:#a99300}
.oz .c5{stroke:#741800}.oz .f5{fill:#741800}
.oz .c6{stroke:#4b005c}.oz .f6{fill:#4b005c}
.oz .good{fill:#cfe6fb}.oz .bad{fill:#fbd0bd}.oz .warn{fill:#fbecb4}.oz .none{fill:#f3f5f7}
.oz text.good{fill:#0b4a83}.oz text.bad{fill:#8a2300;font-weight:600}.oz text.warn{fill:#6b5200}.oz text.none{fill:#59636e}
.oz .sign{fill:none;stroke-width:1.8;stroke-linecap:round;stroke-linejoin:round}
.oz .sign.good{stroke:#0b4a83}.oz .sign.bad{stroke:#8a2300}.oz .sign.warn{stroke:#6b5200}
.oz .bar.good{fill:#2f81c8}.oz .bar.bad{fill:#d1480b}.oz .bar.warn{fill:#d9ab00}.oz .bar.none{fill:#a9b2bb}
@media screen and (prefers-color-scheme:dark){
.oz text{fill:#e8ebee}
.oz .sub,.oz .soft{fill:#a3adb7}
.oz .halo{stroke:#15191d}
.oz .bg{fill:#15191d}
.oz .grid{stroke:#2b3239}
.oz .fine{stroke:#20262b}
.oz .axis{stroke:#7a848e}
.oz .lead{stroke:#4b555f}
.oz .hollow{fill:#15191d}
.oz .full{stroke:#15191d}
.oz .c0{stroke:#4b7ef7}.oz .f0{fill:#4b7ef7}
.oz .c1{stroke:#b4699e}.oz .f1{fill:#b4699e}
.oz .c2{stroke:#8ef58f}.oz .f2{fill:#8ef58f}
.oz .c3{stroke:#80b6dc}.oz .f3{fill:#80b6dc}
.oz .c4{stroke:#eba203}.oz .f4{fill:#eba203}
.oz .c5{stroke:#e15500}.oz .f5{fill:#e15500}
.oz .c6{stroke:#fed5fe}.oz .f6{fill:#fed5fe}
.oz .good{fill:#16395a}.oz .bad{fill:#5e2412}.oz .warn{fill:#4d3f0c}.oz .none{fill:#1d2227}
.oz text.good{fill:#b5daf8}.oz text.bad{fill:#ffc9b3}.oz text.warn{fill:#f7e08a}.oz text.none{fill:#a3adb7}
.oz .sign.good{stroke:#b5daf8}.oz .sign.bad{stroke:#ffc9b3}.oz .sign.warn{stroke:#f7e08a}
.oz .bar.good{fill:#4a9be0}.oz .bar.bad{fill:#ee6a2c}.oz .bar.warn{fill:#e0b62a}.oz .bar.none{fill:#59636e}
}
";

/// Formats digits with a narrow space between thousands, from five digits on.
pub(super) fn group_thousands(digits: &str) -> String {
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    if whole.len() < 5 {
        return digits.to_owned();
    }
    let mut out = String::new();
    for (n, c) in whole.chars().enumerate() {
        if n > 0 && (whole.len() - n).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(c);
    }
    out + rest
}
