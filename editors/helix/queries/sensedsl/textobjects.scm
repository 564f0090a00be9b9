; `mif`, `maf` and `]f` are a device, a reading, a command or a controller; with `t` in place of `f` what holds them,
; with `T` a test.

(device body: (block) @function.inside) @function.around
(reading body: (block) @function.inside) @function.around
(command body: (block) @function.inside) @function.around
(controller body: (block) @function.inside) @function.around

(board body: (block) @class.inside) @class.around
(chip body: (block) @class.inside) @class.around
(driver body: (block) @class.inside) @class.around

(test body: (block) @test.inside) @test.around

[(line_comment) (block_comment)] @comment.inside
(line_comment)+ @comment.around

