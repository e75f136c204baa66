// Where belief meets reality: every move of the control drives the physical machine and its
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

namespace trunnion::emulator {

struct SinkOptions {
    std::uint64_t seed = 1;
    bool trace = false;
    double trace_step_mm = 0.0;   ///< above 0: SAMPLE rows at this distance along the path
    double trace_chord_mm = 0.0;  ///< above 0: SAMPLE rows so close that X Y Z stay within this of
                                  ///< the straight lines between rows
    bool truth = false;
    bool automatic_ballbar = false;    ///< the bar reads without being told to
    std::vector<std::string> measure;  ///< words for MeasureStation, before the program begins
    TraceChunk trace_chunk;            ///< empty: the trace waits for take_trace
    std::string test = "run";          ///< name of the test until the program names one
};

/// Advances the clock, follows the axes, answers G31 from the probe, reads the ballbar, writes the
/// trace. Lines that the program prints steer it as a PC on the serial line would be steered:
/// `TEST words` names the test, `BALLBAR ON words` and `BALLBAR OFF` bound a pass. A name is the
/// words joined by '_', in lower case except single letters: RADIAL A POS is radial_A_pos. What the
/// operator set up is told the same way: SPINDLE 180, LOAD 80, TEMPERATURE 24, CLAMPED 1, EXTENSION
/// 60 (deg, kg, deg C, 0 or 1, mm). SAMPLE 5: the ballbar reads every 5 degrees of the swept angle.
/// POSITIONS DIRECT: turns without a function come from no store (empty mode); POSITIONS STORE ends
/// that. MEASURE LINEAR R1 X: other devices (MeasureStation). MODE RTCP (DPP, RTDFO, TW, DIRECT):
/// so the axes are placed until a move says otherwise. Readings are those of the rows that are
/// written: device_row and Observer, as predict asks.
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
    /// Ends what still reads.
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
    ReadingLog log_;
    std::optional<TraceWriter> trace_;
    records::TravelHistory history_;  ///< of the path itself, for the true tip
    AxisPositions at_;
    double clock_s_ = 0.0;
    bool has_rotary_ = false;
    bool can_read_ = false;  ///< there is a device, so the way to its readings counts
    PositioningMode mode_ = PositioningMode::none;  ///< function that positioned the rotary axes
    PositioningMode plain_mode_ = PositioningMode::none;  ///< of turns without a function
    records::ShopState shop_;
    std::string test_;  ///< of readings outside passes
    std::string line_;
};

}  // namespace trunnion::emulator
