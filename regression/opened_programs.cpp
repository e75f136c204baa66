#include "regression/opened_programs.h"

#include "controller/code_calls.h"
#include "interpreter/lexical.h"

namespace trunnion::regression {

std::optional<interpreter::ProgramText> RememberingSource::keep(
    std::string asked, std::optional<interpreter::ProgramText> found) {
    if (known_.insert(asked).second) opened_.push_back({std::move(asked), found});
    return found;
}

std::optional<interpreter::ProgramText> RememberingSource::find(int o_number) {
    return keep("O" + std::to_string(o_number), source_.find(o_number));
}

std::optional<interpreter::ProgramText> RememberingSource::find(std::string_view name) {
    return keep("<" + std::string(name) + ">", source_.find(name));
}

namespace {

/// The number after a G or M without blanks; -1 when it is computed or too long.
int code_behind(std::string_view text, std::size_t at) {
    int value = 0, digits = 0;
    for (; at < text.size(); ++at) {
        if (interpreter::is_blank(text[at])) continue;
        if (!interpreter::is_digit(text[at])) break;
        value = value * 10 + (text[at] - '0');
        if (++digits > 5) return -1;
    }
    const bool computed =
        at < text.size() && (text[at] == '#' || text[at] == '[' || text[at] == '+');
    return digits == 0 && computed ? -1 : value;
}

}  // namespace

bool codes_call(const setup::Setup& setup) {
    const interpreter::CodeCalls calls = controller::decode_code_calls(setup.stores.parameters);
    return !calls.g.empty() || !calls.m.empty() || calls.t_calls_9000;
}

bool may_call(std::string_view text, const setup::Setup& setup) {
    if (codes_call(setup)) return true;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char letter = interpreter::upper(text[at]);
        if (letter != 'G' && letter != 'M') continue;
        const int code = code_behind(text, at + 1);
        if (code < 0 || code == 98 || code == 198 || code == 65 || code == 66) return true;
    }
    return false;
}

}  // namespace trunnion::regression
