// Programs that call programs: G65-G67, M98, M99, M198 and codes mapped by parameters.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "interpreter/alarms.h"
#include "interpreter/runner.h"
#include "interpreter/word_rules.h"

namespace trunnion::interpreter {
namespace {

const CodeCalls::Call* find_call(const std::map<int, CodeCalls::Call>& calls, double code) {
    const auto it = calls.find(static_cast<int>(std::lround(code)));
    return it == calls.end() ? nullptr : &it->second;
}

/// The eight bytes of a control's MACRO.TXT, most significant first; false when not sixteen hex
/// digits.
bool read_hex_double(std::string_view digits, double& value) {
    std::uint64_t bits = 0;
    if (digits.size() != 16) return false;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + 16, bits, 16);
    if (error != std::errc{} || end != digits.data() + 16) return false;
    std::memcpy(&value, &bits, sizeof value);
    return true;
}

/// P, L and Q of calls and returns: integers without sign.
void check_words(const BlockWords& words, DialectFamily family) {
    if (words.count == 1) return;  // M99 alone
    if (const auto fault = find_word_fault(words, family, false))
        raise_language_alarm(fault->alarm, fault->column, fault->detail);
}

bool is_modal_cancel(const WordValue& word) {
    return word.letter == 'G' && word.value == 67.0;  // vacant is NaN
}

}  // namespace

/// `words` contain a code of the language or a program name, the first of them at `first`. True:
/// words remain for the control.
bool Interpreter::State::special_words(const Block& block, const Code& code, std::size_t first) {
    const bool codes_call = !frame().by_code;
    bool has_name = false, cancels = false;
    for (std::size_t i = first; i < words.count; ++i) {
        has_name = has_name || words.words[i].letter == '<';
        cancels = cancels || is_modal_cancel(words.words[i]);
    }
    Section* const named = has_name ? take_name(block, code) : nullptr;
    if (cancels) cancel_modals();  // the block may call as well: G67 M98 P100
    for (std::size_t i = first; i < words.count; ++i) {
        const WordValue word = words.words[i];
        if (word.vacant || !special.has(word.letter, word.value)) continue;
        if (word.letter == 'T') {
            if (codes_call) return tool_call(i);
            continue;
        }
        if (word.letter == 'M') {
            if (word.value == 98) return subprogram_words(i, named, false);
            if (word.value == 99) return return_words(i);
            if (word.value == 198) return subprogram_words(i, named, true);
            const CodeCalls::Call* call = find_call(options.calls.m, word.value);
            if (codes_call && call) return code_call(i, *call);
            continue;
        }
        if (word.value == 65) return macro_call(i, named, false, false), false;
        if (word.value == 66) return macro_call(i, named, true, false), false;
        if (word.value == 66.1) return macro_call(i, named, true, true), false;
        if (word.value == 10 && macro_file_value(block, code)) return false;
        const CodeCalls::Call* call = find_call(options.calls.g, word.value * 10.0);
        if (codes_call && call) return code_call(i, *call);
    }
    return words.count > 0;
}

/// Removes `<NAME>` from the block and returns the program of that name.
Section* Interpreter::State::take_name(const Block& block, const Code& code) {
    std::size_t at_name = 0;
    for (std::size_t i = 0; i < words.count; ++i)
        if (words.words[i].letter == '<') at_name = i;
    const int column = words.words[at_name].column;
    const bool calls = std::any_of(words.begin(), words.end(), [](const WordValue& w) {
        return (w.letter == 'M' && (w.value == 98 || w.value == 198)) || is_macro_call(w);
    });
    if (!calls) raise_language_alarm(9, column, "a program name without a call");
    std::string_view name;
    for (std::uint32_t i = 0; i < block.items.count; ++i) {
        const Item& item = code.items[block.items.first + i];
        if (item.letter == '<')
            name = std::string_view(code.text).substr(item.b.first, item.b.count);
    }
    Section* const section = files.find(name, *frame().section);
    if (!section) raise_language_alarm(76, column, "<" + std::string(name) + ">");
    remove(at_name);
    return section;
}

