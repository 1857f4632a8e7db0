//! For tests: where the texts of a picture stand.
use crate::canvas::Header;
use crate::record::{Block, Record, Sample};
use trunnion_geometry::Vec3;
use trunnion_machine::Joints;

/// A text, and its box on the sheet: left, top, right, bottom, in tenths of a pixel.
pub(crate) type Placed = (String, [f64; 4]);

/// Height of a text as a share of its size, and width of a character: narrower than most fonts, so that what touches here does overlap.
const HEIGHT: f64 = 0.7;
const WIDTH: f64 = 0.5;

/// All texts that are not turned.
pub(crate) fn texts(svg: &str) -> Vec<Placed> {
    let document = svg.split("<text ").skip(1);
    document
        .filter_map(|element| {
            let (head, rest) = element.split_once('>')?;
            let (text, _) = rest.split_once("</text>")?;
            let value = |name: &str| {
                let (_, after) = head.split_once(&format!("{name}=\""))?;
                Some(after.split_once('"')?.0)
            };
            if value("transform").is_some() {
                return None;
            }
            let number = |name: &str| value(name)?.parse::<f64>().ok();
            let (x, y, size) = (number("x")?, number(" y")?, number("font-size")?);
            let text = text.trim().to_owned();
            let (height, width) = (HEIGHT * size, WIDTH * size * text.chars().count() as f64);
            let left = match value("text-anchor") {
                Some("middle") => x - 0.5 * width,
                Some("end") => x - width,
                _ => x,
            };
            let top = match value("dy") {
                Some("0.76em") => y,
                Some("0.5ex") => y - 0.5 * height,
                _ => y - height,
            };
            Some((text, [left, top, left + width, top + height]))
        })
        .collect()
}

/// Pairs of texts that cover each other.
pub(crate) fn overlaps(svg: &str) -> Vec<(String, String)> {
    let texts = texts(svg);
    assert!(!texts.is_empty(), "no text is read in {svg:.300}");
    let mut found = Vec::new();
    for (at, (text, a)) in texts.iter().enumerate() {
        for (other, b) in &texts[..at] {
            if a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3] {
                found.push((other.clone(), text.clone()));
            }
        }
    }
    found
}

/// A record of blocks through these tips and tool axes, one block for each pair; the letter says whether it is rapid (`r`) or a cut.
pub(crate) fn record(moves: &[(char, Vec3)], axis: impl Fn(usize) -> Vec3) -> Record {
    let mut record = Record::default();
    let mut way = 0.0;
    for (at, pair) in moves.windows(2).enumerate() {
        let [from, to] = [pair[0].1, pair[1].1];
        let first = record.samples.len();
        for (tip, step) in [(from, at), (to, at + 1)] {
            way += if tip == from { 0.0 } else { (to - from).norm() };
            record.samples.push(Sample {
                way,
                time: 0.0,
                joints: Joints::default(),
                tip,
                axis: axis(step),
            });
        }
        record.blocks.push(Block {
            line: at as u32 + 1,
            rapid: pair[1].0 == 'r',
            samples: first..record.samples.len(),
            joined: at > 0,
            deviation: Some([0.0, 0.0]),
            feed: [Some(1000.0), None],
            planned: None,
        });
    }
    record
}

/// A header.
pub(crate) fn header() -> Header {
    Header {
        title: "Title".into(),
        subtitle: "Subtitle".into(),
    }
}

#[test]
fn texts_in_one_place_overlap() {
    let at = |x: f64, text: &str| {
        format!("<text x=\"{x}\" y=\"100\" text-anchor=\"start\" font-size=\"130\">\n{text}\n</text>")
    };
    assert_eq!(overlaps(&(at(0.0, "C15") + &at(100.0, "C30"))).len(), 1);
    assert_eq!(overlaps(&(at(0.0, "C15") + &at(400.0, "C30"))), []);
}
