//! Writes a file whole or not at all. A program that is interrupted while it writes a report or a baseline must not
//! leave half a file, which the next run would read.

use std::io::{self, Write};
use std::path::Path;

/// Writes `content` to a temporary file in the folder of `path`, and then renames it to `path`. A reader of `path`
/// therefore sees the old content or the new one, never a part. If an error is returned, no temporary file is left
/// behind.
///
/// # Errors
/// If the temporary file can't be written or renamed. The folder has to exist.
pub fn write(path: &Path, content: &str) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = neighbour().tempfile_in(folder)?;
    file.write_all(content.as_bytes())?;
    file.persist(path)?;
    Ok(())
}

/// Settings of the temporary file. Its permissions are those of any new file under the umask, because the default of
/// temporary files, readable by the owner alone, would stay after the renaming.
#[cfg(unix)]
fn neighbour() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = tempfile::Builder::new();
    builder.permissions(std::fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn neighbour() -> tempfile::Builder<'static, 'static> {
    tempfile::Builder::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_a_file_and_leaves_no_temporary_file_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write(&path, "one, and longer").unwrap();
        write(&path, "two").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "two");
        assert!(write(&folder.path().join("missing/b.txt"), "three").is_err());
        // A folder can't be replaced by a file.
        std::fs::create_dir_all(folder.path().join("c.txt/inner")).unwrap();
        assert!(write(&folder.path().join("c.txt"), "four").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_written_file_has_the_permissions_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write(&ours, "").unwrap();
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}
