; `mif`, `maf` and `]f` are a device, a reading or a command; with `t` in place of `f` what holds them.

(device body: (block) @function.inside) @function.around
(reading body: (block) @function.inside) @function.around
(command body: (block) @function.inside) @function.around

(board body: (block) @class.inside) @class.around
(chip body: (block) @class.inside) @class.around
(driver body: (block) @class.inside) @class.around

[(line_comment) (block_comment)] @comment.inside
(line_comment)+ @comment.around

