// The separate stores that contain all beliefs of the control about machine and workpiece.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/axes.h"

namespace trunnion::offsets {

/// An offset vector by axis letter in the units of the control: mm and deg, as typed.
struct OffsetVector {
    std::array<double, axis_count> value{};
    double& operator[](Axis axis) { return value[index_of(axis)]; }
    double operator[](Axis axis) const { return value[index_of(axis)]; }
    friend bool operator==(const OffsetVector&, const OffsetVector&) = default;
};

/// External offset, G54-G59 and G54.1 P1-P300, in machine coordinates; and the shifts that an
/// earlier program left in force.
struct WorkOffsets {
    OffsetVector external;
    OffsetVector local;                        ///< G52 in force when a program begins
    OffsetVector preset;                       ///< G92 in force when a program begins
    std::array<OffsetVector, 6> standard;      ///< [0] = G54
    std::array<OffsetVector, 300> additional;  ///< [0] = G54.1 P1
};

/// G54.2 Pn: a fixture offset measured at reference angles. The control rotates it with the table.
struct FixtureOffset {
    OffsetVector offset;            ///< mm along the linear axes
    OffsetVector reference_angles;  ///< deg of the rotary axes
};
struct FixtureOffsets {
    std::array<FixtureOffset, 8> set;  ///< [0] = P1
};

/// Tool offset memory C: geometry and wear of length and radius. Offset number 0 means no offset.
struct ToolOffset {
    double length_geometry_mm = 0.0;
    double length_wear_mm = 0.0;
    double radius_geometry_mm = 0.0;
    double radius_wear_mm = 0.0;
    bool length_given = false, radius_given = false;  ///< also when the value given is 0
    double length_mm() const { return length_geometry_mm + length_wear_mm; }
    double radius_mm() const { return radius_geometry_mm + radius_wear_mm; }
};
struct ToolOffsets {
    std::vector<ToolOffset> tool = std::vector<ToolOffset>(1000);  ///< [n] = offset number n
};

/// One CNC parameter: a number or eight bits. `by_axis` holds the values of an axis parameter.
struct Parameter {
    double value = 0.0;             ///< bit parameters: the byte as a number
    std::map<int, double> by_axis;  ///< axis number (1 X, 2 Y, 3 Z, ...) -> value
};

/// CNC parameters by number, including 19680-19749. Absent parameters read as the control's
/// default.
struct Parameters {
    std::map<int, Parameter> entry;

    std::optional<double> find(int number) const;
    double get(int number, double otherwise = 0.0) const;
    bool bit(int number, int index) const;
    void set(int number, double value);
    void set_bit(int number, int index, bool on);
};

/// All beliefs of the control. Copyable; independent of the physical machine.
struct Stores {
    WorkOffsets work;
    FixtureOffsets fixture;
    ToolOffsets tools;
    Parameters parameters;
    std::map<int, double> signals;    ///< #1000-#1035 inputs, #1100-#1135 outputs, initial values
                                      ///< from the setup
    std::map<int, double> variables;  ///< #500-#999, kept between runs
};

}  // namespace trunnion::offsets
