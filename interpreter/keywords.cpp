#include "interpreter/keywords.h"

#include <cstddef>

#include "interpreter/lexical.h"

namespace trunnion::interpreter {
namespace {

struct StatementRow {
    const char* word;
    Keyword keyword;
};
constexpr StatementRow statements[] = {
    {"IF", Keyword::if_},      {"WHILE", Keyword::while_}, {"DO", Keyword::do_},
    {"END", Keyword::end},     {"GOTO", Keyword::go_to},   {"THEN", Keyword::then},
    {"POPEN", Keyword::popen}, {"PCLOS", Keyword::pclos},  {"DPRNT", Keyword::dprnt},
    {"BPRNT", Keyword::bprnt}, {"SETVN", Keyword::setvn},  {"ELSE", Keyword::else_},
};

struct FunctionRow {
    const char* word;
    OpCode code;
};
constexpr FunctionRow functions[] = {
    {"SIN", OpCode::sin},   {"COS", OpCode::cos},     {"TAN", OpCode::tan},
    {"ASIN", OpCode::asin}, {"ACOS", OpCode::acos},   {"ATAN", OpCode::atan},
    {"SQRT", OpCode::sqrt}, {"ABS", OpCode::abs},     {"BIN", OpCode::bin},
    {"BCD", OpCode::bcd},   {"ROUND", OpCode::round}, {"FIX", OpCode::fix},
    {"FUP", OpCode::fup},   {"LN", OpCode::ln},       {"EXP", OpCode::exp},
    {"POW", OpCode::pow},   {"ADP", OpCode::adp},     {"PRM", OpCode::prm},
};

/// Fanuc's precedence: * / MOD AND before + - OR XOR before comparisons (docs/control.md).
struct OperatorRow {
    const char* word;
    OpCode code;
    Precedence precedence;
};
constexpr OperatorRow operators[] = {
    {"+", OpCode::add, Precedence::sum},
    {"-", OpCode::subtract, Precedence::sum},
    {"*", OpCode::multiply, Precedence::product},
    {"/", OpCode::divide, Precedence::product},
    {"MOD", OpCode::modulo, Precedence::product},
    {"AND", OpCode::bit_and, Precedence::product},
    {"OR", OpCode::bit_or, Precedence::sum},
    {"XOR", OpCode::bit_xor, Precedence::sum},
    {"EQ", OpCode::equal, Precedence::comparison},
    {"NE", OpCode::not_equal, Precedence::comparison},
    {"GT", OpCode::greater, Precedence::comparison},
    {"GE", OpCode::greater_equal, Precedence::comparison},
    {"LT", OpCode::less, Precedence::comparison},
    {"LE", OpCode::less_equal, Precedence::comparison},
};

/// Number of letters of `word` at `p`: 0 unless at least two match (or all of a one-letter word).
std::size_t matched(const char* word, const char* p, const char* end) {
    std::size_t n = 0;
    while (word[n] != 0 && p + n != end && upper(p[n]) == word[n]) ++n;
    return n >= 2 || (word[n] == 0 && n == 1) ? n : 0;
}

}  // namespace

Keyword read_keyword(const char*& p, const char* end) {
    for (const StatementRow& row : statements) {
        const std::size_t n = matched(row.word, p, end);
        if (n == 0) continue;
        p += n;
        return row.keyword;
    }
    return Keyword::none;
}

bool read_function(const char*& p, const char* end, OpCode& function) {
    for (const FunctionRow& row : functions) {
        const std::size_t n = matched(row.word, p, end);
        if (n == 0) continue;
        p += n;
        function = row.code;
        return true;
    }
    return false;
}

Precedence read_operator(const char*& p, const char* end, OpCode& op) {
    for (const OperatorRow& row : operators) {
        const std::size_t n = matched(row.word, p, end);
        if (n == 0) continue;
        p += n;
        op = row.code;
        return row.precedence;
    }
    return Precedence::none;
}

const char* spelling(OpCode code) {
    for (const OperatorRow& row : operators)
        if (row.code == code) return row.word;
    for (const FunctionRow& row : functions)
        if (row.code == code) return row.word;
    if (code == OpCode::round_increment) return "ROUND";
    return nullptr;
}

Precedence precedence(OpCode code) {
    for (const OperatorRow& row : operators)
        if (row.code == code) return row.precedence;
    return Precedence::none;
}

}  // namespace trunnion::interpreter
