//! Parsers of Markdown, XML, CSV, JSON, SARIF and GitHub's commands read the output.

use std::path::Path;
use std::process::Command;

use sensedsl_diagnostics::is_hidden;
use sensedsl_tests::{RunOutput, has, printed, read, run, sensedsl};
use serde_json::Value;

use super::corpus::{Project, projects};

/// The wiring in CSV, as Python's reader parses it.
fn rows(project: &Project) -> Vec<Vec<String>> {
    let script = "
import csv, json, sys
json.dump(list(csv.reader(open(sys.argv[1], newline='', encoding='utf-8'), strict=True)), sys.stdout)";
    let csv = call(project, &["solve", "--format", "csv"]).exits(0).stdout;
    let file = project.source.with_extension("wiring.csv");
    std::fs::write(&file, &csv).unwrap();
    let rows = printed(Command::new("python3").args(["-c", script]).arg(file));
    serde_json::from_str(&rows).unwrap()
}

fn call(project: &Project, arguments: &[&str]) -> RunOutput {
    sensedsl(arguments).arg(&project.source).run()
}

#[test]
fn csv_has_a_cell_for_each_and_no_formula() {
    if !has("python3") {
        return;
    }
    for project in projects() {
        let rows = rows(project);
        assert_eq!(rows.len(), 1 + project.texts.len() + 2);
        for row in &rows {
            assert_eq!(row.len(), 11, "{row:?}");
            for cell in row {
                assert!(cell.len() < 2 || !cell.starts_with(['=', '+', '-', '@']), "{row:?}");
                assert!(!cell.contains(is_hidden), "{row:?}");
            }
        }
    }
}

/// The HTML without links to mail addresses, which no escape prevents in GitHub's dialect; they
/// lead where their text says.
fn without_mail(html: &str) -> String {
    let mut parts = html.split("<a href=\"mailto:");
    let mut out = parts.next().unwrap().to_owned();
    for part in parts {
        let (address, rest) = part.split_once("\">").unwrap();
        let (text, rest) = rest.split_once("</a>").unwrap();
        assert_eq!(address, text);
        out.push_str(text);
        out.push_str(rest);
    }
    out
}

/// The text of HTML in the form that cmark writes.
fn unescaped(html: &str) -> String {
    let text = html.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
    text.replace("&amp;", "&")
}

#[test]
fn markdown_shows_text_in_cells() {
    if !has("cmark-gfm") || !has("python3") {
        return;
    }
    for project in projects() {
        let mut command = Command::new("cmark-gfm");
        command.args([
            "--unsafe",
            "-e",
            "table",
            "-e",
            "autolink",
            "-e",
            "strikethrough",
            "-e",
            "footnotes",
        ]);
        let html = printed(command.arg(project.output.join("wiring.md")));
        let html = without_mail(&html);
        for element in ["<script", "<a", "<img", "<em", "<del", "<code", "<b>", "<!", "<li"] {
            assert!(!html.contains(element), "{element} in\n{html}");
        }
        // The table of all pins is below the parts.
        let (_, pins) = html.split_once("<h3>Pins</h3>").unwrap();
        let rows: Vec<Vec<String>> = pins
            .split("<tr>")
            .skip(2)
            .map(|row| {
                let cells = row.split("<td").skip(1).map(|cell| {
                    let cell = cell.split_once('>').unwrap().1.split_once("</td>").unwrap().0;
                    unescaped(cell)
                });
                cells.collect()
            })
            .collect();
        let expected = self::rows(project);
        assert_eq!(rows.len() + 1, expected.len(), "{html}");
        for (row, expected) in rows.iter().zip(expected.iter().skip(1)) {
            assert_eq!(row.len(), 8, "{row:?}");
            // The apostrophe is only for spreadsheets.
            let place = expected[8]
                .strip_prefix('\'')
                .filter(|rest| rest.starts_with(['=', '+', '-', '@']));
            assert_eq!(row[6].trim(), place.unwrap_or(&expected[8]).trim());
        }
    }
}

#[test]
fn the_picture_is_xml_with_the_text_in_it() {
    if !has("python3") {
        return;
    }
    let script = "
import sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
for element in root.iter():
    name = element.tag.split('}')[1]
    assert name in ('svg', 'title', 'style', 'g', 'rect', 'circle', 'path', 'text'), name
    assert name != 'style' or not any(word in element.text for word in ('url', 'import', 'expression'))
    assert not any(key.startswith('on') or 'href' in key for key in element.attrib), element.attrib
    if name in ('text', 'title'):
        print(element.text)";
    for project in projects() {
        let mut command = Command::new("python3");
        command.env("PYTHONIOENCODING", "utf-8").args(["-c", script]);
        let texts = printed(command.arg(project.output.join("pinout.svg")));
        assert!(!texts.contains(|c| is_hidden(c) && c != '\n'), "{texts}");
        assert!(
            texts.lines().filter(|line| line.contains("(ADC12_IN")).count() >= project.texts.len()
        );
    }
}

#[test]
fn json_says_the_very_text() {
    for project in projects() {
        let schema: Value =
            serde_json::from_str(&read(&project.output.join("schema.json"))).unwrap();
        let items = schema["boards"][0]["items"].as_array().unwrap();
        for (item, text) in items.iter().zip(project.texts) {
            assert_eq!(item["label"], *text);
            assert_eq!(item["quantity"], *text);
        }
        if has("python3") {
            let mut tool = Command::new("python3");
            run(tool.args(["-m", "json.tool"]).arg(project.output.join("schema.json")));
        }
    }
}

/// A file with a mistake beside each text, and with a hostile name.
fn mistaken(folder: &Path, project: &Project) -> std::path::PathBuf {
    let text = read(&project.source).replace("type = analog;", "type = \"x\";");
    let text = text.replace("label = ", "unit = ");
    let path =
        folder.join("robot\u{1b}[31m\u{202e} %0A::error file=x,line=1::owned {0} [a](1).sense");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn sarif_and_commands_of_github_keep_messages_in_their_place() {
    for project in projects() {
        let file = mistaken(project.source.parent().unwrap(), project);
        let check = |format| sensedsl(["check", "--format", format]).arg(&file).run().exits(1);
        let reported = check("json").json();
        let diagnostics = reported["diagnostics"].as_array().unwrap();
        assert!(diagnostics.len() >= project.texts.len(), "{reported}");
        let sarif = check("sarif");
        let log = sarif.json();
        assert_eq!(log["version"], "2.1.0");
        let results = log["runs"][0]["results"].as_array().unwrap();
        assert_eq!(results.len(), diagnostics.len());
        for result in results {
            let uri =
                result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].as_str();
            let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"%/._-~".contains(&byte);
            assert!(uri.unwrap().bytes().all(is_plain), "{result}");
            let message = result["message"]["text"].as_str().unwrap();
            assert!(
                !message.contains("[a](1)") && !message.replace("{{0}}", "").contains("{0}"),
                "{message}"
            );
        }
        let github = check("github");
        for (line, diagnostic) in github.stdout.lines().zip(diagnostics) {
            let command = if diagnostic["severity"] == "error" { "::error file=" } else { "::" };
            assert!(line.starts_with(command), "{line}");
            let properties = line[2..].split_once("::").unwrap().0;
            assert!(
                properties.contains(&format!(",title={}", diagnostic["code"].as_str().unwrap())),
                "{line}"
            );
        }
        assert_eq!(github.stdout.lines().count(), diagnostics.len());
        for text in [&sarif.stdout, &github.stdout] {
            assert!(!text.contains(|c| is_hidden(c) && c != '\n'));
        }
    }
}
