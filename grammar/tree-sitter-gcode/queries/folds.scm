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
] @fold
