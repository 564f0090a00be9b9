// The grammar of `.sense` files: text in, the same tree out as the compiler's parser (`crates/syntax`) makes of it, with
// the same names of nodes in lower case. A test compares the two on every file of the project.
//
// Keywords are words only where the grammar has one, as in the compiler: everywhere else the word rule makes them
// identifiers. The only place that takes both is the beginning of an item (`driver = srf08;`), hence `_property_name`.
// A file that the compiler refuses may pass here: `N-5` is a subtraction here, and a reported hyphen there.

// All units of `crates/syntax/src/unit.rs`.
const UNITS = [
  "us", "ms", "s", "Hz", "kHz", "MHz", "mV", "V", "Ohm", "kOhm", "%", "mm", "cm", "m", "deg", "degC", "mA", "A", "W",
  "rpm", "deg/s", "mm/s", "cm/s", "m/s", "m/s^2",
];

// Words that begin an item, which are names of properties where `=` comes next.
const ITEMS = [
  "use", "const", "spare", "board", "chip", "sensor", "actuator", "driver", "connection", "reading", "command", "link",
  "prefer", "avoid", "reserve", "release", "allow", "controller", "test", "at", "fault", "always", "never",
  "eventually", "when",
];

const DECIMAL = /[0-9][0-9_]*/;
const INTEGER = choice(/0[xX]_*[0-9a-fA-F][0-9a-fA-F_]*/, /0[bB]_*[01][01_]*/, DECIMAL);
const EXPONENT = /[eE][+-]?[0-9][0-9_]*/;
const FLOAT = seq(DECIMAL, choice(seq(/\.[0-9][0-9_]*/, optional(EXPONENT)), EXPONENT));

const sepBy1 = (separator, rule) => seq(rule, repeat(seq(separator, rule)));
const block = (...items) => seq("{", repeat(choice(...items)), "}");

