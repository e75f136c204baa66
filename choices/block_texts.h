// Text of a block, from the programs of a run.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "choices/control_path.h"
#include "interpreter/program_source.h"

namespace trunnion::choices {

/// Refers to the programs, which must outlive it.
class BlockTexts {
  public:
    BlockTexts(const interpreter::ProgramText& main,
               const std::vector<interpreter::ProgramText>& all)
        : main_(main), all_(all) {}
    std::string block(const PathBlock& block) const {
        for (const interpreter::ProgramText& text : all_)
            if (text.name == block.program) return line_of(text.text, block.line);
        return line_of(main_.text, block.line);
    }

  private:
    static std::string line_of(std::string_view text, int line) {
        for (int k = 1; k < line && !text.empty(); ++k)
            text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
        std::string out(text.substr(0, text.find_first_of("\r\n")));
        return out;
    }
    const interpreter::ProgramText& main_;
    const std::vector<interpreter::ProgramText>& all_;
};

}  // namespace trunnion::choices
