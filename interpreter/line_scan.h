// A fast scan over the lines of a text that only reads the beginning of each line.
#pragma once

#include <optional>
#include <string_view>

#include "interpreter/program_files.h"

namespace trunnion::interpreter {

enum class LineKind : unsigned char {
    blank,  ///< only blanks and comments
    block,
    program,  ///< starts with O, ':' or <name>
    over      ///< '%', a folder line `&F=..`, or Ctrl-Z
};

struct LineHead {
    LineKind kind = LineKind::blank;
    TextPlace place;
    int number = 0;  ///< of a program; of `<NAME>` 0
    int sequence_number = -1;
    const char* content = nullptr;  ///< after blanks, comments, skips and N
};

/// 8001 for the name "O8001", as of a program `<O8001>`; empty for other names.
std::optional<int> number_of_name(std::string_view name);

/// Skips a byte order mark.
TextPlace start_of_text(std::string_view text);

/// The first small letter of a text that a run reads as a capital: not in a comment, a name or a
/// printed text. Line and column from 1.
struct LetterPlace {
    int line = 0, column = 0;
};
std::optional<LetterPlace> first_small_letter(std::string_view text);

class LineScan {
  public:
    LineScan(std::string_view text, TextPlace from) : text_(text), next_(from) {}

    /// Moves to the next line; false at the end of the text.
    bool next();
    const LineHead& head() const { return head_; }
    /// The start of the next line.
    TextPlace behind() const { return next_; }

  private:
    void read_head(const char* p, const char* end);

    std::string_view text_;
    TextPlace next_;
    LineHead head_;
};

}  // namespace trunnion::interpreter
