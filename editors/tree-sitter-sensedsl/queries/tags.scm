; What a list of symbols shows.

(board name: (identifier) @name) @definition.module
(chip name: (identifier) @name) @definition.class
(driver name: (identifier) @name) @definition.class
(device name: (identifier) @name) @definition.function
(reading name: (identifier) @name) @definition.function
(command name: (identifier) @name) @definition.function
(controller name: (identifier) @name) @definition.function
(test name: (identifier) @name) @definition.method
(connection name: (identifier) @name) @definition.field
(const name: (identifier) @name) @definition.constant

((property
  name: (identifier) @_property
  value: (name_value (identifier) @name)) @reference.class
  (#eq? @_property "driver"))
