//! Reads an STL, binary or ASCII.
//!
//! A binary file is 80 bytes of free text, the number of triangles and 50 bytes for each; an ASCII file has lines of words and begins with
//! `solid`. A file that says of itself that something is missing is refused: a surface that lacks triangles would be compared as if it were whole.
use crate::file::SurfaceError;
use trunnion_geometry::Vec3;

/// Largest file, MiB: a triangle of 50 bytes takes up to 500 bytes of memory.
const MOST_MIB: usize = 64;

/// Bytes of a binary file before its triangles, and of one triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// The corners of the triangles, mm.
pub(crate) fn triangles(bytes: &[u8]) -> Result<Vec<[Vec3; 3]>, SurfaceError> {
    if bytes.len() > MOST_MIB << 20 {
        return Err(wrong(&format!(
            "is larger than {MOST_MIB} MiB, the most for an STL: export it with fewer triangles, or only the part of the surface that this program cuts"
        )));
    }
    if bytes.is_empty() {
        return Err(wrong("the file is empty: export the surface again"));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(wrong("is UTF-16 text; save it as plain ASCII, or export a binary STL"));
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if announced(bytes).is_some_and(|count| bytes.len() as u64 == HEAD as u64 + count * TRIANGLE as u64) {
        return binary(bytes);
    }
    // programs write `solid` at the start of binary files too
    let is_text = word_is(text.trim_ascii_start(), b"solid") && !text[..text.len().min(HEAD + TRIANGLE)].contains(&0);
    if is_text { ascii(text) } else { binary(bytes) }
}

fn wrong(what: &str) -> SurfaceError {
    SurfaceError {
        place: None,
        message: format!("cannot be read as STL: {what}"),
    }
}

/// How many triangles a binary file says that it has.
fn announced(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEAD - 4..)?.first_chunk::<4>()?;
    Some(u64::from(u32::from_le_bytes(*count)))
}

fn binary(bytes: &[u8]) -> Result<Vec<[Vec3; 3]>, SurfaceError> {
    let Some(count) = announced(bytes) else {
        return Err(wrong(&format!(
            "an ASCII file begins with `solid`, and a binary one has at least {HEAD} bytes; this one has {}: it is cut, or no STL",
            bytes.len()
        )));
    };
    let body = &bytes[HEAD..];
    let holds = (body.len() / TRIANGLE) as u64;
    if count > holds {
        return Err(wrong(&format!(
            "it announces {count} triangles but contains {holds}: it is cut, or no STL; copy or export it again"
        )));
    }
    if count < holds {
        return Err(wrong(&format!(
            "it announces {count} triangles but contains {holds}: which of them belong to the surface is not known; export it again"
        )));
    }
    let mut all = Vec::with_capacity(count as usize);
    for (index, triangle) in body.chunks_exact(TRIANGLE).enumerate() {
        let number = |at: usize| {
            let bytes = triangle[at..].first_chunk::<4>().copied().unwrap_or_default();
            f64::from(f32::from_le_bytes(bytes))
        };
        // the normal comes first
        let corners = [12, 24, 36].map(|at| Vec3::new(number(at), number(at + 4), number(at + 8)));
        if let Some(corner) = corners
            .iter()
            .find(|corner| !corner.iter().all(|value| is_length(*value)))
        {
            return Err(wrong(&format!(
                "triangle {} of {count} has the corner ({}, {}, {}), which is no place in mm: export it again",
                index + 1,
                corner.x,
                corner.y,
                corner.z
            )));
        }
        all.push(corners);
    }
    Ok(all)
}

/// A coordinate of sensible size, mm.
fn is_length(value: f64) -> bool {
    value.is_finite() && value.abs() < 1e9
}

fn word_is(text: &[u8], word: &[u8]) -> bool {
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    text[..end].eq_ignore_ascii_case(word)
}

