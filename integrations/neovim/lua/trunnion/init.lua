-- Trunnion in Neovim: file types and the language server.
local M = {}

--- What `trunnion lsp` reads as initializationOptions: machine, dialect, tool, hints, codeLens (docs/editors.md).
M.settings = {}
M.cmd = { 'trunnion', 'lsp' }
M.root_markers = { 'trunnion.toml', '.git' }
M.filetypes = { 'gcode', 'apt', 'klartext' }

local function first_line(buffer)
  return (vim.api.nvim_buf_get_lines(buffer, 0, 1, false)[1] or ''):gsub('\r$', '')
end

local function matches(patterns, text)
  for _, pattern in ipairs(patterns) do
    if vim.regex('\\C' .. pattern):match_str(text) then
      return true
    end
  end
  return false
end

--- Tells Neovim which files are programs.
function M.add_filetypes()
  -- Neovim 0.7 asks Lua for file types only if told to
  vim.g.do_filetype_lua = 1
  local patterns, extensions = {}, {}
  for filetype, known in pairs(require('trunnion.filetypes')) do
    local unsure = {}
    for _, extension in ipairs(known.only_with_first_line or {}) do
      unsure[extension] = true
    end
    for _, extension in ipairs(known.extensions) do
      -- in lower case and in capitals, as controls write names
      for _, written in ipairs({ extension, extension:upper() }) do
        if unsure[extension] then
          -- a pattern that answers nothing leaves the file to what Neovim knows
          patterns['.*%.' .. written] = {
            function(_, buffer)
              return buffer and matches(known.first_line, first_line(buffer)) and filetype or nil
            end,
            { priority = 10 },
          }
        else
          extensions[written] = filetype
        end
      end
    end
    for _, name in ipairs(known.file_names or {}) do
      patterns[name] = { filetype, { priority = 10 } }
    end
  end
  vim.filetype.add({ extension = extensions, pattern = patterns })
  -- programs without an extension of their own
  vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
    group = vim.api.nvim_create_augroup('trunnion_first_line', {}),
    callback = function(event)
      if vim.bo[event.buf].filetype ~= '' then
        return
      end
      for filetype, known in pairs(require('trunnion.filetypes')) do
        if matches(known.first_line, first_line(event.buf)) then
          vim.bo[event.buf].filetype = filetype
          return
        end
      end
    end,
  })
end

local function root(buffer)
  local name = vim.api.nvim_buf_get_name(buffer)
  local folder = vim.fn.fnamemodify(name, ':p:h')
  for _, marker in ipairs(M.root_markers) do
    local found = vim.fn.findfile(marker, folder .. ';')
    found = found ~= '' and found or vim.fn.finddir(marker, folder .. ';')
    if found ~= '' then
      return vim.fn.fnamemodify(found, ':p:h' .. (vim.fn.isdirectory(found) == 1 and ':h' or ''))
    end
  end
  return folder
end

-- Before Neovim 0.8 there is no vim.lsp.start: one server for each folder.
local clients = {}

local function start(buffer)
  local config = { name = 'trunnion', cmd = M.cmd, root_dir = root(buffer), init_options = M.settings }
  if vim.lsp.start then
    return vim.lsp.start(config)
  end
  local key = config.root_dir
  if not clients[key] or not vim.lsp.get_client_by_id(clients[key]) then
    clients[key] = vim.lsp.start_client(config)
  end
  if clients[key] then
    vim.lsp.buf_attach_client(buffer, clients[key])
  end
end

--- Starts the server for programs. `settings`: see above; `cmd`: another program than `trunnion` on PATH.
function M.setup(options)
  options = options or {}
  M.settings = options.settings or M.settings
  M.cmd = options.cmd or M.cmd
  M.add_filetypes()
  if vim.lsp.config and vim.lsp.enable then
    vim.lsp.config('trunnion', { cmd = M.cmd, init_options = M.settings })
    vim.lsp.enable('trunnion')
    return
  end
  vim.api.nvim_create_autocmd('FileType', {
    group = vim.api.nvim_create_augroup('trunnion_server', {}),
    pattern = M.filetypes,
    callback = function(event)
      start(event.buf)
    end,
  })
end

return M
