(source_file) @local.scope
(const name: (identifier) @local.definition.constant)
(name_value (identifier) @local.reference)
