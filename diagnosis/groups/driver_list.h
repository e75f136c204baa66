// Location of a gap: smooth functions of position, time, direction, mode, speed (driver_list.cpp).
#pragma once

#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::diagnosis {

/// A driver: functions of each row. Each function is multiplied by every carrier (a way in which a
/// reading can move: machine directions, table directions, an axis).
struct Driver {
    std::string by, component, text;
    std::vector<std::vector<double>> columns;  ///< by column, one entry for each row
    std::vector<std::vector<double>> walk;     ///< of a course of time: a random walk instead
    bool of_time = false;
    bool has_effect = false;  ///< whole it contains a named effect: it stands beside that alone
    bool only_where = false;  ///< says where, but stands in no model: causes describe the same
};

/// All drivers that the readings may show. `with_play`: axes whose play has a table.
std::vector<Driver> drivers_of(const emulator::Replay& replay, const records::ReadingTable& table,
                               const identification::BaseModel& base, std::vector<Axis> with_play);

}  // namespace trunnion::diagnosis