void Interpreter::State::remove(std::size_t at_word) {
    for (std::size_t i = at_word + 1; i < words.count; ++i) words.words[i - 1] = words.words[i];
    --words.count;
}

/// Removes the first word with this letter from the block and returns its value.
double Interpreter::State::take(char letter, double otherwise) {
    for (std::size_t i = 0; i < words.count; ++i) {
        if (words.words[i].letter != letter) continue;
        const WordValue word = words.words[i];
        remove(i);
        return word.vacant ? otherwise : word.value;
    }
    return otherwise;
}

/// Removes the code in front and the first P and L, whose values it returns (-1 and 1 where they
/// are not there or vacant): in one walk, because programs call macros in their inner loops.
std::pair<double, double> Interpreter::State::take_program_and_repeats() {
    bool has_p = false, has_l = false;
    std::pair<double, double> values{-1.0, 1.0};
    std::size_t kept = 0;
    for (std::size_t i = 1; i < words.count; ++i) {
        const WordValue& word = words.words[i];
        const bool is_p = word.letter == 'P' && !has_p, is_l = word.letter == 'L' && !has_l;
        if (is_p || is_l) {
            (is_p ? has_p : has_l) = true;
            if (!word.vacant) (is_p ? values.first : values.second) = word.value;
            continue;
        }
        words.words[kept++] = word;
    }
    words.count = kept;
    return values;
}

ArgumentRules Interpreter::State::argument_rules() const {
    ArgumentRules r;
    r.whole_numbers_as_written = options.whole_arguments_as_written;
    r.increments_per_unit = rules.increments_per_unit;
    return r;
}

Section& Interpreter::State::called(int number, bool outside, int column) {
    Section* section = outside ? files.find_outside(number) : files.find(number, frame().section);
    if (!section) raise_language_alarm(76, column, "O" + std::to_string(number));
    return *section;
}

/// G65 P_ L_ arguments, or G66 / G66.1 with the same words.
void Interpreter::State::macro_call(std::size_t at_word, Section* named, bool modal,
                                    bool every_block) {
    if (at_word != 0)
        raise_language_alarm(127, words.words[0].column, "G65 and G66 stand first in their block");
    check_words(words, options.dialect.family);
    const int column = words.words[0].column;
    const auto [p, l] = take_program_and_repeats();
    if (p < 0.0 && !named) raise_language_alarm(76, column, "P is missing");
    const int repeats = whole_number(l, column);
    Section& section = named ? *named : called(whole_number(p, column), false, column);
    if (modal) {
        if (modal_count == modals.size()) raise_language_alarm(122, column);
        ModalCall& call = modals[modal_count++];
        call.section = &section;
        call.repeats = repeats;
        call.every_block = every_block;
        frame().modal_limit = static_cast<int>(modal_count);
        return pass_arguments(words.begin(), words.end(), argument_rules(), call.locals);
    }
    start_macro(section, repeats, false);
}

/// Starts a macro with the remaining words of the block as arguments.
void Interpreter::State::start_macro(Section& section, int repeats, bool by_code) {
    const auto depth = static_cast<std::size_t>(frame().macro_depth) + 1;
    if (depth >= levels.size())
        raise_language_alarm(122, words.count > 0 ? words.words[0].column : 1);
    pass_arguments(words.begin(), words.end(), argument_rules(), levels[depth]);
    if (repeats < 1) return;
    if (repeats > 1) repeated[depth] = levels[depth];
    push(section, repeats, true, by_code);
    frame().locals = memory.locals = &levels[depth];
}

void Interpreter::State::push(Section& section, int repeats, bool macro, bool by_code) {
    const Frame& caller = frame();
    Frame f;
    f.macro_depth = caller.macro_depth + (macro ? 1 : 0);
    f.sub_depth = caller.sub_depth + (macro ? 0 : 1);
    if (f.macro_depth > options.dialect.macro_call_levels) raise_language_alarm(122);
    if (f.sub_depth > options.dialect.subprogram_levels ||
        f.macro_depth + f.sub_depth > options.dialect.total_levels)
        raise_language_alarm(77);
    f.section = &section;
    f.locals = caller.locals;
    f.start = {section.begin.byte, section.begin.line, section.first_block};
    f.back = at;
    f.back_link = link_from;
    f.repeats = repeats;
    f.modal_limit = caller.modal_limit;
    f.macro = macro;
    f.by_code = by_code || caller.by_code;
    frames.push_back(f);
    at = f.start;
    link_from = -1;
}

