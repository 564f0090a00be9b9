//! Hostile text, in one place: labels, quantities and table cells, and names that have a meaning
//! for a reader of generated files.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use sensedsl_tests::sensedsl;

use crate::firmware::tools::empty;

/// A file that a command in a text would create if it were run.
pub(crate) const OWNED: &str = "owned-by-injection";

/// Each text is used as a label, as a quantity, and in the cells of a pin.
pub(crate) const TEXTS: &[&str] = &[
    // Quotes and escapes of C and its kin.
    "\"; int main() { return 1; } //",
    "'quoted' \"twice\" `thrice`",
    "ends with a backslash \\",
    "\\\" \\n \\x41 \\u0041 \\0",
    "??/ ??= ??( trigraphs ??/",
    "*/ int x; /* */",
    "// and \\\nint y;",
    "%s %n %1000000d %%",
    "#define X #include <x> #",
    "R\"x(raw)x\" u8\"\"",
    // Shells, Make and CMake.
    "$(shell touch owned-by-injection) $(info x) $@ $$",
    "; touch owned-by-injection & && || `touch owned-by-injection`",
    "${CMAKE_COMMAND} $ENV{HOME} $<1:x> [==[ ]==]",
    "a: b\n\ttouch owned-by-injection",
    // SVG, HTML, XML.
    "<script>document.title='owned'</script>",
    "</text><script>document.title='owned'</script>",
    "</title></svg><img src=x onerror=\"document.title='owned'\">",
    "]]> <!-- --> <![CDATA[ x ]]> --",
    "&lt; &amp; &#60; &unknown; &",
    "<!DOCTYPE x [<!ENTITY y SYSTEM \"file:///etc/passwd\">]> &y;",
    "javascript:alert(1)",
    // Markdown.
    "| a | b |\n| - | - |",
    "[text](javascript:alert(1)) ![x](y) [r]: z",
    "**bold** _it_ ~~gone~~ # head",
    "http://example.com www.example.com a@example.com",
    "<b>html</b> <a href=x>y</a> $x^2$",
    "- item\n1. item\n> quote\n\n    code",
    // JSON, SARIF, GitHub, CSV, Prolog.
    "\",\"injected\":true,\"x\":\"",
    "{0} {{1}} [a](1) \\u202e",
    "::error file=x::owned%0A::set-output name=a::b",
    "=cmd|'/c calc'!A0",
    "+1+1",
    "@SUM(1+1)*cmd|' /C calc'!A0",
    "-2+3+cmd|' /C calc'!D2",
    "a,b;c\td\"e",
    "'). halt. :- initialization(halt). % ('",
    // Terminals.
    "\u{1b}[31mred\u{1b}[0m \u{1b}]0;title\u{7}",
    "\u{1b}]8;;http://example.com\u{7}link\u{1b}]8;;\u{7} \u{1b}[2J",
    "\u{9b}31m \u{9d}0;t\u{9c} \u{8}\u{8}\u{7f} \r over",
    "\u{0} \u{1} \u{1f} \u{b} \u{c}",
    // Unicode.
    "\u{202e}txt.exe \u{2066}isolated\u{2069} \u{200f}\u{200e}\u{61c}",
    "line\u{2028}paragraph\u{2029}end\u{85}",
    "\u{feff}mark \u{200b}zero\u{200d}width \u{ad}soft",
    "e\u{301}\u{302}\u{303} שלום مرحبا 試験 😀",
    "Раре \u{391}\u{399} homoglyphs \u{ff21}",
    "\u{fffe}\u{ffff}\u{e0041}",
    " leading and trailing ",
    "°C, µs and Ω",
];

/// Words of the languages of generated files, of their libraries, and of SenseDSL itself.
const WORDS: &str = "
    auto break case char const default do double else enum extern float goto inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void
    volatile while alignas and bitand catch class compl concept consteval constexpr co_await
    decltype delete explicit export friend mutable namespace new noexcept not_eq nullptr operator
    private requires template this thread_local throw try typeid typename using virtual xor_eq
    asm typeof linux unix NULL EOF errno assert stdin main std uint8_t size_t INFINITY M_PI bool_
    TRUE_ printf exit fn impl match mod self Self_ crate dyn async yield macro_rules dynamic
    discontiguous halt is rem once call fail module initialization shell wildcard foreach define
    endef ifeq MAKEFLAGS all clean flash project set install test PUBLIC ENV CACHE ON OFF IGNORE
    sense sensedsl schema Decoder Commands hello_request id name quantity raw value values link
    board Board pads tasks ports icus adcs up_config sense_values stop run Handler message con
    nul COM1_
