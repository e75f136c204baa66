// Executes a main program as far as it is sequential and what it needs is known.
#include <fmt/format.h>

#include "check/section.h"
#include "interpreter/known_values.h"
#include "interpreter/print_output.h"
#include "interpreter/word_rules.h"

namespace trunnion::check {

namespace {

using interpreter::Item;
using interpreter::ItemKind;
using interpreter::KnownValues;

/// What follows a block: the next one, or nothing that is known.
enum class Step { on, end, unknown };

bool is_call(char letter, int code10, const CheckOptions& options) {
    const bool own = letter == 'G' ? code10 == 650 || code10 == 660 || code10 == 661
                                   : letter == 'M' && (code10 == 980 || code10 == 1980);
    return own || (options.calls_program && options.calls_program(letter, code10));
}

/// The known words left for the control after the language has taken G67 and those of M98, M198 or
/// M99; empty when the words are arguments or belong to a called program, or may do.
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

/// The items that count with the setup's switches of block skip.
std::span<const Item> items_in_use(const interpreter::ParsedProgram& program,
                                   const interpreter::Block& block, const CheckOptions& options) {
    const auto items = program.items(block);
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].kind == ItemKind::skip && items[i].number < options.skip_switches.size() &&
            options.skip_switches[items[i].number])
            return items.first(i);
    return items;
}

/// Of a constant word or an expression. Throws Alarm.
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

/// Where an alarm has no column of its own, that of the item.
template <typename Work>
void at_column(const Item& item, Work work) {
    try {
        work();
    } catch (Alarm& alarm) {
        if (alarm.where.column == 0) alarm.where.column = item.column;
        throw;
    }
}

std::string comment_of(const interpreter::ParsedProgram& program, const interpreter::Block& block) {
    std::string_view chosen;
    for (const interpreter::Comment& comment : program.comments(block))
        if (chosen.empty() || !comment.leading) {
            chosen = program.text(comment);
            if (!comment.leading) break;
        }
    return std::string(chosen);
}

/// One main program in its order.
class SequentialRun {
  public:
    SequentialRun(const CheckSection& section, const CheckOptions& options, Trial& trial)
        : program_(*section.program),
          options_(options),
          trial_(trial),
          known_(options.dialect.has_98000, [this](int number) {
              return options_.variable_alarm ? options_.variable_alarm(number, false) : 0;
          }) {}

    /// Throws the alarm with which a run stops at this block.
    Step run(const interpreter::Block& block) {
        const auto items = items_in_use(program_, block, options_);
        const auto first = std::find_if(items.begin(), items.end(), [](const Item& item) {
            return item.kind != ItemKind::skip;
        });
        if (first == items.end()) return Step::on;
        if (block.kind != interpreter::BlockKind::words) known_.rules = trial_.rules();
        return first->kind == ItemKind::word ? words(block, items) : statements(block, items);
    }

