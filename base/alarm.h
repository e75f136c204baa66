// What stops an NC program, and what is said about a bad file.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace trunnion::inline base {

/// A place in an NC program: name of the program (O number or file), line and column from 1.
struct SourceRef {
    std::string program;
    int line = 0;
    int column = 0;
};

/// An NC alarm as on the control's screen. The one exception of NC execution, caught in one place
/// (Controller::run). `number` and `text` as in controller/alarms.h, e.g. 10 and
/// "IMPROPER G-CODE".
class Alarm : public std::exception {
  public:
    Alarm(int number, std::string text, SourceRef where = {})
        : number(number), text(std::move(text)), where(std::move(where)) {}
    const char* what() const noexcept override { return text.c_str(); }

    int number;
    std::string text;
    SourceRef where;    ///< filled in by whoever knows it, innermost first; line 0 = not known yet
    std::string block;  ///< the block's text
};

/// A bad file or option: becomes `path:line:column: error: message` with the line and a caret,
/// exit code 2.
class InputError : public std::exception {
  public:
    InputError(std::string message, SourceRef where = {}, std::string line_text = {})
        : message(std::move(message)), where(std::move(where)), line_text(std::move(line_text)) {}
    const char* what() const noexcept override { return message.c_str(); }

    std::string message;
    SourceRef where;        ///< `program` holds the path
    std::string line_text;  ///< shown above the caret when not empty
};

/// `path:line:column: error: message`, then the line and a caret where they are known.
std::string format_diagnostic(const SourceRef& where, const std::string& message,
                              const std::string& line_text);

}  // namespace trunnion::inline base
