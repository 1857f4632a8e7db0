-- Neovim 0.11 and newer read this file: `vim.lsp.enable('trunnion')`.
return {
  cmd = { 'trunnion', 'lsp' },
  filetypes = { 'gcode', 'apt', 'klartext' },
  root_markers = { 'trunnion.toml', '.git' },
}