module.exports = grammar({
  name: "sensedsl",

  word: ($) => $.identifier,
  extras: ($) => [/[ \t\n\r\v\f]/, $.line_comment, $.block_comment],
  inline: ($) => [$._sign],

  rules: {
    source_file: ($) => repeat(choice($.use, $.const, $.board, $.device, $.chip, $.driver, $.test)),

    // Items.

    use: ($) => seq("use", field("path", $.string), ";"),
    const: ($) => seq("const", field("name", $.identifier), "=", field("value", $._value), ";"),
    board: ($) => seq(
      optional("spare"),
      "board",
      field("name", $.identifier),
      optional($.on_clause),
      field("body", alias($._board_block, $.block)),
    ),
    on_clause: ($) => seq("on", field("source", choice($.identifier, $.string))),
    link: ($) => seq("link", field("body", alias($._plain_block, $.block))),
    device: ($) => seq(
      choice(
        seq("sensor", field("name", $.identifier), "returns"),
        seq("actuator", field("name", $.identifier), "accepts"),
      ),
      field("type", $.type),
      field("body", alias($._device_block, $.block)),
    ),
    chip: ($) => seq("chip", field("name", $.identifier), field("body", alias($._chip_block, $.block))),
    driver: ($) => seq(
      "driver",
      field("name", $.identifier),
      optional(seq("for", $.kind)),
      field("body", alias($._driver_block, $.block)),
    ),
    connection: ($) => seq(
      "connection",
      field("name", $.identifier),
      optional(seq("for", $.kind)),
      field("body", alias($._plain_block, $.block)),
    ),
    reading: ($) => seq(
      "reading",
      field("name", $.identifier),
      "returns",
      field("type", $.type),
      field("body", alias($._plain_block, $.block)),
    ),
    command: ($) => seq(
      "command",
      field("name", $.identifier),
      "accepts",
      field("type", $.type),
      field("body", alias($._plain_block, $.block)),
    ),
    controller: ($) => seq(
      "controller",
      field("name", $.identifier),
      "every",
      field("cycle", $._expression),
      field("body", alias($._device_block, $.block)),
    ),
    test: ($) => seq("test", field("name", $.identifier), field("body", alias($._test_block, $.block))),
    kind: ($) => $.identifier,
    type: ($) => seq(
      field("scalar", $.identifier),
      optional(seq("[", field("length", choice($.integer, $.identifier)), "]")),
    ),

    // What each block may hold.

    _board_block: ($) => block($.device, $.chip, $.controller, $._rule, $.link, $.property),
    _chip_block: ($) => block($.device, $.connection, $._rule, $.property),
    _device_block: ($) => block($._rule, $.property),
    _driver_block: ($) => block($.connection, $.reading, $.command, $.property),
    _plain_block: ($) => block($.property),
    _test_block: ($) => block($._step, $.property),

    // Properties and rules.

    property: ($) => choice(
      seq(field("name", $._property_name), "=", field("value", $._value), ";"),
      // Only here a value may be a name with a value: `mux = Page = 3`.
      seq(
        field("name", alias("mux", $.identifier)),
        "=",
        field("value", choice($._value, alias($._pair, $.list))),
        ";",
      ),
    ),
    _property_name: ($) => choice($.identifier, ...ITEMS.map((word) => alias(word, $.identifier))),
    _pair: ($) => seq($.name_value, "=", $._value),

    _rule: ($) => choice($.prefer, $.avoid, $.reserve, $.release, $.allow),
    prefer: ($) => seq("prefer", $.property),
    avoid: ($) => seq("avoid", $.property),
    reserve: ($) => seq("reserve", sepBy1(",", field("resource", $._resource)), ";"),
    release: ($) => seq("release", sepBy1(",", field("resource", $._resource)), ";"),
    allow: ($) => seq("allow", field("code", $.identifier), field("reason", $.string), ";"),
    _resource: ($) => choice($.identifier, alias($._dotted_pin, $.identifier)),

    // Steps of tests.

    _step: ($) => choice(
      $.set_step,
      $.fault_step,
      $.always_rule,
      $.never_rule,
      $.eventually_rule,
      $.when_rule,
    ),
    set_step: ($) => seq(
      "at",
      field("time", $._expression),
      "set",
      field("name", $.identifier),
      "=",
      field("value", $._value),
      ";",
    ),
    fault_step: ($) => seq(
      "fault",
      field("kind", $.name_value),
      optional(seq("of", field("device", $.name_value))),
      "at",
      field("time", $._expression),
      optional(alias($._duration, $.clause)),
      ";",
    ),
    _duration: ($) => seq("for", field("time", $._expression)),
    always_rule: ($) => seq("always", field("condition", $._condition), repeat($.clause), ";"),
    never_rule: ($) => seq("never", field("condition", $._condition), repeat($.clause), ";"),
    eventually_rule: ($) => seq("eventually", field("condition", $._condition), repeat($.clause), ";"),
    when_rule: ($) => seq(
      "when",
      field("condition", $._condition),
      "then",
      field("consequence", $._condition),
      repeat($.clause),
      ";",
    ),
    clause: ($) => seq(choice("within", "from", "to"), field("time", $._expression)),

    // Conditions of tests.

    _condition: ($) => choice($.logic, $.not, $.compare, $.inside, $._quantity),
    logic: ($) => choice(
      prec.left(1, seq(field("left", $._condition), field("operator", "or"), field("right", $._condition))),
      prec.left(2, seq(field("left", $._condition), field("operator", "and"), field("right", $._condition))),
    ),
    not: ($) => prec(3, seq("not", field("condition", $._condition))),
    compare: ($) => seq(
      field("left", $._quantity),
      field("operator", choice("<", "<=", ">", ">=", "==", "!=")),
      field("right", $._quantity),
    ),
    inside: ($) => seq(field("value", $._quantity), "in", field("range", $._value)),
    _quantity: ($) => choice(
      alias($._operation, $.binary),
      $.number,
      alias($._code, $.number),
      $._other_atom,
    ),
    _operation: ($) => choice(
      prec.left(1, seq(field("left", $._quantity), field("operator", choice("+", "-")), field("right", $._quantity))),
      prec.left(2, seq(field("left", $._quantity), field("operator", choice("*", "/")), field("right", $._quantity))),
    ),
    _other_atom: ($) => choice(
      $.name_value,
      $.index,
      $.call,
      $.member,
      alias($._group, $.paren),
      alias($._signed_atom, $.signed),
    ),
    _signed_atom: ($) => prec(3, seq(
      $._sign,
      choice(alias($._signed_number, $.number), alias($._code, $.number), $._other_atom),
    )),
    _group: ($) => seq("(", $._condition, ")"),
    index: ($) => seq(field("name", $._word), "[", field("index", $._quantity), "]"),
    call: ($) => seq(field("function", $._word), "(", sepBy1(",", field("argument", $._condition)), ")"),
    member: ($) => seq(field("name", $._word), ".", field("member", $.identifier)),

    // Values.

    _value: ($) => choice($._expression, $.range),
    range: ($) => seq(field("from", $._expression), "..", field("to", $._expression)),
    _expression: ($) => choice($.binary, $.number, alias($._code, $.number), $._other_factor),
    binary: ($) => choice(
      prec.left(1, seq(
        field("left", $._expression),
        field("operator", choice("+", "-")),
        field("right", $._expression),
      )),
      prec.left(2, seq(
        field("left", $._expression),
        field("operator", choice("*", "/")),
        field("right", $._expression),
      )),
    ),
    _other_factor: ($) => choice($.name_value, $.string_value, $.list, $.paren, $.signed),
    // A number has its own sign.
    signed: ($) => prec(3, seq(
      $._sign,
      choice(alias($._signed_number, $.number), alias($._code, $.number), $._other_factor),
    )),
    list: ($) => seq("[", optional(sepBy1(",", $._value)), "]"),
    paren: ($) => seq("(", $._expression, ")"),
    name_value: ($) => $._word,
    _word: ($) => choice(
      $.identifier,
      alias("raw", $.identifier),
      alias($._dotted_pin, $.identifier),
      alias($._frame, $.identifier),
    ),
    string_value: ($) => $.string,

    number: ($) => choice($._unsigned_number, $._signed_number),
    _unsigned_number: ($) => seq(choice($.integer, $.float), optional($.unit)),
    _signed_number: ($) => seq($._sign, $._unsigned_number),
    // The sign of a code touches it: `raw -20` is one, `raw - 20` an operation on a name.
    _code: ($) => seq(
      "raw",
      choice(
        $.integer,
        $.float,
        alias($._signed_integer, $.integer),
        alias($._signed_float, $.float),
      ),
      optional($.unit),
    ),
    _sign: () => choice("+", "-"),
    unit: () => choice(...UNITS),

    // Tokens.

    identifier: () => /[A-Za-z_][A-Za-z0-9_]*/,
    integer: () => token(INTEGER),
    float: () => token(FLOAT),
    _signed_integer: () => token(seq(/[+-]/, INTEGER)),
    _signed_float: () => token(seq(/[+-]/, FLOAT)),
    // A pin of nRF: `P0.13`.
    _dotted_pin: () => token(/[Pp][0-9]\.[0-9]+/),
    // The frame of a serial port: `8N1`. `1E3`, `0X1` and `0B1` are numbers.
    _frame: () => token(/[0-9]+([ACDF-WYZ]|[A-Z]{2,})[0-9]+/),
    string: ($) => seq(
      '"',
      repeat(choice(alias(token.immediate(prec(1, /[^"\\\r\n]+/)), $.string_content), $.escape_sequence)),
      token.immediate('"'),
    ),
    escape_sequence: () => token.immediate(/\\(["\\nrt]|u\{[0-9A-Fa-f]{1,6}\})/),
    line_comment: () => token(seq("//", /[^\r\n]*/)),
    block_comment: () => token(seq("/*", /[^*]*\*+([^/*][^*]*\*+)*/, "/")),
  },
});
