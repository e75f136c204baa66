#include "controller/alarms.h"

#include <fmt/format.h>

#include <algorithm>

#include "cutter/cutter_alarms.h"
#include "interpreter/alarms.h"

namespace trunnion::controller {

const std::vector<AlarmRow>& alarm_table() {
    static const std::vector<AlarmRow> all = [] {
        std::vector<AlarmRow> rows = control_alarms();
        for (const interpreter::AlarmInfo& info : interpreter::language_alarms())
            rows.push_back({info.number, "PS", info.text, info.cause, info.remedy});
        for (const cutter::CutterAlarm& row : cutter::cutter_alarms())
            rows.push_back({row.number, "PS", row.text, row.cause, row.remedy});
        std::sort(rows.begin(), rows.end(),
                  [](const AlarmRow& a, const AlarmRow& b) { return a.number < b.number; });
        return rows;
    }();
    return all;
}

const AlarmRow* find_alarm(int number) {
    const std::vector<AlarmRow>& rows = alarm_table();
    const auto it = std::lower_bound(rows.begin(), rows.end(), number,
                                     [](const AlarmRow& row, int n) { return row.number < n; });
    return it != rows.end() && it->number == number ? &*it : nullptr;
}

std::string alarm_title(int number, std::string_view text) {
    const AlarmRow* row = find_alarm(number);
    const bool own = number >= 3000 && number < 5000 && row == nullptr;
    return fmt::format("{}{:04} {}", row ? row->prefix : own ? "MC" : "PS", number, text);
}

void raise_alarm(int number, int column) {
    const AlarmRow* row = find_alarm(number);
    throw Alarm(number, row ? row->text : "ALARM", SourceRef{{}, 0, column});
}

void raise_alarm(int number, const std::string& detail, int column) {
    const AlarmRow* row = find_alarm(number);
    throw Alarm(number, std::string(row ? row->text : "ALARM") + " " + detail,
                SourceRef{{}, 0, column});
}

void refuse_option(std::string_view option, int column) {
    raise_alarm(10, fmt::format("({}: an option that is not emulated)", option), column);
}

}  // namespace trunnion::controller
