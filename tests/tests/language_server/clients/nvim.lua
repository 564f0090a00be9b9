-- Neovim's own client, without any configuration: what is wrong, an outline, what is said of a word, then the layout.
local function say(...) io.stdout:write(string.format(...), '\n') end

local function run()
  local id = vim.lsp.start_client({ name = 'sensedsl', cmd = { vim.env.SENSEDSL, 'lsp' } })
  vim.lsp.buf_attach_client(0, id)
  vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 20)
  for _, one in ipairs(vim.diagnostic.get(0)) do
    local code = one.code or one.user_data and one.user_data.lsp and one.user_data.lsp.code
    say('wrong %d:%d-%d %s', one.lnum, one.col, one.end_col, code)
  end
  local line = vim.api.nvim_buf_get_lines(0, 0, 1, true)[1]
  vim.api.nvim_buf_set_lines(0, 0, 1, true, { (line:gsub('analgo', 'analog')) })
  vim.wait(20000, function() return #vim.diagnostic.get(0) == 0 end, 20)
  local function ask(method, params)
    local answers = vim.lsp.buf_request_sync(0, method, params, 20000) or {}
    return answers[id] and answers[id].result
  end
  local file = { uri = vim.uri_from_bufnr(0) }
  say('outline %s', (ask('textDocument/documentSymbol', { textDocument = file }) or {})[1].name)
  local at = { line = 0, character = 17 }
  say('hover %s', (ask('textDocument/hover', { textDocument = file, position = at }) or {}).contents.value)
  if vim.lsp.buf.format then
    vim.lsp.buf.format({ timeout_ms = 20000 })
  else
    vim.lsp.buf.formatting_sync(nil, 20000)
  end
  vim.cmd('write')
end

local done, why = pcall(run)
if not done then say('failed %s', why) end
vim.cmd(done and 'qa!' or 'cq!')
