" Indentation: four spaces for each bracket that is open, as `sensedsl fmt` has it.
if exists('b:did_indent')
  finish
endif
let b:did_indent = 1

setlocal nolisp nocindent nosmartindent autoindent
setlocal indentexpr=SensedslIndent()
setlocal indentkeys=0{,0},0],0),!^F,o,O

let b:undo_indent = 'setlocal indentexpr< indentkeys<'

if exists('*SensedslIndent')
  finish
endif

" A line without its texts and comments.
function! s:Brackets(number) abort
  let l:text = substitute(getline(a:number), '"\%(\\.\|[^"\\]\)*"', '', 'g')
  return substitute(substitute(l:text, '/\*.\{-}\*/', '', 'g'), '//.*$', '', '')
endfunction

function! SensedslIndent() abort
  let l:before = prevnonblank(v:lnum - 1)
  if l:before == 0
    return 0
  endif
  let l:text = s:Brackets(l:before)
  " Brackets that close at the beginning of the line before have moved that line already.
  let l:rest = substitute(l:text, '^\s*[]})]\+', '', '')
  let l:open = len(substitute(l:rest, '[^[{(]', '', 'g')) - len(substitute(l:rest, '[^]})]', '', 'g'))
  let l:close = len(matchstr(getline(v:lnum), '^\s*\zs[]})]\+'))
  return max([0, indent(l:before) + (l:open - l:close) * shiftwidth()])
endfunction
