// The active states of a control as plain values, used to explain differences.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace trunnion::controller {
struct Control;
}  // namespace trunnion::controller

namespace trunnion::regression {

/// The state after a block. Set in control_snapshot.cpp only, to be independent of the controller's
/// structure.
struct ControlSnapshot {
    std::array<std::int16_t, 24> modal10{};        ///< code * 10 by modal group
    std::int16_t work_number = 0;                  ///< P of G54.1
    std::int16_t fixture_number = 0;               ///< P of G54.2
    std::int16_t length_number = 0;                ///< H
    std::int16_t radius_number = 0;                ///< D
    std::int32_t tool_selected = 0;                ///< T
    std::int32_t tool = 0;                         ///< in the spindle
    std::int32_t spindle_direction = 0;            ///< +1 M3, -1 M4, 0 M5
    std::int32_t coolant = 0;                      ///< 0, 1
    float feed = 0.0F;                             ///< F as written
    float speed = 0.0F;                            ///< S as written
    float radius_mm = 0.0F;                        ///< of D while G41 or G42 is active
    std::array<float, 3> length_mm{};              ///< tool length vector
    std::array<float, 3> origin_mm{};              ///< origin of the work frame, machine
                                                   ///< coordinates
    std::array<float, 3> origin_deg{};             ///< the same of A B C
    std::array<float, 3> local_mm{};               ///< G52
    std::array<float, 3> preset_mm{};              ///< G92
    std::array<float, 9> feature{};                ///< rotation of the tilted plane
    std::array<float, 3> scale{1.0F, 1.0F, 1.0F};  ///< G51 times G51.1
    float rotation_deg = 0.0F;                     ///< G68
    std::array<float, 4> smoothing{};              ///< values of G5.1 Q, G5.1 R, G5 P, G8 P
    std::array<float, 2> overrides{};              ///< #3003, #3004: what the operator may not stop
    friend bool operator==(const ControlSnapshot&, const ControlSnapshot&) = default;
};

/// Actions of a block besides moves, and axis positions; not part of the active state.
struct BlockLook {
    int line = 0;
    const std::string* program = nullptr;
    std::uint64_t store_key = 0;                ///< of the words of a G10 block; 0: none
    std::array<double, 3> rotary_deg{};         ///< A B C, machine positions
    bool bare_words_meet_no_parameter = false;  ///< numbers without point while 3401 is not given
};

/// Offsets in force whose values the stores do not have: the path does not tell one from another.
struct UnsetOffsets {
    std::int32_t length = 0;     ///< H of G43, G44, with or without a value; 0: none
    bool length_is_set = false;  ///< not 0, or a 0 that the setup states
    std::int32_t radius = 0;     ///< D, negative under G42; 0: none, or its radius is set
    std::int32_t work = 0;       ///< 54 .. 59, 100 + P of G54.1; 0: its values are not all 0
};
UnsetOffsets unset_offsets(const controller::Control& control);

/// Updates `snapshot` (`smoothing` is kept from block to block).
BlockLook look_at(const controller::Control& control, ControlSnapshot& snapshot);
int tool_in_spindle(const controller::Control& control);
/// Line of the running block.
int running_line(const controller::Control& control);
/// True when G93 is active for the present move.
bool feeds_by_inverse_time(const controller::Control& control);

/// The differences that a field can explain.
enum Explains : unsigned {
    explains_path = 1,
    explains_feed = 2,
    explains_speed = 4,
    explains_coolant = 8,
    explains_tool = 16
};

/// One part of the active state, for comparison and as text.
struct SnapshotField {
    const char* name;
    unsigned explains;
    std::array<double, 3> (*value)(const ControlSnapshot&);
    std::string (*text)(const ControlSnapshot&);  ///< "G54.1 P1", "H2"
};
std::span<const SnapshotField> snapshot_fields();

}  // namespace trunnion::regression
