-- Run by run.sh inside Neovim: a program with a mistake is opened, and what the server says of it is looked at.
local folder = vim.env.TRUNNION_TEST_FOLDER
vim.opt.runtimepath:prepend(vim.env.TRUNNION_PLUGIN)
require('trunnion').setup({ cmd = { vim.env.TRUNNION_BIN, 'lsp' } })
vim.cmd('filetype on')

local passed, failed = 0, 0
local function test(name, body)
  local ok, problem = pcall(body)
  passed, failed = passed + (ok and 1 or 0), failed + (ok and 0 or 1)
  print((ok and 'ok - ' or 'not ok - ') .. name .. (ok and '' or ': ' .. tostring(problem)) .. '\n')
end

local function until_true(what, condition)
  local value
  assert(vim.wait(30000, function()
    value = condition()
    return value and true or false
  end, 50), 'waited in vain for ' .. what)
  return value
end

local function write(name, lines)
  local path = folder .. '/' .. name
  vim.fn.mkdir(vim.fn.fnamemodify(path, ':h'), 'p')
  vim.fn.writefile(lines, path)
  return path
end

local function open(name, lines)
  vim.cmd('edit! ' .. vim.fn.fnameescape(write(name, lines)))
  return vim.api.nvim_get_current_buf()
end

-- the answer of the server to a request about the current buffer
local function ask(buffer, method, params)
  local answers = until_true(method, function()
    local replies = vim.lsp.buf_request_sync(buffer, method, params, 20000)
    return replies and next(replies) and replies or nil
  end)
  local _, reply = next(answers)
  assert(not reply.error and not reply.err, vim.inspect(reply))
  return reply.result
end

local function text(buffer)
  return table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), '\n')
end

test('file types by extension and first line', function()
  local expected = {
    { 'a.nc', 'gcode', 'G0 X1' }, { 'A.MPF', 'gcode', 'G0 X1' }, { 'a.ngc', 'gcode', 'G0 X1' }, { 'a.MIN', 'gcode', '$A.MIN%' },
    { 'a.cls', 'apt', 'GOTO/1,2,3' }, { 'a.ncl.12', 'apt', 'GOTO/1,2,3' }, { 'a.hd', 'klartext', '0 L X+1' },
    { 'a.h', 'klartext', '0 BEGIN PGM A MM' }, { 'O1234', 'gcode', '%' }, { 'PART_1', 'gcode', '%_N_PART_MPF' },
    { 'WELLE', 'klartext', 'BEGIN PGM WELLE MM' }, { 'CUTS', 'apt', 'PARTNO GUIDE VANE' },
  }
  for _, case in ipairs(expected) do
    open('types/' .. case[1], { case[3] })
    assert(vim.bo.filetype == case[2], case[1] .. ' is ' .. vim.bo.filetype)
  end
  open('types/stdio.h', { '#include <stddef.h>' })
  assert(vim.bo.filetype == 'c' or vim.bo.filetype == 'cpp', 'a C header is ' .. vim.bo.filetype)
  open('types/notes.txt', { '% of the parts' })
  assert(vim.bo.filetype == 'text', 'a text is ' .. vim.bo.filetype)
end)

local mistake = { '%', 'O0001', 'G21 G90 G17', 'G0 X1,5 Y0', 'G1 X2. F100', 'M30', '%' }

test('a mistake is shown as a diagnostic', function()
  local buffer = open('part.nc', mistake)
  local found = until_true('diagnostics', function()
    local all = vim.diagnostic.get(buffer)
    return #all > 0 and all or nil
  end)
  local line = vim.tbl_filter(function(one) return one.lnum == 3 end, found)
  assert(#line > 0, vim.inspect(found))
  assert(line[1].source == 'trunnion', line[1].source)
  print('  ' .. line[1].message:gsub('\n.*', '') .. '\n')
end)

test('hover explains a code', function()
  local buffer = open('hover.nc', { '%', 'O0002', 'G21 G90 G17', 'G0 X1. Y0', 'M30', '%' })
  vim.api.nvim_win_set_cursor(0, { 3, 4 })
  local params = vim.lsp.util.make_position_params(0, 'utf-16')
  local answer = until_true('a hover', function()
    local result = ask(buffer, 'textDocument/hover', params)
    return type(result) == 'table' and result or nil
  end)
  local shown = vim.inspect(answer.contents)
  assert(shown:find('G90') and shown:lower():find('absolute'), shown)
end)

test('a quick fix is applied', function()
  -- the letter O in place of a zero
  local buffer = open('fix.nc', { '%', 'O0003', 'G21 G90 G17', 'GO X1. Y0', 'M30', '%' })
  until_true('diagnostics', function() return #vim.diagnostic.get(buffer) > 0 end)
  vim.api.nvim_win_set_cursor(0, { 4, 3 })
  local params = { textDocument = vim.lsp.util.make_text_document_params(buffer), context = { diagnostics = {}, only = { 'quickfix' } } }
  params.range = { start = { line = 3, character = 0 }, ['end'] = { line = 3, character = 10 } }
  local fix = until_true('a quick fix', function()
    for _, action in ipairs(ask(buffer, 'textDocument/codeAction', params) or {}) do
      return action
    end
  end)
  print('  ' .. fix.title .. '\n')
  if not fix.edit then
    fix = ask(buffer, 'codeAction/resolve', fix)
  end
  vim.lsp.util.apply_workspace_edit(fix.edit, 'utf-16')
  assert(text(buffer):find('\nG0 X1. Y0\n', 1, true), text(buffer))
  until_true('the diagnostic to go', function()
    return #vim.tbl_filter(function(one) return one.lnum == 3 end, vim.diagnostic.get(buffer)) == 0
  end)
end)

print(('%d passed, %d failed\n'):format(passed, failed))
vim.cmd(failed == 0 and 'qall!' or 'cquit!')
