//! Pages that are made from the headers of source files: compared, or written again under `UPDATE=1`.
use std::path::Path;

/// Compares the pages (file name, text) with those in `folder` of the repository. Panics, naming the stale ones and `test`, the
/// test file that writes them again; a page that nothing makes any more is stale too.
pub(crate) fn assert_fresh(folder: &str, wanted: &[(String, String)], test: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let update = std::env::var_os("UPDATE").is_some();
    if update {
        std::fs::create_dir_all(&path).expect("the folder can be made");
    }
    let mut stale = Vec::new();
    for (name, text) in wanted {
        let page = path.join(name);
        if std::fs::read_to_string(&page).ok().as_ref() == Some(text) {
            continue;
        }
        if update {
            std::fs::write(&page, text).expect("the page can be written");
        } else {
            stale.push(name.clone());
        }
    }
    for entry in std::fs::read_dir(&path).expect("the folder is there").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if wanted.iter().all(|(known, _)| *known != name) {
            stale.push(format!("{name} (nothing of that name)"));
        }
    }
    assert!(
        stale.is_empty(),
        "stale in {folder}: {}; run UPDATE=1 cargo test --test all {test}",
        stale.join(", ")
    );
}
