// What all repeats of the present readings have in common, and those on other lines.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/advice/measurements.h"

namespace trunnion::diagnosis {

/// What all repeats start from.
struct Again {
    const setup::Setup& setup;
    records::ReadingTable table;
    double start_s;
};

bool reads(const records::ReadingTable& table, records::Device device);
bool logs_axes(const records::ReadingTable& table);
/// "the lines", "the points": what is read again.
std::string readings_of(const records::ReadingTable& table);
/// The axes that move in the rows of each test.
std::map<std::string, std::vector<Axis>> moving_axes(const records::ReadingTable& table);
/// The measurement of these rows, from `start_s` on.
Measurement repeat_of(const Again& again, std::string name, std::string text,
                      records::ReadingTable table);

/// Lines beside those of the present readings, one for each axis that rests; and all of them,
/// because an angle about one axis and one about another may look alike on a single line.
void add_parallel_lines(const Again& again, std::vector<Measurement>& list);
/// A line of the laser along each axis that was not measured so.
void add_other_axes(const Again& again, std::vector<Measurement>& list);

}  // namespace trunnion::diagnosis
