// Characters of one block: skips blanks and comments, counts positions. Internal to the parser.
#pragma once

#include <string>
#include <string_view>

#include "interpreter/code.h"
#include "interpreter/lexical.h"

namespace trunnion::interpreter {

class BlockReader {
  public:
    /// Value of `peek` at the end of the block.
    static constexpr char at_end = '\0';

    BlockReader(std::string_view text, std::uint64_t byte, bool nested_comments, Code& out)
        : begin(text.data() + byte),
          p(begin),
          end(text.data() + text.size()),
          text_(text.data()),
          nested_comments_(nested_comments),
          out_(out),
          first_comment_(out.comments.size()) {}

    /// Next significant character in upper case, not consumed; at_end at the end of the line or
    /// text.
    char peek();
    /// Skips blanks only and returns the next character as written.
    char peek_raw();
    std::uint16_t column() const;
    /// Detail of an alarm when just blanks part the digits at `p` from those before, and both
    /// together would be one number.
    std::string blank_inside_number() const;
    /// Consumes `c`, or raises `alarm`.
    void expect(char c, int alarm);

    const char* const begin;
    const char* p;
    const char* const end;
    bool leading = true;  ///< no item and no '=' was read yet

  private:
    void read_comment();

    const char* text_;
    bool nested_comments_;
    Code& out_;
    std::size_t first_comment_;
    static constexpr std::size_t most_comments = 4096;  ///< per block; further comments are ignored
};

}  // namespace trunnion::interpreter
