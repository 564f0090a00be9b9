; Colours in the words of Helix's themes.

[
  "use" "const" "spare" "board" "on" "link" "sensor" "returns" "actuator" "accepts" "chip" "connection" "reading"
  "command" "driver" "for" "prefer" "avoid" "reserve" "release" "allow" "raw" "controller" "every" "test"
  "at" "set" "fault" "of" "always" "never" "eventually" "when" "then" "within" "from" "to" "and" "or" "not" "in"
] @keyword

(board name: (identifier) @type)
(chip name: (identifier) @type)
(driver name: (identifier) @type)
(test name: (identifier) @type)
(connection name: (identifier) @type)
(device name: (identifier) @function)
(reading name: (identifier) @function)
(command name: (identifier) @function)
(controller name: (identifier) @function)
(const name: (identifier) @constant)

(on_clause source: (identifier) @constant)
(type scalar: (identifier) @type.builtin)
(type length: (identifier) @constant)
(kind (identifier) @type.builtin)

(property name: (identifier) @variable.other.member)
(reserve resource: (identifier) @constant)
(release resource: (identifier) @constant)
(allow code: (identifier) @constant)

(set_step name: (identifier) @constant)
(index name: (identifier) @constant)
(call function: (identifier) @function.builtin)
(member name: (identifier) @constant)
(member member: (identifier) @variable.other.member)

(name_value) @constant
[(integer) (float)] @constant.numeric
(unit) @type.builtin
(string) @string
(escape_sequence) @constant.character.escape

["+" "-" "*" "/" ".." "=" "<" "<=" ">" ">=" "==" "!="] @operator
["{" "}" "[" "]" "(" ")"] @punctuation.bracket
[";" "," "."] @punctuation.delimiter

[(line_comment) (block_comment)] @comment
