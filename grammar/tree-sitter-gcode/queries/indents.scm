; the form that Neovim reads
[
  (if)
  (while)
  (for)
  (loop)
  (repeat_until)
  (do_loop)
  (o_sub)
  (o_if)
  (o_while)
  (o_do)
  (o_repeat)
] @indent.begin

[
  (else)
  (elseif)
  (end_mark)
  "ENDIF"
  "ENDWHILE"
  "ENDFOR"
  "ENDLOOP"
  "UNTIL"
  "ENDSUB"
  "ENDREPEAT"
] @indent.branch
