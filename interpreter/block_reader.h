// Characters of one block: blanks and comments skipped, places counted. Internal to the parser.
#pragma once

#include <string_view>

#include "interpreter/code.h"
#include "interpreter/lexical.h"

namespace trunnion::interpreter {

class BlockReader {
  public:
    /// What `peek` gives where the block ends.
    static constexpr char at_end = '\0';

    BlockReader(std::string_view text, std::uint64_t byte, bool nested_comments, Code& out)
        : begin(text.data() + byte),
          p(begin),
          end(text.data() + text.size()),
          text_(text.data()),
          nested_comments_(nested_comments),
          out_(out),
          first_comment_(out.comments.size()) {}

    /// Next character that counts, upper case, not consumed; at_end at the line's or text's end.
    char peek();
    /// Same for blanks only: the first character behind them, as written.
    char peek_raw();
    std::uint16_t column() const;
    /// Consumes `c` or raises `alarm`.
    void expect(char c, int alarm);

    const char* const begin;
    const char* p;
    const char* const end;
    bool leading = true;  ///< neither an item nor '=' was read yet

  private:
    void read_comment();

    const char* text_;
    bool nested_comments_;
    Code& out_;
    std::size_t first_comment_;
    static constexpr std::size_t most_comments = 4096;  ///< of a block; more are passed over
};

}  // namespace trunnion::interpreter
