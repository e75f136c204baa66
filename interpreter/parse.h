// A whole file as plain data, without executing it: for checking, comparing and printing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "interpreter/block_parser.h"
#include "interpreter/program_source.h"

namespace trunnion::interpreter {

/// Every line of a file in order, including blank lines. Skip marks `/n` remain items; switches are
/// ignored. A program starts at a block of kind `program`; kind `end_of_record` is '%' or a folder
/// line.
struct ParsedProgram {
    ProgramText source;
    Code code;
    std::vector<Block> blocks;
    std::vector<Alarm>
        faults;           ///< lines that could not be parsed, with position and text; not in blocks
    VariableNames names;  ///< from SETVN

    std::span<const Item> items(const Block& block) const {
        return {code.items.data() + block.items.first, block.items.count};
    }
    std::span<const Op> expression(Span span) const {
        return {code.ops.data() + span.first, span.count};
    }
    std::span<const Comment> comments(const Block& block) const {
        return {code.comments.data() + block.comments.first, block.comments.count};
    }
    std::string_view text(const Comment& comment) const {
        return source.text.substr(comment.byte, comment.size);
    }
    /// The block as written, without its line end.
    std::string_view text(const Block& block) const;
    /// `<NAME>` of a block that starts a program, without the brackets.
    std::string_view name(const Block& block) const {
        return source.text.substr(block.byte + block.name.first, block.name.count);
    }
    SourceRef where(const Block& block, int column = 1) const {
        return {source.name, block.line, column};
    }
};

ParsedProgram parse_program(const ProgramText& source, const Dialect& dialect);

/// The value of a word or jump target without variables: `X10.`, `X[5+5]`; empty where variables or
/// parameters are needed, and for an expression with an alarm.
std::optional<double> constant_value(const ParsedProgram& program, const Item& item);

/// True when N, O, name, items, expressions and comments are equal; positions are ignored.
bool same_block(const ParsedProgram& a, const Block& block_a, const ParsedProgram& b,
                const Block& block_b);

}  // namespace trunnion::interpreter
