//! Outputs that have a path: regular files are replaced whole, anything else is written through.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Writes `content` to the output at `path`.
pub(crate) fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(there) if there.is_file() => overwrite(&fs::canonicalize(path)?, &there, content),
        // Opening a folder for writing fails, and says why.
        Ok(_) => for_writing(path)?.write_all(content),
        Err(error) if error.kind() == ErrorKind::NotFound => create(&link_target(path), content),
        Err(error) => Err(error),
    }
}

/// Replaces a regular file, which keeps its permissions and, where we may set it, its owner.
fn overwrite(path: &Path, there: &Metadata, content: &[u8]) -> io::Result<()> {
    // The administrator could write to it in spite of its permissions.
    if there.permissions().readonly() {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "the file is read-only"));
    }
    for_writing(path)?;
    let neighbour = filled(path, content)?;
    keep_owner(neighbour.as_file(), there);
    neighbour.as_file().set_permissions(there.permissions())?;
    neighbour.persist(path)?;
    Ok(())
}

/// Makes a file where there is none.
fn create(path: &Path, content: &[u8]) -> io::Result<()> {
    filled(path, content)?.persist(path)?;
    Ok(())
}

/// A temporary file with `content` in the folder of `path`; it is removed unless it takes a name.
fn filled(path: &Path, content: &[u8]) -> io::Result<tempfile::NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = neighbour().tempfile_in(folder)?;
    file.write_all(content)?;
    Ok(file)
}

/// Opens what is there, and changes nothing in it.
fn for_writing(path: &Path) -> io::Result<File> {
    OpenOptions::new().write(true).open(path)
}

/// The file that is missing where `path`, or the symbolic link there, leads. Links in a circle are another error than
/// that of a missing file.
fn link_target(path: &Path) -> PathBuf {
    match fs::read_link(path) {
        Ok(target) => link_target(&path.parent().unwrap_or(Path::new("")).join(target)),
        Err(_) => path.to_owned(),
    }
}

/// Gives `file` the owner of what was `there`. Only the administrator may; for others the file becomes their own.
#[cfg(unix)]
fn keep_owner(file: &File, there: &Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let _ = fchown(file, Some(there.uid()), Some(there.gid()));
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) {}

/// Readable by those whom the umask lets read a new file, not by its owner alone as temporary files are.
#[cfg(unix)]
fn neighbour() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = tempfile::Builder::new();
    builder.permissions(fs::Permissions::from_mode(0o666));
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
    fn a_file_is_replaced_whole_and_nothing_is_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write(&path, b"one, and longer").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "two");
        assert!(write(&folder.path().join("missing/b.txt"), b"three").is_err());
        // A folder can't be replaced by a file, even an empty one.
        for inner in ["c.txt/inner", "d.txt"] {
            fs::create_dir_all(folder.path().join(inner)).unwrap();
        }
        assert_eq!(write(&folder.path().join("c.txt"), b"four").unwrap_err().kind(), ErrorKind::IsADirectory);
        assert_eq!(write(&folder.path().join("d.txt"), b"four").unwrap_err().kind(), ErrorKind::IsADirectory);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
    }

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
        use std::process::Command;

        use super::*;

        fn mode(path: &Path) -> u32 {
            fs::metadata(path).unwrap().permissions().mode()
        }

        #[test]
        fn a_file_is_as_readable_as_any_new_file_and_stays_as_readable_as_it_was() {
            let folder = tempfile::tempdir().unwrap();
            let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
            write(&ours, b"").unwrap();
            fs::write(&plain, "").unwrap();
            assert_eq!(mode(&ours), mode(&plain));
            fs::set_permissions(&ours, fs::Permissions::from_mode(0o604)).unwrap();
            write(&ours, b"new").unwrap();
            assert_eq!((mode(&ours) & 0o777, fs::read(&ours).unwrap()), (0o604, b"new".to_vec()));
        }

        #[test]
        fn a_read_only_file_is_an_error_and_stays_what_it_was() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a");
            fs::write(&path, "old").unwrap();
            fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
            assert_eq!(write(&path, b"new").unwrap_err().kind(), ErrorKind::PermissionDenied);
            assert_eq!(fs::read(&path).unwrap(), b"old");
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        }

        #[test]
        fn a_link_stays_and_the_file_that_it_leads_to_is_written_whole() {
            let folder = tempfile::tempdir().unwrap();
            let path = |name: &str| folder.path().join(name);
            fs::create_dir(path("inner")).unwrap();
            // Relative to its own folder, through another link, to a file that is and to one that is not.
            symlink("inner/second", path("first")).unwrap();
            symlink("target", path("inner/second")).unwrap();
            for content in ["made", "replaced"] {
                let before = fs::metadata(path("inner/target")).map(|there| there.ino());
                write(&path("first"), content.as_bytes()).unwrap();
                assert_eq!(fs::read_to_string(path("inner/target")).unwrap(), content);
                assert_ne!(before.ok(), Some(fs::metadata(path("inner/target")).unwrap().ino()), "not in place");
                assert!(path("first").is_symlink() && path("inner/second").is_symlink());
            }
            symlink("round", path("round")).unwrap();
            assert!(write(&path("round"), b"").is_err());
            assert!(path("round").is_symlink());
        }

        #[test]
        fn a_pipe_is_written_through_and_stays_a_pipe() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("pipe");
            assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
            let reader = std::thread::spawn({
                let path = path.clone();
                move || fs::read_to_string(path).unwrap()
            });
            write(&path, b"through").unwrap();
            // Before the reader is joined: if the pipe had been replaced, nobody would ever write to it.
            assert!(fs::symlink_metadata(&path).unwrap().file_type().is_fifo());
            assert_eq!(reader.join().unwrap(), "through");
        }
    }
}
