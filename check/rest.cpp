// Blocks that are not carried out: behind what is known, behind jumps, and in subprograms.
#include <fmt/format.h>

#include "check/trial.h"
#include "interpreter/print_output.h"

namespace trunnion::check {

using interpreter::Item;
using interpreter::ItemKind;
using interpreter::KnownValues;

bool is_call(char letter, int code10, const CheckOptions& options) {
    const bool own = letter == 'G' ? code10 == 650 || code10 == 660 || code10 == 661
                                   : letter == 'M' && (code10 == 980 || code10 == 1980);
    return own || (options.calls_program && options.calls_program(letter, code10));
}

std::optional<interpreter::BlockWords> left_for_control(const interpreter::BlockWords& all,
                                                        const CheckOptions& options) {
    const auto has_m = [&](double code) {
        return std::any_of(all.begin(), all.end(), [code](const interpreter::WordValue& w) {
            return w.letter == 'M' && !w.vacant && w.value == code;
        });
    };
    const bool call = has_m(98.0) || has_m(198.0), back = has_m(99.0);
    interpreter::BlockWords left = all;
    left.count = 0;
    for (const interpreter::WordValue& w : all) {
        const bool code_word = w.letter == 'G' || w.letter == 'M';
        if (w.vacant && code_word) return std::nullopt;
        const int code = code10_of(w.value);
        if (w.letter == 'G' && is_call('G', code, options)) return std::nullopt;
        if (options.calls_program && options.calls_program(w.letter, code)) return std::nullopt;
        const bool taken = w.letter == '<' || (w.letter == 'G' && code == 670) ||
                           (w.letter == 'M' && (code == 980 || code == 1980 || code == 990)) ||
                           ((back || call) && (w.letter == 'P' || w.letter == 'L')) ||
                           (call && w.letter == 'Q');
        if (!taken && !w.vacant) left.words[left.count++] = w;
    }
    return left;
}

std::optional<double> value_of(const interpreter::ParsedProgram& program, const Item& item,
                               const KnownValues& known) {
    if (item.a.count == 0) return item.value;
    const auto value = known.value(program.expression(item.a));
    if (value && item.kind == ItemKind::go_to && !(*value > 0.0))
        throw Alarm(128, "", {"", 0, item.column});
    return value && item.negative ? -*value : value;
}

std::optional<int> target_of(const interpreter::ParsedProgram& program, const Item& item,
                             const KnownValues& known) {
    if (item.b.count == 0) return static_cast<int>(item.value);
    return known.target(program.expression(item.b), item.column);
}

std::string alarm_line(const Alarm& alarm, const CheckOptions& options) {
    if (!options.alarm_text) return fmt::format("alarm {} {}", alarm.number, alarm.text);
    const std::string title = options.alarm_text(alarm.number);
    // The text of the alarm without its number: "+ OVERTRAVEL ( SOFT 1 ) X".
    const std::string text = title.substr(std::min(title.size(), title.find(' ') + 1));
    return alarm.text.starts_with(text) ? title + alarm.text.substr(text.size()) : title;
}

/// Of one program some numbers have a decimal point and others do not: seldom meant.
bool mixes_points(const CheckSection& section) {
    for (const interpreter::Block* block : section.blocks)
        for (const Item& item : section.program->items(*block))
            if (item.kind == ItemKind::word && item.decimal_point && item.a.count == 0 &&
                std::string_view("ABCUVWXYZ").find(item.letter) != std::string_view::npos)
                return true;
    return false;
}

void add_cautions(Trial& trial, const CheckSection& section, const interpreter::Block& block,
                  Findings& findings) {
    for (Caution& caution : trial.cautions()) {
        const bool arc = caution.rule == "arc-radius";
        if (findings.has(caution.rule, block.line)) continue;
        const bool warn = arc || (caution.rule == "decimal-point" && mixes_points(section));
        findings.add({caution.rule, warn ? Severity::warning : Severity::note,
                      section.program->source.name, block.line, 1, std::move(caution.text),
                      std::move(caution.remedy)});
    }
}

void add_alarm(const Alarm& alarm, const CheckSection& section, ReachedBlock at,
               const CheckOptions& options, Findings& findings) {
    const Reach reach = at.reach;
    const int line = alarm.where.line > 0 ? alarm.where.line : at.block.line;
    if (findings.has_error(line)) return;  // one finding for each cause
    Finding found;
    found.rule = "alarm";
    found.severity = reach == Reach::certain       ? Severity::error
                     : reach == Reach::conditional ? Severity::warning
                                                   : Severity::note;
    found.path = section.program->source.name;
    found.line = line;
    found.column = std::max(1, alarm.where.column);
    found.text = (reach == Reach::certain   ? "a run stops here: "
                  : reach == Reach::as_main ? "as a main program it stops here: "
                                            : "a run stops here if it reaches this block: ") +
                 alarm_line(alarm, options);
    found.remedy = "Correct the block, or the state in which it is reached.";
    findings.add(std::move(found));
}

namespace {

/// The same of a block whose words are not all known.
std::optional<ConstantWords> words_for_control(const interpreter::ParsedProgram& program,
                                               const interpreter::Block& block,
                                               const CheckOptions& options) {
    if (block.kind == interpreter::BlockKind::statements) return std::nullopt;
    auto out = constant_words(program, block);
    if (!out) return std::nullopt;
    const auto left = left_for_control(out->words, options);
    if (!left) return std::nullopt;
    out->words = *left;
    return out;
}

/// Throws an alarm that the block's expressions raise whatever the variables hold. What stands
/// behind a condition makes the reach conditional.
void evaluate_all(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                  const CheckOptions& options, Reach& reach) {
    KnownValues known(options.dialect.has_98000, [&](int number) {
        return options.variable_alarm ? options.variable_alarm(number, false) : 0;
    });
    for (const Item& item : program.items(block)) {
        if (item.kind == ItemKind::skip || item.kind == ItemKind::print_text) continue;
        value_of(program, item, known);
        if (reach == Reach::certain &&
            (item.kind == ItemKind::if_goto || item.kind == ItemKind::if_then))
            reach = Reach::conditional;
        if (item.kind != ItemKind::assign || item.b.count == 0) continue;
        const auto number = target_of(program, item, known);
        if (!number) continue;
        if (known.owns(*number)) at_column(item, [&] { known.set(*number, std::nullopt); });
        const int alarm = known.owns(*number) || !options.variable_alarm
                              ? 0
                              : options.variable_alarm(*number, true);
        if (alarm != 0) throw Alarm(alarm, "", {"", 0, item.column});
    }
}

/// G10 does not depend on the blocks before it, except for its data entry modes L50 and L52.
bool stands_alone(const interpreter::BlockWords& words) {
    bool sets_data = false, enters = false;
    for (const interpreter::WordValue& w : words) {
        sets_data = sets_data || (w.letter == 'G' && w.value == 10.0);
        enters = enters || (w.letter == 'L' && w.value >= 50.0);
    }
    return sets_data && !enters;
}

/// Throws an alarm of the words alone.
void refuse_words(const CheckSection& section, const interpreter::Block& block, Trial& trial,
                  const CheckOptions& options) {
    const auto words = words_for_control(*section.program, block, options);
    if (!words || words->words.count == 0) return;
    // Without a column a word is missing: it may be one that is not known.
    const auto alarm = trial.read(words->words);
    if (alarm && (words->all || alarm->where.column > 0)) throw *alarm;
    if (!words->all || !stands_alone(words->words)) return;
    if (const auto own = trial.run(words->words)) throw *own;
}

/// True when the program O`number` of the same file has nothing but M99 that ends it.
bool returns(const interpreter::ParsedProgram& program, int number) {
    bool inside = false, found = false;
    for (const interpreter::Block& block : program.blocks) {
        if (block.kind == interpreter::BlockKind::program) inside = block.o_number == number;
        if (!inside) continue;
        found = true;
        for (const Item& item : program.items(block)) {
            if (item.kind != ItemKind::word) continue;
            const auto value = interpreter::constant_value(program, item);
            const int code = value ? code10_of(*value) : 0;
            const bool ends = item.letter == 'M' && code != 990 && (code == 20 || code >= 300);
            const bool computed = !value && (item.letter == 'M' || item.letter == 'G');
            const bool calls = item.letter == 'G' && code >= 650 && code <= 661;
            if (ends || calls || computed) return false;
        }
        if (has_code(program, block, 'M', 990) && word_value(program, block, 'P')) return false;
    }
    return found;
}

/// A call that may not come back to the next block.
bool goes_away(const interpreter::ParsedProgram& program, const interpreter::Block& block,
               const CheckOptions& options) {
    const auto items = program.items(block);
    const bool calls = std::any_of(items.begin(), items.end(), [&](const Item& item) {
        if (item.kind != ItemKind::word) return false;
        const auto value = interpreter::constant_value(program, item);
        return is_call(item.letter, value ? code10_of(*value) : -1, options);
    });
    if (!calls) return false;
    int column = 1;
    const auto number = called_program(program, block, column);
    return !number || !returns(program, *number);
}

/// True when the block behind this one is not always the next one.
bool branches(const interpreter::ParsedProgram& program, const interpreter::Block& block,
              const CheckOptions& options) {
    const auto items = program.items(block);
    return leaves(program, block) || goes_away(program, block, options) ||
           std::any_of(items.begin(), items.end(), [](const Item& item) {
               return item.kind == ItemKind::go_to || item.kind == ItemKind::if_block ||
                      item.kind == ItemKind::else_ || item.kind == ItemKind::while_do ||
                      item.kind == ItemKind::end;
           });
}

}  // namespace

void read_rest(const CheckSection& section, const CarriedOut& so_far, Trial& trial,
               const CheckOptions& options, Findings& findings) {
    bool straight = !so_far.lost;  // no branch since the last block that was carried out
    for (std::size_t i = 0; i < section.blocks.size(); ++i) {
        const interpreter::Block& block = *section.blocks[i];
        const bool behind = i >= so_far.stopped_at;
        Reach reach = so_far.ended         ? Reach::never
                      : behind && straight ? Reach::certain
                                           : Reach::conditional;
        straight = straight && (!behind || !branches(*section.program, block, options));
        if (so_far.done[i]) continue;
        try {
            if (block.kind != interpreter::BlockKind::words)
                evaluate_all(*section.program, block, options, reach);
            refuse_words(section, block, trial, options);
            add_cautions(trial, section, block, findings);
        } catch (const Alarm& alarm) {
            add_alarm(alarm, section, {block, reach}, options, findings);
        }
    }
}

}  // namespace trunnion::check
