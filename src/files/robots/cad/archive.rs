//! Zip archives, bounded: members read one by one, and an archive written again with one member changed.

use crate::file::problem::ImportError;
use crate::robots::warning::{syntax_problem, too_large};
use crate::robots::xml::MAX_BYTES;
use std::io::{Cursor, Read, Write};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// What archives begin with.
const MAGIC: &[u8] = b"PK\x03\x04";
const REMEDY: &str = "save the document again with FreeCAD";

/// An archive in memory.
#[derive(Debug, Clone)]
pub(crate) struct Archive {
    name: String,
    bytes: Vec<u8>,
}

impl Archive {
    /// Returns the archive in the bytes, if they are one.
    pub(crate) fn of(name: &str, bytes: &[u8]) -> Option<Archive> {
        let archive = || Archive {
            name: name.to_owned(),
            bytes: bytes.to_vec(),
        };
        bytes.starts_with(MAGIC).then(archive)
    }

    fn fail(&self, why: &ZipError) -> ImportError {
        let message = format!("the zip archive cannot be read ({why}); {REMEDY}");
        syntax_problem(message).in_file(&self.name, "", None)
    }

    fn open(&self) -> Result<ZipArchive<Cursor<&[u8]>>, ImportError> {
        ZipArchive::new(Cursor::new(&self.bytes[..])).map_err(|e| self.fail(&e))
    }

    /// Returns the bytes of a member, or `None` if it does not exist.
    ///
    /// # Errors
    /// Returns an error if the archive is broken, or if the member is larger than a description may be.
    pub(crate) fn member(&self, member: &str) -> Result<Option<Vec<u8>>, ImportError> {
        let mut archive = self.open()?;
        let found = match archive.by_name(member) {
            Ok(found) => found,
            Err(ZipError::FileNotFound) => return Ok(None),
            Err(e) => return Err(self.fail(&e)),
        };
        let mut out = Vec::new();
        // What a header says of the size need not be so.
        let limit = MAX_BYTES as u64 + 1;
        found
            .take(limit)
            .read_to_end(&mut out)
            .map_err(|e| self.fail(&ZipError::Io(e)))?;
        if out.len() > MAX_BYTES {
            let name = format!("{}:{member}", self.name);
            return Err(too_large(out.len(), MAX_BYTES).in_file(&name, "", None));
        }
        Ok(Some(out))
    }

    /// Returns the archive with a new content of one member; all others stay byte for byte, with the same compression.
    ///
    /// # Errors
    /// Returns an error if the archive is broken.
    pub(crate) fn with(&self, member: &str, content: &[u8]) -> Result<Vec<u8>, ImportError> {
        let mut archive = self.open()?;
        let mut out = ZipWriter::new(Cursor::new(Vec::new()));
        out.set_raw_comment(archive.comment().into())
            .map_err(|e| self.fail(&e))?;
        for at in 0..archive.len() {
            let old = archive.by_index_raw(at).map_err(|e| self.fail(&e))?;
            if old.name().map_err(|e| self.fail(&e))? != member {
                out.raw_copy_file(old).map_err(|e| self.fail(&e))?;
                continue;
            }
            let mut options =
                SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
            if let Some(time) = old.last_modified() {
                options = options.last_modified_time(time);
            }
            out.start_file(member, options).map_err(|e| self.fail(&e))?;
            out.write_all(content)
                .map_err(|e| self.fail(&ZipError::Io(e)))?;
        }
        let done = out.finish().map_err(|e| self.fail(&e))?;
        Ok(done.into_inner())
    }
}
