-- Which files are programs. `npm run test:manifest` in vscode-extension compares this table with the manifest of the VS Code
-- extension, which it compares with the dialect tables in grammar/dialects.
return {
  gcode = {
    extensions = {
      'nc', 'ngc', 'mpf', 'spf', 'tap', 'cnc', 'eia', 'gcode', 'gco', 'min', 'iso', 'ptp', 'fnc', 'ncc', 'gc', 'din', 'arc', 'ssb', 'msb',
      'sub', 'lib',
    },
    -- Vim regular expressions
    first_line = {
      [[^%\s*$]], [[^%_N_]], [[^%\s*O\d]], [[^%\s*[MS]PF]], [[^\$[^% \t]\+\.\(MIN\|SSB\|SUB\|LIB\|MSB\)%]],
    },
  },
  apt = {
    extensions = { 'apt', 'cl', 'cls', 'ncl', 'cldata', 'aptcl', 'clf', 'apl' },
    -- Creo numbers its versions: part.ncl.1
    file_names = { '.*%.ncl%.%d%d?' },
    first_line = { [[^\s*\(PARTNO\>\|\$\$\s*\(->\|\*\)\)]] },
  },
  klartext = {
    extensions = { 'h', 'hp', 'hd', 'klartext' },
    first_line = { [[^\s*\d*\s*BEGIN PGM\>]] },
    -- these extensions belong to C and C++ unless the first line is one of Klartext
    only_with_first_line = { 'h' },
  },
}