/// Returns the remaining words first and calls afterwards, or calls at once.
bool Interpreter::State::give_or(Pending call) {
    pending = call;
    if (words.count > 0) return true;
    perform_pending();
    return false;
}

/// M98 P_ L_ Q_, M198 P_ L_.
bool Interpreter::State::subprogram_words(std::size_t at_word, Section* named, bool outside) {
    check_words(words, options.dialect.family);
    const int column = words.words[at_word].column;
    remove(at_word);
    const double p = take('P', -1.0);
    if (p < 0.0 && !named) raise_language_alarm(76, column, "P is missing");
    const int l = whole_number(take('L', -1.0), column);
    const bool packed = options.dialect.family == DialectFamily::fanuc;
    const int number = whole_number(p, column);
    SubprogramCall call = unpack_subprogram(number, l, packed);
    if (!named && call.program != number && !files.find(call.program, frame().section) &&
        files.find(number, frame().section))
        call = {number, 1};  // eight-digit program number without L
    Pending todo;
    todo.kind = Pending::Kind::subprogram;
    todo.named = named;
    todo.program = call.program;
    todo.repeats = call.repeats;
    todo.sequence_number = whole_number(take('Q', -1.0), column);
    todo.outside = outside;
    return give_or(todo);
}

/// M99 P_ L_: P is the block of the caller to continue at, L sets the remaining repeats.
bool Interpreter::State::return_words(std::size_t at_word) {
    check_words(words, options.dialect.family);
    const int column = words.words[at_word].column;
    remove(at_word);
    Pending todo;
    todo.kind = Pending::Kind::give_back;
    todo.sequence_number = whole_number(take('P', -1.0), column);
    todo.repeats = whole_number(take('L', -1.0), column);
    return give_or(todo);
}

/// A G or M code that a parameter maps to a program.
bool Interpreter::State::code_call(std::size_t at_word, const CodeCalls::Call& call) {
    const int column = words.words[at_word].column;
    remove(at_word);
    if (!call.with_arguments) {
        Pending todo;
        todo.kind = Pending::Kind::subprogram;
        todo.program = call.program;
        todo.by_code = true;
        return give_or(todo);
    }
    const int repeats = whole_number(take('L', 1.0), column);
    Section& section = called(call.program, false, column);
    if (!call.modal) return start_macro(section, repeats, true), false;
    if (modal_count == modals.size()) raise_language_alarm(122, column);
    ModalCall& modal = modals[modal_count++];
    modal.section = &section;
    modal.repeats = repeats;
    modal.every_block = false;
    frame().modal_limit = static_cast<int>(modal_count);
    pass_arguments(words.begin(), words.end(), argument_rules(), modal.locals);
    return false;
}

/// 6001#5: a T code calls O9000 with its number in #149.
bool Interpreter::State::tool_call(std::size_t at_word) {
    memory.set(149, words.words[at_word].value);
    remove(at_word);
    Pending todo;
    todo.kind = Pending::Kind::subprogram;
    todo.program = 9000;
    todo.by_code = true;
    return give_or(todo);
}

/// Each G67 cancels the latest modal call; without a modal call it has no effect (post processors
/// output it as a precaution).
void Interpreter::State::cancel_modals() {
    if (std::any_of(words.begin(), words.end(), is_macro_call)) return;  // G67 is out of place
    for (std::size_t i = 0; i < words.count;) {
        if (!is_modal_cancel(words.words[i])) {
            ++i;
            continue;
        }
        remove(i);
        if (modal_count > 0) --modal_count;
    }
}

