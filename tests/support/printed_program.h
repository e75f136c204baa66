// Programs that are printed and read again, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "interpreter/print.h"

namespace trunnion {

/// A program says the same when it is printed and read again: its first and its second print.
inline std::pair<std::string, std::string> check_print(const std::string& text,
                                                       const interpreter::Dialect& dialect) {
    const interpreter::ParsedProgram a = interpreter::parse_program({"a", text, nullptr}, dialect);
    const std::string once = interpreter::print_program(a);
    const interpreter::ParsedProgram b = interpreter::parse_program({"b", once, nullptr}, dialect);
    INFO(text);
    INFO(once);
    REQUIRE(b.faults.empty());
    REQUIRE(a.blocks.size() == b.blocks.size());
    for (std::size_t i = 0; i < a.blocks.size(); ++i)
        REQUIRE(interpreter::same_block(a, a.blocks[i], b, b.blocks[i]));
    return {once, interpreter::print_program(b)};
}

}  // namespace trunnion
