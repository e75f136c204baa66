#include "interpreter/parse.h"

#include <algorithm>
#include <bit>

#include "interpreter/known_values.h"
#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"

namespace trunnion::interpreter {
namespace {

std::uint64_t next_line(std::string_view text, std::uint64_t byte) {
    const char* const end = text.data() + text.size();
    const char* p = find_line_end(text.data() + byte, end);
    if (p != end) p = past_line_end(p, end);
    return static_cast<std::uint64_t>(p - text.data());
}

void learn_names(ParsedProgram& program, const Block& block) {
    for (const Item& item : program.items(block))
        if (item.kind == ItemKind::setvn)
            read_names(std::string_view(program.code.text).substr(item.b.first, item.b.count),
                       static_cast<int>(item.value), program.names);
}

/// The old end-of-file mark: everything after it is ignored.
bool is_control_z(const ParsedProgram& program, const Block& block) {
    const std::string_view text = program.text(block);
    const std::size_t first = text.find_first_not_of(" \t");
    return block.kind == BlockKind::end_of_record && first != text.npos && text[first] == control_z;
}

bool same_number(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_op(const Op& a, const Op& b) {
    if (a.code != b.code || a.number != b.number) return false;
    return a.code != OpCode::constant || same_number(a.value, b.value);
}

bool same_expression(const ParsedProgram& a, Span span_a, const ParsedProgram& b, Span span_b) {
    const auto x = a.expression(span_a), y = b.expression(span_b);
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), same_op);
}

/// Variables and parameters.
bool needs_a_run(const Op& op) {
    return (op.code >= OpCode::local && op.code <= OpCode::indirect) || op.code >= OpCode::prm;
}

bool has_text(const Item& item) {
    return item.kind == ItemKind::print_text || item.kind == ItemKind::setvn ||
           (item.kind == ItemKind::word && item.letter == '<');
}

bool same_item(const ParsedProgram& a, const Item& x, const ParsedProgram& b, const Item& y) {
    if (x.kind != y.kind || x.letter != y.letter || x.number != y.number || x.digits != y.digits ||
        x.decimal_point != y.decimal_point || x.negative != y.negative ||
        !same_number(x.value, y.value) || !same_expression(a, x.a, b, y.a))
        return false;
    if (!has_text(x)) return same_expression(a, x.b, b, y.b);
    return a.code.text.compare(x.b.first, x.b.count, b.code.text, y.b.first, y.b.count) == 0;
}

}  // namespace

std::string_view ParsedProgram::text(const Block& block) const {
    const std::string_view rest = source.text.substr(block.byte);
    const char* const end = find_line_end(rest.data(), rest.data() + rest.size());
    return rest.substr(0, static_cast<std::size_t>(end - rest.data()));
}

ParsedProgram parse_program(const ProgramText& source, const Dialect& dialect) {
    ParsedProgram program;
    program.source = source;
    ParseOptions options;
    options.dialect = dialect;
    options.keep_skips = true;
    options.names = &program.names;
    const std::string_view text = source.text;
    TextPlace at = start_of_text(text);
    while (at.byte < text.size()) {
        std::uint64_t end = 0;
        try {
            program.blocks.push_back(parse_block(text, at.byte, at.line, options, program.code));
            learn_names(program, program.blocks.back());
            end = program.blocks.back().end;
            if (is_control_z(program, program.blocks.back())) {
                program.blocks.pop_back();
                return program;
            }
        } catch (Alarm& fault) {
            Block lost;
            lost.byte = at.byte;
            fault.where = {source.name, at.line, fault.where.column};
            fault.block = program.text(lost);
            program.faults.push_back(fault);
            end = next_line(text, at.byte);
        }
        if (end > at.byte && is_line_end(text[end - 1])) ++at.line;
        at.byte = end;
    }
    return program;
}

std::optional<double> constant_value(const ParsedProgram& program, const Item& item) {
    if (item.a.count == 0) return item.value;
    const auto code = program.expression(item.a);
    if (std::any_of(code.begin(), code.end(), needs_a_run)) return std::nullopt;
    try {
        const auto value = KnownValues(false).value(code);
        if (!value || is_vacant(*value)) return std::nullopt;
        return item.negative ? -*value : *value;
    } catch (const Alarm&) {
        return std::nullopt;  // it has no value
    }
}

bool same_block(const ParsedProgram& a, const Block& block_a, const ParsedProgram& b,
                const Block& block_b) {
    if (block_a.kind != block_b.kind || block_a.sequence_number != block_b.sequence_number ||
        block_a.o_number != block_b.o_number || a.name(block_a) != b.name(block_b))
        return false;
    const auto items_a = a.items(block_a), items_b = b.items(block_b);
    const auto comments_a = a.comments(block_a), comments_b = b.comments(block_b);
    return std::equal(items_a.begin(), items_a.end(), items_b.begin(), items_b.end(),
                      [&](const Item& x, const Item& y) { return same_item(a, x, b, y); }) &&
           std::equal(comments_a.begin(), comments_a.end(), comments_b.begin(), comments_b.end(),
                      [&](const Comment& x, const Comment& y) { return a.text(x) == b.text(y); });
}

}  // namespace trunnion::interpreter
