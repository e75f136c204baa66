#include "records/same_readings.h"

#include <algorithm>

#include "base/alarm.h"

namespace trunnion::records {

void refuse_same_readings(const ReadingTable& first, const ReadingTable& next) {
    const auto same = [](const Reading& a, const Reading& b) {
        return a.commanded == b.commanded && a.value_mm == b.value_mm && a.device == b.device;
    };
    std::size_t values = 0;
    for (const Reading& row : next.rows) values += row.value_mm && *row.value_mm != 0.0 ? 1 : 0;
    if (values > 0 && std::search(first.rows.begin(), first.rows.end(), next.rows.begin(),
                                  next.rows.end(), same) != first.rows.end())
        throw InputError("the same readings as in " + first.path + ", given twice",
                         {next.path, 0, 0});
}

}  // namespace trunnion::records
