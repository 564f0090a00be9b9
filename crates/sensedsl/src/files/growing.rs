//! A file that grows while the program runs, such as a record. In: bytes. Out: the file, as soon as the disk takes
//! them.
//!
//! A thread writes, because a disk may be busy for seconds and nobody may wait for it. What it has not taken yet is
//! bounded; a disk that is too slow for good is an error like a full one. A file that is there is never written over.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// How many pieces wait for the disk: a second each, as records are written.
const WAITING_MAX: usize = 60;

/// A file that is appended to.
pub(crate) struct Growing {
    piece: Vec<u8>,
    to_disk: Option<SyncSender<Vec<u8>>>,
    writer: Option<JoinHandle<()>>,
    failed: Arc<Mutex<Option<io::Error>>>,
    written: u64,
}

impl Growing {
    /// Makes a new file.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        let file = OpenOptions::new().write(true).create_new(true).open(path)?;
        let failed = Arc::new(Mutex::new(None));
        let (to_disk, pieces) = sync_channel(WAITING_MAX);
        let told = Arc::clone(&failed);
        let writer = std::thread::spawn(move || write_all(file, &pieces, &told));
        Ok(Self {
            piece: Vec::new(),
            to_disk: Some(to_disk),
            writer: Some(writer),
            failed,
            written: 0,
        })
    }

    /// Waits until everything is written.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        self.to_disk = None;
        if let Some(writer) = self.writer.take() {
            let _ = writer.join();
        }
        self.check()
    }

    /// What went wrong since the last call.
    fn check(&self) -> io::Result<()> {
        let failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner).take();
        failed.map_or(Ok(()), Err)
    }
}

fn write_all(mut file: File, pieces: &Receiver<Vec<u8>>, failed: &Mutex<Option<io::Error>>) {
    for piece in pieces {
        if let Err(error) = file.write_all(&piece) {
            *failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            return;
        }
    }
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.piece.extend_from_slice(bytes);
        self.written += bytes.len() as u64;
        Ok(bytes.len())
    }

    /// Hands everything to the disk.
    fn flush(&mut self) -> io::Result<()> {
        self.check()?;
        if self.piece.is_empty() {
            return Ok(());
        }
        let piece = std::mem::take(&mut self.piece);
        let Some(to_disk) = &self.to_disk else { return Ok(()) };
        match to_disk.try_send(piece) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => Err(io::Error::other("the disk is too slow for it")),
            Err(TrySendError::Disconnected(_)) => {
                self.check()?;
                Err(io::Error::other("the disk takes no more"))
            }
        }
    }
}

/// It only tells where it is: nobody goes back in a file that grows.
impl Seek for Growing {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match to {
            SeekFrom::Current(0) | SeekFrom::End(0) => Ok(self.written),
            SeekFrom::Start(at) if at == self.written => Ok(at),
            SeekFrom::Start(_) | SeekFrom::Current(_) | SeekFrom::End(_) => {
                Err(io::Error::from(io::ErrorKind::Unsupported))
            }
        }
    }
}
