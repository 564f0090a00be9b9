; In the words of Neovim's nvim-treesitter; Helix and Zed have files of their own beside their settings.

[
  (block)
  (list)
  (paren)
  (index)
  (call)
] @indent.begin

["}" "]" ")"] @indent.branch @indent.end

(ERROR "{") @indent.begin

(block_comment) @indent.ignore
