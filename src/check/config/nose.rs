//! The nose of a turning tool in `[[tool]]`.
use super::ConfigError;
use super::file::{FileTool, at};
use toml::Spanned;
use trunnion_interp::{Nose, ToolShape};

/// The nose of a turning tool.
pub(super) fn nose(tool: &FileTool) -> Result<Option<ToolShape>, ConfigError> {
    let turning = tool
        .shape
        .as_ref()
        .filter(|name| name.get_ref().eq_ignore_ascii_case("turning"));
    let Some(name) = turning else {
        let stray = tool
            .nose_radius
            .as_ref()
            .map(Spanned::span)
            .or(tool.tip_direction.as_ref().map(Spanned::span));
        return stray.map_or(Ok(None), |span| {
            Err(ConfigError {
                message: "`nose_radius` and `tip_direction` belong to a turning tool: add `shape = \"turning\"`"
                    .to_owned(),
                span: Some(span),
            })
        });
    };
    let (Some(radius), Some(tip)) = (&tool.nose_radius, &tool.tip_direction) else {
        let message =
            "a turning tool needs its nose radius in mm and where its tip is: `nose_radius = 0.8`, `tip_direction = 3`";
        return Err(at(name, message));
    };
    if !(*radius.get_ref() >= 0.0 && radius.get_ref().is_finite()) {
        return Err(at(radius, "`nose_radius` must be 0 mm or more"));
    }
    if *tip.get_ref() > 9 {
        return Err(at(
            tip,
            "`tip_direction` must be 0 to 9, the direction of the imaginary tool nose",
        ));
    }
    if let Some(corner) = &tool.corner_radius {
        return Err(at(corner, "a turning tool has a `nose_radius`, no `corner_radius`"));
    }
    Ok(Some(ToolShape::Turning(Nose {
        radius_mm: *radius.get_ref(),
        tip: *tip.get_ref(),
    })))
}
