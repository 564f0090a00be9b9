//! `sensedsl studio`: the page on loopback, with the files of a folder.
//!
//! Only who has the address that is printed gets in: it has a token, which the page sends with each request for a file.
//! Requests that name another host, or come from a page of another origin, are refused, so that no web site that is open
//! beside it can reach the folder.

mod answer;
mod boards;
mod folder;
mod guard;
mod site;

use std::net::Ipv4Addr;
use std::sync::Arc;

use anyhow::{Context as _, Result, anyhow};
use tiny_http::{Request, Server};

use self::answer::{Answer, Method};
use self::boards::Boards;
use self::folder::Folder;
use self::guard::Guard;
use self::site::Site;
use crate::cli::StudioArgs;
use crate::files::shown;
use crate::status::Status;
use crate::terminal::Terminal;

/// How many requests are answered at once: one that is slow does not hold up the others.
const THREADS: usize = 4;

/// What all requests need.
struct Studio {
    site: Site,
    folder: Folder,
    boards: Boards,
    guard: Guard,
}

pub(crate) fn run(args: &StudioArgs, terminal: &mut Terminal) -> Result<Status> {
    let site = Site::find(args.site.as_deref())?;
    let folder = Folder::open(&args.folder)?;
    let server = Server::http((Ipv4Addr::LOCALHOST, args.port)).map_err(|why| {
        anyhow!("cannot listen on port {}: {why}; choose another port with --port", args.port)
    })?;
    let port = server.server_addr().to_ip().map(|at| at.port()).context("no port")?;
    let guard = Guard::new(port)?;
    let url = guard.url();
    terminal
        .aside(&format!("serving the files of {}; press Ctrl-C to stop", shown(folder.root())))?;
    terminal.result(&format!("{url}\n"))?;
    if args.open {
        open(&url).with_context(|| format!("cannot start a browser; open {url}"))?;
    }
    let boards = Boards::of(folder.root());
    let studio = Arc::new(Studio { site, folder, boards, guard });
    let server = Arc::new(server);
    let threads = (1..THREADS).map(|_| {
        let (studio, server) = (Arc::clone(&studio), Arc::clone(&server));
        std::thread::spawn(move || studio.serve(&server))
    });
    let threads: Vec<_> = threads.collect();
    studio.serve(&server);
    for thread in threads {
        let _ = thread.join();
    }
    Ok(Status::Done)
}

impl Studio {
    /// Answers requests, until there is nobody to answer.
    fn serve(&self, server: &Server) {
        while let Ok(mut request) = server.recv() {
            let answer = self.answer(&mut request);
            // Who asked may have gone.
            let _ = answer.send(request);
        }
    }

    fn answer(&self, request: &mut Request) -> Answer {
        if let Err(refused) = self.guard.admits(request) {
            return refused;
        }
        let url = request.url().to_owned();
        let (path, query) = url.split_once('?').unwrap_or((&url, ""));
        let method = Method::of(request);
        if let Some(path) = path.strip_prefix("/api/") {
            if !self.guard.has_token(request) {
                return Answer::refused(
                    403,
                    "the token is missing: open the address that the terminal shows",
                );
            }
            return self.called(method, path, request);
        }
        match (method, path) {
            (Method::Get, "/" | "/index.html") if self.guard.is_token(query) => {
                self.site.page(self.guard.token())
            }
            (Method::Get, "/" | "/index.html") => Answer::refused(
                403,
                "open the address that the terminal shows: it ends with a token",
            ),
            // The server is on this machine: a page that is kept for times without it would only grow old.
            (Method::Get, "/service.js") => Answer::refused(404, "not found"),
            (Method::Get, path) => self.site.file(path),
            (_, _) => Answer::refused(405, "files of the page can only be read"),
        }
    }
}

impl Studio {
    /// What the page's program asks for.
    fn called(&self, method: Method, path: &str, request: &mut Request) -> Answer {
        let (what, of) = path.split_once('/').unwrap_or((path, ""));
        match (method, what) {
            (Method::Get, "project") => self.folder.project(),
            (_, "files") => self.folder.answer(method, of, request),
            (Method::Post, "boards") => self.boards.answer(of, request),
            (Method::Delete, "boards") => {
                self.boards.end(of);
                Answer::json(200, &serde_json::Value::Null)
            }
            (_, _) => Answer::refused(404, "not found"),
        }
    }
}

/// Starts the browser of this system.
fn open(url: &str) -> Result<()> {
    let (program, first): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut call = std::process::Command::new(program);
    call.args(first).arg(url).stdin(std::process::Stdio::null());
    call.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
    call.spawn().with_context(|| shown(program))?;
    Ok(())
}