  private:
    Step statements(const interpreter::Block& block, std::span<const Item> items) {
        bool binary = false;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const Item& item = items[i];
            switch (item.kind) {
                case ItemKind::skip:
                case ItemKind::popen:
                case ItemKind::pclos:
                case ItemKind::setvn:
                case ItemKind::dprnt:
                case ItemKind::print_text: break;
                case ItemKind::bprnt: binary = true; break;
                case ItemKind::print_value: print(item, binary); break;
                case ItemKind::assign:
                    if (assign(block, item) == Step::unknown) return Step::unknown;
                    break;
                case ItemKind::if_then:
                case ItemKind::if_goto: {
                    const auto condition = value_of(program_, item, known_);
                    if (!condition) return on_unknown_condition(item, items.subspan(i + 1));
                    if (*condition == 0.0 || interpreter::is_vacant(*condition)) return Step::on;
                    break;
                }
                default: value_of(program_, item, known_); return Step::unknown;
            }
        }
        return Step::on;
    }

    /// After IF .. THEN #n= .. the variable is unknown; a jump leads somewhere unknown.
    Step on_unknown_condition(const Item& item, std::span<const Item> rest) {
        if (item.kind != ItemKind::if_then || rest.empty()) return Step::unknown;
        const auto number = target_of(program_, rest[0], known_);
        if (!number || !known_.owns(*number)) return Step::unknown;
        at_column(rest[0], [&] { known_.set(*number, std::nullopt); });
        return Step::on;
    }

    void print(const Item& item, bool binary) {
        const auto value = value_of(program_, item, known_);
        if (value && binary)
            at_column(item, [&] { interpreter::binary_print(*value, item.digits); });
    }

    Step assign(const interpreter::Block& block, const Item& item) {
        const auto value = value_of(program_, item, known_);
        const auto number = target_of(program_, item, known_);
        if (!number) return Step::unknown;
        const bool own = known_.owns(*number);
        if (own) at_column(item, [&] { known_.set(*number, value); });
        if (!own && !value) return Step::unknown;
        if (!own)
            at_column(item, [&] {
                if (const auto alarm = trial_.assign(*number, *value, comment_of(program_, block)))
                    throw *alarm;
            });
        return Step::on;
    }

    Step words(const interpreter::Block& block, std::span<const Item> items) {
        interpreter::BlockWords words;
        words.line = block.line;
        words.byte = block.byte;
        words.sequence_number = block.sequence_number;
        bool all_known = true, ends = false, skips = false, leaves = false, from_file = false;
        for (const Item& item : items) {
            if (item.kind == ItemKind::skip) continue;
            const bool plain = item.kind == ItemKind::word && item.letter != '<' &&
                               words.count < interpreter::BlockWords::capacity;
            const auto value = value_of(program_, item, known_);
            all_known = all_known && plain && value;
            if (!plain || !value) continue;
            const int code = code10_of(interpreter::is_vacant(*value) ? -1.0 : *value);
            leaves =
                leaves || is_call(item.letter, code, options_) ||
                (item.letter == 'T' && options_.calls_program && options_.calls_program('T', 0)) ||
                (item.letter == 'M' && code == 990);
            from_file = from_file || (item.letter == 'G' && code == 100 &&
                                      word_value(program_, block, 'L') == 85.0);
            skips = skips || (item.letter == 'G' && (code == 310 || code == 370));
            ends = ends || (item.letter == 'M' && (code == 300 || code == 20));
            if (item.letter == 'G' && code == 670) continue;  // the language's own
            words.words[words.count++] = {*value, item.letter, item.decimal_point,
                                          interpreter::is_vacant(*value), item.column};
        }
        leaves = leaves || from_file;
        if (all_known && leaves) refuse_call(words);
        if (all_known && leaves && !from_file) refuse_before_leaving(words);
        if (!all_known || leaves || (ends && skips)) return Step::unknown;
        if (words.count > 0)
            if (const auto alarm = trial_.run(words)) throw *alarm;
        if (ends)
            if (const auto alarm = trial_.end()) throw *alarm;
        return ends ? Step::end : skips ? Step::unknown : Step::on;
    }

    /// The control carries out the words of its own before the program is called or left.
    void refuse_before_leaving(const interpreter::BlockWords& words) const {
        const auto own = left_for_control(words, options_);
        if (!own || own->count == 0) return;
        if (const auto alarm = trial_.run(*own)) throw *alarm;
    }

    /// Word rules and the missing program of a call whose words are known.
    void refuse_call(const interpreter::BlockWords& words) const {
        bool m98 = false, calls = false;
        std::optional<double> number;
        for (const interpreter::WordValue& w : words) {
            if (!w.vacant && w.letter == 'M' && options_.calls_program &&
                options_.calls_program('M', code10_of(w.value)))
                return;
            m98 = m98 || (w.letter == 'M' && w.value == 98.0);
            calls = calls || m98 || interpreter::is_macro_call(w);
            if (w.letter == 'P' && !w.vacant && !number) number = w.value;
        }
        if (!calls) return;
        if (const auto fault = interpreter::find_word_fault(words, options_.dialect.family, true))
            throw Alarm(fault->alarm, "", {"", 0, fault->column});
        const int o = number ? whole_of(std::round(*number)) : -1;
        if (!options_.finds_program || exists(o) || (m98 && o > 9999 && exists(o % 10000))) return;
        throw Alarm(76, "", {"", 0, 1});
    }

    bool exists(int o_number) const {
        const auto& blocks = program_.blocks;
        return options_.finds_program(o_number) ||
               std::any_of(blocks.begin(), blocks.end(), [&](const interpreter::Block& block) {
                   return block.kind == interpreter::BlockKind::program &&
                          block.o_number == o_number;
               });
    }

    const interpreter::ParsedProgram& program_;
    const CheckOptions& options_;
    Trial& trial_;
    KnownValues known_;
};

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

/// Throws an alarm that the block's expressions raise whatever the variables hold.
void evaluate_all(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                  const CheckOptions& options) {
    KnownValues known(options.dialect.has_98000, [&](int number) {
        return options.variable_alarm ? options.variable_alarm(number, false) : 0;
    });
    for (const Item& item : program.items(block)) {
        if (item.kind == ItemKind::skip || item.kind == ItemKind::print_text) continue;
        value_of(program, item, known);
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

/// After the sequential part, and in subprograms: checks of the words alone.
void read_on(const CheckSection& section, std::size_t from, Trial& trial,
             const CheckOptions& options, Findings& findings) {
    for (std::size_t i = from; i < section.blocks.size(); ++i) {
        const interpreter::Block& block = *section.blocks[i];
        try {
            if (block.kind != interpreter::BlockKind::words)
                evaluate_all(*section.program, block, options);
            const auto words = words_for_control(*section.program, block, options);
            if (!words || words->words.count == 0) continue;
            const auto alarm = trial.read(words->words);
            // Without a column a word is missing: it may be one that is not known.
            if (alarm && (words->all || alarm->where.column > 0)) throw *alarm;
        } catch (const Alarm& alarm) {
            add_alarm(alarm, section, block, options, findings);
        }
    }
}

}  // namespace

void check_trial(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    if (!options.start_trial) return;
    const auto trial = options.start_trial();
    SequentialRun sequence(section, options, *trial);
    std::size_t at = 0;
    Step step = section.subprogram ? Step::unknown : Step::on;
    while (step == Step::on && at < section.blocks.size()) {
        const interpreter::Block& block = *section.blocks[at];
        try {
            step = sequence.run(block);
            if (step != Step::unknown) ++at;
        } catch (const Alarm& alarm) {
            add_alarm(alarm, section, block, options, findings);
            step = Step::unknown;
            ++at;
        }
    }
    if (at < section.blocks.size()) return read_on(section, at, *trial, options, findings);
    if (section.subprogram || section.blocks.empty() || step != Step::on) return;
    if (const auto alarm = trial->end())
        add_alarm(*alarm, section, *section.blocks.back(), options, findings);
}

}  // namespace trunnion::check
