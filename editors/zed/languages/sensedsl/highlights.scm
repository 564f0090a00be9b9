; Colours; the same as `tree-sitter-sensedsl/queries/highlights.scm`, which a test compares.

; Words of the language.

[
  "use" "const" "spare" "board" "on" "link" "sensor" "returns" "actuator" "accepts" "chip" "connection" "reading"
  "command" "driver" "for" "prefer" "avoid" "reserve" "release" "allow" "raw"
] @keyword

; Names that items define.

(board name: (identifier) @type)
(chip name: (identifier) @type)
(driver name: (identifier) @type)
(connection name: (identifier) @type)
(device name: (identifier) @function)
(reading name: (identifier) @function)
(command name: (identifier) @function)
(const name: (identifier) @constant)

(on_clause source: (identifier) @constant)
(type scalar: (identifier) @type.builtin)
(type length: (identifier) @constant)
(kind (identifier) @type.builtin)

; Properties and rules.

(property name: (identifier) @property)
(reserve resource: (identifier) @constant)
(release resource: (identifier) @constant)
(allow code: (identifier) @constant)

; Values.

(name_value) @constant
[(integer) (float)] @number
(unit) @type.builtin
(string) @string
(escape_sequence) @string.escape

; Marks.

["+" "-" "*" "/" ".." "="] @operator
["{" "}" "[" "]" "(" ")"] @punctuation.bracket
[";" ","] @punctuation.delimiter

[(line_comment) (block_comment)] @comment
