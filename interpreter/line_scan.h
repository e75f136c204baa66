// A fast pass over the lines of a text that looks only at what a line begins with.
#pragma once

#include <string_view>

#include "interpreter/program_files.h"

namespace trunnion::interpreter {

enum class LineKind : unsigned char {
    blank,  ///< nothing but blanks and comments
    block,
    program,  ///< begins with O, ':' or <name>
    over      ///< '%', a folder line `&F=..`, or Ctrl-Z
};

struct LineHead {
    LineKind kind = LineKind::blank;
    TextPlace place;
    int number = 0;  ///< of a program
    int sequence_number = -1;
    const char* content = nullptr;  ///< behind blanks, comments, skips and N
};

/// Behind a byte order mark.
TextPlace start_of_text(std::string_view text);

class LineScan {
  public:
    LineScan(std::string_view text, TextPlace from) : text_(text), next_(from) {}

    /// Moves to the next line; false at the end of the text.
    bool next();
    const LineHead& head() const { return head_; }
    /// The start of the line behind the present one.
    TextPlace behind() const { return next_; }

  private:
    void read_head(const char* p, const char* end);

    std::string_view text_;
    TextPlace next_;
    LineHead head_;
};

}  // namespace trunnion::interpreter
