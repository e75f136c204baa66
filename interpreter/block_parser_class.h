// Parser of one block. Words and programs are in block_parser.cpp, macro statements in
// statement_parser.cpp.
#pragma once

#include "interpreter/block_parser.h"
#include "interpreter/block_reader.h"
#include "interpreter/expression_parser.h"

namespace trunnion::interpreter {

class BlockParser {
  public:
    BlockParser(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
                Code& out)
        : in_(text, byte, options.dialect.comment_nesting, out),
          expressions_(in_, options, out),
          options_(options),
          out_(out),
          text_(text) {
        block_.byte = byte;
        block_.line = line;
        block_.items.first = static_cast<std::uint32_t>(out.items.size());
        block_.comments.first = static_cast<std::uint32_t>(out.comments.size());
    }

    Block run();

  private:
    bool start();
    bool is_hurco_end(char c) const;
    bool item(char c);
    void finish();
    void program_number(char c);
    void program_name();
    void called_name();
    std::string_view name();
    void number_word();
    bool skip();
    void comma_word();
    void word(char letter);
    void word_value(Item& item);
    void assignment();
    void refuse_comparison();
    void statement(Keyword keyword, std::uint16_t column);
    void if_statement(std::uint16_t column);
    void after_then();
    bool end_if(std::uint16_t column);
    void while_statement(std::uint16_t column);
    std::uint8_t loop_number();
    void jump(std::uint16_t column);
    void print_statement(ItemKind kind, std::uint16_t column);
    void print_value(bool binary);
    void print_text();
    void setvn(std::uint16_t column);
    void semicolon();
    Item& add(ItemKind kind, std::uint16_t column);
    void end_at(const char* p) { block_.end = static_cast<std::uint64_t>(p - text_.data()); }

    BlockReader in_;
    ExpressionParser expressions_;
    const ParseOptions& options_;
    Code& out_;
    std::string_view text_;
    Block block_;
    bool words_ = false, statements_ = false, computed_ = false;
    bool closed_ = false;      ///< a jump or loop statement was read; nothing may follow
    bool macro_call_ = false;  ///< G65, G66: ROUND in an argument gives an integer
    bool program_ = false;
};

}  // namespace trunnion::interpreter
