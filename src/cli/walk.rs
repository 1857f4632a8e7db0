//! Files to check: arguments as they are, directories walked.
use super::failure::Failure;
use std::path::PathBuf;
use walkdir::WalkDir;

/// Files named by `paths`, directories walked in name order for the extensions of programs. A directory without any is a failure.
pub(crate) fn programs(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let before = files.len();
        for entry in WalkDir::new(path).sort_by_file_name() {
            let entry = entry.map_err(|error| Failure::file(path, error))?;
            if entry.file_type().is_file()
                && entry
                    .file_name()
                    .to_str()
                    .is_some_and(trunnion_dialect::is_program_file_name)
            {
                files.push(entry.into_path());
            }
        }
        if files.len() == before {
            let known = trunnion_dialect::program_extensions().join(" .");
            return Err(Failure::file(
                path,
                format!(
                    "no program in this directory (looked for .{known}); name the file itself if it has another extension"
                ),
            ));
        }
    }
    Ok(files)
}
