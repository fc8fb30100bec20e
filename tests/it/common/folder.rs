//! A folder of files for one test, gone with it, and commands that run in it.

use super::*;

pub(crate) struct Folder(TempDir);

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        self.0.path()
    }
}

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(tempdir().unwrap())
    }

    /// Returns a folder with one file.
    pub(crate) fn with(name: &str, content: impl AsRef<[u8]>) -> Folder {
        let folder = Folder::new();
        folder.put(name, content);
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, and makes the folders that it is in.
    pub(crate) fn put(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub(crate) fn text(&self, name: &str) -> String {
        utf8_text(&self.bytes(name))
    }

    /// Returns the names of the files and folders in it, in order.
    pub(crate) fn names(&self) -> Vec<String> {
        let all = fs::read_dir(&self.0).unwrap();
        let name = |f: std::io::Result<fs::DirEntry>| f.unwrap().file_name().into_string();
        all.map(|f| name(f).unwrap()).sorted().collect()
    }

    /// Returns the exit code, standard output and standard error of a command that runs in this folder.
    pub(crate) fn run<L: Line + ?Sized>(&self, args: &L) -> (Option<i32>, String, String) {
        let o = ozols(args).current_dir(&self.0).output().unwrap();
        (o.status.code(), utf8_text(&o.stdout), utf8_text(&o.stderr))
    }

    /// Returns standard output and standard error of a command that succeeds in this folder.
    #[track_caller]
    pub(crate) fn succeed<L: Line + ?Sized>(&self, args: &L) -> (String, String) {
        let (code, said, told) = self.run(args);
        assert_eq!(code, Some(0), "{:?}: {told}", args.words());
        (said, told)
    }

    /// Returns the JSON on standard output of a command in this folder, whatever its exit code.
    #[track_caller]
    pub(crate) fn json<L: Line + ?Sized>(&self, args: &L) -> Value {
        let (_, said, told) = self.run(&[&args.words()[..], &["--format", "json"]].concat());
        serde_json::from_str(&said).unwrap_or_else(|e| panic!("{e}: {said}{told}"))
    }

    /// Asserts that a command in this folder ends with exit code 2 and an error that contains these words.
    #[track_caller]
    pub(crate) fn assert_fails<L: Line + ?Sized>(&self, args: &L, says: &str) {
        let (code, _, told) = self.run(args);
        assert_eq!(code, Some(2), "{:?}: {told}", args.words());
        has(&told, says);
    }
}
