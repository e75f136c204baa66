// Words not accepted by the control, and variables that it does not have.
#include <fmt/format.h>

#include <array>

#include "check/section.h"
#include "interpreter/arguments.h"
#include "interpreter/memory.h"
#include "interpreter/word_rules.h"

namespace trunnion::check {

namespace {

constexpr int too_many_words = 1090;

std::string alarm_text(const CheckOptions& options, int number) {
    return options.alarm_text ? options.alarm_text(number) : fmt::format("alarm {}", number);
}

/// What the control says of the arguments in a block that begins with G65, G66 or G66.1.
std::optional<interpreter::WordFault> argument_fault(const interpreter::BlockWords& words) {
    std::array<interpreter::WordValue, interpreter::BlockWords::capacity> arguments;
    std::size_t count = 0;
    std::string own = "GPL<";  // of the call itself, one each
    for (const interpreter::WordValue& w : words) {
        const std::size_t at = own.find(w.letter);
        if (at == own.npos)
            arguments[count++] = w;
        else
            own.erase(at, 1);
    }
    interpreter::Locals locals;
    try {
        interpreter::pass_arguments(arguments.data(), arguments.data() + count, {}, locals);
    } catch (const Alarm& alarm) {
        return interpreter::WordFault{alarm.number, alarm.where.column, {}};
    }
    return std::nullopt;
}

void check_block_words(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                       const CheckOptions& options, Findings& findings) {
    const auto constants = constant_words(program, block);
    if (!constants)
        return findings.add("word", Severity::error, {block, 1},
                            alarm_text(options, too_many_words) + ": too many words in a block",
                            "Split the block.");
    bool mapped = false;
    if (options.calls_program)
        for (const interpreter::WordValue& w : constants->words)
            mapped = mapped || (!w.vacant && (w.letter == 'G' || w.letter == 'M') &&
                                options.calls_program(w.letter, code10_of(w.value)));
    if (mapped) return;  // the words are arguments
    auto fault =
        interpreter::find_word_fault(constants->words, options.dialect.family, constants->all);
    if (!fault && constants->words.count > 0 &&
        interpreter::is_macro_call(constants->words.words[0]))
        fault = argument_fault(constants->words);
    if (fault)
        findings.add(
            "word", Severity::error, {block, fault->column},
            alarm_text(options, fault->alarm) + (fault->detail.empty() ? "" : " " + fault->detail),
            "Correct the word.");
}

/// A dwell of `P10.` is 10 s on a Haas or LinuxCNC; a Fanuc takes no point there.
void check_dwell(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                 const CheckOptions& options, Findings& findings) {
    if (options.dialect.family != interpreter::DialectFamily::fanuc ||
        !has_code(program, block, 'G', 40) || findings.has_error(block.line))
        return;
    for (const interpreter::Item& item : program.items(block))
        if (item.kind == interpreter::ItemKind::word && item.letter == 'P' && item.decimal_point &&
            item.a.count == 0)
            findings.add("dwell-point", Severity::warning, {block, item.column},
                         fmt::format("G4 P{:g}. is {:g} ms here: a Fanuc takes P without a decimal "
                                     "point, other controls read seconds",
                                     item.value, item.value),
                         "Write milliseconds without a point, or seconds as X.");
}

void check_group(int number, BlockPlace place, const CheckOptions& options, Findings& findings) {
    if (options.work_offset_is_group_12 || (number != 4012 && number != 4212 && number != 4412))
        return;
    findings.add(
        "modal-group", Severity::warning, place,
        fmt::format("#{} reads G66 or G67 here; on some controls it is the work offset", number),
        "For G54-G59 read the number 2 higher, or set [control] work_offset_is_group_12.");
}

/// Alarms 115 and 116 of a variable number.
int variable_alarm(int number, bool writes, const CheckOptions& options) {
    if (number == 0) return writes ? 116 : 0;
    if (number <= interpreter::local_count ||
        interpreter::common_slot(number, options.dialect.has_98000) >= 0)
        return 0;
    if (number < 1000) return 115;
    return options.variable_alarm ? options.variable_alarm(number, writes) : 0;
}

void check_variable(int number, bool writes, BlockPlace place, const CheckOptions& options,
                    Findings& findings) {
    const int alarm = variable_alarm(number, writes, options);
    if (alarm == 0) return;
    const std::string text = alarm_text(options, alarm) + ": *";
    findings.add("variable", place, {text, text, "#", number},
                 alarm == 116    ? "Write to another variable."
                 : number < 1000 ? "Use a variable of this control."
                                 : "Use a variable of this control, or declare the range in "
                                   "[control.builder] of the setup.");
}

void check_variables(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                     const CheckOptions& options, Findings& findings) {
    for (const interpreter::Item& item : program.items(block)) {
        for (const interpreter::Span span : {item.a, item.b}) {
            if (item.letter == '<') continue;
            if (item.kind == interpreter::ItemKind::print_text ||
                item.kind == interpreter::ItemKind::setvn)
                continue;
            for (const interpreter::Op& op : program.expression(span))
                if (op.code == interpreter::OpCode::system) {
                    check_variable(op.number, false, {block, op.column}, options, findings);
                    check_group(op.number, {block, op.column}, options, findings);
                }
        }
        if (item.kind == interpreter::ItemKind::assign && item.b.count == 0)
            check_variable(whole_of(item.value), true, {block, item.column}, options, findings);
    }
}

}  // namespace

std::optional<ConstantWords> constant_words(const interpreter::ParsedProgram& program,
                                            const interpreter::Block& block) {
    ConstantWords out;
    out.words.line = block.line;
    out.words.byte = block.byte;
    out.words.sequence_number = block.sequence_number;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word) continue;
        const std::optional<double> value = item.letter == '<'
                                                ? std::optional<double>(0.0)
                                                : interpreter::constant_value(program, item);
        out.all = out.all && value;
        if (out.words.count == interpreter::BlockWords::capacity) return std::nullopt;
        interpreter::WordValue& word = out.words.words[out.words.count++];
        word.letter = item.letter;
        word.value = value.value_or(0.0);
        word.vacant = !value;
        word.decimal_point = item.decimal_point;
        word.column = item.column;
        word.computed = item.a.count != 0;
    }
    return out;
}

void check_words(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    for (const interpreter::Block* block : section.blocks) {
        check_block_words(*section.program, *block, options, findings);
        check_dwell(*section.program, *block, options, findings);
        if (block->kind == interpreter::BlockKind::computed ||
            block->kind == interpreter::BlockKind::statements ||
            block->kind == interpreter::BlockKind::program)
            check_variables(*section.program, *block, options, findings);
    }
}

}  // namespace trunnion::check
