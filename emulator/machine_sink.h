// The junction of belief and reality: every move of the control drives the physical machine and its
// devices.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/ballbar_station.h"
#include "emulator/measure_station.h"
#include "emulator/path_sampler.h"
#include "emulator/tool_tip.h"
#include "emulator/touch_station.h"
#include "emulator/trace.h"
#include "setup/programmed_point.h"

namespace trunnion::emulator {

struct SinkOptions {
    std::uint64_t seed = 1;
    bool trace = false;
    double trace_step_mm = 0.0;   ///< > 0: SAMPLE rows at this distance along the path
    double trace_chord_mm = 0.0;  ///< > 0: SAMPLE rows so dense that X Y Z stay within this
                                  ///< distance of the straight lines between rows
    bool truth = false;
    bool automatic_ballbar = false;    ///< the bar reads without BALLBAR ON
    std::vector<std::string> measure;  ///< commands for MeasureStation before the program starts
    TraceChunk trace_chunk;            ///< empty: the trace is returned by take_trace
    std::string test = "run";          ///< test name until the program gives one
};

/// Advances the clock, follows the axes, answers G31 from the probe, reads the ballbar, writes the
/// trace. Lines printed by the program control it, like a PC on the serial line:
///   TEST words         names the test: the words joined by '_', in lower case except single
///                      letters (RADIAL A POS is radial_A_pos)
///   BALLBAR ON words   starts a pass, BALLBAR OFF ends it
///   SPINDLE 180, LOAD 80, TEMPERATURE 24, CLAMPED 1, EXTENSION 60
///                      settings of the operator (deg, kg, deg C, 0 or 1, mm)
///   SAMPLE 5           the ballbar reads every 5 degrees of the swept angle
///   POSITIONS DIRECT   rotations without a function use no store (empty mode), until POSITIONS
///   STORE
///   MEASURE LINEAR R1 X  other devices (MeasureStation)
///   MODE RTCP          (DPP, RTDFO, TW, DIRECT) positioning function until a move sets another
/// Readings are evaluated on the rows that are written, with device_row and Observer as in predict.
class MachineSink : public motion::MotionSink {
  public:
    /// `setup` must outlive the sink.
    MachineSink(const setup::Setup& setup, EffectModels effects, const SinkOptions& options);

    void place(const AxisPositions& machine);
    motion::MoveResult move(const motion::AxisMove& move) override;
    void dwell(double duration_s) override;
    void printed(std::string_view text);

    double clock_s() const { return clock_s_; }
    std::size_t readings() const { return log_.size(); }
    /// Ends all devices that still read.
    records::ReadingTable take_readings();
    std::string take_trace() { return trace_ ? trace_->take() : std::string(); }
    std::vector<std::string> take_notes() { return bar_.take_notes(); }

  private:
    void obey(std::string_view line);
    void set_shop(std::string_view line);
    void follow_mode(const motion::AxisMove& move);
    std::optional<Touch> probe(const motion::AxisMove& move);
    records::Reading row_now() const;
    void end_pass();
    std::vector<double> sample_places(const motion::AxisMove& move) const;
    void write_trace(const PathSampler& path, double end_s);
    Vector3 true_tip_W(const PathSampler& path, double s) const;

    const setup::Setup& setup_;
    SinkOptions options_;
    Observer machine_;
    TouchStation touch_;
    BallbarStation bar_;
    MeasureStation measure_;
    setup::ProgrammedPoint meant_;  ///< by the stores before the program
    ReadingLog log_;
    std::optional<TraceWriter> trace_;
    records::TravelHistory history_;  ///< of the path itself, for the true tip
    AxisPositions at_;
    double clock_s_ = 0.0;
    bool has_rotary_ = false;
    bool can_read_ = false;  ///< a device exists, so the path to its readings must be kept
    PositioningMode mode_ = PositioningMode::none;  ///< function that positioned the rotary axes
    PositioningMode plain_mode_ = PositioningMode::none;  ///< mode of rotations without a function
    records::ShopState shop_;
    std::string test_;  ///< name for readings outside passes
    std::string line_;
};

}  // namespace trunnion::emulator
