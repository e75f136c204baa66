// Slips of whoever wrote a table: columns exchanged, a sign turned, another unit (table_slips.cpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "records/readings.h"

namespace trunnion::diagnosis {

/// One slip, and how to undo it in a row.
struct TableSlip {
    std::string words;  ///< "the columns dir_x and dir_y seem to be exchanged"
    std::function<void(records::Reading&)> undo;
    double factor = 1.0;  ///< by which undoing it multiplies the values ..
    records::Device device = records::Device::none;  ///< .. of this device
    bool of_unit = false;  ///< values or positions in another unit: a factor that no machine has
};

/// The slips that this table allows, each by itself.
std::vector<TableSlip> slips_of(const records::ReadingTable& table);

records::ReadingTable undone(const TableSlip& slip, records::ReadingTable table);

}  // namespace trunnion::diagnosis
