#include "imports/row_writer.h"

#include <algorithm>

#include "base/alarm.h"

namespace trunnion::imports {
namespace {

constexpr double pause_s = 60.0;  ///< between two files whose clocks both began at zero
/// Between rows of different positions that carry the same time stamp.
constexpr double shortest_s = 1e-6;

std::string file_name_of(const std::string& path) {
    return path.substr(path.find_last_of('/') + 1);
}

records::ReadingTable head_of(const setup::Setup& setup, const std::string& kind,
                              std::vector<std::string> columns) {
    records::ReadingTable head;
    head.names = setup.machine.chain.names();
    head.comment = {{"schema", "trunnion.readings/1"}, {"source", "real"}, {"import", kind}};
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        head.axes.push_back(axis.axis);
    head.optional_columns = std::move(columns);
    for (const char* more : {"session", "source"}) head.optional_columns.emplace_back(more);
    return head;
}

}  // namespace

RowWriter::RowWriter(const setup::Setup& setup, const std::string& kind,
                     std::vector<std::string> columns, bool directions, bool degrees)
    : head_(head_of(setup, kind, std::move(columns))), writer_(head_, directions, degrees) {
    text_ = writer_.head_text();
}

void RowWriter::begin_file(const std::string& path, const Facts& facts) {
    path_ = path;
    name_ = file_name_of(path_);
    session_ = facts.text("session");
    begins_ = true;
}

void RowWriter::add(records::Reading row, int line) {
    if (row.session.empty()) row.session = session_;
    const bool restarts = begins_ || row.session != last_session_;
    if (index_ == 0)
        shift_s_ = -row.time_s;
    else if (restarts && row.time_s < last_file_s_)
        shift_s_ = last_s_ + pause_s - row.time_s;
    else if (row.time_s < last_file_s_)
        throw InputError("the clock runs back", {path_, line, 1});
    begins_ = false;
    last_session_ = row.session;
    last_file_s_ = row.time_s;
    row.time_s = std::max(row.time_s + shift_s_, last_s_);
    if (index_ > 0 && row.time_s == last_s_ && row.commanded != last_at_)
        row.time_s = last_s_ + shortest_s;
    row.index = index_++;
    if (line > 0) row.source = name_ + ':' + std::to_string(line);
    last_s_ = row.time_s;
    last_at_ = row.commanded;
    writer_.append(row, text_);
}

}  // namespace trunnion::imports