/// The lines of a text that are not blank, with their numbers from 1. A line ends with LF, CR LF or CR.
#[derive(Clone, Copy)]
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    fn line(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let line = &self.rest[..end.unwrap_or(self.rest.len())];
            let ends = if self.rest[line.len()..].starts_with(b"\r\n") {
                2
            } else {
                1
            };
            self.rest = self.rest.get(line.len() + ends..).unwrap_or_default();
            self.number += 1;
            if !line.trim_ascii().is_empty() {
                return Some(line);
            }
        }
        None
    }

    /// What is wrong at a part of the last line.
    fn fault(&self, line: &[u8], at: &[u8], what: &str) -> SurfaceError {
        let column = (at.as_ptr() as usize).saturating_sub(line.as_ptr() as usize) + 1;
        SurfaceError {
            place: Some((self.number, column)),
            ..wrong(what)
        }
    }

    /// The next line, which begins with these words; what follows them.
    fn expect(&mut self, words: &[&str]) -> Result<(&'a [u8], &'a [u8]), SurfaceError> {
        let Some(line) = self.line() else {
            let what = format!(
                "the file ends where `{}` is expected: it is cut; copy or export it again",
                words.join(" ")
            );
            return Err(SurfaceError {
                place: Some((self.number.max(1), 1)),
                ..wrong(&what)
            });
        };
        let mut rest = line.trim_ascii_start();
        for word in words {
            if !word_is(rest, word.as_bytes()) {
                let what = format!("{} stands where `{}` is expected", quoted(line), words.join(" "));
                return Err(self.fault(line, line.trim_ascii_start(), &what));
            }
            rest = rest[word.len()..].trim_ascii_start();
        }
        Ok((line, rest))
    }
}

/// The beginning of a text of the file.
fn quoted(text: &[u8]) -> String {
    const MOST: usize = 60;
    let text = text.trim_ascii();
    let more = if text.len() > MOST { "..." } else { "" };
    let shown = String::from_utf8_lossy(&text[..text.len().min(MOST)]).into_owned();
    format!("`{shown}{more}`")
}

fn ascii(text: &[u8]) -> Result<Vec<[Vec3; 3]>, SurfaceError> {
    let mut lines = Lines { rest: text, number: 0 };
    let mut all = Vec::new();
    lines.expect(&["solid"])?;
    loop {
        let mut ahead = lines;
        match ahead.line() {
            Some(line) if word_is(line.trim_ascii_start(), b"endsolid") => {
                lines = ahead;
                // a file may hold several
                if ahead.line().is_none() {
                    return Ok(all);
                }
                lines.expect(&["solid"])?;
            }
            None => {
                lines.expect(&["endsolid"])?;
            }
            Some(_) => all.push(facet(&mut lines)?),
        }
    }
}

