//! `sensedsl studio` as browsers and others talk to it: who is let in, and what becomes of a folder's files.

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use sensedsl_tests::{TempDir, binary};
use serde_json::Value;

const ROBOT: &str = "board B on STM32F407G_DISC1 {}\n";

/// A server with a folder and a page of its own.
struct Studio {
    folder: TempDir,
    _site: TempDir,
    server: Child,
    port: u16,
    token: String,
}

/// An answer: the status, the headers, the body.
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn tag(&self) -> &str {
        let line = self.head.lines().find_map(|line| line.strip_prefix("ETag: "));
        line.unwrap_or_else(|| panic!("{}", self.head))
    }
}

impl Studio {
    fn start(name: &str) -> Self {
        let folder = TempDir::new(name);
        folder.write("robot.sense", ROBOT);
        folder.write(".hidden/secret.sense", "secret");
        folder.write("notes.txt", "notes");
        let site = TempDir::new(&format!("{name}-site"));
        site.write("index.html", "<head><title>Page</title></head>");
        let mut call = Command::new(binary());
        call.arg("studio").arg(folder.join("robot.sense")).arg("--site").arg(site.join(""));
        call.stdout(Stdio::piped()).stderr(Stdio::null());
        let mut server = call.spawn().unwrap();
        let mut url = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut url).unwrap();
        let (host, token) = url.trim().split_once("/?token=").unwrap();
        let port = host.rsplit_once(':').unwrap().1.parse().unwrap();
        Self { folder, _site: site, server, port, token: token.to_owned() }
    }

    /// Sends a request with these headers, and those of the page unless they are there.
    fn ask(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let host = format!("127.0.0.1:{}", self.port);
        let own = [("Host", host.as_str()), ("X-Sensedsl-Token", &self.token)];
        let is_missing = |name: &str| headers.iter().all(|(other, _)| *other != name);
        let own = own.into_iter().filter(|(name, _)| is_missing(name));
        let all = own.chain(headers.iter().copied());
        let all: String = all.map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        let length = body.len();
        let mut stream = TcpStream::connect(&host).unwrap();
        write!(stream, "{method} {path} HTTP/1.1\r\n{all}Content-Length: {length}\r\nConnection: close\r\n\r\n{body}").unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, head: head.to_owned(), body: body.to_owned() }
    }

    fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, &[], "")
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

#[test]
fn only_the_page_that_was_opened_gets_in() {
    let studio = Studio::start("studio-guard");
    let page = studio.get(&format!("/?token={}", studio.token));
    assert!(page.body.contains(&format!("content=\"{}\"", studio.token)), "{}", page.body);
    assert!(page.head.contains("Content-Security-Policy: default-src 'self'"), "{}", page.head);
    assert_eq!((studio.get("/").status, studio.get("/?token=0").status), (403, 403));
    let own = format!("http://localhost:{}", studio.port);
    let local = format!("localhost:{}", studio.port);
    let project = |headers: &[(&str, &str)]| studio.ask("GET", "/api/project", headers, "").status;
    assert_eq!(project(&[]), 200);
    assert_eq!(
        project(&[("Host", &local), ("Origin", &own), ("Sec-Fetch-Site", "same-origin")]),
        200
    );
    assert_eq!(project(&[("X-Sensedsl-Token", "0")]), 403);
    // A page of another origin, also one on this machine.
    assert_eq!(project(&[("Origin", "http://evil.example")]), 403);
    assert_eq!(project(&[("Origin", "null")]), 403);
    assert_eq!(project(&[("Origin", "http://localhost:1")]), 403);
    assert_eq!(project(&[("Sec-Fetch-Site", "cross-site")]), 403);
    assert_eq!(project(&[("Sec-Fetch-Site", "same-site")]), 403);
    // A name that was made to lead here.
    let rebound = format!("evil.example:{}", studio.port);
    assert_eq!(project(&[("Host", &rebound)]), 421);
    assert_eq!(studio.ask("GET", "/", &[("Host", &rebound)], "").status, 421);
    assert_eq!(studio.ask("OPTIONS", "/api/project", &[], "").status, 404);
    assert_eq!(studio.ask("POST", "/", &[], "x").status, 405);
}

