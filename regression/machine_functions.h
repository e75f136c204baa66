// Functions of a run besides moves: M and T codes, dwells, modes and stores, in order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "motion/motion.h"
#include "regression/control_snapshot.h"
#include "regression/path_record.h"
#include "regression/program_lines.h"

namespace trunnion::regression {

enum class FunctionKind : std::uint8_t {
    m_code,
    tool_call,
    dwell,
    spindle,
    coolant,
    exact_stop,
    path_mode,
    smoothing,
    override_bits,
    offset,
    store
};

/// One function at its position on the path. Plain data, written unchanged to a temporary file.
struct FunctionEvent {
    std::uint64_t key = 0;           ///< equal for the same function; excludes the duration of a
                                     ///< dwell
    double value = 0.0;              ///< code, seconds or tool, depending on `kind`
    double detail = 0.0;             ///< tool loaded by M6; which of `smoothing`, `override_bits`
                                     ///< or `offset` (OffsetKind)
    double cut_mm = 0.0;             ///< length of all cuts before it
    std::array<double, 3> tip_mm{};  ///< tip position in W
    std::uint32_t line = 0;
    std::uint16_t program = 0;
    std::uint8_t mode = 0;  ///< PositioningMode of the last move
    FunctionKind kind = FunctionKind::m_code;
    bool placed = true;  ///< false: its position between the moves of its block is unknown
};
using FunctionEvents = SpilledArray<FunctionEvent>;

/// Which offset an event of kind `offset` is about. The values of these are not in the stores, so
/// that the path does not show which one is in force; `known_length`: of a tool that the setup does
/// not know, so that the path does not show whether the offset is the right one.
enum class OffsetKind : std::uint8_t { length, known_length, radius, work };

/// Collects the functions of one run. Spindle, coolant and exact stop are states that count at the
/// next move, dwell or other function: M3 S500 in one block or in two is the same, and M8 twice is
/// M8 once. After M6, M0 and M1 nothing counts as still commanded, because a real machine then
/// stops spindle and coolant.
class FunctionRecorder {
  public:
    FunctionRecorder(FunctionEvents& events, PathRecord& path, KeyedLines& blocks)
        : events_(events), path_(path), blocks_(blocks) {}

    /// `tool_is_known`: the path shows whether the length in force is that of the tool.
    void before_move(const motion::AxisMove& move, const UnsetOffsets& unset, bool tool_is_known);
    void dwell(double duration_s);
    /// `tool`: in the spindle after the code.
    void m_code(int code, int tool, int line);
    /// Called after each block.
    void block(const ControlSnapshot& snapshot, const BlockLook& look);
    void finish();

  private:
    static constexpr int nothing_said = -99;
    struct States {
        int tool = 0, spindle = 0, coolant = 0, exact_stop = 0;
        std::uint32_t spindle_line = 0, coolant_line = 0;  ///< lines that commanded them
    };
    void tell_states();
    void tell_offsets(const UnsetOffsets& unset, bool tool_is_known);
    void tell_values(std::span<const float> now, std::span<float> told, FunctionKind kind);
    void tell(int now, int& told, FunctionKind kind, std::uint32_t line = 0);
    FunctionEvent& add(FunctionKind kind, double value, double detail = 0.0, bool placed = true);
    void write_held(std::uint32_t line, std::uint16_t program);

    FunctionEvents& events_;
    PathRecord& path_;
    KeyedLines& blocks_;
    States now_, told_;
    std::int16_t path_mode_ = 640;
    bool exact_mode_ = false;
    std::uint32_t exact_line_ = 0;  ///< of G61 or G64 that no move has told; 0: the running block
    std::array<float, 4> smoothing_{};
    std::array<float, 2> overrides_{};
    std::array<float, 4> offsets_{};  ///< told last, by OffsetKind
    std::uint8_t mode_ = 0;
    std::vector<FunctionEvent> held_;  ///< of the running block, whose line is known at its end
};

/// "M8", "dwell 0.5 s", "exact stop".
std::string text_of(const FunctionEvent& event);

}  // namespace trunnion::regression
