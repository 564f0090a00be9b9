[
  (block)
  (list)
  (block_comment)
] @fold