";

/// The pins with an ADC whose rows contain the texts.
const PINS: [&str; 16] = [
    "PA0", "PA1", "PA2", "PA3", "PA4", "PA5", "PA6", "PA7", "PB0", "PB1", "PC0", "PC1", "PC2",
    "PC3", "PC4", "PC5",
];

/// A design with some of [`TEXTS`], and its output folder.
pub(crate) struct Project {
    pub(crate) texts: &'static [&'static str],
    pub(crate) source: PathBuf,
    pub(crate) output: PathBuf,
}

/// A text as a string literal of the language.
fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            // Some of these characters raw, the others as escapes.
            '\n' | '\r' => write!(out, "\\u{{{:x}}}", u32::from(character)).unwrap(),
            _ if u32::from(character) % 2 == 1 && !character.is_ascii_graphic() => {
                write!(out, "\\u{{{:x}}}", u32::from(character)).unwrap();
            }
            _ => out.push(character),
        }
    }
    out + "\""
}

/// A text as a table cell.
fn cell(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

fn table(texts: &[&str]) -> String {
    let mut table =
        String::from("# mcu = STM32F407VGT6\nPin,ADC,UART,Header,Position,Label,Side\n");
    for ((text, pin), input) in
        texts.iter().zip(PINS).zip([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15])
    {
        let text = cell(text);
        writeln!(table, "{pin},ADC12_IN{input},-,{text},{text},{text},-").unwrap();
    }
    table + "PA9,-,USART1_TX,-,-,-,-\nPA10,-,USART1_RX,-,-,-,-\n"
}

fn design(texts: &[&str]) -> String {
    let mut design = String::from(
        "board Robot on \"robot.csv\" {\n    link { transport = uart; unit = USART1; }\n",
    );
    for (at, (text, pin)) in texts.iter().zip(PINS).enumerate() {
        let (id, text) = (at + 1, string(text));
        writeln!(
            design,
            "    sensor S{id} returns uint16 {{ id = {id}; type = analog; pin = {pin}; label = {text}; quantity = {text}; }}"
        )
        .unwrap();
    }
    design + "}\n"
}

/// The projects with all texts, generated once.
pub(crate) fn projects() -> &'static [Project] {
    static PROJECTS: OnceLock<Vec<Project>> = OnceLock::new();
    PROJECTS.get_or_init(|| {
        let folder = empty("injection/texts");
        let make = |(at, texts): (usize, &'static [&'static str])| {
            let folder = folder.join(at.to_string());
            std::fs::create_dir(&folder).unwrap();
            std::fs::write(folder.join("robot.csv"), table(texts)).unwrap();
            let (source, output) = (folder.join("robot.sense"), folder.join("out"));
            std::fs::write(&source, design(texts)).unwrap();
            let _ = generate(&source, &output);
            Project { texts, source, output }
        };
        TEXTS.chunks(PINS.len()).enumerate().map(make).collect()
    })
}

/// A project whose boards and devices are named by [`WORDS`], generated once.
pub(crate) fn words() -> &'static Path {
    static WORDS_PROJECT: OnceLock<PathBuf> = OnceLock::new();
    WORDS_PROJECT.get_or_init(|| {
        let folder = empty("injection/words");
        let (source, output) = (folder.join("words.sense"), folder.join("out"));
        std::fs::write(&source, words_design()).unwrap();
        let _ = generate(&source, &output);
        output
    })
}

/// One board, with a device on its bus for each word.
pub(crate) fn words_design() -> String {
    let mut design = String::from("board default on STM32F407G_DISC1 {\n");
    let mut seen = std::collections::BTreeSet::new();
    let folded = |word: &str| word.replace('_', "").to_lowercase();
    for (at, word) in WORDS.split_whitespace().filter(|word| seen.insert(folded(word))).enumerate()
    {
        let (id, unit, address) = (at + 1, at / 100 + 1, at % 100 + 8);
        writeln!(
            design,
            "    sensor {word} returns uint16 {{ id = {id}; type = i2c; unit = I2C{unit}; address = {address}; register = 0; }}"
        )
        .unwrap();
    }
    design + "}\n"
}

/// Generates with all hosts.
pub(crate) fn generate(source: &Path, output: &Path) -> String {
    let call = sensedsl(["generate"]).arg(source).arg("-o").arg(output);
    call.run().exits(0).stdout
}