#[test]
fn a_file_is_written_if_it_is_still_what_was_read() {
    let studio = Studio::start("studio-files");
    let project: Value = serde_json::from_str(&studio.get("/api/project").body).unwrap();
    assert_eq!(project["files"], serde_json::json!({ "robot.sense": ROBOT }));
    assert_eq!(project["open"], "robot.sense");
    let path = "/api/files/robot.sense";
    let first = studio.get(path);
    assert_eq!((first.status, first.body.as_str()), (200, ROBOT));
    assert_eq!(project["etags"]["robot.sense"], first.tag());
    assert_eq!(studio.ask("PUT", path, &[], "new").status, 428);
    let written = studio.ask("PUT", path, &[("If-Match", first.tag())], "new");
    assert_eq!((written.status, written.body.as_str()), (200, ""));
    assert_eq!(fs::read_to_string(studio.folder.join("robot.sense")).unwrap(), "new");
    // Somebody else has changed it since.
    let stale = studio.ask("PUT", path, &[("If-Match", first.tag())], "mine");
    assert_eq!((stale.status, stale.body.as_str(), stale.tag()), (409, "new", written.tag()));
    assert_eq!(studio.ask("PUT", path, &[("If-None-Match", "*")], "mine").status, 409);
    let made = studio.ask("PUT", "/api/files/sub/a%20b.csv", &[("If-None-Match", "*")], "Pin\n");
    assert_eq!(made.status, 200);
    assert_eq!(fs::read_to_string(studio.folder.join("sub/a b.csv")).unwrap(), "Pin\n");
    let gone = studio.ask("DELETE", path, &[("If-Match", written.tag())], "");
    assert_eq!((gone.status, studio.folder.join("robot.sense").exists()), (200, false));
}

#[test]
fn nothing_outside_of_the_folder_is_read_or_written() {
    let studio = Studio::start("studio-outside");
    let outside = TempDir::new("studio-outside-of-it");
    outside.write("other.sense", "other");
    std::os::unix::fs::symlink(outside.join("other.sense"), studio.folder.join("link.sense"))
        .unwrap();
    std::os::unix::fs::symlink(outside.join(""), studio.folder.join("out")).unwrap();
    for path in [
        "..%2fother.sense",
        "../other.sense",
        "%2fetc%2fpasswd",
        "/etc/passwd",
        "a/../../b.sense",
        ".hidden/secret.sense",
        "notes.txt",
        "link.sense",
        "out/other.sense",
        "%ff.sense",
        "a%00.sense",
        "c:%5cb.sense",
        "",
    ] {
        let path = format!("/api/files/{path}");
        let read = studio.get(&path);
        assert_eq!(read.status, 404, "{path}: {}", read.body);
        let written = studio.ask("PUT", &path, &[("If-None-Match", "*")], "new");
        assert!([403, 404, 409].contains(&written.status), "{path}: {}", written.status);
    }
    assert_eq!(fs::read_to_string(outside.join("other.sense")).unwrap(), "other");
    assert_eq!(fs::read_dir(outside.join("")).unwrap().count(), 1);
    for path in
        ["/../robot.sense", "/%2e%2e/robot.sense", "/.hidden", "//etc/passwd", "/service.js"]
    {
        assert_eq!(studio.get(path).status, 404, "{path}");
    }
    let large = "x".repeat(64 << 20);
    let tag = studio.get("/api/files/robot.sense").tag().to_owned();
    let mut stream = TcpStream::connect(("127.0.0.1", studio.port)).unwrap();
    let head = format!(
        "PUT /api/files/robot.sense HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Sensedsl-Token: {}\r\nIf-Match: {tag}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        studio.port,
        studio.token,
        large.len()
    );
    stream.write_all(head.as_bytes()).unwrap();
    // The server may refuse it before all is there.
    let _ = stream.write_all(large.as_bytes());
    let mut answer = String::new();
    let _ = stream.read_to_string(&mut answer);
    assert!(answer.is_empty() || answer.starts_with("HTTP/1.1 413"), "{answer}");
    assert_eq!(fs::read_to_string(studio.folder.join("robot.sense")).unwrap(), ROBOT);
    assert_eq!(studio.get("/api/project").status, 200);
}

