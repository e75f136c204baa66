#include "imports/row_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "imports/times.h"
#include "records/table_line.h"
#include "setup/declared.h"

namespace trunnion::imports {
namespace {

constexpr double pause_s = 60.0;          ///< between two files whose clocks both started at zero
constexpr double night_s = 4.0 * 3600.0;  ///< a longer pause starts a new session
/// Time between rows with different positions but equal time stamps.
constexpr double shortest_s = 1e-6;

/// An impossible number is caused by wrong columns or units; a table with it would not be readable.
void refuse_huge(const records::Reading& row, const SourceRef& place) {
    bool huge = false;
    for (const double v :
         {row.time_s, row.feed_mm_min, row.temperature_c, row.load_kg, row.extension_mm,
          row.value_mm.value_or(0.0), row.velocity_mm_s.value_or(0.0), row.sigma_mm.value_or(0.0),
          row.acceleration_mm_s2.value_or(0.0)})
        huge = huge || std::abs(v) > largest_number;
    if (row.point_W_mm) huge = huge || row.point_W_mm->cwiseAbs().maxCoeff() > largest_number;
    for (const double q : row.commanded.value) huge = huge || std::abs(q) > largest_number;
    if (huge) throw InputError(beyond_largest, place);
}

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
    const bool named = std::find(columns.begin(), columns.end(), "instrument") != columns.end();
    if (!setup.instruments.empty() && !named) columns.emplace_back("instrument");
    head.optional_columns = std::move(columns);
    for (const char* more : {"session", "source"}) head.optional_columns.emplace_back(more);
    return head;
}

}  // namespace

RowWriter::RowWriter(const setup::Setup& setup, const std::string& kind,
                     std::vector<std::string> columns, bool directions, bool degrees)
    : setup_(setup),
      head_(head_of(setup, kind, std::move(columns))),
      writer_(head_, directions, degrees) {
    text_ = writer_.head_text();
}

void RowWriter::keep_axes(const std::vector<Axis>& axes) {
    std::erase_if(head_.axes, [&](Axis axis) {
        return std::find(axes.begin(), axes.end(), axis) == axes.end();
    });
    text_ = writer_.head_text();
}

void RowWriter::begin_file(const std::string& path, const Facts& facts) {
    path_ = path;
    name_ = file_name_of(path_);
    session_ = facts.text("session");
    if (session_ == "each") session_ = session_of(path);
    instrument_ = instrument_of(facts);
    begins_ = true;
    dated_ = false;
}

/// A remark above a table may name an instrument that the setup does not have.
std::string RowWriter::instrument_of(const Facts& facts) const {
    const std::string name = facts.text("instrument");
    if (setup_.find_instrument(name)) return name;
    if (facts.is_told("instrument"))
        throw InputError("the setup has no [[instrument]] named '" + name + "'", {setup_.path});
    return "";
}

/// The name of the file without its ending; of a second file with that name another one.
std::string RowWriter::session_of(const std::string& path) {
    const auto known = sessions_.find(path);
    if (known != sessions_.end()) return known->second;
    const std::string file = file_name_of(path), stem = file.substr(0, file.find_last_of('.'));
    std::string name = stem;
    const auto is_taken = [&] {
        return std::any_of(sessions_.begin(), sessions_.end(),
                           [&](const auto& one) { return one.second == name; });
    };
    for (int k = 2; is_taken(); ++k) name = fmt::format("{}_{}", stem, k);
    return sessions_.emplace(path, std::move(name)).first->second;
}

std::string RowWriter::day_of_row(double time_s) {
    if (day_.empty() || std::abs(time_s - day_s_) > night_s) {
        const std::string day = day_of(time_s);
        day_ = day_.starts_with(day) ? day_ + "_later" : day;
    }
    day_s_ = time_s;
    return day_;
}

void RowWriter::invent_times() {
    const std::string line = fmt::format("# {} = {}\n", records::times_key, records::invented);
    if (text_.find(line) == std::string::npos) text_.insert(0, line);
}

void RowWriter::declare(const std::string& part) {
    const bool readable = std::all_of(part.begin(), part.end(), [](char c) {
        return c != '=' && static_cast<unsigned char>(c) >= ' ';
    });
    if (!readable || !declared_.insert(part).second) return;
    const auto digests = setup::declared_digests(setup_);
    if (const auto own = digests.find(part); own != digests.end())
        text_.insert(0, fmt::format("# {}{} = {}\n", records::declared_key, part, own->second));
}

void RowWriter::add_column(const std::string& name) {
    text_.insert(text_.size() - 1, ',' + name);
    has_column_ = true;
}

void RowWriter::add(records::Reading row, int line, const std::string& more) {
    if (row.session.empty()) row.session = session_;
    if (row.instrument.empty()) row.instrument = instrument_;
    if (row.session.empty() && dated_) row.session = day_of_row(row.time_s);
    const bool restarts = begins_ || row.session != last_session_;
    if (index_ == 0)
        shift_s_ = -row.time_s;
    else if (restarts && row.time_s < last_file_s_)
        shift_s_ = last_s_ + pause_s - row.time_s;
    else if (row.time_s < last_file_s_)
        throw InputError("times are not in ascending order", {path_, line, 1});
    begins_ = false;
    last_session_ = row.session;
    last_file_s_ = row.time_s;
    row.time_s = std::max(row.time_s + shift_s_, last_s_);
    if (index_ > 0 && row.time_s == last_s_ && row.commanded != last_at_)
        row.time_s = last_s_ + shortest_s;
    refuse_huge(row, {path_, line, 1});
    row.index = index_++;
    if (line > 0) row.source = name_ + ':' + std::to_string(line);
    last_s_ = row.time_s;
    last_at_ = row.commanded;
    writer_.append(row, text_);
    if (has_column_) text_.insert(text_.size() - 1, ',' + records::cell_text(more));
}

}  // namespace trunnion::imports
