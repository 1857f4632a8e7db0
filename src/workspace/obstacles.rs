//! Obstacles that comments of a program declare: `(trunnion: obstacle name = "clamp", box = [[0, 0, 0], [40, 20, 30]])`.
use crate::LoadError;
use std::path::Path;
use trunnion_dialect::Dialect;
use trunnion_interp::{Directive, directives, may_declare_obstacles};
use trunnion_machine::{Machine, Obstacle};
use trunnion_syntax::{LineIndex, parse};

/// Adds them to the machine. An obstacle that cannot be read is an error and no finding: nothing may be judged clear of what is not known.
///
/// # Errors
/// What is wrong with one, with its place.
pub(crate) fn declare(
    path: Option<&Path>,
    source: &[u8],
    dialect: &Dialect,
    mut machine: Option<&mut Machine>,
) -> Result<(), LoadError> {
    if !may_declare_obstacles(source) {
        return Ok(());
    }
    let program = parse(source.to_vec(), dialect.lex);
    let mut all: Vec<Obstacle> = machine
        .as_ref()
        .map_or(Vec::new(), |machine| machine.obstacles.0.clone());
    for (range, directive) in directives(&program) {
        let Directive::Obstacle(keys) = directive else { continue };
        let wrong = |message: String| {
            let (line, column) = LineIndex::new(source).line_column(source, range.start);
            let name = path.map_or_else(|| "<stdin>".to_owned(), |path| path.display().to_string());
            LoadError {
                place: format!("{name}:{line}:{column}"),
                message: format!(
                    "this obstacle cannot be read: {message}; write the keys of [[obstacle]], for example (trunnion: obstacle name = \"clamp\", \
                     box = [[0, 0, 0], [40, 20, 30]])"
                ),
            }
        };
        let obstacle = Obstacle::from_line(&keys, &all).map_err(wrong)?;
        if let (Some(machine), Some(letter)) = (&machine, obstacle.axis)
            && machine.axes.iter().all(|axis| axis.letter != letter)
        {
            return Err(wrong(format!(
                "machine {} has no axis {}",
                machine.id,
                char::from(letter)
            )));
        }
        all.push(obstacle);
    }
    if let Some(machine) = &mut machine {
        machine.obstacles.0 = all;
    }
    Ok(())
}
