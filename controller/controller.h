// The emulated control: runs NC programs on its stores and drives a MotionSink. BELIEF only.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controller/clamp.h"
#include "base/alarm.h"
#include "interpreter/dialect.h"
#include "interpreter/interpreter.h"
#include "interpreter/program_source.h"
#include "motion/motion.h"
#include "offsets/stores.h"
#include "positioning/tcp_frame.h"

namespace trunnion {

/// One axis as the control knows it (parameters 1020, 1022, 1006, 1320, 1321, 1420, ...).
struct ControlAxis {
    Axis axis = Axis::X;
    bool rotary = false;
    std::optional<double> min, max;     ///< stored stroke limits, machine coordinates, mm or rad
    std::optional<double> rapid_speed;  ///< mm/s or rad/s
    std::optional<double> max_acceleration;  ///< mm/s^2 or rad/s^2
};

struct ControlConfig {
    std::vector<ControlAxis> axes;  ///< in the control's order: axis number 1 is [0]
    Dialect dialect;
    std::vector<ClampCode> clamps;
    /// #5041.. and #5061.. include the tool length (facts/control.md 2.8: assumed).
    bool work_positions_with_length = true;
    /// G89 under G98: feeds all the way out to the initial level, as the reference paths do; false:
    /// feeds to R and rapids on like G85 (Fanuc's drawing, from memory).
    bool g89_feeds_to_initial = true;
    std::vector<bool> skip_switches = std::vector<bool>(10, false);
    bool optional_stop = false;    ///< M01 stops
    std::uint64_t max_blocks = 0;  ///< 0: none
    /// Asked every few thousand blocks with their number; false: the run ends with `limit`.
    std::function<bool(std::uint64_t blocks)> go_on;
    std::int64_t clock_s = 0;  ///< #3011/#3012 and #3002 start here (seconds since 1970), so
                               ///< that same inputs give the same bytes
    TcpFrame tcp_frame = TcpFrame::start;  ///< G43.4 with the table turned
};

enum class RunStatus : unsigned char { ok, alarm, limit };

struct RunResult {
    RunStatus status = RunStatus::ok;
    std::optional<Alarm> alarm;
    std::uint64_t blocks = 0;
    std::uint64_t moves = 0;
    double time_s = 0.0;
    double path_mm = 0.0;
    AxisPositions machine;           ///< final, mm and rad
    AxisPositions work;              ///< final, in the active work frame, mm and rad
    std::vector<std::string> modal;  ///< "G00", "G17", ... one for each modal group, in group order
    bool reads_skip = false;         ///< the program asked where G31 touched (#5061..)
    std::vector<std::string> notes;  ///< unknown M codes, codes accepted without effect, ...
};

class Controller {
  public:
    /// `stores` is changed by the program (G10, system variables, #500...).
    Controller(ControlConfig config, Stores& stores, ProgramSource& programs, MotionSink& sink,
               Interpreter::Print print);
    ~Controller();

    /// Runs a program from its first block to its end, alarm or limit. Alarms do not escape.
    RunResult run(const ProgramText& program);
    RunResult run(int o_number);

    /// Macro variables, before a run (--set) or after it (--vars).
    void set_variable(int number, double value);
    double variable(int number) const;
    std::vector<int> used_common_variables() const;

    /// Machine position the axes stand at before the run (default: all zero).
    void place(const AxisPositions& machine);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trunnion
