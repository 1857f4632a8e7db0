//! Tools as people declare them: `--tool ball:10`, `[[tool]]`.
use trunnion_dialect::did_you_mean;
use trunnion_interp::{Tool, ToolShape};

/// Names of tool shapes, for messages.
pub(super) const SHAPES: &str = "ball, flat, bull or turning";

/// Reads `shape:diameter[:corner radius]`, lengths in mm, for the tool in use: `ball:10`, `bull:16:2`.
pub fn parse_tool_flag(text: &str) -> Result<Tool, String> {
    let wanted = || {
        format!(
            "cannot read the tool `{text}`: write shape:diameter[:corner radius] in mm, for example ball:10, flat:12 or bull:16:2"
        )
    };
    let mut parts = text.split(':').map(str::trim);
    let (Some(name), Some(diameter)) = (parts.next(), parts.next()) else {
        return Err(wanted());
    };
    let diameter: f64 = diameter.parse().map_err(|_| wanted())?;
    let corner = parts.next().map(str::parse::<f64>).transpose().map_err(|_| wanted())?;
    if parts.next().is_some() {
        return Err(wanted());
    }
    let shape = shape(name, Some(diameter), corner).map_err(|(_, message)| message)?;
    Ok(Tool {
        number: 0,
        shape: Some(shape),
        diameter_mm: Some(diameter),
        length_mm: None,
        holder_mm: None,
    })
}

/// What of a tool is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// The shape's name, or what it needs.
    Shape,
    /// The diameter.
    Diameter,
    /// The corner radius.
    CornerRadius,
}

/// A shape from its name and sizes in mm, or which part is wrong and why.
pub(super) fn shape(name: &str, diameter: Option<f64>, corner: Option<f64>) -> Result<ToolShape, (Part, String)> {
    if let Some(diameter) = diameter
        && !(diameter > 0.0 && diameter.is_finite())
    {
        let message = format!("the tool diameter must be greater than 0 mm, not {diameter}");
        return Err((Part::Diameter, message));
    }
    match (name.to_ascii_lowercase().as_str(), corner) {
        ("ball", None) => Ok(ToolShape::Ball),
        ("flat", None) => Ok(ToolShape::Flat),
        ("ball" | "flat", Some(_)) => Err((
            Part::CornerRadius,
            format!("a {name} tool takes no corner radius; for a tool with a corner radius write `bull`"),
        )),
        ("turning", _) => Err((
            Part::Shape,
            "a turning tool is declared in trunnion.toml: `shape = \"turning\"`, `nose_radius = 0.8`, `tip_direction = 3`".to_owned(),
        )),
        ("bull", None) => Err((Part::Shape, "a bull tool needs a corner radius".to_owned())),
        ("bull", Some(radius)) => {
            let most = diameter.map_or(f64::INFINITY, |diameter| diameter / 2.0);
            if radius > 0.0 && radius <= most {
                Ok(ToolShape::Bull(radius))
            } else {
                let message =
                    format!("the corner radius must be greater than 0 mm and at most half the diameter, not {radius}");
                Err((Part::CornerRadius, message))
            }
        }
        _ => {
            let near = did_you_mean(name, &["ball", "flat", "bull", "turning"], &format!("; write {SHAPES}"));
            Err((Part::Shape, format!("unknown tool shape `{name}`{near}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_read() {
        let tool = parse_tool_flag("ball:10").unwrap();
        assert_eq!(
            (tool.number, tool.shape, tool.diameter_mm),
            (0, Some(ToolShape::Ball), Some(10.0))
        );
        assert_eq!(parse_tool_flag("BULL:16:2").unwrap().shape, Some(ToolShape::Bull(2.0)));
    }

    #[test]
    fn broken_flags_say_what_is_wanted() {
        for text in [
            "",
            "ball",
            "ball:",
            "ball:x",
            "ball:-1",
            "ball:0",
            "ball:nan",
            "cone:10",
            "bull:10",
            "bull:10:6",
            "flat:10:1",
            "bull:10:1:1",
        ] {
            assert!(parse_tool_flag(text).is_err(), "{text}");
        }
    }
}