/// `G10L85P500(400777CED9168730)` of MACRO.TXT: #500 from eight bytes. All F is vacant (assumed).
bool Interpreter::State::macro_file_value(const Block& block, const Code& code) {
    int l = 0, p = -1;
    for (const WordValue& word : words) {
        if (word.letter == 'L') l = whole_number(word.value, word.column);
        if (word.letter == 'P') p = whole_number(word.value, word.column);
    }
    if (l != 85 || p < 0) return false;
    double v = 0.0;
    if (!read_hex_double(comment_of(block, code), v))
        raise_language_alarm(1144, words.words[0].column, "sixteen hexadecimal digits expected");
    memory.set(p, v);
    return true;
}

/// G66.1: the block itself is the argument list. False: not active in this program. Some modal
/// call is.
bool Interpreter::State::call_every_block() {
    if (frame().modal_limit < static_cast<int>(modal_count)) return false;
    ModalCall& call = modals[modal_count - 1];
    if (!call.every_block) return false;
    ArgumentRules r = argument_rules();
    r.pass_all = true;
    pass_arguments(words.begin(), words.end(), r, call.locals);
    push(*call.section, call.repeats, true, false);
    frame().modal_limit = static_cast<int>(modal_count) - 1;
    frame().locals = memory.locals = &call.locals;
    return true;
}

/// G66: the macro runs after a block with motion. Its local variables keep their values.
void Interpreter::State::call_after_motion() {
    moved = false;
    const auto level = std::min<std::size_t>(
        modal_count, static_cast<std::size_t>(std::max(frame().modal_limit, 0)));
    if (level == 0 || modals[level - 1].every_block) return;
    ModalCall& call = modals[level - 1];
    if (call.repeats < 1) return;
    push(*call.section, call.repeats, true, false);
    frame().modal_limit = static_cast<int>(level) - 1;
    frame().locals = memory.locals = &call.locals;
}

void Interpreter::State::perform_pending() {
    const Pending todo = pending;
    pending = {};
    if (todo.kind == Pending::Kind::give_back) return give_back(todo.sequence_number, todo.repeats);
    call_subprogram(todo);
}

void Interpreter::State::call_subprogram(const Pending& call) {
    Section& section = call.named ? *call.named : called(call.program, call.outside, 1);
    if (call.repeats < 1) return;
    const int n = call.sequence_number;
    const auto place = n < 0 ? std::nullopt : files.find_sequence(section, n, section.begin.byte);
    if (n >= 0 && !place) raise_language_alarm(78, 1, "N" + std::to_string(n));
    push(section, call.repeats, false, call.by_code);
    if (place) frame().start = at = {place->byte, place->line, -1};
}

/// M99, or the end of a called program. `n`: block of the caller to continue at (-1: after the
/// call); `repeats`: remaining repeats (-1: unchanged).
void Interpreter::State::give_back(int n, int repeats) {
    Frame& f = frame();
    if (frames.size() == 1) {
        ended = n < 0 && options.main_m99_ends;
        if (ended) main_end = MainEnd::returned;
        at = f.start;
        link_from = -1;
        if (n >= 0) jump(target_of_return(f, n));
        return;
    }
    if (repeats >= 0) f.repeats = repeats + 1;
    if (n < 0 && --f.repeats > 0) return repeat();
    const TextPlace target = n < 0 ? TextPlace{} : target_of_return(frames[frames.size() - 2], n);
    at = f.back;
    link_from = f.back_link;
    frames.pop_back();
    memory.locals = frame().locals;
    if (n >= 0) jump(target);
}

/// M99 P: searched from the start of the program that continues.
TextPlace Interpreter::State::target_of_return(const Frame& caller, int n) {
    const auto place = files.find_sequence(*caller.section, n, caller.section->begin.byte);
    if (!place) raise_language_alarm(78, 1, "N" + std::to_string(n));
    return *place;
}

/// The next of L repeats, with the original arguments.
void Interpreter::State::repeat() {
    Frame& f = frame();
    const auto depth = static_cast<std::size_t>(f.macro_depth);
    if (f.macro && f.locals == &levels[depth]) *f.locals = repeated[depth];
    f.loops = {};
    at = f.start;
    link_from = -1;
}

}  // namespace trunnion::interpreter
