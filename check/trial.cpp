// Executes a main program as far as it is sequential and what it needs is known.
#include "check/trial.h"

#include <fmt/format.h>

#include "interpreter/print_output.h"
#include "interpreter/word_rules.h"

namespace trunnion::check {

namespace {

using interpreter::Item;
using interpreter::ItemKind;
using interpreter::KnownValues;

/// What follows a block: the next one, the target of a jump, or nothing that is known.
enum class Step { on, jump, end, unknown };

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
        : section_(section),
          program_(*section.program),
          options_(options),
          trial_(trial),
          known_(options.dialect.has_98000, [this](int number) {
              return options_.variable_alarm ? options_.variable_alarm(number, false) : 0;
          }) {}

    /// Where the last jump goes.
    const interpreter::Block* target() const { return target_; }

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
                case ItemKind::go_to: return go_to(item);
                default: value_of(program_, item, known_); return Step::unknown;
            }
        }
        return Step::on;
    }

    /// A number that stands once in the program; of several a run takes the next one.
    Step go_to(const Item& item) {
        const auto number = value_of(program_, item, known_);
        if (!number || !interpreter::is_whole(*number)) return Step::unknown;
        const auto found = section_.numbered.find(whole_of(*number));
        if (found == section_.numbered.end() || found->second.size() != 1) return Step::unknown;
        target_ = found->second.front();
        return Step::jump;
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
            words.words[words.count++] = {
                *value,      item.letter,      item.decimal_point, interpreter::is_vacant(*value),
                item.column, item.a.count != 0};
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

    const CheckSection& section_;
    const interpreter::ParsedProgram& program_;
    const CheckOptions& options_;
    Trial& trial_;
    KnownValues known_;
    const interpreter::Block* target_ = nullptr;
};

/// Blocks that a program with jumps may take beyond its length: a loop may have no end.
constexpr std::size_t most_more = 10'000;

std::size_t index_of(const CheckSection& section, const interpreter::Block* block) {
    return static_cast<std::size_t>(
        std::lower_bound(section.blocks.begin(), section.blocks.end(), block) -
        section.blocks.begin());
}

/// Carries out blocks as long as the next one is known.
CarriedOut run_known(const CheckSection& section, const CheckOptions& options, Trial& trial,
                     Reach reach, Findings& findings) {
    SequentialRun sequence(section, options, trial);
    CarriedOut out;
    out.done.resize(section.blocks.size());
    std::size_t& at = out.stopped_at;
    const interpreter::Block* block = nullptr;
    Step step = Step::on;
    try {
        for (std::size_t left = section.blocks.size() + most_more;
             at < section.blocks.size() && step != Step::end; --left) {
            out.lost = left == 0;
            block = section.blocks[at];
            if (!out.lost) step = sequence.run(*block);
            if (out.lost || step == Step::unknown) return out;
            add_cautions(trial, section, *block, findings);
            out.done[at] = true;
            at = step == Step::jump ? index_of(section, sequence.target()) : at + 1;
        }
        out.ended = true;
        if (step == Step::end || !block) return out;
        if (const auto alarm = trial.end()) throw *alarm;
    } catch (const Alarm& alarm) {
        add_cautions(trial, section, *block, findings);
        add_alarm(alarm, section, {*block, reach}, options, findings);
        if (out.ended) return out;
        out.done[at] = true;
        ++at;
    }
    return out;
}

}  // namespace

void check_trial(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    if (!options.start_trial) return;
    const auto trial = options.start_trial();
    CarriedOut so_far{std::vector<bool>(section.blocks.size()), 0, false, false};
    if (!section.subprogram) so_far = run_known(section, options, *trial, Reach::certain, findings);
    read_rest(section, so_far, *trial, options, findings);
    if (!section.subprogram || !section.may_start) return;
    const auto started = options.start_trial();
    run_known(section, options, *started, Reach::as_main, findings);
}

}  // namespace trunnion::check
