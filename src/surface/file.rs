//! Required surfaces from files: TOML or JSON with grids and patches, STL.
use crate::mesh::Required;
use crate::patch::{HIGHEST_DEGREE, Patch};
use crate::sheet::Sheet;
use crate::stl;
use serde::Deserialize;
use trunnion_geometry::Vec3;

/// What is wrong with a surface's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SurfaceError {
    /// Line and column from 1, where they are known.
    pub place: Option<(usize, usize)>,
    /// What is wrong and what to do.
    pub message: String,
}

impl core::fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.place {
            Some((line, column)) => write!(f, "{line}:{column}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl std::error::Error for SurfaceError {}

fn wrong(message: impl Into<String>) -> SurfaceError {
    SurfaceError {
        place: None,
        message: message.into(),
    }
}

/// The schema name that a file must have.
const SCHEMA: &str = "trunnion-surface/1";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: String,
    #[serde(default)]
    grid: Vec<Rows>,
    #[serde(default)]
    patch: Vec<Rows>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    rows: Vec<Vec<[f64; 3]>>,
}

/// Reads grids (`[[grid]] rows = [[[x, y, z], ...], ...]`: points, bilinear between them) and Bezier patches (`[[patch]]`: control
/// points) in mm, from TOML or JSON with the key `schema`. `tolerance`: how far the triangles for the search may lie off, mm.
///
/// # Errors
/// What is wrong, with line and column where the text itself cannot be read.
pub fn required(text: &str, is_json: bool, tolerance: f64) -> Result<Required, SurfaceError> {
    let file: File = if is_json {
        serde_json::from_str(text).map_err(|error| SurfaceError {
            place: Some((error.line(), error.column())),
            message: error.to_string(),
        })?
    } else {
        toml::from_str(text).map_err(|error| SurfaceError {
            place: error.span().map(|span| line_column(text, span.start)),
            message: error.message().to_owned(),
        })?
    };
    if file.schema != SCHEMA {
        return Err(wrong(format!(
            "unknown schema {:?}; this version reads `{SCHEMA}`",
            file.schema
        )));
    }
    let mut sheets = Vec::new();
    for (index, grid) in file.grid.into_iter().enumerate() {
        sheets.push(Sheet::Grid(points(grid, &format!("grid {}", index + 1), usize::MAX)?));
    }
    for (index, patch) in file.patch.into_iter().enumerate() {
        let rows = points(patch, &format!("patch {}", index + 1), HIGHEST_DEGREE + 1)?;
        sheets.push(Sheet::Patch(Patch::new(rows)));
    }
    if sheets.is_empty() {
        return Err(wrong(
            "no surface: add at least one [[grid]] or [[patch]] with rows of points",
        ));
    }
    Required::from_sheets(sheets, tolerance).map_err(wrong)
}

fn line_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at.min(text.len())];
    let line = before.matches('\n').count() + 1;
    (line, before.chars().rev().take_while(|c| *c != '\n').count() + 1)
}

/// Rows of equal length, at least two by two.
fn points(rows: Rows, name: &str, most: usize) -> Result<Vec<Vec<Vec3>>, SurfaceError> {
    let (lines, columns) = (rows.rows.len(), rows.rows.first().map_or(0, Vec::len));
    if lines < 2 || columns < 2 {
        return Err(wrong(format!(
            "{name}: {lines} rows of {columns} points; at least 2 rows of 2 points are required"
        )));
    }
    if lines > most || columns > most {
        let degree = most - 1;
        return Err(wrong(format!(
            "{name}: {lines} rows of {columns} control points; the highest degree is {degree}"
        )));
    }
    if lines.saturating_mul(columns) > 20_000_000 {
        return Err(wrong(format!("{name}: more than 20 million points")));
    }
    let mut all = Vec::with_capacity(lines);
    for (index, row) in rows.rows.into_iter().enumerate() {
        if row.len() != columns {
            let (row_number, count) = (index + 1, row.len());
            return Err(wrong(format!(
                "{name}: row {row_number} has {count} points, row 1 has {columns}"
            )));
        }
        let row: Vec<Vec3> = row.into_iter().map(|[x, y, z]| Vec3::new(x, y, z)).collect();
        if row
            .iter()
            .any(|point| !point.iter().all(|value| value.is_finite() && value.abs() < 1e9))
        {
            return Err(wrong(format!(
                "{name}: row {} contains a number that is not a length in mm",
                index + 1
            )));
        }
        all.push(row);
    }
    Ok(all)
}

