; A constant is known in the whole file, wherever it stands; names in values may be one.

(source_file) @local.scope
(const name: (identifier) @local.definition)
(name_value (identifier) @local.reference)
(type length: (identifier) @local.reference)