fn facet(lines: &mut Lines<'_>) -> Result<[Vec3; 3], SurfaceError> {
    // the normal says nothing that the corners do not
    lines.expect(&["facet"])?;
    lines.expect(&["outer", "loop"])?;
    let mut corners = [Vec3::zeros(); 3];
    for corner in &mut corners {
        let (line, mut rest) = lines.expect(&["vertex"])?;
        for value in corner.iter_mut() {
            let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
            let word = &rest[..end];
            let number = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
            let Some(number) = number.filter(|number| is_length(*number)) else {
                let what = if word.is_empty() {
                    "a `vertex` has three numbers; one is missing".to_owned()
                } else {
                    format!("{} is no coordinate in mm: write a number such as 1.5", quoted(word))
                };
                return Err(lines.fault(line, word, &what));
            };
            *value = number;
            rest = rest[end..].trim_ascii_start();
        }
        if !rest.is_empty() {
            let what = format!("a `vertex` has three numbers; {} follows them", quoted(rest));
            return Err(lines.fault(line, rest, &what));
        }
    }
    lines.expect(&["endloop"])?;
    lines.expect(&["endfacet"])?;
    Ok(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 -2.5e-1\nendloop\nendfacet\n";

    fn text() -> String {
        format!("solid a b\n{FACET}{FACET}endsolid a b\n")
    }

    fn bytes(announced: u32, triangles: usize) -> Vec<u8> {
        let mut bytes = b"solid of a binary file".to_vec();
        bytes.resize(80, b' ');
        bytes.extend(announced.to_le_bytes());
        for _ in 0..triangles {
            for value in [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 10.0, -0.25] {
                bytes.extend(value.to_le_bytes());
            }
            bytes.extend([0, 0]);
        }
        bytes
    }

    fn refused(bytes: &[u8]) -> String {
        triangles(bytes).expect_err("refused").to_string()
    }

    /// The library that read these files before reads the same.
    #[test]
    fn both_forms_are_read() {
        let wanted = [Vec3::zeros(), Vec3::new(10.0, 0.0, 0.0), Vec3::new(0.0, 10.0, -0.25)];
        for file in [text().into_bytes(), bytes(2, 2)] {
            assert_eq!(triangles(&file).expect("an STL"), [wanted, wanted]);
            let mut cursor = std::io::Cursor::new(&file);
            let theirs: Vec<_> = stl_io::create_stl_reader(&mut cursor).expect("an STL").collect();
            assert_eq!(theirs.len(), 2);
            for triangle in theirs {
                let corners = triangle.expect("a triangle").vertices;
                assert_eq!(
                    corners.map(|c| Vec3::new(c[0].into(), c[1].into(), c[2].into())),
                    wanted
                );
            }
        }
        // other line ends, capitals, a mark of the encoding, and a second solid, which was left out
        for other in [
            text().replace('\n', "\r"),
            text().replace('\n', "\r\n"),
            text().to_ascii_uppercase(),
            format!("\u{feff}{}", text()),
            text().replace("normal 0 0 1", "normal nan nan nan"),
            format!("\nsolid\n{FACET}\nendsolid\n\nsolid b\n{FACET}endsolid"),
        ] {
            assert_eq!(triangles(other.as_bytes()).expect("an STL").len(), 2, "{other}");
        }
        // a byte or two behind the last triangle are no triangle
        let mut padded = bytes(2, 2);
        padded.extend(b"\r\n");
        assert_eq!(triangles(&padded).expect("an STL").len(), 2);
    }

    #[test]
    fn what_is_wrong_with_an_ascii_file_is_said_with_its_place() {
        let of = |from: &str, to: &str| refused(text().replacen(from, to, 1).as_bytes());
        assert_eq!(
            of("10 0 0", "1,5 0 0"),
            "5:8: cannot be read as STL: `1,5` is no coordinate in mm: write a number such as 1.5"
        );
        for value in ["nan", "inf", "-1e400", "1e9", "x"] {
            assert!(of("10 0 0", &format!("0 {value} 0")).starts_with("5:10: "), "{value}");
        }
        assert!(of("10 0 0", "10 0").contains("one is missing"));
        assert!(of("10 0 0", "10 0 0 7").contains("`7` follows them"));
        assert!(of("outer", "inner").starts_with("3:1: cannot be read as STL: `inner loop` stands where `outer loop`"));
        let long = of("10 0 0", &format!("{} 0 0", "9".repeat(1_000_000) + "x"));
        assert!(long.len() < 200, "{}", long.len());
        // cut anywhere, it is refused
        let whole = text();
        for end in 1..whole.len() - "endsolid a b\n".len() {
            let message = refused(&whole.as_bytes()[..end]);
            assert!(!message.contains("whole buffer") && message.len() < 300, "{message}");
        }
        assert!(refused(&whole.as_bytes()[..53]).contains("is cut"));
        assert!(refused(b"solid\n").contains("the file ends where `endsolid` is expected"));
        assert!(refused((text() + "facet\n").as_bytes()).contains("stands where `solid` is expected"));
    }

    #[test]
    fn what_is_wrong_with_a_binary_file_is_said() {
        assert!(refused(b"").contains("is empty"));
        assert!(refused(b"hello").contains("this one has 5"));
        assert!(refused(&[0xff, 0xfe, 0x73, 0]).contains("UTF-16"));
        assert!(refused(&bytes(3, 2)).contains("announces 3 triangles but contains 2"));
        assert!(refused(&bytes(1, 2)).contains("announces 1 triangles but contains 2"));
        assert!(refused(&bytes(0, 2)).contains("announces 0 triangles but contains 2"));
        assert!(refused(&bytes(2, 2)[..130]).contains("is cut"));
        for value in [f32::NAN, f32::INFINITY, 3e38] {
            let mut bad = bytes(2, 2);
            bad[84 + 50 + 24..][..4].copy_from_slice(&value.to_le_bytes());
            assert!(refused(&bad).contains("triangle 2 of 2 has the corner ("), "{value}");
        }
        assert!(refused(&vec![b'h'; (MOST_MIB << 20) + 1]).contains("is larger than 64 MiB"));
    }
}
