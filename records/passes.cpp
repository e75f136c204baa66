#include "records/passes.h"

#include <map>
#include <string_view>

namespace trunnion::records {
namespace {

/// True when the next rows (`step` 1) or the last ones (-1) are of the same test, at two times or
/// more.
bool goes_on(std::span<const Reading> rows, std::size_t k, std::size_t step) {
    for (std::size_t i = k + step; i < rows.size() && rows[i].test == rows[k].test; i += step)
        if (rows[i].time_s != rows[k].time_s) return true;
    return false;
}

/// True when a test ended at row `from` and is repeated from row `to` on: another test ran in
/// between. Rows of logs that were taken at the same time alternate, one time each.
bool repeated(std::span<const Reading> rows, std::size_t from, std::size_t to) {
    constexpr std::size_t back = static_cast<std::size_t>(-1);
    if (to - from < 3 || !(goes_on(rows, from, back) || goes_on(rows, to, 1))) return false;
    for (std::size_t i = from + 1; i < to; ++i)
        if (goes_on(rows, i, 1)) return true;
    return false;
}

}  // namespace

std::size_t session_end(const std::vector<Reading>& rows, std::size_t begin) {
    std::size_t end = begin;
    while (end < rows.size() && rows[end].part == rows[begin].part &&
           rows[end].session == rows[begin].session)
        ++end;
    return end;
}

std::vector<PassRows> passes_of(std::span<const Reading> rows) {
    std::vector<PassRows> passes;
    std::map<std::string_view, std::size_t> last;  // pass of each test
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto [found, first] = last.try_emplace(rows[k].test, passes.size());
        if (!first && repeated(rows, passes[found->second].back(), k))
            found->second = passes.size();
        if (found->second == passes.size()) passes.emplace_back();
        passes[found->second].push_back(k);
    }
    return passes;
}

std::vector<PassRows> passes_of(const ReadingTable& table) {
    std::vector<PassRows> all;
    const std::span<const Reading> rows(table.rows);
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
        end = session_end(table.rows, begin);
        for (PassRows& pass : passes_of(rows.subspan(begin, end - begin))) {
            for (std::size_t& row : pass) row += begin;
            all.push_back(std::move(pass));
        }
    }
    return all;
}

}  // namespace trunnion::records
