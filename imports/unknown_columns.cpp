#include "imports/unknown_columns.h"

#include "imports/column_roles.h"
#include "imports/columns.h"
#include "records/reading_columns.h"

namespace trunnion::imports {

namespace {

/// Of traces and readings, as plain_name() writes them: without units.
const std::set<std::string>& own_names() {
    static const std::set<std::string> names = [] {
        std::set<std::string> out{"seq",       "index",    "time",         "tool",  "feed",
                                  "feedmm",    "tipx",     "tipy",         "tipz",  "tooli",
                                  "toolj",     "toolk",    "length",       "truex", "truey",
                                  "truez",     "velocity", "acceleration", "value", "sigma",
                                  "extension", "spindle",  "temperature",  "load"};
        for (const records::ReadingColumn& column : records::reading_columns())
            out.insert(plain_name(std::string(column.name)));
        return out;
    }();
    return names;
}

}  // namespace

std::vector<std::string> unknown_columns(const TextTable& table, const AxisNames& axes,
                                         const std::set<std::size_t>& used) {
    std::vector<std::string> out;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        const std::string& name = table.columns()[k].name;
        const bool known = used.contains(k) || name.empty() || role_of(name, axes) ||
                           own_names().contains(plain_name(name));
        if (!known) out.push_back(name);
    }
    return out;
}

}  // namespace trunnion::imports
