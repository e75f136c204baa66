// Columns of an ISO 230-2 table that are runs: "1+", "Lauf 2 vor". None is dropped silently.
#pragma once

#include <string>
#include <vector>

#include "imports/iso_values.h"
#include "imports/run_names.h"

namespace trunnion::imports {

struct RunColumn {
    std::size_t column = 0;
    RunName name;
};

/// The usual order of measurement: run 1 up, run 1 down, run 2 up ...
bool before(const RunName& a, const RunName& b);

/// "towards +, by the order of the targets".
std::string by_order(int way);
/// Direction of a pass whose name is `name`. One told above the table must not contradict it.
int way_of(const IsoSource& source, const std::string& name, int direction);

/// The columns of runs in measured order, which is that of the columns where their numbers rise;
/// empty for a list with one value a line. A note tells the
/// columns beside them that hold no readings. Throws InputError for a column of numbers beside them
/// that is not understood, and for two columns of one pass.
std::vector<RunColumn> run_columns(const IsoSource& source, std::vector<std::string>& notes);

/// A row in place of a target: true for results ("Mean", "2 s") and for a line without values,
/// false for a target. Throws InputError for a name that is neither.
class ResultRows {
  public:
    ResultRows(const IsoSource& source, const std::vector<RunColumn>& runs)
        : source_(source), runs_(runs) {}
    bool skips(std::size_t i, const std::vector<records::TableCell>& cells);
    const std::vector<std::string>& names() const { return names_; }

  private:
    bool is_run(std::size_t k) const;

    const IsoSource& source_;
    const std::vector<RunColumn>& runs_;
    std::vector<std::string> names_;
};

/// "'Mean', 'Temp'".
std::string quoted(const std::vector<std::string>& names);

}  // namespace trunnion::imports