/// Reads an STL of at most 64 MiB, binary or ASCII; its numbers are taken as mm.
///
/// # Errors
/// What is wrong, with line and column in an ASCII file.
pub fn required_stl(bytes: &[u8]) -> Result<Required, SurfaceError> {
    let corners = stl::triangles(bytes)?;
    if corners.is_empty() {
        return Err(wrong(
            "cannot be read as STL: it has no triangles; export the surface again",
        ));
    }
    let triangles = (0..corners.len() as u32).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]);
    Required::from_triangles(corners.as_flattened(), triangles.collect()).map_err(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        required(text, false, 1e-3)
            .map(|_| ())
            .expect_err("refused")
            .to_string()
    }

    #[test]
    fn grids_and_patches_are_read_from_toml_and_json() {
        let toml =
            "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [10, 0, 0]], [[0, 10, 0], [10, 10, 0]]]\n";
        let found = required(toml, false, 1e-3).expect("a surface");
        assert_eq!((found.triangles(), found.sheets().len()), (2, 1));
        let json = r#"{"schema":"trunnion-surface/1","patch":[{"rows":[[[0,0,0],[5,0,2],[10,0,0]],[[0,9,0],[5,9,2],[10,9,0]]]}]}"#;
        let found = required(json, true, 1e-3).expect("a surface");
        assert!((found.nearest(&Vec3::new(5.0, 4.0, 4.0)).distance - 3.0).abs() < 2e-3);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        assert!(refused("schema = \"x\"").contains("trunnion-surface/1"));
        assert!(refused("schema = \"trunnion-surface/1\"\ngrids = 1\n").starts_with("2:1: unknown field `grids`"));
        let head = "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = ";
        assert!(refused(&format!("{head}[[[0,0,0],[1,0,0]]]")).contains("1 rows of 2 points"));
        assert!(refused(&format!("{head}[[[0,0,0],[1,0,0]],[[0,1,0]]]")).contains("row 2 has 1 points"));
        assert!(refused(&format!("{head}[[[0,0,0],[nan,0,0]],[[0,1,0],[1,1,0]]]")).contains("row 1"));
        let json = required("{", true, 1e-3).map(|_| ()).expect_err("refused");
        assert!(json.place.is_some());
    }

    #[test]
    fn stl_is_read_in_both_forms_and_hostile_bytes_are_refused() {
        let ascii = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 0\nendloop\nendfacet\nendsolid a\n";
        let found = required_stl(ascii).expect("a surface");
        assert_eq!(found.nearest(&Vec3::new(1.0, 1.0, 2.0)).distance, 2.0);
        let mut binary = vec![0_u8; 80];
        binary.extend(1_u32.to_le_bytes());
        for value in [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 10.0, 0.0] {
            binary.extend(value.to_le_bytes());
        }
        binary.extend([0, 0]);
        assert_eq!(
            required_stl(&binary)
                .expect("a surface")
                .nearest(&Vec3::new(1.0, 1.0, 2.0))
                .distance,
            2.0
        );
        binary[83] = 0x7f;
        assert!(
            required_stl(&binary)
                .map(|_| ())
                .expect_err("refused")
                .message
                .contains("announces")
        );
        for bytes in [&b""[..], b"solid", b"\xff\xfe", &[0; 84]] {
            assert!(required_stl(bytes).is_err(), "{bytes:?}");
        }
    }
}
