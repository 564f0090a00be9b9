" Colours without tree-sitter, in Neovim and Vim. Keywords are words only where the language has one, so that none is a
" `syntax keyword`: what follows a word decides.
if exists('b:current_syntax')
  finish
endif

syntax match sensedslProperty "\<\h\w*\>\ze\_s*==\@!" nextgroup=sensedslValue skipwhite skipempty
syntax region sensedslValue contained transparent start="=" end=";" end="\ze[{}]"
      \ contains=sensedslComment,sensedslString,sensedslNumber,sensedslRaw,sensedslName

" Heads: a keyword, the name, then what it is.
syntax match sensedslKeyword "\<spare\>\ze\_s\+board\>"
syntax match sensedslKeyword "\<\%(board\|chip\|driver\|connection\)\>\ze\_s\+\h" nextgroup=sensedslThing skipwhite skipempty
syntax match sensedslThing contained "\h\w*" nextgroup=sensedslOn,sensedslFor skipwhite skipempty
syntax match sensedslOn contained "\<on\>" nextgroup=sensedslName,sensedslString skipwhite skipempty
syntax match sensedslFor contained "\<for\>" nextgroup=sensedslType skipwhite skipempty
syntax match sensedslKeyword "\<\%(sensor\|actuator\|reading\|command\)\>\ze\_s\+\h" nextgroup=sensedslDevice skipwhite skipempty
syntax match sensedslDevice contained "\h\w*" nextgroup=sensedslVerb skipwhite skipempty
syntax match sensedslVerb contained "\<\%(returns\|accepts\)\>" nextgroup=sensedslType skipwhite skipempty
syntax match sensedslType contained "\h\w*" nextgroup=sensedslLength
syntax region sensedslLength contained transparent start="\[" end="\]" contains=sensedslNumber,sensedslName
syntax match sensedslKeyword "\<controller\>\ze\_s\+\h" nextgroup=sensedslController skipwhite skipempty
syntax match sensedslController contained "\h\w*" nextgroup=sensedslCycle skipwhite skipempty
syntax region sensedslCycle contained transparent matchgroup=sensedslKeyword start="\<every\>" matchgroup=NONE
      \ end="\ze[{};]" contains=sensedslComment,sensedslNumber,sensedslRaw,sensedslName
syntax match sensedslKeyword "\<test\>\ze\_s\+\h" nextgroup=sensedslThing skipwhite skipempty
syntax match sensedslKeyword "\<const\>\ze\_s\+\h" nextgroup=sensedslConst skipwhite skipempty
syntax match sensedslConst contained "\h\w*" nextgroup=sensedslValue skipwhite skipempty

" Statements.
syntax match sensedslKeyword "\<link\>\ze\_s*{"
syntax match sensedslKeyword "\<use\>\ze\_s*\"" nextgroup=sensedslString skipwhite skipempty
syntax match sensedslKeyword "\<\%(prefer\|avoid\)\>\ze\_s\+\h"
syntax match sensedslKeyword "\<\%(reserve\|release\)\>\ze\_s\+\h" nextgroup=sensedslResource skipwhite skipempty
syntax match sensedslResource contained "[Pp]\d\.\d\+\|\h\w*" nextgroup=sensedslComma skipwhite skipempty
syntax match sensedslComma contained "," nextgroup=sensedslResource skipwhite skipempty
syntax match sensedslKeyword "\<allow\>\ze\_s\+\h" nextgroup=sensedslCode skipwhite skipempty
syntax match sensedslCode contained "\h\w*" nextgroup=sensedslString skipwhite skipempty

" Steps of tests: words that join their pieces are words only there.
syntax region sensedslStep transparent matchgroup=sensedslKeyword
      \ start="\<\%(at\|fault\|always\|never\|eventually\|when\)\>\%(\_s*=\)\@!" matchgroup=NONE end=";" end="\ze[{}]"
      \ contains=sensedslComment,sensedslString,sensedslNumber,sensedslRaw,sensedslName,sensedslJoint,
      \sensedslFunction,sensedslMember

" Values. What stands later wins.
syntax match sensedslNumber contained nextgroup=sensedslUnit skipwhite
      \ "\<\%(0[xX][0-9A-Fa-f_]\+\|0[bB][01_]\+\|\d[0-9_]*\%(\.\d[0-9_]*\)\?\%([eE][+-]\?\d[0-9_]*\)\?\)"
syntax match sensedslName contained "\<\%([Pp]\d\.\d\+\|\h\w*\|\%(0X\)\@!\d\+\%([ACDF-WYZ]\|\u\{2,}\)\d\+\)\>"
syntax match sensedslJoint contained "\<\%(and\|or\|not\|in\|then\|within\|from\|to\|for\|at\)\>"
syntax match sensedslJoint contained "\<\%(set\|of\)\>" nextgroup=sensedslName skipwhite skipempty
syntax match sensedslFunction contained "\<\h\w*\ze("
syntax match sensedslMember contained "\%(\w\.\)\@2<=\h\w*"
syntax match sensedslRaw contained "\<raw\>\ze\_s\+[+-]\?\d"
syntax match sensedslUnit contained
      \ "\%(m/s^2\|deg/s\|mm/s\|cm/s\|m/s\|kOhm\|degC\|kHz\|MHz\|Ohm\|deg\|rpm\|us\|ms\|Hz\|mV\|mm\|cm\|mA\|s\|V\|m\|A\|W\)\w\@!\|%"

syntax region sensedslString start=+"+ skip=+\\.+ end=+"\|$+ contains=sensedslEscape
syntax match sensedslEscape contained +\\\%(["\\nrt]\|u{\x\{1,6}}\)+
syntax match sensedslComment "//.*$" contains=@Spell
syntax region sensedslComment start="/\*" end="\*/" contains=@Spell

highlight default link sensedslCode Constant
highlight default link sensedslComment Comment
highlight default link sensedslConst Constant
highlight default link sensedslController sensedslDevice
highlight default link sensedslDevice Function
highlight default link sensedslEscape SpecialChar
highlight default link sensedslFor sensedslKeyword
highlight default link sensedslFunction Function
highlight default link sensedslJoint sensedslKeyword
highlight default link sensedslKeyword Keyword
highlight default link sensedslMember sensedslProperty
highlight default link sensedslName Constant
highlight default link sensedslNumber Number
highlight default link sensedslOn sensedslKeyword
highlight default link sensedslProperty Identifier
highlight default link sensedslRaw sensedslKeyword
highlight default link sensedslResource Constant
highlight default link sensedslString String
highlight default link sensedslThing Structure
highlight default link sensedslType Type
highlight default link sensedslUnit Special
highlight default link sensedslVerb sensedslKeyword

let b:current_syntax = 'sensedsl'
