// Comments, and the brackets that are none. "(" opens an expression or parameters where the grammar expects one, arguments behind the
// name of a call, and a comment anywhere else.
#include "tree_sitter/parser.h"
#include <string.h>

enum Token { COMMENT, OPEN, CALL_OPEN, RECOVERY };

static bool line_end(int32_t c) { return c == '\n' || c == '\r' || c == 0; }
static bool blank(int32_t c) { return c == ' ' || c == '\t'; }
static bool letter(int32_t c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

static bool is_operator(const char *word, unsigned length) {
  static const char *const operators[] = {"AND", "OR", "XOR", "NOT", "MOD", "DIV"};
  for (unsigned k = 0; k < sizeof operators / sizeof *operators; k++) {
    if (strlen(operators[k]) == length && strncmp(operators[k], word, length) == 0) return true;
  }
  return word[0] == 'B' && length > 1 && word[1] == '_';
}

// Reads to the end of the bracket. `prose`: two words stand beside each other, which no expression has.
static bool to_close(TSLexer *lexer, bool *prose) {
  char word[8];
  unsigned length = 0;
  bool after_word = false, gap = false, in_text = false;
  *prose = false;
  for (;; lexer->advance(lexer, false)) {
    int32_t c = lexer->lookahead;
    if (!in_text && (letter(c) || c == '_')) {
      if (length < sizeof word) word[length] = (char)(c >= 'a' && c <= 'z' ? c - 32 : c);
      length++;
      continue;
    }
    if (length > 0) {
      bool plain = length > 1 && !is_operator(word, length < sizeof word ? length : (unsigned)sizeof word);
      if (plain && after_word && gap) *prose = true;
      after_word = plain;
      gap = false;
      length = 0;
    }
    if (line_end(c)) return false;
    if (c == '"') in_text = !in_text;
    if (c == ')' && !in_text) return true;
    if (blank(c)) gap = true;
    else after_word = false;
  }
}

static bool comment(TSLexer *lexer) {
  lexer->result_symbol = COMMENT;
  lexer->mark_end(lexer);
  return true;
}

static bool bracket(TSLexer *lexer, const bool *valid, bool behind_blank) {
  lexer->advance(lexer, false);
  lexer->mark_end(lexer);
  bool recovery = valid[RECOVERY];
  if (!recovery && valid[OPEN]) {
    lexer->result_symbol = OPEN;
    return true;
  }
  // MSG ("...") and CYCLE81 (50, ...), but not OSUB (FIRST SIDE)
  while (blank(lexer->lookahead)) lexer->advance(lexer, false);
  int32_t first = lexer->lookahead;
  bool value = (first >= '0' && first <= '9') || first == '"' || first == ',' || first == '-' || first == '.' || first == '$';
  if (!recovery && valid[CALL_OPEN] && behind_blank && value) {
    lexer->result_symbol = CALL_OPEN;
    return true;
  }
  bool prose;
  // a text in a comment may have one quotation mark, so a comment ends at the first bracket
  if (!recovery && valid[CALL_OPEN] && !behind_blank) {
    to_close(lexer, &prose);
    if (!prose) {
      lexer->result_symbol = CALL_OPEN;
      return true;
    }
    if (lexer->lookahead != ')') return false;
  } else {
    while (!line_end(lexer->lookahead) && lexer->lookahead != ')') lexer->advance(lexer, false);
    // `first` may have been the end itself
    if (lexer->lookahead != ')') return false;
  }
  lexer->advance(lexer, false);
  return comment(lexer);
}

bool tree_sitter_gcode_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid) {
  (void)payload;
  bool behind_blank = false;
  while (blank(lexer->lookahead)) {
    behind_blank = true;
    lexer->advance(lexer, true);
  }
  switch (lexer->lookahead) {
    case '(':
      return bracket(lexer, valid, behind_blank);
    case ';':
      if (!valid[COMMENT]) return false;
      while (!line_end(lexer->lookahead)) lexer->advance(lexer, false);
      return comment(lexer);
    case '/': {
      lexer->advance(lexer, false);
      if (!valid[COMMENT] || lexer->lookahead != '*') return false;
      lexer->advance(lexer, false);
      for (int32_t before = 0; lexer->lookahead != 0 || !lexer->eof(lexer); lexer->advance(lexer, false)) {
        if (before == '*' && lexer->lookahead == '/') {
          lexer->advance(lexer, false);
          return comment(lexer);
        }
        before = lexer->lookahead;
      }
      return false;
    }
    default:
      return false;
  }
}

// There is nothing to remember between two tokens.
void *tree_sitter_gcode_external_scanner_create(void) { return NULL; }
void tree_sitter_gcode_external_scanner_destroy(void *payload) { (void)payload; }
unsigned tree_sitter_gcode_external_scanner_serialize(void *payload, char *buffer) { (void)payload; (void)buffer; return 0; }
void tree_sitter_gcode_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
  (void)payload;
  (void)buffer;
  (void)length;
}
