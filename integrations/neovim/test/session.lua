-- A session of a person in Neovim, for the record that tests/all/lsp_sessions.rs plays again: open, look, break, mend, rename, format, save.
local folder = vim.env.TRUNNION_TEST_FOLDER
vim.opt.runtimepath:prepend(vim.env.TRUNNION_PLUGIN)
require('trunnion').setup({ cmd = { vim.env.TRUNNION_TEE, 'lsp' } })
vim.cmd('filetype on')
vim.cmd('edit ' .. vim.fn.fnameescape(folder .. '/part.nc'))
local buffer = vim.api.nvim_get_current_buf()

local function until_true(what, condition)
  assert(vim.wait(30000, condition, 50), 'waited in vain for ' .. what)
end

local function ask(method, more)
  local params = vim.tbl_extend('force', vim.lsp.util.make_position_params(0, 'utf-16'), more or {})
  local replies = vim.lsp.buf_request_sync(buffer, method, params, 20000)
  local _, reply = next(replies or {})
  assert(reply, method)
  return reply.result
end

local function at(needle, plus)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local start = line:find(needle, 1, true)
    if start then
      vim.api.nvim_win_set_cursor(0, { number, start - 1 + (plus or 0) })
      return number
    end
  end
  error(needle)
end

until_true('diagnostics', function() return #vim.diagnostic.get(buffer) > 0 end)
ask('textDocument/documentSymbol')
at('G21')
ask('textDocument/hover')
at('y#100', 2)
ask('textDocument/definition')
ask('textDocument/references', { context = { includeDeclaration = true } })
ask('textDocument/documentHighlight')
-- a mistake: the letter O for a zero, and the quick fix
local row = at('G0 X0.', 1)
vim.api.nvim_buf_set_text(buffer, row - 1, 5, row - 1, 6, { 'O' })
local function wrong()
  return vim.tbl_filter(function(one) return one.lnum == row - 1 and one.message:find('letter O', 1, true) end, vim.diagnostic.get(buffer))
end
until_true('the mistake', function() return #wrong() > 0 end)
local range = { start = { line = row - 1, character = 4 }, ['end'] = { line = row - 1, character = 6 } }
local actions = ask('textDocument/codeAction', { range = range, context = { diagnostics = {}, only = { 'quickfix' } } })
vim.lsp.util.apply_workspace_edit(actions[1].edit, 'utf-16')
until_true('the end of the mistake', function() return #wrong() == 0 end)
-- a new block, letter by letter, with a look at the completions; then it is undone
row = at('N130')
vim.api.nvim_buf_set_lines(buffer, row, row, false, { '' })
vim.api.nvim_win_set_cursor(0, { row + 1, 0 })
for letter in ('N135 G'):gmatch('.') do
  local line = vim.api.nvim_get_current_line()
  vim.api.nvim_buf_set_text(buffer, row, #line, row, #line, { letter })
  -- longer than Neovim holds changes back
  vim.wait(200)
end
vim.api.nvim_win_set_cursor(0, { row + 1, 6 })
ask('textDocument/completion')
ask('textDocument/signatureHelp')
vim.api.nvim_buf_set_lines(buffer, row, row + 1, false, {})
-- a request that is cancelled
local _, cancel = vim.lsp.buf_request(buffer, 'textDocument/hover', vim.lsp.util.make_position_params(0, 'utf-16'), function() end)
cancel()
at('#100=', 1)
vim.lsp.util.apply_workspace_edit(ask('textDocument/rename', { newName = '#110' }), 'utf-16')
local edits = ask('textDocument/formatting', { options = { tabSize = 2, insertSpaces = true } })
vim.lsp.util.apply_text_edits(edits, buffer, 'utf-16')
ask('textDocument/codeAction', { range = range, context = { diagnostics = {}, only = { 'refactor.rewrite' } } })
ask('textDocument/foldingRange')
vim.cmd('silent write')
vim.wait(1000)
vim.cmd('qall!')
