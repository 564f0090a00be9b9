[
  (block)
  (list)
  (paren)
  (index)
  (call)
] @indent

["}" "]" ")"] @outdent
