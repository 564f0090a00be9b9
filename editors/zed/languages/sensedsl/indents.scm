(block "}" @end) @indent
(list "]" @end) @indent
(paren ")" @end) @indent
(index "]" @end) @indent
(call ")" @end) @indent
