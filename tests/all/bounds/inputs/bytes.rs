//! Bytes: what a text editor would never write, and lines and numbers without an end.
use super::{HEAD, Input, cut, lines, repeat};

/// Each UTF-16 code unit of a program as two bytes.
fn utf_16(n: usize, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let text = format!("\u{feff}{HEAD}{}M30\n", repeat("G1 X1.\n", n));
    text.encode_utf16().flat_map(bytes).collect()
}

/// A small generator of numbers that look random.
fn noise(n: usize) -> impl Iterator<Item = u8> {
    (0..n as u32).map(|i| (i.wrapping_mul(2_654_435_761) ^ (i >> 3)).wrapping_mul(0x9e37_79b9) as u8)
}

#[expect(clippy::too_many_lines, reason = "it is one list")]
pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("empty", |_| Vec::new()),
        Input::new("one-byte", |_| b"G".to_vec()),
        Input::new("one-nul", |_| b"\0".to_vec()),
        Input::new("only-percent", |n| repeat("%\n", n).into()),
        Input::new("newlines", |n| repeat("\n", n).into()),
        Input::new("carriage-returns", |n| repeat("\r", 10 * n).into()),
        Input::new("returns-only", |n| {
            format!("{HEAD}{}M30\n", repeat("G1 X1.\n", n))
                .replace('\n', "\r")
                .into()
        }),
        Input::new("newline-return", |n| {
            format!("{HEAD}{}M30\n", repeat("G1 X1.\n", n))
                .replace('\n', "\n\r")
                .into()
        }),
        Input::new("spaces", |n| cut(&repeat(" ", 10 * n))),
        Input::new("tabs", |n| cut(&format!("G1{}X1.", repeat("\t", 10 * n)))),
        Input::new("form-feeds", |n| cut(&repeat("\u{c}\u{b}\u{85}", n))),
        Input::new("nul-bytes", |n| vec![0; 10 * n]),
        Input::new("nul-between", |n| cut(&repeat("G1\0X1.\0\n", n))),
        Input::new("control-characters", |n| {
            cut(&repeat("\u{1}\u{2}\u{7}\u{8}\u{1b}[31m\u{7f}\n", n))
        }),
        Input::new("high-bytes", |n| vec![0xff; 10 * n]),
        Input::new("invalid-utf-8", |n| {
            let mut out = HEAD.as_bytes().to_vec();
            for _ in 0..n {
                out.extend(b"G1 X1. \xe4\xc3(\xf0\x9f)\n");
            }
            out
        }),
        Input::new("noise", |n| noise(10 * n).collect()),
        Input::new("noise-of-text", |n| {
            noise(10 * n)
                .map(|byte| b" \nGXYZ0123456789.-#[]()=/MN"[byte as usize % 27])
                .collect()
        }),
        Input::new("utf-8-mark", |n| {
            format!("\u{feff}{HEAD}{}M30\n", repeat("G1 X1.\n", n)).into()
        }),
        Input::new("marks", |n| cut(&repeat("\u{feff}", n))),
        Input::new("utf-16-little", |n| utf_16(n, u16::to_le_bytes)),
        Input::new("utf-16-big", |n| utf_16(n, u16::to_be_bytes)),
        Input::new("umlauts", |n| cut(&repeat("ä", n))),
        Input::new("combining", |n| cut(&format!("(a{})", repeat("\u{301}", n)))),
        Input::new("full-width-digits", |n| cut(&repeat("Ｇ１ Ｘ１\n", n))),
        Input::new("png", |n| [b"\x89PNG\r\n\x1a\n".to_vec(), noise(n).collect()].concat()),
        Input::new("elf", |n| {
            [b"\x7fELF\x02\x01\x01\0".to_vec(), noise(n).collect()].concat()
        }),
        Input::new("html", |n| repeat("<html><body>G1 X1.</body></html>\n", n).into()),
        Input::new("one-line-of-words", |n| cut(&repeat("X1. Z2. ", n))),
        Input::new("one-line-of-unknown-codes", |n| {
            let codes: Vec<String> = (0..n / 2).map(|i| format!("G{}.{}", i % 1000, i % 9)).collect();
            cut(&codes.join(" "))
        }),
        Input::new("one-line-of-unknown-names", |n| {
            let names: Vec<String> = (0..n / 2).map(|i| format!("QQ{i}=1")).collect();
            cut(&names.join(" "))
        }),
        Input::new("one-line-of-g", |n| cut(&repeat("G1", n))),
        Input::new("one-line-of-m", |n| cut(&repeat("M3", n))),
        Input::new("one-line-of-letters", |n| cut(&repeat("X", n))),
        Input::new("one-line-of-points", |n| cut(&format!("G1 X{}", repeat(".", n)))),
        Input::new("one-line-of-slashes", |n| cut(&format!("{}G1 X1.", repeat("/", n)))),
        Input::new("one-line-of-semicolons", |n| cut(&repeat(";", n))),
        Input::new("one-line-of-colons", |n| cut(&repeat(":", n))),
        Input::new("one-line-of-commas", |n| cut(&format!("G1 X1.{}", repeat(",", n)))),
        Input::new("one-line-of-equals", |n| cut(&format!("R1{}1", repeat("=", n)))),
        Input::new("one-line-of-comments", |n| cut(&repeat("()", n))),
        Input::new("one-line-of-at", |n| cut(&repeat("@ ", n))),
        Input::new("one-line-of-continued", |n| {
            format!("PARTNO\n{}FINI\n", repeat("GOTO/1, $\n", n)).into()
        }),
        Input::new("long-comment", |n| cut(&format!("({})", repeat("comment ", n)))),
        Input::new("long-name", |n| cut(&format!("{}=1", repeat("A", n)))),
        Input::new("long-label", |n| {
            cut(&format!("GOTOF {0}\n{0}:", repeat("LABEL", n / 8)))
        }),
        Input::new("long-parameter-name", |n| {
            cut(&format!("#<{0}>=1\nG1 X#<{0}>", repeat("a", n)))
        }),
        Input::new("digits", |n| cut(&format!("G1 X{}", repeat("1", n)))),
        Input::new("digits-after-the-point", |n| cut(&format!("G1 X0.{}1", repeat("0", n)))),
        Input::new("digits-of-a-code", |n| {
            cut(&format!("G{0}\nM{0}\nT{0}\nN{0}\nO{0}", repeat("0", n)))
        }),
        Input::new("exponents", |n| {
            cut(&lines(n, |i| format!("G1 X1E{i} Y1EX{i} Z-1e-{i}")))
        }),
        Input::new("numbers-without-end", |n| {
            cut(&lines(n, |i| format!("G1 X{}99999999999999999999 Y-{i}e400", i % 2)))
        }),
        Input::new("enormous-coordinates", |n| {
            cut(&lines(n, |i| {
                format!(
                    "G{} X{}00000000000000000000000. Y-1. Z1. A999999999. C-{i}99999999.",
                    i % 2,
                    i % 9
                )
            }))
        }),
    ]
}
