// Executes a main program as far as it is sequential with constant words.
#include <fmt/format.h>

#include "check/section.h"

namespace trunnion::check {

namespace {

/// Meaning of a block for an execution without variables and devices.
enum class Step { run, pass, end, skip, unknown };  // skip: ends where the signal comes

bool is_call(char letter, int code10, const CheckOptions& options) {
    const bool own = letter == 'G' ? code10 == 650 || code10 == 660 || code10 == 661
                                   : letter == 'M' && (code10 == 980 || code10 == 1980);
    return own || (options.calls_program && options.calls_program(letter, code10));
}

/// True when only variables of the language are set, so the control is unchanged.
bool sets_own_variables(const interpreter::ParsedProgram& program,
                        const interpreter::Block& block) {
    for (const interpreter::Item& item : program.items(block))
        if (item.kind != interpreter::ItemKind::assign || item.b.count > 0 || item.value >= 1000.0)
            return false;
    return true;
}

Step step_of(const interpreter::ParsedProgram& program, const interpreter::Block& block,
             const CheckOptions& options) {
    if (block.kind == interpreter::BlockKind::statements)
        return sets_own_variables(program, block) ? Step::pass : Step::unknown;
    bool ends = false, skips = false;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word || item.letter == '<') return Step::unknown;
        const auto value = interpreter::constant_value(program, item);
        if (!value) return Step::unknown;
        const int code = code10_of(*value);
        if (is_call(item.letter, code, options)) return Step::unknown;
        if (item.letter == 'T' && options.calls_program && options.calls_program('T', 0))
            return Step::unknown;
        skips = skips || (item.letter == 'G' && (code == 310 || code == 370));
        if (item.letter == 'G' && code == 100 && word_value(program, block, 'L') == 85.0)
            return Step::unknown;
        if (item.letter == 'M' && code == 990) return Step::unknown;
        ends = ends || (item.letter == 'M' && (code == 300 || code == 20));
    }
    if (skips) return ends ? Step::unknown : Step::skip;
    return ends ? Step::end : Step::run;
}

void add_alarm(const Alarm& alarm, const CheckSection& section, const interpreter::Block& block,
               const CheckOptions& options, Findings& findings) {
    const int line = alarm.where.line > 0 ? alarm.where.line : block.line;
    if (findings.has_error(line)) return;  // one finding for each cause
    Finding found;
    found.rule = "alarm";
    found.path = section.program->source.name;
    found.line = line;
    found.column = std::max(1, alarm.where.column);
    const std::string title = options.alarm_text ? options.alarm_text(alarm.number)
                                                 : fmt::format("alarm {}", alarm.number);
    // The text of the alarm without its number: "+ OVERTRAVEL ( SOFT 1 ) X".
    const std::string text = title.substr(std::min(title.size(), title.find(' ') + 1));
    found.text = "a run stops here: " + title;
    if (alarm.text.starts_with(text)) found.text += alarm.text.substr(text.size());
    found.remedy = "Correct the block, or the state in which it is reached.";
    findings.add(std::move(found));
}

}  // namespace

namespace {

/// The words left for the control after the language has taken G67 and those of M98, M198 or M99;
/// empty when the words are arguments or belong to a called program.
std::optional<interpreter::BlockWords> words_for_control(const interpreter::ParsedProgram& program,
                                                         const interpreter::Block& block,
                                                         const CheckOptions& options) {
    if (block.kind == interpreter::BlockKind::statements) return std::nullopt;
    const auto constants = constant_words(program, block);
    if (!constants || !constants->all) return std::nullopt;
    const bool back = has_code(program, block, 'M', 990);
    const bool call = has_code(program, block, 'M', 980) || has_code(program, block, 'M', 1980);
    interpreter::BlockWords out = constants->words;
    out.count = 0;
    for (const interpreter::WordValue& w : constants->words) {
        const int code = code10_of(w.value);
        if (w.letter == 'G' && is_call('G', code, options)) return std::nullopt;
        if (options.calls_program && options.calls_program(w.letter, code)) return std::nullopt;
        const bool taken = w.letter == '<' || (w.letter == 'G' && code == 670) ||
                           (w.letter == 'M' && (code == 980 || code == 1980 || code == 990)) ||
                           ((back || call) && (w.letter == 'P' || w.letter == 'L')) ||
                           (call && w.letter == 'Q');
        if (!taken) out.words[out.count++] = w;
    }
    return out;
}

/// After the sequential part, and in subprograms: checks of the words alone.
void read_on(const CheckSection& section, std::size_t from, Trial& trial,
             const CheckOptions& options, Findings& findings) {
    for (std::size_t i = from; i < section.blocks.size(); ++i) {
        const interpreter::Block& block = *section.blocks[i];
        const auto words = words_for_control(*section.program, block, options);
        if (!words || words->count == 0) continue;
        if (const auto alarm = trial.read(*words))
            add_alarm(*alarm, section, block, options, findings);
    }
}

}  // namespace

void check_trial(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    if (!options.start_trial) return;
    const auto trial = options.start_trial();
    std::size_t at = 0;
    for (; at < section.blocks.size() && !section.subprogram; ++at) {
        const interpreter::Block& block = *section.blocks[at];
        const Step step = step_of(*section.program, block, options);
        if (step == Step::unknown) break;
        if (step == Step::pass) continue;
        const auto words = words_for_control(*section.program, block, options);
        if (!words) break;
        std::optional<Alarm> alarm;
        if (words->count > 0) alarm = trial->run(*words);
        if (!alarm && step == Step::end) alarm = trial->end();
        if (alarm) add_alarm(*alarm, section, block, options, findings);
        if (alarm || step == Step::end || step == Step::skip) {
            ++at;
            break;
        }
    }
    if (at < section.blocks.size()) return read_on(section, at, *trial, options, findings);
    if (section.subprogram || section.blocks.empty()) return;
    if (const auto alarm = trial->end())
        add_alarm(*alarm, section, *section.blocks.back(), options, findings);
}

}  // namespace trunnion::check
