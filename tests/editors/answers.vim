" Files and places in, names of colours out, by Neovim or Vim: reads the file that WORDS names, a JSON list of
" [path, [[line, column], ...]], and writes to ANSWER, for each file, its file type, its comment, the colour of each
" place, whether tree-sitter colours it, and its text with all lines indented anew. Lines and columns count from 1.
function! s:Answer(path, places) abort
  execute 'edit' fnameescape(a:path)
  let l:answer = {'filetype': &filetype, 'comment': &commentstring}
  let l:answer.tree_sitter = v:false
  if has('nvim')
    let l:answer.tree_sitter = luaeval('vim.treesitter.highlighter.active[vim.api.nvim_get_current_buf()] ~= nil')
  endif
  " Colours by patterns, whether tree-sitter is there or not.
  set syntax=sensedsl
  syntax sync fromstart
  let l:answer.colours = map(copy(a:places), 'synIDattr(synID(v:val[0], v:val[1], 1), "name")')
  silent %substitute/^\s\+//e
  silent normal! gg=G
  let l:answer.text = join(getline(1, '$'), "\n") . "\n"
  bwipeout!
  return l:answer
endfunction

filetype plugin indent on
syntax on
try
  let s:items = json_decode(join(readfile($WORDS), "\n"))
  call writefile([json_encode(map(s:items, 's:Answer(v:val[0], v:val[1])'))], $ANSWER)
catch
  call writefile([v:exception . ' at ' . v:throwpoint], $ANSWER)
  cquit
endtry
qall!
