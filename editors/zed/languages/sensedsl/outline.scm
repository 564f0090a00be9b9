(board "board" @context name: (identifier) @name) @item
(chip "chip" @context name: (identifier) @name) @item
(driver "driver" @context name: (identifier) @name) @item
(connection "connection" @context name: (identifier) @name) @item
(device ["sensor" "actuator"] @context name: (identifier) @name) @item
(reading "reading" @context name: (identifier) @name) @item
(command "command" @context name: (identifier) @name) @item
(controller "controller" @context name: (identifier) @name) @item
(test "test" @context name: (identifier) @name) @item
(const "const" @context name: (identifier) @name) @item
