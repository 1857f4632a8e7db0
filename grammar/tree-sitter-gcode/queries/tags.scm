; for lists of definitions and calls
(o_sub . (o_word) @name) @definition.function
(subprogram (o_word) @name "CALL") @reference.call
(procedure name: (name) @name) @definition.function
(call name: (name) @name) @reference.call
