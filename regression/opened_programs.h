// Programs read by a run: a source that records all requests.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/dialect.h"
#include "interpreter/program_source.h"
#include "setup/setup.h"

namespace trunnion::regression {

/// A requested program, by number or name, and what was found (empty: nothing).
struct OpenedProgram {
    std::string asked;
    std::optional<interpreter::ProgramText> found;
};

/// Forwards to another source and keeps each program at its first request. The main program and
/// these, in this order, determine a run.
class RememberingSource : public interpreter::ProgramSource {
  public:
    RememberingSource(interpreter::ProgramSource& source, std::vector<OpenedProgram>& opened)
        : source_(source), opened_(opened) {}
    std::optional<interpreter::ProgramText> find(int o_number) override;
    std::optional<interpreter::ProgramText> find(std::string_view name) override;

  private:
    std::optional<interpreter::ProgramText> keep(std::string asked,
                                                 std::optional<interpreter::ProgramText> found);

    interpreter::ProgramSource& source_;
    std::vector<OpenedProgram>& opened_;
    std::set<std::string> known_;
};

/// True when G, M or T codes call programs by parameters 6050-6089, 6001#5.
bool codes_call(const setup::Setup& setup);

/// False when no block of the text can call another program: no M98, M198, G65, G66, no computed G
/// or M, and no codes that call by parameter. True in doubt.
bool may_call(std::string_view text, const setup::Setup& setup);

}  // namespace trunnion::regression
