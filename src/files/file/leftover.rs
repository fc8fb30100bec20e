//! Files that a killed run left half written.
//!
//! Whoever writes a file beside the one it is to become holds its lock; where nobody does, whoever began it is gone.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions};
use std::path::Path;

/// Removes the files of a folder whose names `are_ours` says are such files, and that nobody holds.
pub fn clean(folder: &Path, are_ours: impl Fn(&OsStr) -> bool) {
    let Ok(all) = fs::read_dir(folder) else {
        return;
    };
    let ours = all.flatten().filter(|f| are_ours(&f.file_name()));
    for file in ours.filter(|f| f.file_type().is_ok_and(|t| t.is_file())) {
        let path = file.path();
        // A file system without locks keeps them: nobody can tell whose they are.
        let held = OpenOptions::new().write(true).open(&path);
        if held.is_ok_and(|f| f.try_lock().is_ok()) {
            let _ = fs::remove_file(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::clean;
    use std::fs::{self, File};

    #[test]
    fn what_is_held_or_somebody_elses_stays() {
        let folder = std::env::temp_dir().join(format!("ozols-leftover-{}", std::process::id()));
        fs::create_dir_all(folder.join("x.folder")).unwrap();
        let make = |name: &str| File::create(folder.join(name)).unwrap();
        let held = make("x.held");
        held.lock().unwrap();
        drop((make("x.left"), make("y.other")));
        clean(&folder, |name| name.to_string_lossy().starts_with("x."));
        let mut there: Vec<_> = fs::read_dir(&folder)
            .unwrap()
            .map(|f| f.unwrap().file_name().into_string().unwrap())
            .collect();
        there.sort();
        assert_eq!(there, ["x.folder", "x.held", "y.other"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
