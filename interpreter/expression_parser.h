// Parses expressions and variable references into reverse Polish code. Internal to the parser.
#pragma once

#include "interpreter/block_parser.h"
#include "interpreter/block_reader.h"
#include "interpreter/keywords.h"

namespace trunnion::interpreter {

class ExpressionParser {
  public:
    ExpressionParser(BlockReader& in, const ParseOptions& options, Code& out)
        : in_(in), options_(options), out_(out), first_op_(out.ops.size()) {}

    /// sum level, or including comparisons
    Span expression(Precedence lowest);
    /// `#n` or `#[..]` as a value: allowed in a word or GOTO besides a number.
    Span variable();
    /// `[..]`
    Span bracketed();
    /// The number of a variable after '#': constant in `number`, or code in the returned span.
    Span variable_number(int& number);

    bool round_to_increment = false;  ///< ROUND inside an NC word

  private:
    void binary(Precedence level);
    void unary();
    void primary();
    void bracket();
    void open();
    void close();
    void number();
    void function(OpCode code, std::uint16_t column);
    bool slash_bracket();
    void atan(std::uint16_t column);
    void prm(std::uint16_t column);
    void load(std::uint16_t column);
    bool reference(int& number);
    int named_variable();
    void emit(OpCode code, std::uint16_t column, int operands);

    BlockReader& in_;
    const ParseOptions& options_;
    Code& out_;
    std::size_t first_op_;
    int brackets_ = 0;  ///< open grouping brackets
    int depth_ = 0;     ///< open brackets of any kind
    int stack_ = 0;
};

}  // namespace trunnion::interpreter
