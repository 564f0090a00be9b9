//! A map from a drawing: SVG in, lines and walls out.
//!
//! An element is a line or a wall if its `class`, or that of a group around it, says so; anything else is decoration.
//! Paths, lines, polylines, polygons, rectangles, circles and ellipses count, moved by `transform` of themselves and of
//! their groups. A line is as wide as its `stroke-width`. The drawing is as large as its `width` or its `height` says
//! (`2000mm`, `2m`, `200cm`); without a unit it has no scale, and is not a map.

use kurbo::{Affine, BezPath, Circle, Ellipse, PathEl, Rect, Shape as _};
use roxmltree::{Document, Node};

use crate::map::{Line, Map, Piece, Point};

/// How far a curve may be from its straight pieces, in metres.
const FLATNESS_M: f64 = 2e-4;
/// Pieces that a map has at most.
const PIECES_MAX: usize = 100_000;
/// The depth of groups that are read.
const DEPTH_MAX: usize = 64;

/// Why a drawing is not a map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapError {
    /// The place in the text, in bytes.
    pub at: usize,
    /// What is wrong, as a sentence without a full stop.
    pub why: String,
}

/// What is inherited from the groups around an element.
#[derive(Clone, Copy)]
struct Around {
    transform: Affine,
    class: Option<Class>,
    width: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Class {
    Line,
    Wall,
}

/// Reads a drawing.
///
/// # Errors
///
/// The text is not SVG, a shape cannot be read, it has neither lines nor walls, or too many of them, or no scale.
pub fn read(text: &str) -> Result<Map, MapError> {
    let document = Document::parse(text).map_err(|error| MapError {
        at: offset(text, error.pos()),
        why: format!("this is not SVG: {error}"),
    })?;
    let root = document.root_element();
    let wrong = |why: &str| MapError { at: root.range().start, why: why.to_owned() };
    if root.tag_name().name() != "svg" {
        return Err(wrong("a map is an SVG drawing, whose first element is `svg`"));
    }
    let (scale, origin, size) = frame(root)?;
    // Metres, y upwards.
    let transform = Affine::new([scale, 0.0, 0.0, -scale, -origin.0 * scale, origin.1 * scale]);
    let mut map = Map { size, ..Map::default() };
    let around = Around { transform, class: None, width: 1.0 };
    element(root, around, scale, 0, &mut map)?;
    if map.lines.is_empty() && map.walls.is_empty() {
        return Err(wrong("nothing in it has the class `line` or `wall`"));
    }
    if !has_scale(root) {
        return Err(wrong("it has no scale: its `width` needs a unit, such as `2000mm`"));
    }
    Ok(map)
}

fn offset(text: &str, at: roxmltree::TextPos) -> usize {
    let row = usize::try_from(at.row).unwrap_or(1).saturating_sub(1);
    let before: usize = text.split_inclusive('\n').take(row).map(str::len).sum();
    let column = usize::try_from(at.col).unwrap_or(1).saturating_sub(1);
    (before + column).min(text.len())
}

/// Whether the width or the height of the drawing has a unit that is a length outside of a screen.
fn has_scale(root: Node<'_, '_>) -> bool {
    let sizes = ["width", "height"].into_iter().filter_map(|name| root.attribute(name));
    let mut texts = sizes.map(str::trim);
    texts.any(|text| text.ends_with('m') || text.ends_with("in"))
}

type Frame = (f64, (f64, f64), (f64, f64));

/// Metres of a user unit, the user units of the top left corner, and the size in metres.
fn frame(root: Node<'_, '_>) -> Result<Frame, MapError> {
    let wrong = |why: String| MapError { at: root.range().start, why };
    let numbers = |text: &str| -> Vec<f64> {
        let words = text.split([' ', ',']).filter(|word| !word.is_empty());
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let length = |name: &str| root.attribute(name).map(metres);
    let view = root.attribute("viewBox").map(numbers);
    let (width, height) = (length("width"), length("height"));
    let bad = || wrong("its `width` and `height` must be lengths such as `2000mm`".to_owned());
    let (left, top, units) = match view.as_deref() {
        Some([left, top, wide, high]) if *wide > 0.0 && *high > 0.0 => {
            (*left, *top, Some((*wide, *high)))
        }
        Some(_) => return Err(wrong("its `viewBox` must be four numbers".to_owned())),
        None => (0.0, 0.0, None),
    };
    let width = width.map(|one| one.ok_or_else(bad)).transpose()?;
    let height = height.map(|one| one.ok_or_else(bad)).transpose()?;
    let scale = match (units, width, height) {
        (Some((wide, _)), Some(width), _) => width / wide,
        (Some((_, high)), None, Some(height)) => height / high,
        (Some(_), None, None) | (None, _, _) => 1e-3,
    };
    let size = match units {
        Some((wide, high)) => (wide * scale, high * scale),
        None => (width.unwrap_or(1.0), height.unwrap_or(1.0)),
    };
    Ok((scale, (left, top), size))
}

/// A length in metres; without a unit it is in millimetres.
fn metres(text: &str) -> Option<f64> {
    let units = [("mm", 1e-3), ("cm", 1e-2), ("in", 25.4e-3), ("m", 1.0), ("px", 1e-3), ("", 1e-3)];
    let (number, factor) =
        units.iter().find_map(|(unit, factor)| Some((text.trim().strip_suffix(unit)?, factor)))?;
    number.trim().parse::<f64>().ok().filter(|one| *one > 0.0).map(|one| one * factor)
}

fn element(
    node: Node<'_, '_>,
    around: Around,
    scale: f64,
    depth: usize,
    map: &mut Map,
) -> Result<(), MapError> {
    let wrong = |why: String| MapError { at: node.range().start, why };
    if depth > DEPTH_MAX {
        return Err(wrong(format!("groups nest more than {DEPTH_MAX} deep")));
    }
    let mut around = around;
    if let Some(text) = node.attribute("transform") {
        let own = transform(text)
            .ok_or_else(|| wrong(format!("`transform` cannot be read: `{text}`")))?;
        around.transform *= own;
    }
    for word in node.attribute("class").unwrap_or_default().split_whitespace() {
        match word {
            "line" => around.class = Some(Class::Line),
            "wall" => around.class = Some(Class::Wall),
            _ => {}
        }
    }
    if let Some(text) = stroke_width(node) {
        let width = text.trim().trim_end_matches("px").parse();
        around.width =
            width.map_err(|_| wrong(format!("`stroke-width` is not a number: `{text}`")))?;
    }
    let outline = if around.class.is_some() { shape(node).map_err(wrong)? } else { None };
    if let Some((path, class)) = outline.zip(around.class) {
        add(&path, around, class, scale, map);
        let pieces = map.walls.len() + map.lines.iter().map(|one| one.pieces.len()).sum::<usize>();
        if pieces > PIECES_MAX {
            return Err(wrong(format!("the drawing has more than {PIECES_MAX} straight pieces")));
        }
    }
    for child in node.children().filter(Node::is_element) {
        element(child, around, scale, depth + 1, map)?;
    }
    Ok(())
}

/// The width of its stroke, as an attribute or in its style, where Inkscape writes it.
fn stroke_width<'n>(node: Node<'n, '_>) -> Option<&'n str> {
    let styles = node.attribute("style").unwrap_or_default().split(';');
    let mut pairs = styles.filter_map(|one| one.split_once(':'));
    let of_style = pairs.find(|(name, _)| name.trim() == "stroke-width").map(|(_, value)| value);
    of_style.or_else(|| node.attribute("stroke-width"))
}

/// The outline of an element; `None` if it has none.
fn shape(node: Node<'_, '_>) -> Result<Option<BezPath>, String> {
    let number = |name: &str| -> Result<f64, String> {
        let text = node.attribute(name).unwrap_or("0").trim().trim_end_matches("px");
        text.parse().map_err(|_| format!("`{name}` is not a number: `{text}`"))
    };
    let tolerance = 1e-3;
    Ok(Some(match node.tag_name().name() {
        "path" => {
            let text = node.attribute("d").unwrap_or_default();
            BezPath::from_svg(text).map_err(|error| format!("the path cannot be read: {error}"))?
        }
        "line" => kurbo::Line::new((number("x1")?, number("y1")?), (number("x2")?, number("y2")?))
            .to_path(tolerance),
        "rect" => {
            let (x, y) = (number("x")?, number("y")?);
            Rect::new(x, y, x + number("width")?, y + number("height")?).to_path(tolerance)
        }
        "circle" => Circle::new((number("cx")?, number("cy")?), number("r")?).to_path(tolerance),
        "ellipse" => {
            let radii = (number("rx")?, number("ry")?);
            Ellipse::new((number("cx")?, number("cy")?), radii, 0.0).to_path(tolerance)
        }
        name @ ("polyline" | "polygon") => {
            let text = node.attribute("points").unwrap_or_default();
            let words = text.split([' ', ',', '\n', '\t', '\r']).filter(|word| !word.is_empty());
            let all: Result<Vec<f64>, _> = words.map(str::parse).collect();
            let all =
                all.map_err(|_| format!("`points` has a word that is not a number: `{text}`"))?;
            let mut path = BezPath::new();
            for pair in all.chunks_exact(2) {
                let [x, y] = pair else { continue };
                if path.is_empty() {
                    path.move_to((*x, *y));
                } else {
                    path.line_to((*x, *y));
                }
            }
            if name == "polygon" && !path.is_empty() {
                path.close_path();
            }
            path
        }
        _ => return Ok(None),
    }))
}

/// The straight pieces of a path, as lines or walls of the map.
fn add(path: &BezPath, around: Around, class: Class, scale: f64, map: &mut Map) {
    let path = around.transform * path.clone();
    let mut pieces = Vec::new();
    let (mut first, mut last) = (None, None);
    kurbo::flatten(path, FLATNESS_M, |part| {
        let point = |at: kurbo::Point| Point { x: at.x, y: at.y };
        match part {
            PathEl::MoveTo(at) => (first, last) = (Some(point(at)), Some(point(at))),
            PathEl::LineTo(at) => {
                pieces.extend(last.map(|from| Piece { from, to: point(at) }));
                last = Some(point(at));
            }
            PathEl::ClosePath => {
                pieces.extend(last.zip(first).map(|(from, to)| Piece { from, to }));
                last = first;
            }
            PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        }
    });
    match class {
        Class::Wall => map.walls.extend(pieces),
        Class::Line if pieces.is_empty() => {}
        Class::Line => {
            // Groups may stretch: the width goes with the area.
            let stretched = around.transform.determinant().abs().sqrt();
            let grown = if scale > 0.0 { stretched / scale } else { 1.0 };
            map.lines.push(Line { pieces, half_width_m: around.width * grown * scale / 2.0 });
        }
    }
}

/// The transforms of an attribute, one after the other.
fn transform(text: &str) -> Option<Affine> {
    let mut all = Affine::IDENTITY;
    for one in text.split_inclusive(')') {
        let one = one.trim().trim_start_matches(',').trim();
        if one.is_empty() {
            continue;
        }
        let (name, rest) = one.strip_suffix(')')?.split_once('(')?;
        let words = rest.split([' ', ',']).filter(|word| !word.is_empty());
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        let turned = |degrees: f64| {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            Affine::new([cos, sin, -sin, cos, 0.0, 0.0])
        };
        let own = match (name.trim(), numbers?.as_slice()) {
            ("translate", [x]) => Affine::translate((*x, 0.0)),
            ("translate", [x, y]) => Affine::translate((*x, *y)),
            ("scale", [both]) => Affine::scale(*both),
            ("scale", [x, y]) => Affine::scale_non_uniform(*x, *y),
            ("rotate", [degrees]) => turned(*degrees),
            ("rotate", [degrees, x, y]) => {
                Affine::translate((*x, *y)) * turned(*degrees) * Affine::translate((-*x, -*y))
            }
            ("matrix", [a, b, c, d, e, f]) => Affine::new([*a, *b, *c, *d, *e, *f]),
            _ => return None,
        };
        all *= own;
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    const OVAL: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="2000mm" viewBox="0 0 1000 600">
        <rect width="1000" height="600" fill="white"/>
        <g class="wall"><rect x="5" y="5" width="990" height="590"/></g>
        <g transform="translate(500 300)"><path class="line" stroke-width="10"
            d="M-200 -150 H200 A150 150 0 0 1 200 150 H-200 A150 150 0 0 1 -200 -150 Z"/></g>
    </svg>"#;

    #[test]
    fn a_drawing_has_the_size_that_it_says() {
        let map = read(OVAL).unwrap();
        assert!((map.size.0 - 2.0).abs() < 1e-12 && (map.size.1 - 1.2).abs() < 1e-12);
        // 2 mm a unit: the upper straight is at y = 150 units, and the line is 20 mm wide.
        let straight = Point { x: 1.0, y: -0.3 };
        assert!(map.off_line(straight) < 1e-9);
        assert_eq!(map.darkness(straight, 1e-3), 1.0);
        let edge = Point { x: 1.0, y: -0.31 };
        assert!((map.darkness(edge, 1e-3) - 0.5).abs() < 1e-6);
        assert_eq!(map.darkness(Point { x: 1.0, y: -0.312 }, 1e-3), 0.0);
        // The arc is within its flatness.
        let turn = Point { x: 1.4 + 0.3, y: -0.6 };
        assert!(map.off_line(turn) < 2.0 * FLATNESS_M, "{}", map.off_line(turn));
        let right = map.ray(Point { x: 1.0, y: -0.6 }, 0.0, 4.0).unwrap();
        assert!((right - 0.99).abs() < 1e-9, "{right}");
        assert!((map.clearance(Point { x: 0.11, y: -0.6 }) - 0.1).abs() < 1e-9);
    }

    #[test]
    fn a_width_may_be_in_the_style() {
        let text = "<svg xmlns='x' width='1m' viewBox='0 0 1000 1000'>
            <path class='line' style='fill:none;stroke-width:20px' d='M0 500 H1000'/></svg>";
        let map = read(text).unwrap();
        assert_eq!(map.darkness(Point { x: 0.5, y: -0.509 }, 0.0), 1.0);
        assert_eq!(map.darkness(Point { x: 0.5, y: -0.511 }, 0.0), 0.0);
        assert_eq!(map.begin(), Some((Point { x: 0.0, y: -0.5 }, 0.0)));
        let [stroke] = map.strokes().try_into().unwrap();
        assert!((stroke.width_m - 0.02).abs() < 1e-12 && !stroke.is_wall);
    }

    #[test]
    fn what_is_no_map_is_told_with_its_place() {
        for (text, why) in [
            ("<svg", "this is not SVG"),
            ("<html/>", "first element is `svg`"),
            ("<svg xmlns='x'><path d='M0 0'/></svg>", "nothing in it has the class"),
            ("<svg xmlns='x'><path class='line' d='M0 0 X'/></svg>", "the path cannot be read"),
            ("<svg xmlns='x'><circle class='wall' r='big'/></svg>", "`r` is not a number"),
            ("<svg xmlns='x' width='wide'/>", "must be lengths"),
            ("<svg xmlns='x' width='2000'><path class='line' d='M0 0 H9'/></svg>", "no scale"),
            ("<svg xmlns='x'><path class='line' d='M0 0 H9'/></svg>", "no scale"),
            ("<svg xmlns='x'><g transform='bend(3)'/></svg>", "`transform` cannot be read"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.why.contains(why), "{text}: {error:?}");
            assert!(error.at <= text.len());
        }
        let deep = format!("<svg xmlns='x'>{}{}</svg>", "<g>".repeat(80), "</g>".repeat(80));
        assert!(read(&deep).unwrap_err().why.contains("nest"));
    }
}
