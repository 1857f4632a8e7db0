//! What LinuxCNC's interpreter is told of a run's setup.
use crate::{Setup, Tool};
use std::sync::Arc;
use trunnion_ngc::{Files, Limits, Loaded, Parameters, Setup as Told, Start, ToolEntry, ToolTable};

/// First parameter of the coordinate systems: X of G54; 20 further on that of G55 (LinuxCNC documentation, Parameters).
const FIRST_SYSTEM: u32 = 5221;
/// Names of the coordinate systems in the order of their parameters.
pub(super) const SYSTEMS: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

/// Called programs by way of the run's library.
struct Library(Arc<dyn crate::Files>);

impl Files for Library {
    fn load(&self, name: &str) -> Result<Loaded, Vec<String>> {
        let loaded = self.0.load(name)?;
        Ok(Loaded {
            path: loaded.path,
            bytes: loaded.bytes,
        })
    }
}

fn row(tool: &Tool) -> ToolEntry {
    let mut offset = [0.0; 9];
    offset[2] = tool.length_mm.unwrap_or(0.0);
    let number = i32::try_from(tool.number).unwrap_or(i32::MAX);
    ToolEntry {
        number,
        pocket: number,
        offset,
        diameter: tool.diameter_mm.unwrap_or(0.0),
        ..ToolEntry::default()
    }
}

/// The setup of the interpreter: declared offsets as parameters, declared tools as its table.
pub(super) fn told(setup: &Setup, declared: &[Tool]) -> Told {
    let mut values = Vec::new();
    for (index, name) in SYSTEMS.iter().enumerate() {
        let offset = setup
            .work_offsets
            .iter()
            .find(|offset| offset.name.eq_ignore_ascii_case(name));
        if let Some(offset) = offset {
            for (axis, value) in offset.values.into_iter().enumerate() {
                values.push((FIRST_SYSTEM + 20 * index as u32 + axis as u32, value));
            }
        }
    }
    let tools = setup.tools.iter().chain(declared).filter(|tool| tool.number != 0);
    Told {
        start: Start::Unknown,
        tools: ToolTable {
            rows: tools.map(row).collect(),
            ..ToolTable::default()
        },
        parameters: Parameters { values },
        files: setup.library.0.clone().map(|files| Arc::new(Library(files)) as Arc<dyn Files>),
        limits: Limits {
            blocks: setup.limits.blocks,
            depth: setup.limits.depth,
        },
        ..Told::default()
    }
}