/// The code of a controller in the folder is compiled and stepped, and the robot follows its line.
#[test]
fn a_robot_with_code_drives_on_its_map() {
    let studio = Studio::start("studio-drives");
    let folder = studio.folder.join("follower");
    let made = Command::new(binary())
        .arg("new")
        .arg(&folder)
        .args(["--template", "line_follower", "--quiet"])
        .output()
        .unwrap();
    assert!(made.status.success(), "{made:?}");
    fs::write(folder.join("picture.svg"), "<svg/>").unwrap();
    let project: Value = serde_json::from_str(&studio.get("/api/project").body).unwrap();
    let files = project["files"].as_object().unwrap();
    assert!(files.contains_key("follower/oval.svg"), "a world names it");
    assert!(!files.contains_key("follower/picture.svg"), "no world names it");
    let call = |board: &str, call: Value| -> Value {
        let path = format!("/api/boards/{board}");
        let answer = studio.ask("POST", &path, &[], &call.to_string());
        assert_eq!(answer.status, 200, "{}", answer.body);
        serde_json::from_str(&answer.body).unwrap()
    };
    let of = serde_json::json!({ "path": "follower/robot.sense", "files": files });
    let robot = serde_json::json!({ "do": "robot", "of": of, "world": "follower/oval.toml" });
    let told = call("one", robot.clone());
    let told = &told["robot"];
    assert_eq!((&told["has_code"], &told["controllers"][0]), (&true.into(), &"Follow".into()));
    assert!(told["maps"][0]["strokes"].as_array().unwrap().len() > 1, "{told}");
    let seen = call("one", serde_json::json!({ "do": "run", "until_ms": 2_000 }));
    let way = seen["figures"][0].as_str().unwrap();
    let metres: f64 = way.split([' ', ':']).find_map(|word| word.parse().ok()).unwrap();
    assert!(metres > 0.8 && way.contains("off the line"), "{way}");
    assert_eq!(
        seen["notes"],
        serde_json::json!([{ "level": "info", "text": seen["notes"][0]["text"] }])
    );

    // What the compiler says is told, and what was mended runs.
    let code = folder.join("build/firmware/Robot/user/follow.c");
    let text = fs::read_to_string(&code).unwrap();
    let broken = text.replace("last_mm = now_mm;", "last_mm = now_mm");
    fs::write(&code, broken).unwrap();
    let refused = call("one", robot.clone());
    let wrong = &refused["diagnostics"][0];
    assert_eq!((&refused["robot"], &wrong["code"]), (&Value::Null, &"E0535".into()));
    assert!(wrong["message"].as_str().unwrap().contains("user/follow.c:"), "{wrong}");
    assert_eq!(wrong["file"], "follower/robot.sense");
    fs::write(&code, "#include \"follow.h\"\nvoid follow_init(void) {}\nvoid follow_step(const struct follow_in *in, struct follow_out *out, uint32_t dt_us) { (void)in; (void)out; for (;;) { if (dt_us > 0) __builtin_trap(); else break; } }\n").unwrap();
    call("one", robot.clone());
    let seen = call("one", serde_json::json!({ "do": "run", "until_ms": 100 }));
    let notes = seen["notes"].to_string();
    assert!(notes.contains("the controllers' code stopped after 0.00"), "{notes}");

    // What is not a number sets nothing, and what is too much sets the most.
    let wild = "#include \"follow.h\"\n#include <math.h>\nvoid follow_init(void) {}\n\
        void follow_step(const struct follow_in *in, struct follow_out *out, uint32_t dt_us) {\n\
        (void)in; (void)dt_us; follow_set_left(out, NAN); follow_set_right(out, 1e9f); }\n";
    fs::write(&code, wild).unwrap();
    call("one", robot.clone());
    let seen = call("one", serde_json::json!({ "do": "run", "until_ms": 100 }));
    let outputs = seen["outputs"].as_array().unwrap().iter();
    let numbers: Vec<&Value> = outputs.map(|one| &one[1][0]).collect();
    assert_eq!(numbers[..2], [&serde_json::json!(0.0), &serde_json::json!(100.0)], "{seen}");

    // Without code the world's PID stands in for it.
    fs::remove_dir_all(folder.join("build")).unwrap();
    let told = call("two", robot.clone());
    assert_eq!(told["robot"]["has_code"], false);
    assert_eq!(told["robot"]["stand_ins"], serde_json::json!(["Follow"]));
    let seen = call("two", serde_json::json!({ "do": "run", "until_ms": 1_000 }));
    assert!(seen["figures"][0].as_str().unwrap().contains("off the line"), "{seen}");
    assert_eq!(studio.ask("DELETE", "/api/boards/two", &[], "").status, 200);
    let run = "{\"do\":\"run\",\"until_ms\":2000}";
    assert_eq!(studio.ask("POST", "/api/boards/two", &[], run).status, 410);
}

/// Only the page runs boards, and the oldest of too many ends.
#[test]
fn boards_are_the_pages_own() {
    let studio = Studio::start("studio-boards");
    let path = "/api/boards/one";
    assert_eq!(studio.ask("POST", path, &[("X-Sensedsl-Token", "0")], "{}").status, 403);
    assert_eq!(studio.ask("POST", path, &[("Origin", "http://evil.example")], "{}").status, 403);
    let text =
        "board B on STM32F407G_DISC1 { sensor Light returns uint16 { id = 1; type = analog; } }";
    let of = serde_json::json!({ "path": "a.sense", "files": { "a.sense": text } });
    let robot = serde_json::json!({ "do": "robot", "of": of }).to_string();
    for name in ["one", "two", "three", "four", "five"] {
        let told = studio.ask("POST", &format!("/api/boards/{name}"), &[], &robot);
        assert!(told.body.contains("\"board\":\"B\""), "{}", told.body);
    }
    let run = |name: &str| {
        let path = format!("/api/boards/{name}");
        studio.ask("POST", &path, &[], "{\"do\":\"run\",\"until_ms\":20}")
    };
    assert!(run("five").body.contains("\"now_ms\":20"));
    assert_eq!(run("one").status, 410, "it was the oldest");
    assert_eq!(studio.ask("POST", path, &[], "{").status, 410);
    assert!(studio.ask("POST", "/api/boards/five", &[], "{").body.contains("error"));
    let head = studio.ask("HEAD", &format!("/?token={}", studio.token), &[], "");
    assert!(head.body.is_empty() && head.head.contains("Content-Length: "), "{}", head.head);
    assert_eq!(studio.ask("GET", path, &[], "").status, 404);
}
