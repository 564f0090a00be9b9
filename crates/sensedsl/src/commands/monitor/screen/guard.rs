//! The terminal while a screen is on it. It is given back however the program ends.
//!
//! In: nothing. Out: the terminal to draw on. A panic of any thread gives it back before its message is printed, and
//! what is dropped gives it back too; [`is_open`] says whether the screen is still there.

use std::io::{self, Stdout, Write as _, stdout};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use ratatui_core::terminal::Terminal;
use ratatui_crossterm::CrosstermBackend;
use ratatui_crossterm::crossterm::event::{DisableBracketedPaste, EnableBracketedPaste};
use ratatui_crossterm::crossterm::terminal::{
    Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use ratatui_crossterm::crossterm::{cursor, execute};

static IS_OPEN: AtomicBool = AtomicBool::new(false);
static HOOK: Once = Once::new();

/// The terminal, as long as it is ours.
pub(super) struct Guard {
    pub(super) terminal: Terminal<CrosstermBackend<Stdout>>,
}

impl Guard {
    /// Takes the terminal: its own page, and each key as it is pressed.
    pub(super) fn open() -> io::Result<Self> {
        HOOK.call_once(|| {
            let before = std::panic::take_hook();
            std::panic::set_hook(Box::new(move |panic| {
                give_back();
                before(panic);
            }));
        });
        let terminal = Terminal::new(CrosstermBackend::new(stdout()))?;
        let guard = Self { terminal };
        take()?;
        Ok(guard)
    }

    /// Takes it again where something has given it back meanwhile.
    pub(super) fn keep(&mut self) -> io::Result<()> {
        if is_open() {
            return Ok(());
        }
        take()?;
        self.renew()
    }

    /// Draws everything anew the next time: what is on the terminal may be anything.
    pub(super) fn renew(&mut self) -> io::Result<()> {
        // `Terminal::clear` asks the terminal where its cursor is, and the thread that reads keys would get the answer.
        self.terminal = Terminal::new(CrosstermBackend::new(stdout()))?;
        execute!(stdout(), Clear(ClearType::All))
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        give_back();
    }
}

fn take() -> io::Result<()> {
    enable_raw_mode()?;
    IS_OPEN.store(true, Ordering::SeqCst);
    execute!(stdout(), EnterAlternateScreen, EnableBracketedPaste, cursor::Hide)
}

fn is_open() -> bool {
    IS_OPEN.load(Ordering::SeqCst)
}

/// Gives the terminal back, if it is ours.
pub(super) fn give_back() {
    if !IS_OPEN.swap(false, Ordering::SeqCst) {
        return;
    }
    // There is nowhere to report that the terminal is gone.
    let _ = execute!(stdout(), DisableBracketedPaste, LeaveAlternateScreen, cursor::Show);
    let _ = disable_raw_mode();
    let _ = stdout().flush();
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    use std::fs::{File, OpenOptions};
    use std::io::Read as _;
    use std::process::{Command, Stdio};

    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
    use rustix::termios::{LocalModes, tcgetattr};

    const PANICS: &str = "SENSEDSL_TEST_PANICS";

    /// The test runs itself on a terminal, where it panics.
    #[test]
    fn a_panic_is_told_on_the_terminal_as_it_was() {
        if std::env::var_os(PANICS).is_some() {
            let _guard = Guard::open().unwrap();
            panic!("as it was asked to");
        }
        let outer = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&outer).unwrap();
        unlockpt(&outer).unwrap();
        let path = ptsname(&outer, Vec::new()).unwrap().into_string().unwrap();
        let inner = OpenOptions::new().read(true).write(true).open(path).unwrap();
        let end = || Stdio::from(inner.try_clone().unwrap());
        let name =
            "commands::monitor::screen::guard::tests::a_panic_is_told_on_the_terminal_as_it_was";
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", name, "--nocapture"])
            .env(PANICS, "1")
            .env("RUST_BACKTRACE", "0")
            .stdin(end())
            .stdout(end())
            .stderr(end())
            .spawn()
            .unwrap();
        // A terminal holds more than what is printed, so nobody has to read meanwhile.
        assert!(!child.wait().unwrap().success());
        let modes = tcgetattr(&inner).unwrap().local_modes;
        assert!(modes.contains(LocalModes::ICANON | LocalModes::ECHO | LocalModes::ISIG));
        rustix::fs::fcntl_setfl(&outer, rustix::fs::OFlags::NONBLOCK).unwrap();
        let mut seen = Vec::new();
        let _ = File::from(outer).read_to_end(&mut seen);
        let seen = String::from_utf8_lossy(&seen);
        let (before, after) = seen.split_once("\u{1b}[?1049l").unwrap();
        assert!(before.contains("\u{1b}[?1049h") && !before.contains("as it was asked to"));
        assert!(after.contains("\u{1b}[?25h") && after.contains("as it was asked to"), "{seen}");
    }
}
