-- Neovim's part for SenseDSL: the language server, and colours by tree-sitter where its parser has been compiled. Set
-- `vim.g.sensedsl_server` to another command, or to `false` for none, before this is read.
if vim.g.loaded_sensedsl then
  return
end
vim.g.loaded_sensedsl = true

-- The grammar stands beside this folder, to which a package is a link.
local file = vim.loop.fs_realpath(debug.getinfo(1, 'S').source:sub(2))
local grammar = vim.fn.fnamemodify(file, ':h:h:h') .. '/tree-sitter-sensedsl'

local function root_of(file)
  local folder = vim.fn.fnamemodify(file, ':p:h')
  local git = vim.fn.finddir('.git', folder .. ';')
  return git ~= '' and vim.fn.fnamemodify(git, ':p:h:h') or folder
end

-- By root, for Neovim 0.7, which starts a client for each call.
local clients = {}

local function start_server(buffer)
  local command = vim.g.sensedsl_server
  if command == nil then
    command = { 'sensedsl', 'lsp' }
  end
  if not command or vim.fn.executable(command[1]) ~= 1 then
    return
  end
  local root = root_of(vim.api.nvim_buf_get_name(buffer))
  local config = { name = 'sensedsl', cmd = command, root_dir = root }
  if vim.lsp.start then
    vim.lsp.start(config)
    return
  end
  local client = clients[root]
  if not client or not vim.lsp.get_client_by_id(client) then
    client = vim.lsp.start_client(config)
    clients[root] = client
  end
  if client then
    vim.lsp.buf_attach_client(buffer, client)
  end
end

-- Whether the parser is there; its queries are those of the grammar's folder.
local function has_parser()
  local parser = vim.api.nvim_get_runtime_file('parser/sensedsl.*', false)[1]
  if not parser then
    return false
  end
  local add = vim.treesitter.language and vim.treesitter.language.add
  if add then
    add('sensedsl', { path = parser })
  else
    require('vim.treesitter.language').require_language('sensedsl', parser)
  end
  local query = require('vim.treesitter.query')
  local set = query.set or query.set_query
  for _, name in ipairs({ 'highlights', 'folds', 'indents', 'locals' }) do
    local query_file = grammar .. '/queries/' .. name .. '.scm'
    set('sensedsl', name, table.concat(vim.fn.readfile(query_file), '\n'))
  end
  return true
end

local function start_tree_sitter(buffer)
  if vim.treesitter.start then
    vim.treesitter.start(buffer, 'sensedsl')
  else
    vim.treesitter.highlighter.new(vim.treesitter.get_parser(buffer, 'sensedsl'))
  end
end

local parsed
vim.api.nvim_create_autocmd('FileType', {
  pattern = 'sensedsl',
  callback = function(event)
    local buffer = event.buf
    if parsed == nil then
      parsed = has_parser()
    end
    if parsed then
      start_tree_sitter(buffer)
    end
    start_server(buffer)
  end,
})
