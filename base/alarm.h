// Alarms that stop an NC program, and errors of input files.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace trunnion::inline base {

/// A position in an NC program: program name (O number or file), line and column from 1.
struct SourceRef {
    std::string program;
    int line = 0;
    int column = 0;
};

/// An NC alarm as on the control's screen. The only exception of NC execution, caught in one place
/// (Controller::run). `number` and `text` as in controller/alarms.h, e.g. 10 and "IMPROPER G-CODE".
class Alarm : public std::exception {
  public:
    Alarm(int number, std::string text, SourceRef where = {})
        : number(number), text(std::move(text)), where(std::move(where)) {}
    const char* what() const noexcept override { return text.c_str(); }

    int number;
    std::string text;
    SourceRef where;    ///< set by the innermost function that knows it; line 0 = unknown so far
    std::string block;  ///< text of the block
};

/// A bad file or option. Reported as `path:line:column: error: message` with the line and a caret,
/// exit code 2.
class InputError : public std::exception {
  public:
    InputError(std::string message, SourceRef where = {}, std::string line_text = {})
        : message(std::move(message)), where(std::move(where)), line_text(std::move(line_text)) {}
    const char* what() const noexcept override { return message.c_str(); }

    std::string message;
    SourceRef where;        ///< `program` is the path
    std::string line_text;  ///< shown above the caret when not empty
};

/// `path:line:column: error: message`, then the line and a caret if they are known.
std::string format_diagnostic(const SourceRef& where, const std::string& message,
                              const std::string& line_text);

}  // namespace trunnion::inline base
