// Configuration of a control: axes, dialect, clamps, switches and options.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "controller/builder_profile.h"
#include "controller/clamp.h"
#include "controller/hurco_choices.h"
#include "controller/variable_rounding.h"
#include "geometry/axes.h"
#include "interpreter/dialect.h"
#include "positioning/tcp_frame.h"

namespace trunnion::controller {

/// One axis as the control knows it (parameters 1020, 1022, 1006, 1320, 1321, 1420, ...).
struct ControlAxis {
    Axis axis = Axis::X;
    bool rotary = false;
    std::optional<double> min, max;     ///< stored stroke limits, machine coordinates, mm or rad
    std::optional<double> rapid_speed;  ///< mm/s or rad/s
    std::optional<double> max_acceleration;  ///< mm/s^2 or rad/s^2
    bool auxiliary = false;                  ///< moves neither work nor tool
};

struct ControlConfig {
    std::vector<ControlAxis> axes;  ///< in the order of the control: [0] is axis number 1
    interpreter::Dialect dialect;
    std::vector<ClampCode> clamps;
    /// #5041.. and #5061.. include the tool length (assumed: docs/control.md, own choices).
    bool work_positions_with_length = true;
    /// #4012 reads G54-G59 and #4014 G66 G67, as on a control that numbers these groups so.
    bool work_offset_is_group_12 = false;
    /// G89 under G98: feeds all the way out to the initial level, as in the reference paths. False:
    /// feeds to R, then rapid, like G85 (Fanuc's drawing, from memory).
    bool g89_feeds_to_initial = true;
    /// G53 under G91: moves by its words as if G53 were not there. False: the block does not move.
    bool g53_under_g91_moves = false;
    /// Rapids without interpolation, each axis at its own speed (1401#1 LRP = 0), of a Fanuc.
    bool rapids_are_doglegs = false;
    VariableRounding variable_rounding = VariableRounding::none;
    std::vector<bool> skip_switches = std::vector<bool>(10, false);
    bool threading = false;  ///< option G33
    BuilderProfile builder;
    HurcoChoices hurco;
    bool optional_stop = false;    ///< M01 stops
    std::uint64_t max_blocks = 0;  ///< 0: no limit
    /// Called every few thousand blocks with the number of blocks; when it returns false the run
    /// ends with `limit`.
    std::function<bool(std::uint64_t blocks)> go_on;
    std::int64_t clock_s = 0;  ///< start of #3011/#3012 and #3002 (seconds since 1970); a fixed
                               ///< value, so that same inputs give the same bytes
    positioning::TcpFrame tcp_frame =
        positioning::TcpFrame::start;  ///< G43.4 with the table turned
};

}  // namespace trunnion::controller
